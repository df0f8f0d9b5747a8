/**
 * Formats a measured number with six significant digits, more where the whole part has more.
 * @param {number} value
 */
export function readable(value) {
  if (!Number.isFinite(value)) return "–";
  const size = Math.abs(value);
  if (size !== 0 && size < 1e-4) return value.toExponential(3).replace("-", "−").replace("e-", " × 10^−");
  const text = size >= 1e5 ? value.toFixed(1) : value.toPrecision(6);
  const short = text.includes(".") ? text.replace(/\.?0+$/, "") : text;
  return (short === "-0" ? "0" : short).replace("-", "−");
}

/**
 * Formats a time in seconds to the microsecond.
 * @param {number} seconds
 */
export function readableTime(seconds) {
  return `${seconds.toFixed(6)} s`;
}

/**
 * Returns round numbers within a range for the marks of a scale, about `wanted` of them.
 * @param {number} from
 * @param {number} to
 * @param {number} wanted
 * @returns {{ values: number[], step: number }}
 */
export function scaleMarks(from, to, wanted) {
  const rough = (to - from) / Math.max(1, wanted);
  if (!(rough > 0 && Number.isFinite(rough))) return { values: [], step: 1 };
  const decade = 10 ** Math.floor(Math.log10(rough));
  const step = ([1, 2, 5].find((part) => part * decade >= rough) ?? 10) * decade;
  const values = [];
  for (let k = Math.ceil(from / step); k * step <= to; k += 1) values.push(k * step);
  return { values, step };
}

/**
 * Formats a mark with as many decimals as its step has.
 * @param {number} value
 * @param {number} step
 */
export function markText(value, step) {
  const decimals = Math.min(20, Math.max(0, -Math.floor(Math.log10(step) + 1e-9)));
  return (Math.abs(value) < step / 2 ? 0 : value).toFixed(decimals).replace("-", "−");
}
