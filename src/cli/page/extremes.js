/** Numbers of a group in `Extremes`. */
const GROUP = 32;

/** Least and greatest numbers of any part of a list, without going over all of the part. */
export class Extremes {
  /** @type {{least: Float64Array, greatest: Float64Array}[]} */
  #levels;

  /** @param {Float64Array} numbers NaN is left out */
  constructor(numbers) {
    this.numbers = numbers;
    this.#levels = [{ least: numbers, greatest: numbers }];
    for (let { least, greatest } = this.#levels[0]; least.length > GROUP; ) {
      const groups = Math.ceil(least.length / GROUP);
      const level = {
        least: new Float64Array(groups).fill(Infinity),
        greatest: new Float64Array(groups).fill(-Infinity),
      };
      for (let i = 0; i < least.length; i++) {
        const group = Math.floor(i / GROUP);
        if (least[i] < level.least[group]) level.least[group] = least[i];
        if (greatest[i] > level.greatest[group]) level.greatest[group] = greatest[i];
      }
      this.#levels.push(level);
      ({ least, greatest } = level);
    }
  }

  /**
   * Returns the least and greatest number from index `from` up to, without, `to`; infinite if
   * there is none.
   * @param {number} from
   * @param {number} to
   * @returns {[number, number]}
   */
  between(from, to) {
    let least = Infinity;
    let greatest = -Infinity;
    /**
     * @param {number} level
     * @param {number} i
     */
    const take = (level, i) => {
      const { least: low, greatest: high } = this.#levels[level];
      if (low[i] < least) least = low[i];
      if (high[i] > greatest) greatest = high[i];
    };
    for (let level = 0; from < to; level++) {
      const isTop = level === this.#levels.length - 1;
      while (from < to && (isTop || from % GROUP !== 0)) take(level, from++);
      while (from < to && to % GROUP !== 0) take(level, --to);
      from /= GROUP;
      to /= GROUP;
    }
    return [least, greatest];
  }
}
