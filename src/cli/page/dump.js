import { UNKNOWN_X, UNKNOWN_Z } from "./column.js";

/** @typedef {import("./column.js").Changes} Changes */

/** Value of a signal: `null` before its first change; "x" or "z" if bits are unknown. */
/** @typedef {number | bigint | "x" | "z" | null} DumpValue */

/**
 * Signal of a dump.
 * @typedef {object} DumpSignal
 * @property {string} path names of the scopes and the signal, joined by dots
 * @property {string[]} scope names of the scopes, outermost first
 * @property {string} name without the range of its bits
 * @property {number} width in bits; 0 for real numbers and texts
 * @property {"bits" | "real" | "text"} kind
 * @property {"input" | "output" | "register" | "net"} role as far as the dump says it
 * @property {Map<number, string> | null} table names of states by code, or texts by number
 * @property {number} id signals of one id share their changes
 */

/**
 * Scope of a dump, with what is directly in it.
 * @typedef {object} DumpScope
 * @property {string} name
 * @property {string} path
 * @property {DumpScope[]} scopes
 * @property {DumpSignal[]} signals
 */

/**
 * Contents of a dump as a reader finds them.
 * @typedef {object} DumpParts
 * @property {DumpSignal[]} signals
 * @property {number} start first time, in units
 * @property {number} end
 * @property {number} unit seconds per unit of time
 * @property {string[]} [comments]
 * @property {(signal: DumpSignal) => Promise<Changes> | Changes} load
 */

/** A file that is no dump, is damaged, or is not complete. */
export class DumpError extends Error {}

/** Signals of a run and their changes, which are read when they are asked for. */
export class Dump {
  /** @type {Map<number, Promise<Changes>>} */
  #asked = new Map();
  /** @type {Map<number, Changes>} */
  #loaded = new Map();
  /** @type {Map<string, DumpSignal>} */
  #byPath = new Map();
  #load;
  #period = 1;

  /** @param {DumpParts} parts */
  constructor(parts) {
    this.signals = parts.signals;
    this.start = parts.start;
    this.end = parts.end;
    this.unit = parts.unit;
    this.comments = parts.comments ?? [];
    this.scopes = scopesOf(parts.signals);
    this.#load = parts.load;
    for (const signal of parts.signals) {
      if (!this.#byPath.has(signal.path)) this.#byPath.set(signal.path, signal);
    }
  }

  /** Period of the reference clock in units of time; 1 if the clock is not known. */
  get period() {
    return this.#period;
  }

  /**
   * Sets the rate of the reference clock. A period that the unit cannot express is rounded to an
   * even number of femtoseconds, as the program does.
   * @param {number} hz
   */
  setClock(hz) {
    const half = Math.round(1e15 / (2 * hz));
    this.#period = Math.max(1, Math.round((2 * half) / (this.unit * 1e15)));
  }

  /**
   * Finds the clock: in a comment of the dump or, failing that, by the first two rising edges of
   * a signal `clk`. Without either, a tick is a unit of time.
   */
  async findClock() {
    for (const comment of this.comments) {
      const hz = /^clk (\d+) Hz/.exec(comment);
      if (hz) {
        this.setClock(Number(hz[1]));
        return;
      }
    }
    const clk = this.signals.find((signal) => signal.name === "clk" && signal.width === 1);
    if (!clk) return;
    const { times, values } = await this.changes(clk);
    const rises = [];
    for (let i = 0; i < times.length && rises.length < 2; i++) {
      if (values[i] === 1) rises.push(times[i]);
    }
    if (rises.length === 2) this.#period = rises[1] - rises[0];
  }

  /**
   * Returns the time at which a tick begins, in units.
   * @param {number} tick
   */
  timeOfTick(tick) {
    return tick * this.#period;
  }

  /**
   * Returns the tick at a time.
   * @param {number} time in units
   */
  tickOfTime(time) {
    return Math.floor(time / this.#period);
  }

  /**
   * Returns the signal at a path; a range of bits at its end is ignored if no signal has it.
   * @param {string} path
   * @returns {DumpSignal | undefined}
   */
  find(path) {
    return this.#byPath.get(path) ?? this.#byPath.get(path.replace(/\s*\[[-\d:]+\]$/, ""));
  }

  /**
   * Reads the changes of a signal, once.
   * @param {DumpSignal} signal
   * @returns {Promise<Changes>}
   */
  changes(signal) {
    let asked = this.#asked.get(signal.id);
    if (!asked) {
      asked = Promise.resolve(this.#load(signal)).then((changes) => {
        this.#loaded.set(signal.id, changes);
        return changes;
      });
      this.#asked.set(signal.id, asked);
    }
    return asked;
  }

  /**
   * Returns the changes of a signal if they are read.
   * @param {DumpSignal} signal
   */
  loaded(signal) {
    return this.#loaded.get(signal.id);
  }
}

/**
 * Builds the tree of scopes.
 * @param {DumpSignal[]} signals
 * @returns {DumpScope[]} outermost scopes
 */
function scopesOf(signals) {
  /** @type {DumpScope} */
  const root = { name: "", path: "", scopes: [], signals: [] };
  const known = new Map([["", root]]);
  /**
   * @param {string[]} names
   * @returns {DumpScope}
   */
  const scopeAt = (names) => {
    const path = names.join(".");
    const found = known.get(path);
    if (found) return found;
    const scope = { name: names[names.length - 1], path, scopes: [], signals: [] };
    known.set(path, scope);
    scopeAt(names.slice(0, -1)).scopes.push(scope);
    return scope;
  };
  /** @type {string[] | undefined} */
  let names;
  let scope = root;
  for (const signal of signals) {
    // Readers share the array of names between the signals of a scope.
    if (signal.scope !== names) {
      names = signal.scope;
      scope = scopeAt(names);
    }
    scope.signals.push(signal);
  }
  if (root.signals.length === 0) return root.scopes;
  // Signals of a dump without scopes.
  root.name = "signals";
  return [root];
}

/**
 * Returns the index of the first time that is not before `time`.
 * @param {Float64Array} times ascending
 * @param {number} time
 * @param {number} [from] index at which the search begins
 */
export function firstAt(times, time, from = 0) {
  let low = from;
  let high = times.length;
  while (low < high) {
    const middle = (low + high) >>> 1;
    if (times[middle] < time) low = middle + 1;
    else high = middle;
  }
  return low;
}

/**
 * Returns the index of the change whose value holds at a time; -1 before the first.
 * @param {Changes} changes
 * @param {number} time
 */
export function indexAt(changes, time) {
  const { times } = changes;
  const index = firstAt(times, time);
  return times[index] === time ? index : index - 1;
}

/**
 * Returns a value by its index.
 * @param {Changes} changes
 * @param {number} index
 * @returns {DumpValue}
 */
export function valueOf(changes, index) {
  if (index < 0 || index >= changes.times.length) return null;
  const mark = changes.unknown ? changes.unknown[index] : 0;
  if (mark === UNKNOWN_X) return "x";
  if (mark === UNKNOWN_Z) return "z";
  return changes.values[index];
}

/**
 * Returns the value at a time.
 * @param {Changes} changes
 * @param {number} time
 */
export function valueAt(changes, time) {
  return valueOf(changes, indexAt(changes, time));
}

/**
 * Returns the time of the next change after a time (direction 1) or the last one before it
 * (direction -1); `null` if there is none.
 * @param {Changes} changes
 * @param {number} time
 * @param {1 | -1} direction
 */
export function edge(changes, time, direction) {
  const { times } = changes;
  let index = firstAt(times, time);
  if (direction < 0) index--;
  else if (times[index] === time) index++;
  return index >= 0 && index < times.length ? times[index] : null;
}
