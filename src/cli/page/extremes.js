/** Rows of a block whose extremes are kept. */
const EXTREMES_BLOCK = 64;

/** Least and greatest of ranges of a column, from those of blocks. */
export class RangeExtremes {
  #values;
  #least;
  #greatest;
  least = Infinity;
  greatest = -Infinity;

  /** @param {Float64Array} values */
  constructor(values) {
    this.#values = values;
    const blocks = Math.floor(values.length / EXTREMES_BLOCK);
    this.#least = new Float64Array(blocks);
    this.#greatest = new Float64Array(blocks);
    for (let block = 0; block < blocks; block += 1) {
      this.#start();
      this.#take(block * EXTREMES_BLOCK, (block + 1) * EXTREMES_BLOCK);
      this.#least[block] = this.least;
      this.#greatest[block] = this.greatest;
    }
  }

  /**
   * Sets `least` and `greatest` to those of a range of rows, its end excluded. In a range without
   * numbers they are infinite.
   * @param {number} from
   * @param {number} to
   */
  find(from, to) {
    this.#start();
    const [firstBlock, endBlock] = [Math.ceil(from / EXTREMES_BLOCK), Math.floor(to / EXTREMES_BLOCK)];
    if (firstBlock >= endBlock) {
      this.#take(from, to);
      return;
    }
    this.#take(from, firstBlock * EXTREMES_BLOCK);
    for (let block = firstBlock; block < endBlock; block += 1) {
      if (this.#least[block] < this.least) this.least = this.#least[block];
      if (this.#greatest[block] > this.greatest) this.greatest = this.#greatest[block];
    }
    this.#take(endBlock * EXTREMES_BLOCK, to);
  }

  #start() {
    this.least = Infinity;
    this.greatest = -Infinity;
  }

  /**
   * @param {number} from
   * @param {number} to
   */
  #take(from, to) {
    for (let row = from; row < to; row += 1) {
      const value = this.#values[row];
      if (value < this.least) this.least = value;
      if (value > this.greatest) this.greatest = value;
    }
  }
}
