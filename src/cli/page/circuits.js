// Circuits that the program compiles: modules on its memory, as functions in its table.

/**
 * What a program exports for its circuits.
 * @typedef {{ memory: WebAssembly.Memory, __indirect_function_table?: WebAssembly.Table }} Exports
 */

/** The circuits of one run. */
export class Circuits {
  constructor() {
    /** @type {Exports | undefined} */
    this.program = undefined;
    /**
     * Places of the table that are given back.
     * @type {number[]}
     */
    this.free = [];
  }

  /** What the program imports. */
  get calls() {
    return {
      compile: (/** @type {number} */ at, /** @type {number} */ length) => this.compile(at, length),
      free: (/** @type {number} */ place) => this.remove(place),
    };
  }

  /**
   * Compiles a module that lies in the program's memory. Returns the place of its function in the
   * table, or 0 if the browser does not take it: the program then interprets.
   * @param {number} at @param {number} length
   */
  compile(at, length) {
    const { memory, __indirect_function_table: table } = /** @type {Exports} */ (this.program);
    if (!table) return 0;
    try {
      const module = new WebAssembly.Module(new Uint8Array(memory.buffer, at, length));
      const { run } = new WebAssembly.Instance(module, { env: { memory } }).exports;
      const place = this.free.pop() ?? table.grow(1);
      table.set(place, run);
      return place;
    } catch {
      return 0;
    }
  }

  /** @param {number} place */
  remove(place) {
    this.program?.__indirect_function_table?.set(place, null);
    this.free.push(place);
  }
}
