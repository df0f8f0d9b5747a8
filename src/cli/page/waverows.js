import { usualFormat } from "./valueformat.js";

/** @typedef {import("./dump.js").Dump} Dump */
/** @typedef {import("./dump.js").DumpScope} DumpScope */
/** @typedef {import("./dump.js").DumpSignal} DumpSignal */
/** @typedef {import("./savefile.js").SavedRow} SavedRow */
/** @typedef {import("./valueformat.js").ValueFormat} ValueFormat */

/**
 * Row of the waves. Rows of a group follow it with a greater depth. `height` is in rows of text;
 * `color` is the name of a colour of the palette.
 * @typedef {object} WaveRow
 * @property {"signal" | "comment" | "group"} type
 * @property {string} label
 * @property {number} depth
 * @property {boolean} open
 * @property {DumpSignal | null} signal
 * @property {ValueFormat} format
 * @property {"no" | "step" | "line"} curve
 * @property {number} height
 * @property {string} color
 */

/** Height of a row of text in pixels. */
export const ROW_HEIGHT = 22;
/** Greatest number of rows of a group that is open at first. */
const MOST_OPEN = 16;

/** Colours by the numbers of GTKWave: red is for errors, others are for roles. */
const SAVED_COLORS = [
  "series-1",
  "bad",
  "series-2",
  "series-3",
  "series-1",
  "series-5",
  "series-6",
  "series-4",
];

/** Colours of the roles, those that the program's save files give them. */
const ROLE_COLORS = {
  input: "series-3",
  output: "series-1",
  register: "series-2",
  net: "series-4",
};

/**
 * Returns a row for a signal.
 * @param {DumpSignal} signal
 * @param {number} depth
 * @returns {WaveRow}
 */
export function signalRow(signal, depth) {
  return {
    ...plainRow("signal", signal.name, depth),
    signal,
    format: usualFormat(signal),
    color: ROLE_COLORS[signal.role],
  };
}

/**
 * Returns the rows of a scope: a group with its signals and the scopes in it.
 * @param {DumpScope} scope
 * @param {number} depth
 * @returns {WaveRow[]}
 */
export function scopeRows(scope, depth) {
  const group = plainRow("group", depth === 0 ? scope.path : scope.name, depth);
  group.open = depth === 0 && scope.signals.length <= MOST_OPEN;
  return [
    group,
    ...scope.signals.map((signal) => signalRow(signal, depth + 1)),
    ...scope.scopes.flatMap((inner) => scopeRows(inner, depth + 1)),
  ];
}

/**
 * Returns the rows of a save file; signals that are not in the dump are left out.
 * @param {SavedRow[]} saved
 * @param {Dump} dump
 * @param {number} [depth]
 * @returns {WaveRow[]}
 */
export function savedRows(saved, dump, depth = 0) {
  return saved.flatMap((row) => {
    if (row.type === "comment") return [plainRow("comment", row.label, depth)];
    if (row.type === "group") {
      const rows = savedRows(row.rows, dump, depth + 1);
      return [{ ...plainRow("group", row.label, depth), open: row.open }, ...rows];
    }
    const signal = dump.find(row.path);
    if (!signal) return [];
    return [
      {
        ...plainRow("signal", row.label, depth),
        signal,
        format: row.format,
        curve: row.curve,
        height: row.lines,
        color: SAVED_COLORS[row.color] ?? SAVED_COLORS[0],
      },
    ];
  });
}

/**
 * @param {WaveRow["type"]} type
 * @param {string} label
 * @param {number} depth
 * @returns {WaveRow}
 */
function plainRow(type, label, depth) {
  return {
    type,
    label,
    depth,
    open: true,
    signal: null,
    format: { radix: "unsigned" },
    curve: "no",
    height: 1,
    color: "faint",
  };
}

/** Rows of the waves in their order; dispatches `rows` if they change. */
export class WaveRows extends EventTarget {
  /** @type {WaveRow[]} */
  #all = [];
  /** @type {WaveRow[]} */
  #visible = [];
  /** Upper edge of each visible row, and the lower edge of the last, in pixels. */
  #tops = [0];

  /** All rows, also those in closed groups. */
  get all() {
    return this.#all;
  }

  /** Rows that are in no closed group. */
  get visible() {
    return this.#visible;
  }

  /** Height of all visible rows in pixels. */
  get height() {
    return this.#tops[this.#tops.length - 1];
  }

  /**
   * Returns the upper edge of a visible row in pixels.
   * @param {number} index
   */
  top(index) {
    return this.#tops[index];
  }

  /**
   * Returns the index of the visible row at a height in pixels; -1 if there is none.
   * @param {number} y
   */
  at(y) {
    if (y < 0 || y >= this.height) return -1;
    let low = 0;
    let high = this.#visible.length - 1;
    while (low < high) {
      const middle = (low + high + 1) >>> 1;
      if (this.#tops[middle] <= y) low = middle;
      else high = middle - 1;
    }
    return low;
  }

  /** @param {WaveRow[]} rows */
  reset(rows) {
    this.#all = rows;
    this.update();
  }

  /**
   * Adds rows of depth 0 after the group or row of depth 0 in which `after` is, or at the end.
   * @param {WaveRow[]} rows
   * @param {WaveRow | null} after
   */
  add(rows, after) {
    let at = after ? this.#all.indexOf(after) : -1;
    while (at > 0 && this.#all[at].depth > 0) at--;
    this.#all.splice(at < 0 ? this.#all.length : this.#end(at), 0, ...rows);
    this.update();
  }

  /**
   * Removes a row, and the rows of a group.
   * @param {WaveRow} row
   */
  remove(row) {
    const at = this.#all.indexOf(row);
    if (at < 0) return;
    this.#all.splice(at, this.#end(at) - at);
    this.update();
  }

  /**
   * Moves a row, with the rows of a group, one visible row up (-1) or down (1).
   * @param {WaveRow} row
   * @param {1 | -1} direction
   */
  shift(row, direction) {
    const index = this.#visible.indexOf(row);
    if (index < 0) return;
    if (direction < 0) {
      if (index > 0) this.moveBefore(row, this.#visible[index - 1]);
      return;
    }
    const own = this.#block(row);
    const next = this.#visible.slice(index + 1).find((other) => !own.includes(other));
    if (!next) return;
    const behind = this.#visible[this.#visible.indexOf(next) + 1] ?? null;
    this.moveBefore(row, behind);
  }

  /**
   * Moves a row, with the rows of a group, before another one, into that one's group; to the end
   * if there is none.
   * @param {WaveRow} row
   * @param {WaveRow | null} target
   */
  moveBefore(row, target) {
    const block = this.#block(row);
    if (target && block.includes(target)) return;
    const deeper = (target?.depth ?? 0) - row.depth;
    this.#all.splice(this.#all.indexOf(row), block.length);
    for (const each of block) each.depth += deeper;
    this.#all.splice(target ? this.#all.indexOf(target) : this.#all.length, 0, ...block);
    this.update();
  }

  /**
   * Opens or closes a group.
   * @param {WaveRow} row
   */
  toggle(row) {
    if (row.type !== "group") return;
    row.open = !row.open;
    this.update();
  }

  /** Takes up changes of rows. */
  update() {
    this.#visible = [];
    this.#tops = [0];
    let closed = Infinity;
    for (const row of this.#all) {
      if (row.depth > closed) continue;
      closed = row.type === "group" && !row.open ? row.depth : Infinity;
      this.#visible.push(row);
      this.#tops.push(this.height + row.height * ROW_HEIGHT);
    }
    this.dispatchEvent(new Event("rows"));
  }

  /**
   * Returns a row with the rows of its group.
   * @param {WaveRow} row
   */
  #block(row) {
    const at = this.#all.indexOf(row);
    return this.#all.slice(at, this.#end(at));
  }

  /**
   * Returns the index after a row and the rows of its group.
   * @param {number} at
   */
  #end(at) {
    const { depth } = this.#all[at];
    let end = at + 1;
    while (end < this.#all.length && this.#all[end].depth > depth) end++;
    return end;
  }
}
