import { edge } from "./dump.js";
import { secondsText } from "./waveview.js";

/** @typedef {import("./dump.js").Dump} Dump */
/** @typedef {import("./dump.js").DumpSignal} DumpSignal */
/** @typedef {import("./playhead.js").Playhead} Playhead */

/**
 * Cursor and marker in a dump. The cursor is within the tick of the play head, and each moves the
 * other. Dispatches `change`.
 */
export class WaveCursor extends EventTarget {
  /** @type {Dump | null} */
  #dump = null;
  /** Time in units. */
  time = 0;
  /**
   * Time in units.
   * @type {number | null}
   */
  marker = null;
  #playhead;

  /** @param {Playhead} playhead */
  constructor(playhead) {
    super();
    this.#playhead = playhead;
    playhead.addEventListener("change", (event) => {
      const own = /** @type {CustomEvent} */ (event).detail.from === this;
      if (!own) this.#toPlayhead();
    });
  }

  /** @param {Dump} dump */
  show(dump) {
    this.#dump = dump;
    this.marker = null;
    this.#toPlayhead();
  }

  /**
   * Moves to a time within the dump, and the play head to its tick.
   * @param {number} time
   */
  goTo(time) {
    if (!this.#dump) return;
    this.#playhead.set(this.#dump.tickOfTime(time), this);
    // The play head may end before the dump.
    const isThere = this.#playhead.tick === this.#dump.tickOfTime(time);
    this.time = isThere ? time : this.#dump.timeOfTick(this.#playhead.tick);
    this.dispatchEvent(new Event("change"));
  }

  /**
   * Moves to the beginning of the tick at a time; that is where signals change.
   * @param {number} time
   */
  goToTickAt(time) {
    const dump = this.#dump;
    if (!dump) return;
    const inside = Math.min(Math.max(time, dump.start), dump.end - 1);
    this.goTo(dump.timeOfTick(dump.tickOfTime(inside)));
  }

  /** @param {number} ticks */
  step(ticks) {
    this.goToTickAt(this.#dump?.timeOfTick(this.#playhead.tick + ticks) ?? 0);
  }

  /**
   * Moves to the next or previous change of a signal, if there is one.
   * @param {DumpSignal} signal
   * @param {1 | -1} direction
   */
  async goToEdge(signal, direction) {
    const changes = await this.#dump?.changes(signal);
    const time = changes ? edge(changes, this.time, direction) : null;
    if (time !== null) this.goTo(time);
  }

  /**
   * Sets the marker, or removes it if it is there already.
   * @param {number} time
   */
  mark(time) {
    this.marker = this.marker === time ? null : time;
    this.dispatchEvent(new Event("change"));
  }

  /**
   * Sets the marker to the beginning of the tick at a time.
   * @param {number} time
   */
  markTickAt(time) {
    if (this.#dump) this.mark(this.#dump.timeOfTick(this.#dump.tickOfTime(time)));
  }

  /** Returns tick and time of the cursor, and how far the marker is from it. */
  text() {
    const dump = this.#dump;
    if (!dump) return "";
    const step = dump.unit;
    const parts = [`Tick ${count(dump.tickOfTime(this.time))}`, trimmed(secondsText(this.time * step, step))];
    if (this.marker !== null) {
      const units = this.time - this.marker;
      const seconds = units * step;
      parts.push(`Δ ${count(Math.round((units / dump.period) * 1000) / 1000)} ticks`);
      parts.push(trimmed(secondsText(seconds, step)));
      if (units !== 0) parts.push(hertzText(1 / Math.abs(seconds)));
    }
    return parts.join(" · ");
  }

  #toPlayhead() {
    this.time = this.#dump?.timeOfTick(this.#playhead.tick) ?? 0;
    this.dispatchEvent(new Event("change"));
  }
}

/** @param {number} number */
function count(number) {
  return number.toLocaleString("en");
}

/**
 * Returns a time without zeros at the end of its digits.
 * @param {string} text
 */
function trimmed(text) {
  return text.replace(/(\.\d*?)0+ /, "$1 ").replace(". ", " ");
}

/**
 * Returns a frequency with four digits.
 * @param {number} hz
 */
function hertzText(hz) {
  const [factor, unit] = hz >= 1e6 ? [1e-6, "MHz"] : hz >= 1e3 ? [1e-3, "kHz"] : [1, "Hz"];
  return `${Number((hz * factor).toPrecision(4))} ${unit}`;
}
