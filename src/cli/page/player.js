/** Moves a play head with time, as fast or slow as wanted. Dispatches `state`. */
export class Player extends EventTarget {
  #playhead;
  #clockHz = 1;
  #frame = 0;
  #last = 0;
  /** Tick with its fraction. */
  #exact = 0;
  /** Seconds of the run per second. */
  speed = 1;

  /** @param {import("./playhead.js").Playhead} playhead */
  constructor(playhead) {
    super();
    this.#playhead = playhead;
    // Another one who moves the play head goes on from there.
    playhead.addEventListener("change", (event) => {
      const { tick, from } = /** @type {CustomEvent} */ (event).detail;
      if (from !== this) this.#exact = tick;
    });
  }

  /** @param {number} clockHz ticks per second of the run */
  set clockHz(clockHz) {
    this.#clockHz = clockHz;
  }

  get playing() {
    return this.#frame !== 0;
  }

  /** Starts, at the begin if the play head is at the end; or pauses. */
  toggle() {
    if (this.playing) this.pause();
    else this.#play();
  }

  pause() {
    if (!this.playing) return;
    cancelAnimationFrame(this.#frame);
    this.#frame = 0;
    this.dispatchEvent(new CustomEvent("state"));
  }

  #play() {
    if (this.#playhead.tick >= this.#playhead.last) this.#playhead.set(this.#playhead.first, null);
    this.#exact = this.#playhead.tick;
    this.#last = performance.now();
    this.#frame = requestAnimationFrame((now) => this.#step(now));
    this.dispatchEvent(new CustomEvent("state"));
  }

  /** @param {number} now milliseconds */
  #step(now) {
    // A page in the background gets no frames; it goes on where it was.
    const passed = Math.min(0.25, Math.max(0, (now - this.#last) / 1000));
    this.#last = now;
    this.#exact += passed * this.speed * this.#clockHz;
    this.#playhead.set(this.#exact, this);
    if (this.#playhead.tick >= this.#playhead.last) {
      this.pause();
      return;
    }
    this.#frame = requestAnimationFrame((next) => this.#step(next));
  }
}
