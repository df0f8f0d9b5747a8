import { CanvasLayers } from "./layers.js";
import { Palette } from "./palette.js";
import { element } from "./dom.js";
import { WavePainter } from "./wavepaint.js";
import { ROW_HEIGHT } from "./waverows.js";
import { TimeWindow, axisTicks, drawTimeAxis } from "./waveview.js";

/** @typedef {import("./column.js").Changes} Changes */
/** @typedef {import("./dump.js").Dump} Dump */
/** @typedef {import("./dump.js").DumpSignal} DumpSignal */
/** @typedef {import("./wavecursor.js").WaveCursor} WaveCursor */
/** @typedef {import("./waverows.js").WaveRow} WaveRow */
/** @typedef {import("./waverows.js").WaveRows} WaveRows */

/** Height of the time axis in pixels. */
const AXIS_HEIGHT = 36;
/** Pixels by which a pointer moves before the window is moved. */
const PAN_FROM = 4;
/** Zoom for a wheel's movement of a pixel: a usual notch of 100 is a factor of 1.3. */
const WHEEL_ZOOM = 0.0026;

/**
 * What the canvas asks and tells.
 * @typedef {object} CanvasUse
 * @property {() => number[]} sight indices of the visible rows in sight, the second exclusive
 * @property {() => number} scroll height in pixels above what is in sight
 * @property {() => WaveRow | null} selected
 * @property {(signal: DumpSignal) => Changes | undefined} changes
 * @property {(row: WaveRow) => void} select
 * @property {() => void} layout called when the size has changed
 * @property {(event: KeyboardEvent) => void} key
 */

/** Drawing of the rows in sight over time, with the time axis; zoomed and moved by the pointer. */
export class WaveCanvas {
  view = new TimeWindow();
  axis = element("canvas", { class: "waves-axis", "aria-hidden": "true" });
  /** @type {Dump | null} */
  #dump = null;
  /** @type {{x: number, begin: number, to: number, moved: boolean, zooms: boolean} | null} */
  #drag = null;
  /**
   * Times to show as soon as there is a width.
   * @type {{start: number, end: number} | null}
   */
  #wanted = null;
  #rows;
  #cursor;
  #use;
  #palette;
  #painter;
  #layers;

  /**
   * @param {HTMLElement} host element whose colours count
   * @param {WaveRows} rows
   * @param {WaveCursor} cursor
   * @param {CanvasUse} use
   */
  constructor(host, rows, cursor, use) {
    this.#rows = rows;
    this.#cursor = cursor;
    this.#use = use;
    this.#layers = new CanvasLayers(
      {
        role: "application",
        "aria-label": "Waves. Arrow keys move the cursor and select rows; all keys are listed under Keys",
        onkeydown: use.key,
        onpointerdown: (/** @type {PointerEvent} */ event) => this.#down(event),
        onpointermove: (/** @type {PointerEvent} */ event) => this.#move(event),
        onpointerup: (/** @type {PointerEvent} */ event) => this.#up(event),
        onpointercancel: () => (this.#drag = null),
        onwheel: (/** @type {WheelEvent} */ event) => this.#wheel(event),
      },
      (context, width, height) => this.#draw(context, width, height),
      (context, _, height) => this.#drawAbove(context, height),
    );
    this.node = this.#layers.node;
    this.node.addEventListener("layout", () => {
      this.#fill();
      use.layout();
    });
    this.#palette = new Palette(host, () => this.redraw());
    this.#painter = new WavePainter(this.#palette);
  }

  /**
   * Shows a dump.
   * @param {Dump} dump
   * @param {{start: number, end: number} | null} shown times; all if `null`
   */
  show(dump, shown) {
    this.#dump = dump;
    this.view.limit(dump.start, dump.end, dump.period);
    this.#wanted = shown ?? dump;
    this.#fill();
  }

  /** Has all drawn anew. */
  redraw() {
    this.#layers.markAll();
  }

  /** Has cursor and marker drawn anew. */
  redrawCursor() {
    this.#layers.markAbove();
  }

  #fill() {
    if (this.#layers.width === 0) return;
    this.view.resize(this.#layers.width);
    if (this.#wanted) this.view.show(this.#wanted.start, this.#wanted.end);
    this.#wanted = null;
  }

  /**
   * @param {CanvasRenderingContext2D} context
   * @param {number} width
   * @param {number} height
   */
  #draw(context, width, height) {
    const dump = this.#dump;
    if (!dump) return;
    this.#drawAxis(dump, width);
    this.#drawGrid(context, dump, height);
    this.#painter.prepare(context, width);
    const [from, to] = this.#use.sight();
    const scroll = this.#use.scroll();
    for (let index = from; index < to; index++) {
      const row = this.#rows.visible[index];
      const top = this.#rows.top(index) - scroll;
      if (row === this.#use.selected()) {
        context.globalAlpha = 0.12;
        context.fillStyle = this.#palette.colour("accent");
        context.fillRect(0, top, width, row.height * ROW_HEIGHT);
        context.globalAlpha = 1;
      }
      const changes = row.signal ? this.#use.changes(row.signal) : undefined;
      if (changes) this.#painter.paint(row, changes, this.view, top, dump.end);
    }
  }

  /**
   * @param {Dump} dump
   * @param {number} width
   */
  #drawAxis(dump, width) {
    const ratio = window.devicePixelRatio || 1;
    const canvas = this.axis;
    const wide = Math.round(width * ratio);
    if (canvas.width !== wide || canvas.height !== Math.round(AXIS_HEIGHT * ratio)) {
      canvas.width = wide;
      canvas.height = Math.round(AXIS_HEIGHT * ratio);
      canvas.style.width = `${width}px`;
      canvas.style.height = `${AXIS_HEIGHT}px`;
    }
    const context = canvas.getContext("2d");
    if (!context) return;
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    drawTimeAxis(context, this.view, dump, this.#palette, AXIS_HEIGHT);
  }

  /**
   * @param {CanvasRenderingContext2D} context
   * @param {Dump} dump
   * @param {number} height
   */
  #drawGrid(context, dump, height) {
    const view = this.view;
    const step = axisTicks(view, dump.period) * dump.period;
    context.strokeStyle = this.#palette.colour("line");
    context.globalAlpha = 0.5;
    context.beginPath();
    for (let i = Math.ceil(view.start / step); i * step <= view.end; i++) {
      const x = Math.round(view.x(i * step)) + 0.5;
      context.moveTo(x, 0);
      context.lineTo(x, height);
    }
    context.stroke();
    context.globalAlpha = 1;
  }

  /**
   * @param {CanvasRenderingContext2D} context
   * @param {number} height
   */
  #drawAbove(context, height) {
    if (!this.#dump) return;
    const { time, marker } = this.#cursor;
    /**
     * @param {number} at
     * @param {string} colour
     * @param {number[]} dashes
     */
    const line = (at, colour, dashes) => {
      const x = Math.round(this.view.x(at)) + 0.5;
      context.strokeStyle = this.#palette.colour(colour);
      context.setLineDash(dashes);
      context.beginPath();
      context.moveTo(x, 0);
      context.lineTo(x, height);
      context.stroke();
    };
    /**
     * @param {number} from
     * @param {number} to
     */
    const span = (from, to) => {
      context.globalAlpha = 0.1;
      context.fillStyle = this.#palette.colour("accent");
      context.fillRect(from, 0, to - from, height);
      context.globalAlpha = 1;
    };
    if (marker !== null) {
      span(this.view.x(marker), this.view.x(time));
      line(marker, "bad", [5, 4]);
    }
    line(time, "accent", []);
    if (this.#drag?.zooms) span(this.#drag.begin, this.#drag.to);
  }

  /** @param {PointerEvent} event */
  #down(event) {
    if (event.button !== 0) return;
    const [x] = this.#layers.place(event);
    const zooms = event.ctrlKey || event.metaKey;
    this.#drag = { x, begin: x, to: x, moved: false, zooms };
    this.#layers.above.setPointerCapture(event.pointerId);
  }

  /** @param {PointerEvent} event */
  #move(event) {
    const drag = this.#drag;
    if (!drag) return;
    const [x] = this.#layers.place(event);
    drag.moved ||= Math.abs(x - drag.begin) >= PAN_FROM;
    if (!drag.moved) return;
    drag.to = x;
    if (drag.zooms) {
      this.#layers.markAbove();
      return;
    }
    this.view.pan(drag.x - x);
    drag.x = x;
    this.redraw();
  }

  /** @param {PointerEvent} event */
  #up(event) {
    const drag = this.#drag;
    this.#drag = null;
    if (!drag) return;
    const [x, y] = this.#layers.place(event);
    if (drag.moved) {
      const [from, to] = [drag.begin, x].map((place) => this.view.time(place)).sort((a, b) => a - b);
      if (drag.zooms) this.view.show(from, to);
      this.redraw();
      return;
    }
    const row = this.#rows.visible[this.#rows.at(y + this.#use.scroll())];
    if (row) this.#use.select(row);
    const time = this.view.time(x);
    if (event.shiftKey) this.#cursor.markTickAt(time);
    else this.#cursor.goToTickAt(time);
  }

  /** @param {WheelEvent} event */
  #wheel(event) {
    if (!this.#dump) return;
    event.preventDefault();
    const scale = event.deltaMode === WheelEvent.DOM_DELTA_LINE ? ROW_HEIGHT : 1;
    const isSideways = event.shiftKey || Math.abs(event.deltaX) > Math.abs(event.deltaY);
    const delta = (event.deltaX || event.deltaY) * scale;
    if (isSideways) this.view.pan(delta);
    else this.view.zoom(Math.exp(event.deltaY * scale * WHEEL_ZOOM), this.#layers.place(event)[0]);
    this.redraw();
  }
}
