/**
 * Axis of a series. `error` is commanded minus actual position, as in the file.
 * Rows in which a position does not exist are NaN.
 * @typedef {object} SeriesAxis
 * @property {string} name as in the file: `x`, `stepper_x`, `lift`
 * @property {string} unit of positions and errors: `steps`, `counts`, `mm`
 * @property {Float64Array} commanded
 * @property {Float64Array} actual
 * @property {Float64Array} error
 */

/**
 * Axes that move one point: x, y and z of one machine, or a single axis.
 * @typedef {object} SeriesGroup
 * @property {string} name prefix of the axes' names without `_`, or the name of the single axis
 * @property {string} unit
 * @property {SeriesAxis[]} axes
 */

/** Commanded and actual positions of a run, a row per sampling period. */
export class Series {
  /** @type {Map<SeriesGroup, Float64Array>} */
  #distances = new Map();
  /** @type {Map<SeriesGroup, Float64Array>} */
  #speeds = new Map();

  /**
   * @param {Float64Array} ticks tick of each row, increasing
   * @param {Float64Array} times seconds
   * @param {SeriesAxis[]} axes
   */
  constructor(ticks, times, axes) {
    this.ticks = ticks;
    this.times = times;
    this.axes = axes;
    this.groups = groupsOf(axes);
  }

  /** Number of rows. */
  get rows() {
    return this.ticks.length;
  }

  /** Ticks per second, by the last row; 0 if there is none. */
  get clockHz() {
    const last = this.rows - 1;
    return last >= 0 && this.times[last] > 0 ? this.ticks[last] / this.times[last] : 0;
  }

  /**
   * True if the rows of another series are the first ones of this one, as in a run that goes on.
   * @param {Series} other
   */
  continues(other) {
    const last = other.rows - 1;
    return last >= 0 && last < this.rows && this.axes.length === other.axes.length &&
      this.axes.every((axis, k) => {
        const before = other.axes[k];
        const same = (/** @type {number} */ row) => axis.commanded[row] === before.commanded[row] && axis.actual[row] === before.actual[row];
        return axis.name === before.name && same(0) && same(last >> 1) && same(last);
      });
  }

  /**
   * Returns the last row at or before a tick, or the first row.
   * @param {number} tick
   */
  rowAtTick(tick) {
    return Math.max(0, countUpTo(this.ticks, tick) - 1);
  }

  /**
   * Returns the distance along the commanded path up to each row, in the group's unit.
   * @param {SeriesGroup} group
   */
  distance(group) {
    return cached(this.#distances, group, () => distanceAlong(group.axes.map((axis) => axis.commanded)));
  }

  /**
   * Returns the speed of the commanded point between each row and the row before, in units per
   * second; 0 in the first row.
   * @param {SeriesGroup} group
   */
  speed(group) {
    return cached(this.#speeds, group, () => slope(this.distance(group), this.times));
  }
}

/**
 * Reads a series as CSV, with the columns `tick`, `time_s` and, for each axis,
 * `NAME_commanded_UNIT`, `NAME_actual_UNIT` and `NAME_error_UNIT`.
 * @param {Uint8Array | string} file
 * @returns {Series}
 * @throws {Error} naming the line if the file is not such a table
 */
export function readSeries(file) {
  const bytes = typeof file === "string" ? new TextEncoder().encode(file) : file;
  const found = bytes.indexOf(LINE_FEED);
  const headEnd = found < 0 ? bytes.length : found;
  const names = asciiText(bytes, 0, headEnd).replace("\r", "").split(",");
  return seriesOf(names, readColumns(bytes, headEnd + 1, names.length));
}

/**
 * Returns the series of a table.
 * @param {string[]} names of its columns
 * @param {Float64Array[]} columns
 * @returns {Series}
 * @throws {Error} if a column is missing
 */
export function seriesOf(names, columns) {
  const column = (/** @type {string} */ name) => {
    const k = names.indexOf(name);
    if (k < 0) throw new Error(`Line 1: the column ${name} is missing`);
    return columns[k];
  };
  const axes = names.flatMap((name) => {
    const parts = /^(.+)_commanded_(.+)$/.exec(name);
    if (!parts) return [];
    const [, axis, unit] = parts;
    const actual = column(`${axis}_actual_${unit}`);
    return [{ name: axis, unit, commanded: column(name), actual, error: column(`${axis}_error_${unit}`) }];
  });
  if (axes.length === 0) throw new Error("Line 1: no column NAME_commanded_UNIT");
  return new Series(column("tick"), column("time_s"), axes);
}

/**
 * Returns how many of the sorted numbers are at most `limit`.
 * @param {Float64Array} sorted
 * @param {number} limit
 */
export function countUpTo(sorted, limit) {
  let [low, high] = [0, sorted.length];
  while (low < high) {
    const middle = (low + high) >> 1;
    if (sorted[middle] <= limit) low = middle + 1;
    else high = middle;
  }
  return low;
}

/**
 * Factor by which errors are drawn larger to be visible: the greatest of 1, 2 and 5 times a power of
 * ten with which the largest error is at most a sixteenth of the drawing. The program's pictures
 * have the same rule.
 * @param {number} largest error
 * @param {number} size of the drawing, in the same unit
 */
export function initialMagnification(largest, size) {
  const wanted = (0.0625 * size) / largest;
  if (!(Number.isFinite(wanted) && wanted > 1)) return 1;
  const decade = 10 ** Math.floor(Math.log10(wanted));
  return [10, 5, 2, 1].map((step) => step * decade).find((step) => step <= wanted) ?? 1;
}

/**
 * @param {SeriesAxis[]} axes
 * @returns {SeriesGroup[]}
 */
function groupsOf(axes) {
  /** @type {Map<string, SeriesGroup>} */
  const groups = new Map();
  for (const axis of axes) {
    // Only linear axes span a space; A, B and C turn, U, V and W are beside X, Y and Z.
    const parts = /^(?:(.+)_)?[xyz]$/.exec(axis.name);
    const name = parts ? (parts[1] ?? "") : axis.name;
    const key = parts ? `space ${name} ${axis.unit}` : `alone ${name}`;
    const group = groups.get(key) ?? { name, unit: axis.unit, axes: [] };
    groups.set(key, group);
    group.axes.push(axis);
  }
  return [...groups.values()];
}

/**
 * @template Key, Value
 * @param {Map<Key, Value>} cache
 * @param {Key} key
 * @param {() => Value} compute
 * @returns {Value}
 */
function cached(cache, key, compute) {
  const value = cache.get(key) ?? compute();
  cache.set(key, value);
  return value;
}

/** @param {Float64Array[]} positions */
function distanceAlong(positions) {
  const distance = new Float64Array(positions[0].length);
  for (let row = 1; row < distance.length; row += 1) {
    let square = 0;
    for (const position of positions) {
      const step = position[row] - position[row - 1];
      if (step === step) square += step * step;
    }
    distance[row] = distance[row - 1] + Math.sqrt(square);
  }
  return distance;
}

/**
 * @param {Float64Array} values
 * @param {Float64Array} times
 */
function slope(values, times) {
  const slopes = new Float64Array(values.length);
  for (let row = 1; row < values.length; row += 1) {
    const span = times[row] - times[row - 1];
    slopes[row] = span > 0 ? (values[row] - values[row - 1]) / span : 0;
  }
  return slopes;
}

const COMMA = 0x2c;
const LINE_FEED = 0x0a;
const RETURN = 0x0d;
const MINUS = 0x2d;
const POINT = 0x2e;
const ZERO = 0x30;
/** Powers of ten that are exact. */
const POWERS = Array.from({ length: 23 }, (_, k) => Number(`1e${k}`));

/**
 * @param {Uint8Array} bytes
 * @param {number} from
 * @param {number} to
 */
function asciiText(bytes, from, to) {
  return String.fromCharCode(...bytes.subarray(from, to));
}

/**
 * Reads rows of numbers. The file may have a million rows, so it is read byte by byte without a
 * string for each cell.
 * @param {Uint8Array} bytes
 * @param {number} from
 * @param {number} width cells of a row
 */
function readColumns(bytes, from, width) {
  let rows = 0;
  for (let k = from; k < bytes.length; k += 1) if (bytes[k] === LINE_FEED) rows += 1;
  if (bytes.length > from && bytes[bytes.length - 1] !== LINE_FEED) rows += 1;
  const columns = Array.from({ length: width }, () => new Float64Array(rows));
  let begin = from;
  for (let row = 0; row < rows; row += 1) {
    for (let column = 0; column < width; column += 1) {
      let end = begin;
      while (end < bytes.length && bytes[end] !== COMMA && bytes[end] !== LINE_FEED) end += 1;
      const last = end === bytes.length || bytes[end] === LINE_FEED;
      if (last !== (column === width - 1)) {
        throw new Error(`Line ${row + 2}: ${last ? "fewer" : "more"} than ${width} cells`);
      }
      columns[column][row] = readNumber(bytes, begin, last && bytes[end - 1] === RETURN ? end - 1 : end, row);
      begin = end + 1;
    }
  }
  return columns;
}

/**
 * Reads a cell; an empty one is NaN. If all digits together are an exact number, the cell is the
 * quotient of two exact numbers, so that it is rounded once. Others are left to `Number`.
 * @param {Uint8Array} bytes
 * @param {number} from
 * @param {number} to
 * @param {number} row
 */
function readNumber(bytes, from, to, row) {
  if (from === to) return NaN;
  const negative = bytes[from] === MINUS;
  let [whole, digits, point] = [0, 0, -1];
  let k = negative ? from + 1 : from;
  for (; k < to; k += 1) {
    const digit = bytes[k] - ZERO;
    if (digit >= 0 && digit <= 9) {
      whole = whole * 10 + digit;
      digits += 1;
    } else if (bytes[k] === POINT && point < 0) {
      point = digits;
    } else {
      break;
    }
  }
  const decimals = point < 0 ? 0 : digits - point;
  if (k === to && digits > 0 && whole <= Number.MAX_SAFE_INTEGER && decimals < POWERS.length) {
    const value = whole / POWERS[decimals];
    return negative ? -value : value;
  }
  const text = asciiText(bytes, from, to);
  const value = Number(text);
  if (Number.isNaN(value) && text.toLowerCase() !== "nan") {
    throw new Error(`Line ${row + 2}: ${text} is not a number`);
  }
  return value;
}
