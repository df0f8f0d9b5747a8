/** @typedef {import("./valueformat.js").ValueFormat} ValueFormat */

/**
 * Row of a save file that shows a signal. `lines` is its height in rows of text, `color` GTKWave's
 * number of a colour, 0 for the usual one.
 * @typedef {object} SavedSignal
 * @property {"signal"} type
 * @property {string} path without the range of its bits
 * @property {string} label
 * @property {ValueFormat} format
 * @property {"no" | "step" | "line"} curve
 * @property {number} lines
 * @property {number} color
 */

/** @typedef {{type: "comment", label: string}} SavedComment */

/**
 * @typedef {object} SavedGroup
 * @property {"group"} type
 * @property {string} label
 * @property {boolean} open
 * @property {SavedRow[]} rows
 */

/** @typedef {SavedSignal | SavedComment | SavedGroup} SavedRow */

/**
 * Rows of a GTKWave save file and the times that it shows, in whole s, ms, … fs, not in units of
 * the dump; `null` if it names none.
 * @typedef {object} SaveFile
 * @property {SavedRow[]} rows
 * @property {{start: number, end: number} | null} shown
 */

// Flags of a trace, numbered as in GTKWave's analyzer.h.
const GTKW_HEX = 1 << 1;
const GTKW_DECIMAL = 1 << 2;
const GTKW_BINARY = 1 << 3;
const GTKW_BLANK = 1 << 9;
const GTKW_SIGNED = 1 << 10;
const GTKW_ASCII = 1 << 11;
const GTKW_STEP = 1 << 15;
const GTKW_INTERPOLATED = 1 << 16;
const GTKW_CURVE_ROW = 1 << 17;
const GTKW_CLOSED = 1 << 22;
const GTKW_GROUP_BEGIN = 1 << 23;
const GTKW_GROUP_END = 1 << 24;
const GTKW_FIXED_POINT = 1 << 30;

/** Pixels of a frame, in which GTKWave's zoom is given, and of scroll bars and borders. */
const GTKW_FRAME = 200;
const GTKW_BORDERS = 100;

/**
 * Reads a GTKWave save file. Lines that are not about rows, formats, colours, groups and the shown
 * times are skipped.
 * @param {string} text
 * @returns {SaveFile}
 */
export function readSave(text) {
  /** @type {SavedRow[]} */
  const rows = [];
  const open = [rows];
  let flags = 0;
  let color = 0;
  let fraction = 0;
  /** @type {SavedSignal | null} */
  let last = null;
  for (const line of text.split(/\r?\n/)) {
    const entry = /^\[(\w+)\]\s*(.*)$/.exec(line);
    if (entry) {
      if (entry[1] === "color") color = Number(entry[2]);
      if (entry[1] === "fpshift_count") fraction = Number(entry[2]);
    } else if (line.startsWith("@")) {
      flags = parseInt(line.slice(1), 16);
    } else if (line === "" || "[*#&^!".includes(line[0])) {
      continue;
    } else if (flags & GTKW_CURVE_ROW) {
      if (last) last.lines++;
    } else if (flags & GTKW_GROUP_BEGIN) {
      const group = savedGroup(line, (flags & GTKW_CLOSED) === 0);
      open[open.length - 1].push(group);
      open.push(group.rows);
    } else if (flags & GTKW_GROUP_END) {
      if (open.length > 1) open.pop();
    } else if (flags & GTKW_BLANK || line.startsWith("-")) {
      open[open.length - 1].push({ type: "comment", label: line.replace(/^-/, "") });
    } else {
      last = savedSignal(line, flags, fraction, color);
      open[open.length - 1].push(last);
      color = 0;
      fraction = 0;
    }
  }
  return { rows, shown: savedTimes(text) };
}

/**
 * @param {string} line
 * @param {boolean} open
 * @returns {SavedGroup}
 */
function savedGroup(line, open) {
  return { type: "group", label: line.replace(/^-/, ""), open, rows: [] };
}

/**
 * @param {string} line path with a range of bits, after an alias in `+{…}` if it has one
 * @param {number} flags
 * @param {number} fraction
 * @param {number} color
 * @returns {SavedSignal}
 */
function savedSignal(line, flags, fraction, color) {
  const [, alias, whole] = /^(?:\+\{(.*?)\} )?(.*)$/.exec(line) ?? [];
  const path = whole.replace(/\[-?\d+:-?\d+\]$/, "");
  /** @type {ValueFormat} */
  const format = { radix: savedRadix(flags) };
  if (flags & GTKW_FIXED_POINT && fraction > 0) format.fraction = fraction;
  const curve = flags & GTKW_STEP ? "step" : flags & GTKW_INTERPOLATED ? "line" : "no";
  const name = path.slice(path.lastIndexOf(".") + 1);
  const label = alias === undefined ? name : alias.replace(/\[-?\d+:-?\d+\]$/, "");
  return { type: "signal", path, label, format, curve, lines: 1, color };
}

/**
 * @param {number} flags
 * @returns {ValueFormat["radix"]}
 */
function savedRadix(flags) {
  if (flags & GTKW_ASCII) return "state";
  if (flags & GTKW_SIGNED) return "signed";
  if (flags & GTKW_DECIMAL) return "unsigned";
  if (flags & GTKW_BINARY) return "binary";
  return flags & GTKW_HEX ? "hex" : "unsigned";
}

/**
 * Returns the times that the window of a save file shows.
 * @param {string} text
 */
function savedTimes(text) {
  const start = /^\[timestart\] (\d+)/m.exec(text);
  const zoom = /^\*(-?[\d.]+) /m.exec(text);
  const size = /^\[size\] (\d+) /m.exec(text);
  const tree = /^\[sst_width\] (\d+)/m.exec(text);
  const names = /^\[signals_width\] (\d+)/m.exec(text);
  if (!start || !zoom || !size) return null;
  const pane = Number(size[1]) - Number(tree?.[1] ?? 0) - Number(names?.[1] ?? 0) - GTKW_BORDERS;
  const from = Number(start[1]);
  return { start: from, end: from + (pane * 2 ** -Number(zoom[1])) / GTKW_FRAME };
}
