/**
 * The tick that all panes show, a whole number of periods of the reference
 * clock. A pane sets it and hears of it by the event `change`.
 */
export class Playhead extends EventTarget {
  #tick = 0;
  #first = 0;
  #last = Number.MAX_SAFE_INTEGER;

  /** Tick that is shown. */
  get tick() {
    return this.#tick;
  }

  /** First tick that may be shown. */
  get first() {
    return this.#first;
  }

  /** Last tick that may be shown. */
  get last() {
    return this.#last;
  }

  /**
   * Sets the range of ticks, both ends within it; the tick is moved into it.
   * @param {number} first
   * @param {number} last
   */
  limit(first, last) {
    this.#first = Math.floor(first);
    this.#last = Math.max(this.#first, Math.floor(last));
    this.set(this.#tick, null);
  }

  /**
   * Moves to a tick, within the range; a fraction is dropped, as the tick that
   * has begun is shown. Dispatches `change` if the tick is another one.
   * @param {number} tick
   * @param {unknown} from who sets it, so that it can tell its own changes
   */
  set(tick, from) {
    if (!Number.isFinite(tick)) return;
    const whole = Math.min(this.#last, Math.max(this.#first, Math.floor(tick)));
    if (whole === this.#tick) return;
    this.#tick = whole;
    this.dispatchEvent(new CustomEvent("change", { detail: { tick: whole, from } }));
  }
}
