import { firstAt } from "./dump.js";

/** @typedef {import("./dump.js").DumpSignal} DumpSignal */
/** @typedef {import("./dump.js").DumpValue} DumpValue */
/** @typedef {import("./column.js").Changes} Changes */

/**
 * How the values of a signal are shown. `state` shows the name of a value, or the number if it has
 * none. Numbers in `unsigned` and `signed` are divided by 2 to the power of `fraction`, multiplied
 * by `scale` and followed by `unit`.
 * @typedef {object} ValueFormat
 * @property {"binary" | "hex" | "unsigned" | "signed" | "state"} radix
 * @property {number} [fraction] number of fraction bits
 * @property {number} [scale]
 * @property {string} [unit]
 */

/**
 * A unit of length or angle, how much of it a count is, and a text for both.
 * @typedef {{ name: string, scale: number, text: string }} RealUnit
 */

/**
 * Returns the units in which positions of a run, which are counts, are real ones.
 * @param {any} summary JSON of `run --json`
 * @returns {RealUnit[]}
 */
export function realUnits({ settings }) {
  // A value for all axes, or one for each.
  const values = (/** @type {unknown} */ given) => [...new Set([given].flat().map(Number))].filter((count) => count > 0);
  return [
    ...values(settings?.counts_per_mm).map((count) => ({ name: "mm", scale: 1 / count, text: `Counts as mm, 1/${count}` })),
    ...values(settings?.counts_per_rev).map((count) => ({ name: "deg", scale: 360 / count, text: `Counts as deg, 360/${count}` })),
  ];
}

/** Radices in the order in which a menu lists them. */
export const RADICES = /** @type {const} */ (["binary", "hex", "unsigned", "signed", "state"]);

/** Most fraction bits whose decimal digits are all shown. */
const EXACT_FRACTION = 10;

/**
 * Returns the format in which a signal is shown at first.
 * @param {DumpSignal} signal
 * @returns {ValueFormat}
 */
export function usualFormat(signal) {
  if (signal.kind === "text" || signal.table) return { radix: "state" };
  return { radix: signal.width === 1 ? "binary" : "unsigned" };
}

/**
 * Returns a value as text; "" if there is none.
 * @param {DumpValue} value
 * @param {DumpSignal} signal
 * @param {ValueFormat} format
 */
export function valueText(value, signal, format) {
  if (value === null) return "";
  if (value === "x" || value === "z") return value;
  if (signal.kind === "text") return signal.table?.get(Number(value)) ?? String(value);
  if (signal.kind === "real") return scaledText(Number(value), format);
  switch (format.radix) {
    case "binary":
      return value.toString(2).padStart(signal.width, "0");
    case "hex":
      return value.toString(16).padStart(Math.ceil(signal.width / 4), "0");
    case "state":
      return signal.table?.get(Number(value)) ?? value.toString();
    default:
      return numberText(value, signal.width, format);
  }
}

/**
 * @param {number | bigint} value
 * @param {number} width
 * @param {ValueFormat} format
 */
function numberText(value, width, format) {
  const number = format.radix === "signed" ? signedValue(value, width) : value;
  const { fraction = 0, scale = 1 } = format;
  if (scale !== 1) return scaledText(Number(number) / 2 ** fraction, format);
  const text = fraction === 0 ? number.toString() : fixedPointText(BigInt(number), fraction);
  return withUnit(text, format);
}

/**
 * @param {number} number
 * @param {ValueFormat} format
 */
function scaledText(number, format) {
  const scaled = number * (format.scale ?? 1);
  const text = format.scale === undefined || format.scale === 1 ? scaled : rounded(scaled);
  return withUnit(String(text), format);
}

/**
 * Returns a number without the digits that a product of doubles adds.
 * @param {number} number
 */
function rounded(number) {
  return Number(number.toPrecision(10));
}

/**
 * @param {string} text
 * @param {ValueFormat} format
 */
function withUnit(text, format) {
  return format.unit ? `${text} ${format.unit}` : text;
}

/**
 * Returns the number that a bit pattern is in two's complement.
 * @template {number | bigint} T
 * @param {T} value
 * @param {number} width
 * @returns {T}
 */
export function signedValue(value, width) {
  if (typeof value === "bigint") return /** @type {T} */ (BigInt.asIntN(width, value));
  const half = 2 ** (width - 1);
  return /** @type {T} */ (value >= half ? value - 2 * half : value);
}

/**
 * Returns a number with fraction bits in decimal: exactly with few of them, otherwise with as many
 * digits as tell it from its neighbours. Zeros at the end are left out.
 * @param {bigint} number
 * @param {number} fraction
 */
export function fixedPointText(number, fraction) {
  const digits =
    fraction <= EXACT_FRACTION ? fraction : Math.ceil(fraction * Math.log10(2)) + 1;
  const negative = number < 0n;
  const scaled = (negative ? -number : number) * 10n ** BigInt(digits);
  const half = 1n << BigInt(fraction - 1);
  const text = ((scaled + half) >> BigInt(fraction)).toString().padStart(digits + 1, "0");
  const places = text.slice(-digits).replace(/0+$/, "");
  const whole = text.slice(0, -digits);
  const isZero = /^0*$/.test(whole + places);
  return `${negative && !isZero ? "-" : ""}${whole}${places === "" ? "" : `.${places}`}`;
}

/**
 * Returns the shown number of each change, for a curve; unknown values are NaN.
 * @param {Changes} changes
 * @param {DumpSignal} signal
 * @param {ValueFormat} format
 * @returns {Float64Array}
 */
export function shownNumbers(changes, signal, format) {
  const { values, unknown } = changes;
  const numbers = new Float64Array(values.length);
  const isSigned = signal.kind === "bits" && format.radix === "signed";
  const fraction = signal.kind === "bits" ? (format.fraction ?? 0) : 0;
  const factor = (format.scale ?? 1) / 2 ** fraction;
  for (let i = 0; i < numbers.length; i++) {
    const value = values[i];
    const number = isSigned ? signedValue(value, signal.width) : value;
    numbers[i] = unknown?.[i] ? NaN : Number(number) * factor;
  }
  return numbers;
}

/**
 * Changes by pixel columns: where they are, and the first and the last one there.
 * @typedef {object} PixelColumns
 * @property {number} count
 * @property {Float64Array} x of a single change, in pixels; whole for a column of several
 * @property {Int32Array} first
 * @property {Int32Array} last
 */

/**
 * Creates space for the columns of a window.
 * @param {number} width in pixels
 * @returns {PixelColumns}
 */
export function pixelColumns(width) {
  const length = Math.ceil(width) + 1;
  return {
    count: 0,
    x: new Float64Array(length),
    first: new Int32Array(length),
    last: new Int32Array(length),
  };
}

/**
 * Collects the changes in a window by pixel columns. The cost depends on the width, not on the
 * number of changes.
 * @param {Float64Array} times
 * @param {number} start time at the left edge
 * @param {number} perPixel time per pixel
 * @param {number} width in pixels
 * @param {PixelColumns} out is overwritten
 */
export function collectColumns(times, start, perPixel, width, out) {
  const end = start + width * perPixel;
  let count = 0;
  let i = firstAt(times, start);
  while (i < times.length && times[i] < end && count < out.x.length) {
    const x = (times[i] - start) / perPixel;
    const column = Math.floor(x);
    const columnEnd = start + (column + 1) * perPixel;
    let next = i + 1;
    if (next < times.length && times[next] < columnEnd) {
      // Steps that double find the end near by.
      let step = 1;
      while (next + step < times.length && times[next + step] < columnEnd) {
        next += step;
        step *= 2;
      }
      next = firstBefore(times, columnEnd, next, Math.min(next + step, times.length));
    }
    out.x[count] = next - i === 1 ? x : column;
    out.first[count] = i;
    out.last[count] = next - 1;
    count++;
    i = next;
  }
  out.count = count;
}

/**
 * Returns the index of the first time that is not before `time`, between two indices.
 * @param {Float64Array} times
 * @param {number} time
 * @param {number} low
 * @param {number} high
 */
function firstBefore(times, time, low, high) {
  while (low < high) {
    const middle = (low + high) >>> 1;
    if (times[middle] < time) low = middle + 1;
    else high = middle;
  }
  return low;
}
