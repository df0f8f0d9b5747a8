import { CanvasLayers } from "./layers.js";
import { Palette } from "./palette.js";
import { PathPicture } from "./pathpicture.js";
import { drawDirections, drawScales } from "./pathscales.js";
import { displaced } from "./pathviews.js";
import { Polyline } from "./reduction.js";

/** Free pixels around a path that fits, for the marks of the scales. */
const MARGIN = 44;
/** Pixels of lines that are drawn in each frame; where there are more, a picture is drawn once. */
const MOST_IN_FRAME = 100_000;
/** Milliseconds after which a drawing rests. */
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
  /** True if the lines are shown as a picture. */
  #isDense = false;
  #picture = new PathPicture(() => this.#lines());
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
    this.#palette = new Palette(this.#layers.node, () => this.#renew());
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
    this.#renew();
  }

  #renew() {
    this.#picture.clear();
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
    const { captions, group } = this.#view;
    if (captions) drawScales(context, this.#window, this.#palette, captions);
    else drawDirections(context, this.#window, this.#palette, group);
    const rests = this.#resting === 0;
    // At rest only: another scale needs points of its own, which take longer than a frame.
    if (rests || !this.#isDense) {
      this.#isDense = this.#commanded.effort(this.#window) + this.#actual.effort(this.#window) > MOST_IN_FRAME;
    }
    if (!this.#isDense) {
      context.lineJoin = context.lineCap = "round";
      for (const { line, colour, thickness } of this.#lines()) {
        context.strokeStyle = colour;
        context.lineWidth = thickness;
        line.stroke(context, this.#window);
      }
    } else if (this.#picture.show(context, this.#window, rests)) {
      this.#layers.markBase();
    }
  }

  /** The lines, the upper one last. */
  #lines() {
    if (!this.#commanded || !this.#actual) return [];
    return [
      { line: this.#commanded, colour: this.#palette.colour("series-1"), thickness: 3 },
      { line: this.#actual, colour: this.#palette.colour("series-2"), thickness: 1.25 },
    ];
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
