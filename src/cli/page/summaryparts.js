import { ExactNumber } from "./exactjson.js";

/** @typedef {import("./exactjson.js").ExactJson} ExactJson */

/**
 * A table of a summary. A cell is undefined where a row has no such value.
 * @typedef {object} SummaryTable
 * @property {string[]} columns
 * @property {(ExactJson | undefined)[][]} rows
 */

/**
 * A part of a summary: its plain values, and what is within it.
 * @typedef {object} SummaryPart
 * @property {string} name
 * @property {[string, ExactJson][]} plain
 * @property {SummaryTable | null} table
 * @property {SummaryPart[]} parts
 */

/**
 * Divides a value into plain values, tables and parts, whatever circuit it is of.
 * @param {string} name
 * @param {ExactJson} value
 * @returns {SummaryPart}
 */
export function summaryPart(name, value) {
  const table = tableOf(value);
  if (table || !(value instanceof Map)) return { name, plain: [], table, parts: [] };
  const entries = [...value];
  const plain = entries.filter(([, each]) => isPlain(each));
  const parts = entries.filter(([, each]) => !isPlain(each)).map(([key, each]) => summaryPart(key, each));
  return { name, plain, table: null, parts };
}

/**
 * Text of a plain value: numbers as they stand, lists with commas, nothing for null.
 * @param {ExactJson | undefined} value
 * @returns {string}
 */
export function plainText(value) {
  if (value === undefined || value === null) return "–";
  if (Array.isArray(value)) return value.length === 0 ? "none" : value.map(plainText).join(", ");
  if (value instanceof Map) return [...value].map(([key, each]) => `${key} ${plainText(each)}`).join(", ");
  return String(value);
}

/**
 * Returns the rows in the order of a column. Numbers are in the order of their values and before
 * texts; rows without a value are last either way.
 * @param {SummaryTable} table
 * @param {number} column
 * @param {boolean} falling
 */
export function sortedRows({ rows }, column, falling) {
  const sign = falling ? -1 : 1;
  const rank = (/** @type {ExactJson | undefined} */ value) =>
    value === undefined || value === null ? 2 : value instanceof ExactNumber ? 0 : 1;
  return [...rows].sort((a, b) => {
    const [first, second] = [a[column], b[column]];
    if (rank(first) !== rank(second)) return rank(first) === 2 || rank(second) === 2 ? rank(first) - rank(second) : sign * (rank(first) - rank(second));
    if (first instanceof ExactNumber && second instanceof ExactNumber) return sign * (first.valueOf() - second.valueOf());
    return sign * plainText(first).localeCompare(plainText(second), "en", { numeric: true });
  });
}

/**
 * True for values that a line shows: no objects, and no lists with any.
 * @param {ExactJson} value
 * @returns {boolean}
 */
export function isPlain(value) {
  if (value instanceof Map) return value.size === 0;
  return !Array.isArray(value) || value.every(isPlain);
}

/**
 * Returns the table of a list of objects, or of an object whose values are two or more objects with
 * the same keys, which are named in the first column.
 * @param {ExactJson} value
 * @returns {SummaryTable | null}
 */
function tableOf(value) {
  if (Array.isArray(value)) {
    const maps = value.filter((each) => each instanceof Map);
    return maps.length > 0 && maps.length === value.length ? tableOfRows(maps.map((map) => flat(map))) : null;
  }
  if (!(value instanceof Map) || value.size < 2) return null;
  const entries = [...value];
  const keys = entries.map(([, each]) => (each instanceof Map ? [...each.keys()].join("\n") : null));
  if (keys[0] === null || keys[0] === "" || keys.some((each) => each !== keys[0])) return null;
  return tableOfRows(entries.map(([name, each]) => new Map([["", name], ...flat(/** @type {Map<string, ExactJson>} */ (each))])));
}

/** @param {Map<string, ExactJson>[]} maps */
function tableOfRows(maps) {
  const columns = [...new Set(maps.flatMap((map) => [...map.keys()]))];
  return { columns, rows: maps.map((map) => columns.map((column) => map.get(column))) };
}

/**
 * Objects within an object become values with dotted keys.
 * @param {Map<string, ExactJson>} map
 * @returns {Map<string, ExactJson>}
 */
function flat(map) {
  /** @type {[string, ExactJson][]} */
  const entries = [...map].flatMap(([key, value]) =>
    value instanceof Map && value.size > 0
      ? [...flat(value)].map(([inner, each]) => /** @type {[string, ExactJson]} */ ([`${key}.${inner}`, each]))
      : [/** @type {[string, ExactJson]} */ ([key, value])]);
  return new Map(entries);
}
