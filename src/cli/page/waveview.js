/** Least time in a window, in periods of the clock. */
const LEAST_PERIODS = 2;
/** Least time in a window, in units of the dump. */
const LEAST_UNITS = 4;
/** Part of the dump's length that is shown beside it. */
const SLACK = 0.02;

/** Window of time that a canvas shows: times are in units of the dump, places in pixels. */
export class TimeWindow {
  start = 0;
  span = 1;
  #width = 1;
  #from = 0;
  #to = 1;
  #least = LEAST_UNITS;

  /** Width in pixels. */
  get width() {
    return this.#width;
  }

  /** Time per pixel. */
  get perPixel() {
    return this.span / this.#width;
  }

  /** Time at the right edge. */
  get end() {
    return this.start + this.span;
  }

  /** @param {number} width in pixels */
  resize(width) {
    this.#width = Math.max(1, width);
  }

  /**
   * Sets what there is to see.
   * @param {number} from
   * @param {number} to
   * @param {number} period of the clock
   */
  limit(from, to, period) {
    this.#from = from;
    this.#to = Math.max(to, from + 1);
    this.#least = Math.max(LEAST_UNITS, LEAST_PERIODS * period);
  }

  /** @param {number} time */
  x(time) {
    return ((time - this.start) * this.#width) / this.span;
  }

  /** @param {number} x */
  time(x) {
    return this.start + (x * this.span) / this.#width;
  }

  /** Shows all. */
  fit() {
    this.show(this.#from, this.#to);
  }

  /**
   * @param {number} from
   * @param {number} to
   */
  show(from, to) {
    const length = this.#to - this.#from;
    const most = Math.max(this.#least, length * (1 + 2 * SLACK));
    this.span = Math.min(most, Math.max(this.#least, to - from));
    const slack = Math.min(length, this.span) * SLACK;
    const last = Math.max(this.#from - slack, this.#to + slack - this.span);
    const middle = (from + to) / 2;
    this.start = Math.min(last, Math.max(this.#from - slack, middle - this.span / 2));
  }

  /**
   * Zooms so that the time at a place stays there; a factor above 1 shows more time.
   * @param {number} factor
   * @param {number} x
   */
  zoom(factor, x) {
    const time = this.time(x);
    const span = Math.min(
      (this.#to - this.#from) * (1 + 2 * SLACK),
      Math.max(this.#least, this.span * factor),
    );
    const start = time - (x * span) / this.#width;
    this.show(start, start + span);
  }

  /** @param {number} pixels to the right */
  pan(pixels) {
    const start = this.start + pixels * this.perPixel;
    this.show(start, start + this.span);
  }

  /**
   * True if a time is in the window.
   * @param {number} time
   */
  has(time) {
    return time >= this.start && time <= this.end;
  }

  /**
   * Moves a time into the middle of the window if it is not in it.
   * @param {number} time
   */
  reveal(time) {
    if (!this.has(time)) this.show(time - this.span / 2, time + this.span / 2);
  }
}

/**
 * Returns the least step of 1, 2 or 5 times a power of ten that is not below `least`.
 * @param {number} least
 */
export function roundStep(least) {
  const power = 10 ** Math.floor(Math.log10(least));
  return [1, 2, 5, 10].map((digit) => digit * power).find((step) => step >= least * 0.999999) ?? 10 * power;
}

/**
 * Returns a time as text with the digits that a step needs.
 * @param {number} seconds
 * @param {number} step in seconds
 */
export function secondsText(seconds, step) {
  const size = Math.abs(seconds);
  /** @type {[number, string][]} */
  const units = [
    [1, "s"],
    [1e-3, "ms"],
    [1e-6, "µs"],
    [1e-9, "ns"],
    [1e-12, "ps"],
    [1e-15, "fs"],
  ];
  const [unit, name] = units.find(([least]) => size >= least * 0.9999999) ?? [1, "s"];
  const digits = Math.max(0, Math.ceil(Math.log10(unit / step) - 1e-9));
  return `${(seconds / unit).toFixed(Math.min(15, digits))} ${name}`;
}

/**
 * Draws the time axis: ticks above, seconds below.
 * @param {CanvasRenderingContext2D} context
 * @param {TimeWindow} view
 * @param {{period: number, unit: number}} dump
 * @param {import("./palette.js").Palette} colors
 * @param {number} height in pixels
 */
export function drawTimeAxis(context, view, { period, unit }, colors, height) {
  context.clearRect(0, 0, view.width, height);
  context.font = "11px system-ui, sans-serif";
  context.textBaseline = "middle";
  context.fillStyle = colors.colour("text");
  context.strokeStyle = colors.colour("line");
  const least = axisSpacing(view);
  /**
   * @param {number} size of a step's unit in units of time
   * @param {number} step
   * @param {number} y
   * @param {(number: number) => string} text
   */
  const labels = (size, step, y, text) => {
    context.beginPath();
    const last = Math.floor(view.end / size / step);
    // There is no time before 0.
    for (let i = Math.max(0, Math.ceil(view.start / size / step)); i <= last; i++) {
      const x = view.x(i * step * size);
      context.moveTo(Math.round(x) + 0.5, y - height / 4);
      context.lineTo(Math.round(x) + 0.5, y + height / 4);
      context.fillText(text(i * step), x + 4, y);
    }
    context.stroke();
  };
  labels(period, axisTicks(view, period), height / 4, (tick) => tick.toLocaleString("en"));
  const step = roundStep(least * unit);
  labels(1 / unit, step, (3 * height) / 4, (seconds) =>
    seconds === 0 ? "0 s" : secondsText(seconds, step),
  );
}

/**
 * Returns the number of ticks between two labels.
 * @param {TimeWindow} view
 * @param {number} period
 */
export function axisTicks(view, period) {
  return Math.max(1, roundStep(axisSpacing(view) / period));
}

/**
 * Returns the least time between two labels.
 * @param {TimeWindow} view
 */
function axisSpacing(view) {
  return 110 * view.perPixel;
}
