import { Extremes } from "./extremes.js";
import { CanvasLayers } from "./layers.js";
import { Palette } from "./palette.js";
import { countUpTo } from "./series.js";
import { readable, readableTime } from "./quantities.js";

/** Pixels of an axis' lane. */
const LANE = 44;
/** Pixels below the lanes, for the times. */
const FOOT = 18;

/**
 * The errors of all axes over time, a lane each with a scale of its own. Dispatches `place` with
 * the row that is clicked.
 */
export class ErrorStrip extends EventTarget {
  /** @type {import("./series.js").Series | null} */
  #series = null;
  /** @type {Extremes[]} */
  #extremes = [];
  /** Largest error of each axis without its sign. @type {number[]} */
  #largest = [];
  #from = 0;
  #to = 1;
  #row = 0;
  #layers;
  #palette;

  /** @param {Record<string, import("./dom.js").AttributeValue>} attributes of the canvas */
  constructor(attributes) {
    super();
    this.#layers = new CanvasLayers(
      attributes,
      (context, width) => this.#drawLanes(context, width),
      (context, width) => this.#drawHead(context, width),
    );
    this.#palette = new Palette(this.#layers.node, () => this.#layers.markAll());
    this.#listen(this.#layers.above);
  }

  /** Element to put into the page. */
  get node() {
    return this.#layers.node;
  }

  /** Draws again, with the colours that there are now. */
  redraw() {
    this.#palette.renew();
  }

  /**
   * Shows the errors of a series from begin to end.
   * @param {import("./series.js").Series} series
   */
  show(series) {
    this.#series = series;
    this.#extremes = series.axes.map((axis) => new Extremes(axis.error));
    this.#largest = this.#extremes.map((extremes) => {
      const [least, greatest] = extremes.between(0, series.rows);
      return Math.max(0, -least, greatest);
    });
    this.node.style.height = `${series.axes.length * LANE + FOOT}px`;
    this.fit();
  }

  /**
   * Puts the play head at a row, which is brought into sight.
   * @param {number} row
   */
  moveTo(row) {
    if (!this.#series || row === this.#row) return;
    this.#row = row;
    const time = this.#series.times[row];
    const span = this.#to - this.#from;
    if (time < this.#from || time > this.#to) this.#window(time - span / 2, span);
    this.#layers.markAbove();
  }

  /** Shows the whole run. */
  fit() {
    const times = this.#series?.times;
    if (!times || times.length === 0) return;
    this.#window(times[0], times[times.length - 1] - times[0]);
  }

  /**
   * Zooms about the play head.
   * @param {number} factor
   */
  zoomAtHead(factor) {
    if (this.#series) this.#zoom(factor, this.#series.times[this.#row]);
  }

  /**
   * Moves the window by a part of it.
   * @param {number} part
   */
  pan(part) {
    const span = this.#to - this.#from;
    this.#window(this.#from + part * span, span);
  }

  /**
   * @param {number} factor
   * @param {number} time that stays
   */
  #zoom(factor, time) {
    this.#window(time - (time - this.#from) / factor, (this.#to - this.#from) / factor);
  }

  /**
   * Sets the window, within the run and no smaller than a few rows.
   * @param {number} from seconds
   * @param {number} span seconds
   */
  #window(from, span) {
    const times = this.#series?.times;
    if (!times || times.length === 0) return;
    const [first, whole] = [times[0], times[times.length - 1] - times[0]];
    const row = whole / Math.max(1, times.length - 1);
    const width = Math.max(Math.min(span, whole), Math.min(whole, 4 * row), 1e-12);
    this.#from = Math.max(first, Math.min(from, first + whole - width));
    this.#to = this.#from + width;
    this.#layers.markAll();
  }

  /** @param {HTMLCanvasElement} canvas */
  #listen(canvas) {
    /** @type {{ right: number, moved: boolean } | null} */
    let drag = null;
    canvas.addEventListener("wheel", (event) => {
      event.preventDefault();
      if (event.shiftKey) return this.pan(Math.sign(event.deltaY || event.deltaX) * 0.1);
      this.#zoom(2 ** (-event.deltaY * (event.deltaMode === 0 ? 0.002 : 0.05)), this.#timeAt(event));
    }, { passive: false });
    canvas.addEventListener("pointerdown", (event) => {
      if (event.button !== 0) return;
      drag = { right: this.#layers.place(event)[0], moved: false };
      canvas.setPointerCapture(event.pointerId);
    });
    canvas.addEventListener("pointermove", (event) => {
      if (!drag) return;
      const right = this.#layers.place(event)[0];
      if (!drag.moved && Math.abs(right - drag.right) < 4) return;
      this.pan((drag.right - right) / this.#layers.width);
      drag = { right, moved: true };
    });
    canvas.addEventListener("pointerup", (event) => {
      if (drag && !drag.moved && this.#series) {
        const row = Math.max(0, countUpTo(this.#series.times, this.#timeAt(event)) - 1);
        this.dispatchEvent(new CustomEvent("place", { detail: row }));
      }
      drag = null;
    });
    canvas.addEventListener("pointercancel", () => (drag = null));
  }

  /** @param {MouseEvent} event */
  #timeAt(event) {
    const part = this.#layers.place(event)[0] / Math.max(1, this.#layers.width);
    return this.#from + part * (this.#to - this.#from);
  }

  /**
   * @param {CanvasRenderingContext2D} context
   * @param {number} width
   */
  #drawLanes(context, width) {
    const series = this.#series;
    if (!series) return;
    context.font = "12px system-ui, sans-serif";
    const rowAt = (/** @type {number} */ right) =>
      countUpTo(series.times, this.#from + (right / width) * (this.#to - this.#from));
    series.axes.forEach((axis, k) => {
      const middle = k * LANE + LANE / 2;
      const scale = this.#largest[k] > 0 ? (LANE / 2 - 4) / this.#largest[k] : 0;
      context.fillStyle = this.#palette.colour("line");
      context.fillRect(0, Math.round(middle), width, 1);
      context.fillRect(0, (k + 1) * LANE - 1, width, 1);
      context.fillStyle = this.#palette.colour(`series-${(k % 6) + 1}`);
      let held = rowAt(0);
      for (let right = 0; right < width; right += 1) {
        const from = held;
        held = rowAt(right + 1);
        // A row holds up to the next one.
        const [least, greatest] = this.#extremes[k].between(Math.max(0, from - 1), Math.max(from, held));
        if (least > greatest) continue;
        const top = middle - greatest * scale;
        context.fillRect(right, top - 0.5, 1, Math.max(1.5, (greatest - least) * scale));
      }
      const label = `${axis.name}  ±${readable(this.#largest[k])} ${axis.unit}`;
      this.#drawLabel(context, label, 4, k * LANE + 13);
    });
    const foot = series.axes.length * LANE + 13;
    this.#drawLabel(context, readableTime(this.#from), 4, foot);
    const end = readableTime(this.#to);
    this.#drawLabel(context, end, width - context.measureText(end).width - 4, foot);
  }

  /**
   * Draws text on the back's colour, so that it can be read on the curve.
   * @param {CanvasRenderingContext2D} context
   * @param {string} text
   * @param {number} right
   * @param {number} down
   */
  #drawLabel(context, text, right, down) {
    context.globalAlpha = 0.8;
    context.fillStyle = this.#palette.colour("back");
    context.fillRect(right - 2, down - 11, context.measureText(text).width + 4, 14);
    context.globalAlpha = 1;
    context.fillStyle = this.#palette.colour("text");
    context.fillText(text, right, down);
  }

  /**
   * @param {CanvasRenderingContext2D} context
   * @param {number} width
   */
  #drawHead(context, width) {
    const series = this.#series;
    if (!series || series.rows === 0) return;
    const part = (series.times[this.#row] - this.#from) / (this.#to - this.#from);
    context.fillStyle = this.#palette.colour("accent");
    context.fillRect(Math.round(part * width) - 1, 0, 2, series.axes.length * LANE);
  }
}
