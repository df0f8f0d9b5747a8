import { CanvasLayers } from "./layers.js";
import { Palette } from "./palette.js";
import { Polyline } from "./reduction.js";
import { ISOMETRIC, displaced } from "./pathviews.js";
import { markText, scaleMarks } from "./quantities.js";

/** Free pixels around a path that fits, for the marks of the scales. */
const MARGIN = 44;
/** Points of a line that are drawn in a frame of a movement, and at rest after some milliseconds. */
const MOST_MOVING = 8_000;
const MOST_AT_REST = 60_000;
const REST_MS = 150;
/** Pixels within which the pointer is at the path. */
const REACH = 16;

/**
 * The drawing of a path: commanded and actual, with the error magnified. Zoomed and moved by wheel
 * and pointer. Dispatches `place` with the row at which the path is clicked, and `hover` with the
 * row under the pointer or null.
 */
export class PathCanvas extends EventTarget {
  /** @type {import("./series.js").Series | null} */
  #series = null;
  /** @type {import("./pathviews.js").PathView | null} */
  #view = null;
  /** @type {Polyline | null} */
  #commanded = null;
  /** @type {Polyline | null} */
  #actual = null;
  #magnification = 1;
  #row = 0;
  /** @type {number | null} */
  #hovered = null;
  #fitted = true;
  /** Timer while the drawing moves. */
  #resting = 0;
  /** @type {import("./reduction.js").PlaneWindow} */
  #window = { x0: 0, y0: 0, scaleX: 1, scaleY: 1, width: 1, height: 1 };
  #layers;
  #palette;

  /** @param {Record<string, import("./dom.js").AttributeValue>} attributes of the canvas */
  constructor(attributes) {
    super();
    this.#layers = new CanvasLayers(
      attributes,
      (context) => this.#drawPath(context),
      (context) => this.#drawHead(context),
    );
    this.#palette = new Palette(this.#layers.node, () => this.#layers.markAll());
    this.#layers.node.addEventListener("layout", () => this.#layout());
    this.#listen(this.#layers.above);
  }

  /** Element to put into the page. */
  get node() {
    return this.#layers.node;
  }

  /**
   * Shows a series in a view, as large as it fits.
   * @param {import("./series.js").Series} series
   * @param {import("./pathviews.js").PathView} view
   * @param {number} magnification of the error
   * @param {boolean} keepsZoom
   */
  show(series, view, magnification, keepsZoom) {
    this.#series = series;
    this.#view = view;
    this.#hovered = null;
    const [xs, ys] = view.project(displaced(view.group, 0), series.times);
    this.#commanded = new Polyline(xs, ys);
    this.#fitted = this.#fitted || !keepsZoom;
    this.magnify(magnification);
  }

  /** Draws again, with the colours that there are now. */
  redraw() {
    this.#palette.renew();
  }

  /** @param {number} magnification */
  magnify(magnification) {
    this.#magnification = magnification;
    if (!this.#series || !this.#view) return;
    const [xs, ys] = this.#view.project(displaced(this.#view.group, magnification), this.#series.times);
    this.#actual = new Polyline(xs, ys);
    if (this.#fitted) this.fit();
    this.#layers.markAll();
  }

  /**
   * Puts the play head at a row.
   * @param {number} row
   */
  moveTo(row) {
    if (row === this.#row) return;
    this.#row = row;
    this.#layers.markAbove();
  }

  /** Shows all of it. */
  fit() {
    if (!this.#commanded || !this.#actual || !this.#view) return;
    const [first, second] = [this.#commanded.bounds(), this.#actual.bounds()];
    const [left, bottom] = [Math.min(first[0], second[0]), Math.min(first[2], second[2])];
    const [right, top] = [Math.max(first[1], second[1]), Math.max(first[3], second[3])];
    const { width, height } = this.#layers;
    // A path along one axis has no extent along the other.
    const least = Math.max(right - left, top - bottom, 1e-9) * 1e-6;
    let scaleX = Math.max(1, width - 2 * MARGIN) / Math.max(right - left, least);
    let scaleY = Math.max(1, height - 2 * MARGIN) / Math.max(top - bottom, least);
    if (this.#view.trueAspect) scaleX = scaleY = Math.min(scaleX, scaleY);
    this.#window = { x0: (left + right) / 2, y0: (bottom + top) / 2, scaleX, scaleY, width, height };
    this.#fitted = true;
    this.#layers.markAll();
  }

  /**
   * Zooms about the play head, which is moved into the middle if it is out of sight.
   * @param {number} factor
   */
  zoomAtHead(factor) {
    const { width, height } = this.#window;
    const [right, down] = this.#commanded ? this.#pixel(this.#commanded, this.#row) : [width / 2, height / 2];
    if (right < 0 || down < 0 || right > width || down > height) {
      this.pan(width / 2 - right, height / 2 - down);
      this.#zoom(factor, width / 2, height / 2);
    } else {
      this.#zoom(factor, right, down);
    }
  }

  /**
   * Moves the drawing.
   * @param {number} right pixels
   * @param {number} down pixels
   */
  pan(right, down) {
    this.#window.x0 -= right / this.#window.scaleX;
    this.#window.y0 += down / this.#window.scaleY;
    this.#moved();
  }

  #moved() {
    this.#fitted = false;
    this.#layers.markAll();
    clearTimeout(this.#resting);
    this.#resting = setTimeout(() => {
      this.#resting = 0;
      this.#layers.markAll();
    }, REST_MS);
  }

  /**
   * @param {number} factor
   * @param {number} right place that stays, in pixels
   * @param {number} down
   */
  #zoom(factor, right, down) {
    const view = this.#window;
    const [fromX, fromY] = [right - view.width / 2, down - view.height / 2];
    const [before, above] = [view.scaleX, view.scaleY];
    view.scaleX *= factor;
    // Over time only the time is stretched.
    if (this.#view?.trueAspect) view.scaleY *= factor;
    view.x0 += fromX / before - fromX / view.scaleX;
    view.y0 -= fromY / above - fromY / view.scaleY;
    this.#moved();
  }

  #layout() {
    this.#window.width = this.#layers.width;
    this.#window.height = this.#layers.height;
    if (this.#fitted) this.fit();
  }

  /** @param {HTMLCanvasElement} canvas */
  #listen(canvas) {
    /** @type {{ right: number, down: number, moved: boolean } | null} */
    let drag = null;
    canvas.addEventListener("wheel", (event) => {
      event.preventDefault();
      const [right, down] = this.#layers.place(event);
      this.#zoom(2 ** (-event.deltaY * (event.deltaMode === 0 ? 0.002 : 0.05)), right, down);
    }, { passive: false });
    canvas.addEventListener("pointerdown", (event) => {
      if (event.button !== 0) return;
      const [right, down] = this.#layers.place(event);
      drag = { right, down, moved: false };
      canvas.setPointerCapture(event.pointerId);
    });
    canvas.addEventListener("pointermove", (event) => {
      const [right, down] = this.#layers.place(event);
      if (!drag) return this.#hover(this.#rowAt(right, down));
      if (!drag.moved && Math.hypot(right - drag.right, down - drag.down) < 4) return;
      this.pan(right - drag.right, down - drag.down);
      drag = { right, down, moved: true };
    });
    canvas.addEventListener("pointerup", (event) => {
      if (drag && !drag.moved) {
        const row = this.#rowAt(...this.#layers.place(event));
        if (row !== null) this.dispatchEvent(new CustomEvent("place", { detail: row }));
      }
      drag = null;
    });
    canvas.addEventListener("pointercancel", () => (drag = null));
    canvas.addEventListener("pointerleave", () => this.#hover(null));
  }

  /** @param {number | null} row */
  #hover(row) {
    if (row === this.#hovered) return;
    this.#hovered = row;
    this.#layers.markAbove();
    this.dispatchEvent(new CustomEvent("hover", { detail: row }));
  }

  /**
   * @param {number} right
   * @param {number} down
   */
  #rowAt(right, down) {
    const at = (/** @type {Polyline | null} */ line) =>
      line?.nearest(this.#window, right, down, REACH, this.#row) ?? null;
    return at(this.#commanded) ?? at(this.#actual);
  }

  /**
   * @param {Polyline} line
   * @param {number} row
   * @returns {[number, number]}
   */
  #pixel(line, row) {
    const { x0, y0, scaleX, scaleY, width, height } = this.#window;
    return [width / 2 + (line.xs[row] - x0) * scaleX, height / 2 - (line.ys[row] - y0) * scaleY];
  }

  /** @param {CanvasRenderingContext2D} context */
  #drawPath(context) {
    if (!this.#view || !this.#commanded || !this.#actual) return;
    if (this.#view.captions) this.#drawScales(context, this.#view.captions);
    else this.#drawDirections(context);
    context.lineJoin = context.lineCap = "round";
    this.#stroke(context, this.#commanded, "series-1", 3);
    this.#stroke(context, this.#actual, "series-2", 1.25);
  }

  /**
   * @param {CanvasRenderingContext2D} context
   * @param {Polyline} line
   * @param {string} colour
   * @param {number} width
   */
  #stroke(context, line, colour, width) {
    context.strokeStyle = this.#palette.colour(colour);
    context.lineWidth = width;
    line.stroke(context, this.#window, this.#resting === 0 ? MOST_AT_REST : MOST_MOVING);
  }

  /**
   * @param {CanvasRenderingContext2D} context
   * @param {[string, string]} captions
   */
  #drawScales(context, captions) {
    const { x0, y0, scaleX, scaleY, width, height } = this.#window;
    const [halfX, halfY] = [width / 2 / scaleX, height / 2 / scaleY];
    const across = scaleMarks(x0 - halfX, x0 + halfX, width / 110);
    const upward = scaleMarks(y0 - halfY, y0 + halfY, height / 70);
    context.beginPath();
    for (const x of across.values) {
      const right = Math.round(width / 2 + (x - x0) * scaleX) + 0.5;
      context.moveTo(right, 0);
      context.lineTo(right, height);
    }
    for (const y of upward.values) {
      const down = Math.round(height / 2 - (y - y0) * scaleY) + 0.5;
      context.moveTo(0, down);
      context.lineTo(width, down);
    }
    context.strokeStyle = this.#palette.colour("line");
    context.lineWidth = 1;
    context.stroke();
    this.#textStyle(context);
    context.textAlign = "left";
    for (const x of across.values) {
      const right = width / 2 + (x - x0) * scaleX;
      // The lower corners belong to the captions.
      if (right > 40 && right < width - 140) context.fillText(markText(x, across.step), right + 3, height - 6);
    }
    for (const y of upward.values) {
      const down = height / 2 - (y - y0) * scaleY;
      if (down > 40 && down < height - 24) context.fillText(markText(y, upward.step), 4, down - 4);
    }
    context.fillStyle = this.#palette.colour("text");
    context.fillText(captions[1], 4, 16);
    context.textAlign = "right";
    context.fillText(captions[0], width - 6, height - 6);
  }

  /**
   * Draws the directions of X, Y and Z, and a length.
   * @param {CanvasRenderingContext2D} context
   */
  #drawDirections(context) {
    const view = this.#view;
    if (!view) return;
    const { scaleX, width, height } = this.#window;
    const [right, down, length] = [48, height - 62, 40];
    context.beginPath();
    for (const [x, y] of ISOMETRIC) {
      context.moveTo(right, down);
      context.lineTo(right + x * length, down - y * length);
    }
    const { step } = scaleMarks(0, width / scaleX, 6);
    context.moveTo(width - 16 - step * scaleX, height - 24);
    context.lineTo(width - 16, height - 24);
    context.strokeStyle = this.#palette.colour("faint");
    context.lineWidth = 1.5;
    context.stroke();
    this.#textStyle(context);
    context.textAlign = "center";
    view.group.axes.forEach((axis, k) => {
      const [x, y] = ISOMETRIC[k];
      context.fillText(axis.name, right + x * length * 1.3, down - y * length * 1.3 + 4);
    });
    context.textAlign = "right";
    context.fillText(`${markText(step, step)} ${view.group.unit}`, width - 16, height - 8);
  }

  /** @param {CanvasRenderingContext2D} context */
  #textStyle(context) {
    context.font = "12px system-ui, sans-serif";
    context.textBaseline = "alphabetic";
    context.fillStyle = this.#palette.colour("faint");
  }

  /** @param {CanvasRenderingContext2D} context */
  #drawHead(context) {
    if (this.#hovered !== null) this.#drawPoint(context, this.#hovered, "text", 4);
    this.#drawPoint(context, this.#row, "accent", 6);
  }

  /**
   * Draws the commanded point as a ring, the actual one as a disc, and the error between them.
   * @param {CanvasRenderingContext2D} context
   * @param {number} row
   * @param {string} colour
   * @param {number} radius
   */
  #drawPoint(context, row, colour, radius) {
    if (!this.#commanded || !this.#actual) return;
    const [from, to] = [this.#pixel(this.#commanded, row), this.#pixel(this.#actual, row)];
    context.strokeStyle = context.fillStyle = this.#palette.colour(colour);
    context.lineWidth = 2;
    context.beginPath();
    context.moveTo(...from);
    context.lineTo(...to);
    context.stroke();
    context.beginPath();
    context.arc(...from, radius, 0, 2 * Math.PI);
    context.stroke();
    context.beginPath();
    context.arc(...to, radius / 2, 0, 2 * Math.PI);
    context.fill();
  }
}
