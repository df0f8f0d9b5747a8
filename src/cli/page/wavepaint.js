import { indexAt, valueOf } from "./dump.js";
import { collectColumns, pixelColumns, shownNumbers, valueText } from "./valueformat.js";
import { Extremes } from "./extremes.js";
import { ROW_HEIGHT } from "./waverows.js";

/** @typedef {import("./column.js").Changes} Changes */
/** @typedef {import("./dump.js").DumpSignal} DumpSignal */
/** @typedef {import("./waverows.js").WaveRow} WaveRow */
/** @typedef {import("./waveview.js").TimeWindow} TimeWindow */

/** Space in pixels above and below a wave. */
const WAVE_MARGIN = 4;
/** Least width in pixels of a value that is shown as text. */
const LEAST_TEXT = 18;
/** Half the width in pixels of the crossing between two values. */
const CROSSING = 3;
const WAVE_FONT = "11px ui-monospace, monospace";
const FILLED = 0.16;
const DENSE = 0.6;

/** Painter of rows on a canvas. */
export class WavePainter {
  /** @type {CanvasRenderingContext2D} */
  // @ts-expect-error: set by `prepare`, without which nothing is painted.
  #context;
  #columns = pixelColumns(0);
  #character = 7;
  #colors;
  /** @type {WeakMap<WaveRow, {key: string, changes: Changes, extremes: Extremes}>} */
  #curves = new WeakMap();

  /** @param {import("./palette.js").Palette} colors */
  constructor(colors) {
    this.#colors = colors;
  }

  /**
   * Prepares for painting.
   * @param {CanvasRenderingContext2D} context
   * @param {number} width in pixels
   */
  prepare(context, width) {
    if (this.#columns.x.length < width + 1) this.#columns = pixelColumns(width);
    this.#context = context;
    this.#context.font = WAVE_FONT;
    this.#context.textBaseline = "middle";
    this.#character = this.#context.measureText("0").width;
  }

  /**
   * Paints a row whose upper edge is at `top`.
   * @param {WaveRow} row
   * @param {Changes} changes
   * @param {TimeWindow} view
   * @param {number} top
   * @param {number} end time after which nothing is known
   */
  paint(row, changes, view, top, end) {
    const { signal } = row;
    if (!signal) return;
    const right = Math.min(view.width, view.x(end));
    if (right <= 0) return;
    const box = {
      high: Math.round(top + WAVE_MARGIN) + 0.5,
      low: Math.round(top + row.height * ROW_HEIGHT - WAVE_MARGIN) - 0.5,
      right,
    };
    collectColumns(changes.times, view.start, view.perPixel, right, this.#columns);
    this.#context.strokeStyle = this.#colors.colour(row.color);
    this.#context.fillStyle = this.#colors.colour(row.color);
    this.#context.lineWidth = 1;
    if (row.curve !== "no" && signal.kind !== "text") this.#curve(row, signal, changes, view, box);
    else if (signal.width === 1 && row.format.radix !== "state") this.#bit(changes, view, box);
    else this.#bus(row, signal, changes, view, box);
  }

  /**
   * Goes over the times between changes, and over the columns with several changes, which are
   * joined where they touch.
   * @param {Changes} changes
   * @param {TimeWindow} view
   * @param {number} right
   * @param {(from: number, to: number, index: number) => void} steady
   * @param {(from: number, to: number) => void} dense
   */
  #walk(changes, view, right, steady, dense) {
    const { count, x, first, last } = this.#columns;
    let index = indexAt(changes, view.start);
    let from = Math.max(0, index >= 0 ? 0 : view.x(changes.times[0] ?? Infinity));
    for (let i = 0; i < count; i++) {
      if (x[i] > from) steady(from, x[i], index);
      index = last[i];
      from = x[i];
      if (first[i] === last[i]) continue;
      const begin = i;
      while (i + 1 < count && first[i + 1] !== last[i + 1] && x[i + 1] === x[i] + 1) i++;
      index = last[i];
      from = x[begin] + (i - begin) + 1;
      dense(x[begin], Math.min(from, right));
    }
    if (from < right) steady(from, right, index);
  }

  /**
   * @param {Changes} changes
   * @param {TimeWindow} view
   * @param {{high: number, low: number, right: number}} box
   */
  #bit(changes, view, { high, low, right }) {
    const context = this.#context;
    const { values, unknown } = changes;
    /** @type {number | null} */
    let before = null;
    context.beginPath();
    const steady = (/** @type {number} */ from, /** @type {number} */ to, /** @type {number} */ i) => {
      if (i < 0) return;
      if (unknown?.[i]) {
        this.#unknownBox(from, to, high, low);
        before = null;
        return;
      }
      const y = Number(values[i]) ? high : low;
      const begin = Math.round(from) + 0.5;
      if (before === null) context.moveTo(begin, y);
      else if (before !== y) {
        context.lineTo(begin, before);
        context.lineTo(begin, y);
      }
      context.lineTo(Math.round(to) + 0.5, y);
      before = y;
      if (y === high) {
        context.globalAlpha = FILLED;
        context.fillRect(from, high, to - from, low - high);
        context.globalAlpha = 1;
      }
    };
    this.#walk(changes, view, right, steady, (from, to) => {
      this.#denseBox(from, to, high, low);
      before = null;
    });
    context.stroke();
  }

  /**
   * @param {WaveRow} row
   * @param {DumpSignal} signal
   * @param {Changes} changes
   * @param {TimeWindow} view
   * @param {{high: number, low: number, right: number}} box
   */
  #bus(row, signal, changes, view, { high, low, right }) {
    const context = this.#context;
    const middle = (high + low) / 2;
    /** @type {[string, number][]} */
    const texts = [];
    context.beginPath();
    const steady = (/** @type {number} */ from, /** @type {number} */ to, /** @type {number} */ i) => {
      if (i < 0) return;
      if (changes.unknown?.[i]) {
        this.#unknownBox(from, to, high, low);
      } else {
        const slope = Math.min(CROSSING, (to - from) / 2);
        // A value that begins left of the window or goes on right of it has no crossing there.
        const left = from <= 0 ? 0 : slope;
        const behind = to >= right ? 0 : slope;
        context.moveTo(from, left ? middle : high);
        context.lineTo(from + left, high);
        context.lineTo(to - behind, high);
        if (behind) context.lineTo(to, middle);
        else context.moveTo(to, low);
        context.lineTo(to - behind, low);
        context.lineTo(from + left, low);
        if (left) context.lineTo(from, middle);
      }
      const room = Math.floor((to - from - 2 * CROSSING - 2) / this.#character);
      if (to - from < LEAST_TEXT || room < 1) return;
      const text = valueText(valueOf(changes, i), signal, row.format);
      if (text.length <= room) texts.push([text, from + CROSSING + 2]);
      else if (room > 2) texts.push([`${text.slice(0, room - 1)}…`, from + CROSSING + 2]);
    };
    this.#walk(changes, view, right, steady, (from, to) => this.#denseBox(from, to, high, low));
    context.stroke();
    context.fillStyle = this.#colors.colour("text");
    for (const [text, x] of texts) context.fillText(text, x, middle + 0.5);
  }

  /**
   * @param {WaveRow} row
   * @param {DumpSignal} signal
   * @param {Changes} changes
   * @param {TimeWindow} view
   * @param {{high: number, low: number, right: number}} box
   */
  #curve(row, signal, changes, view, { high, low, right }) {
    const context = this.#context;
    const extremes = this.#extremes(row, signal, changes);
    const { numbers } = extremes;
    const { count, x, first, last } = this.#columns;
    const before = indexAt(changes, view.start);
    const behind = count > 0 ? last[count - 1] : before;
    const [least, greatest] = extremes.between(Math.max(0, before), behind + 1);
    if (!(least <= greatest)) return;
    const scale = greatest > least ? (low - high) / (greatest - least) : 0;
    /** @param {number} number */
    const y = (number) => (scale ? low - (number - least) * scale : (low + high) / 2);
    const isStep = row.curve === "step";

    context.beginPath();
    let isDrawn = before >= 0 && !Number.isNaN(numbers[before]);
    if (isDrawn) {
      // A line comes from its last point, which may be far left of the window.
      context.moveTo(isStep ? 0 : view.x(changes.times[before]), y(numbers[before]));
    }
    let level = numbers[before];
    for (let i = 0; i < count; i++) {
      if (isDrawn && isStep) context.lineTo(x[i], y(level));
      const previous = level;
      level = numbers[last[i]];
      if (first[i] !== last[i]) {
        let [bottom, top] = extremes.between(first[i], last[i] + 1);
        if (bottom <= top) {
          // The curve comes from the level before.
          if (previous < bottom) bottom = previous;
          if (previous > top) top = previous;
          context.moveTo(x[i] + 0.5, Math.max(y(bottom), y(top) + 1));
          context.lineTo(x[i] + 0.5, y(top));
          context.moveTo(x[i] + 0.5, y(level));
        }
      }
      const wasDrawn = isDrawn;
      isDrawn = !Number.isNaN(level);
      if (isDrawn && first[i] === last[i]) {
        if (wasDrawn) context.lineTo(x[i], y(level));
        else context.moveTo(x[i], y(level));
      }
    }
    if (isDrawn) {
      const next = isStep ? -1 : behind + 1;
      if (next > 0 && next < numbers.length) {
        context.lineTo(view.x(changes.times[next]), y(numbers[next]));
      } else {
        context.lineTo(right, y(level));
      }
    }
    context.stroke();
    if (row.height > 1) this.#range(row, signal, least, greatest, high, low);
  }

  /**
   * Writes the range of a curve at its left edge.
   * @param {WaveRow} row
   * @param {DumpSignal} signal
   * @param {number} least
   * @param {number} greatest
   * @param {number} high
   * @param {number} low
   */
  #range(row, signal, least, greatest, high, low) {
    const context = this.#context;
    const unit = row.format.unit ? ` ${row.format.unit}` : "";
    /**
     * @param {number} number
     * @param {number} y
     */
    const label = (number, y) => {
      const text = `${Number(number.toPrecision(8))}${unit}`;
      context.globalAlpha = 0.75;
      context.fillStyle = this.#colors.colour("back");
      context.fillRect(2, y - 6, text.length * this.#character + 4, 12);
      context.globalAlpha = 1;
      context.fillStyle = this.#colors.colour("faint");
      context.fillText(text, 4, y + 0.5);
    };
    label(greatest, high + 5);
    if (least < greatest) label(least, low - 5);
  }

  /**
   * @param {WaveRow} row
   * @param {DumpSignal} signal
   * @param {Changes} changes
   */
  #extremes(row, signal, changes) {
    const { radix, fraction, scale } = row.format;
    const key = `${radix} ${fraction} ${scale}`;
    let curve = this.#curves.get(row);
    if (!curve || curve.key !== key || curve.changes !== changes) {
      const numbers = shownNumbers(changes, signal, row.format);
      curve = { key, changes, extremes: new Extremes(numbers) };
      this.#curves.set(row, curve);
    }
    return curve.extremes;
  }

  /**
   * @param {number} from
   * @param {number} to
   * @param {number} high
   * @param {number} low
   */
  #denseBox(from, to, high, low) {
    this.#context.globalAlpha = DENSE;
    this.#context.fillRect(from, high, to - from, low - high);
    this.#context.globalAlpha = 1;
  }

  /**
   * @param {number} from
   * @param {number} to
   * @param {number} high
   * @param {number} low
   */
  #unknownBox(from, to, high, low) {
    const color = this.#context.fillStyle;
    this.#context.globalAlpha = 2 * FILLED;
    this.#context.fillStyle = this.#colors.colour("bad");
    this.#context.fillRect(from, high, Math.max(1, to - from), low - high);
    this.#context.globalAlpha = 1;
    this.#context.fillStyle = color;
  }
}
