/** Greatest width in bits whose values are kept as plain numbers. */
export const PLAIN_BITS = 52;
/** Greatest width in bits of a machine word. */
const WORD_BITS = 64;
/** Mark of a value with unknown bits in `Changes.unknown`. */
export const UNKNOWN_X = 1;
/** Mark of a value whose bits are all high impedance. */
export const UNKNOWN_Z = 2;

/**
 * Changes of a signal, oldest first. `times` are in units of the dump. `values` are bit patterns
 * as unsigned numbers (of up to 52 bits as numbers, of up to 64 in a BigUint64Array, wider ones as
 * bigints), real numbers, or numbers of texts in the signal's table. `unknown` marks the values
 * with unknown bits, if there are any.
 * @typedef {object} Changes
 * @property {Float64Array} times
 * @property {Float64Array | BigUint64Array | bigint[]} values
 * @property {Uint8Array} [unknown]
 */

/** Growing list of a signal's changes. A change at the time of the one before replaces it. */
export class ChangeColumn {
  #length = 0;
  #times = new Float64Array(16);
  /** @type {Float64Array} */
  #numbers;
  /** Both halves of each word, the lower first: half numbers are cheaper than bigints. */
  #halves = new Uint32Array(0);
  /** @type {bigint[]} */
  #wide = [];
  /** @type {Uint8Array | undefined} */
  #unknown;
  /** @type {"plain" | "word" | "wide"} */
  #storage;
  /** @type {Map<string, number>} */
  #texts = new Map();

  /** @param {number} width in bits; 0 for real numbers and texts */
  constructor(width) {
    this.#storage = width <= PLAIN_BITS ? "plain" : width <= WORD_BITS ? "word" : "wide";
    this.#numbers = new Float64Array(this.#storage === "plain" ? 16 : 0);
    if (this.#storage === "word") this.#halves = new Uint32Array(32);
  }

  /** True if values are pushed by `pushPair`. */
  get isWord() {
    return this.#storage === "word";
  }

  /** True if values are pushed by `pushWide`. */
  get isWide() {
    return this.#storage === "wide";
  }

  /** Texts by their numbers. */
  get table() {
    return new Map([...this.#texts].map(([text, number]) => [number, text]));
  }

  /**
   * @param {number} time
   * @param {number} value
   */
  push(time, value) {
    // The place may be in a new array.
    const at = this.#place(time);
    this.#numbers[at] = value;
  }

  /**
   * @param {number} time
   * @param {number} high upper 32 bits
   * @param {number} low lower 32 bits
   */
  pushPair(time, high, low) {
    const at = 2 * this.#place(time);
    this.#halves[at] = low;
    this.#halves[at + 1] = high;
  }

  /**
   * @param {number} time
   * @param {bigint} value
   */
  pushWide(time, value) {
    const at = this.#place(time);
    this.#wide[at] = value;
  }

  /**
   * @param {number} time
   * @param {string} text
   */
  pushText(time, text) {
    let number = this.#texts.get(text);
    if (number === undefined) {
      number = this.#texts.size;
      this.#texts.set(text, number);
    }
    this.push(time, number);
  }

  /**
   * Adds a value from its digits, the highest first: 0, 1, or any other character for an unknown
   * bit. Missing digits are zeros, or unknown if the first digit is.
   * @param {number} time
   * @param {ArrayLike<number>} bytes
   * @param {number} from
   * @param {number} to
   */
  pushDigits(time, bytes, from, to) {
    let high = 0;
    let low = 0;
    let impedance = 0;
    let other = 0;
    const middle = to - 32;
    for (let i = from; i < to; i++) {
      const digit = bytes[i] - 48;
      if (digit !== 0 && digit !== 1) {
        if ((bytes[i] | 32) === 122) impedance++;
        else other++;
      } else if (i < middle) {
        high = high * 2 + digit;
      } else {
        low = low * 2 + digit;
      }
    }
    if (impedance + other > 0) {
      this.pushUnknown(time, impedance === to - from ? UNKNOWN_Z : UNKNOWN_X);
    } else if (this.#storage === "plain") {
      this.push(time, high * 2 ** 32 + low);
    } else if (this.#storage === "word") {
      this.pushPair(time, high, low);
    } else {
      const digits = Array.prototype.slice.call(bytes, from, to);
      this.pushWide(time, BigInt(`0b${String.fromCharCode(...digits)}`));
    }
  }

  /**
   * @param {number} time
   * @param {number} mark `UNKNOWN_X` or `UNKNOWN_Z`
   */
  pushUnknown(time, mark) {
    const at = this.#place(time);
    if (this.#storage === "plain") this.#numbers[at] = 0;
    else if (this.#storage === "word") this.#halves.fill(0, 2 * at, 2 * at + 2);
    else this.#wide[at] = 0n;
    this.#unknown ??= new Uint8Array(this.#times.length);
    this.#unknown[at] = mark;
  }

  /**
   * Returns the changes; the column is not used after that.
   * @returns {Changes}
   */
  finish() {
    const length = this.#length;
    const times = this.#times.slice(0, length);
    /** @type {Changes} */
    const changes = { times, values: this.#wide };
    if (this.#storage === "plain") changes.values = this.#numbers.slice(0, length);
    if (this.#storage === "word") {
      changes.values = new BigUint64Array(this.#halves.slice(0, 2 * length).buffer);
    }
    if (this.#unknown) changes.unknown = this.#unknown.slice(0, length);
    return changes;
  }

  /**
   * Returns the place of a change at a time.
   * @param {number} time
   */
  #place(time) {
    if (this.#length > 0 && this.#times[this.#length - 1] === time) {
      if (this.#unknown) this.#unknown[this.#length - 1] = 0;
      return this.#length - 1;
    }
    if (this.#length === this.#times.length) this.#grow();
    this.#times[this.#length] = time;
    return this.#length++;
  }

  #grow() {
    /**
     * @template {Float64Array | Uint32Array | Uint8Array} T
     * @param {T} array
     * @returns {T}
     */
    const doubled = (array) => {
      const twice = new /** @type {any} */ (array.constructor)(2 * array.length);
      twice.set(array);
      return twice;
    };
    this.#times = doubled(this.#times);
    if (this.#storage === "plain") this.#numbers = doubled(this.#numbers);
    if (this.#storage === "word") this.#halves = doubled(this.#halves);
    if (this.#unknown) this.#unknown = doubled(this.#unknown);
  }
}
