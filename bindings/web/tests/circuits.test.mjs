import assert from "node:assert/strict";
import { existsSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { Circuits } from "../../../src/cli/page/circuits.js";
import { MemoryTree } from "../../../src/cli/page/files.js";
import { System } from "../../../src/cli/page/wasi.js";
import { waves } from "./program.mjs";

const built = join(waves, "../target/wasm32-wasip1/release/motion-rtl.wasm");
const wasm = process.env.MOTION_RTL_WASM ?? built;

/** A module whose function `run` returns its number of ticks. */
const MODULE = Uint8Array.of(
  ...[0, 97, 115, 109, 1, 0, 0, 0],
  ...[1, 8, 1, 0x60, 3, 0x7f, 0x7f, 0x7e, 1, 0x7e],
  ...[2, 15, 1, 3, ...letters("env"), 6, ...letters("memory"), 2, 0, 0],
  ...[3, 2, 1, 0],
  ...[7, 7, 1, 3, ...letters("run"), 0, 0],
  ...[10, 6, 1, 4, 0, 0x20, 2, 0x0b],
);

/** @param {string} text */
function letters(text) {
  return [...text].map((letter) => letter.charCodeAt(0));
}

test("a circuit is a function in the table of the program", () => {
  const memory = new WebAssembly.Memory({ initial: 1 });
  const table = new WebAssembly.Table({ element: "anyfunc", initial: 3 });
  const circuits = new Circuits();
  circuits.program = { memory, __indirect_function_table: table };
  new Uint8Array(memory.buffer, 40).set(MODULE);
  const [first, second] = [0, 1].map(() => circuits.calls.compile(40, MODULE.length));
  assert.deepEqual([first, second], [3, 4]);
  assert.equal(table.get(first)(0, 1, 5n), 5n);
  circuits.calls.free(first);
  assert.equal(table.get(first), null);
  assert.equal(circuits.calls.compile(40, MODULE.length), first);
  assert.equal(table.length, 5);
});

test("what is no module, or has no table to go to, is not compiled", () => {
  const memory = new WebAssembly.Memory({ initial: 1 });
  const circuits = new Circuits();
  circuits.program = { memory };
  new Uint8Array(memory.buffer).set(MODULE);
  assert.equal(circuits.compile(0, MODULE.length), 0);
  circuits.program.__indirect_function_table = new WebAssembly.Table({ element: "anyfunc", initial: 1 });
  assert.equal(circuits.compile(0, MODULE.length - 1), 0);
});

const skip = existsSync(wasm) ? false : "the program for browsers is not built";

test("a run with compiled circuits has the summary of an interpreted one", { skip }, async (t) => {
  const module = await WebAssembly.compile(readFileSync(wasm));
  /** Summary of a run. */
  const summary = async () => {
    const tree = new MemoryTree();
    tree.put("weld.toml", new Uint8Array(readFileSync(join(waves, "weld.toml"))));
    const decoder = new TextDecoder();
    let out = "";
    const words = ["motion-rtl", "run", "weld.toml", "--json", "--no-vcd", "--quiet"];
    const print = (/** @type {Uint8Array} */ bytes, /** @type {1 | 2} */ stream) => {
      if (stream === 1) out += decoder.decode(bytes, { stream: true });
    };
    assert.equal(await new System({ words, tree, print }).run(module), 0);
    return out;
  };
  const compile = t.mock.method(Circuits.prototype, "compile");
  const compiled = await summary();
  const places = compile.mock.calls.map(({ result }) => result);
  assert.ok(places.length > 0 && places.every((place) => place > 0), `${places}`);
  compile.mock.mockImplementation(() => 0);
  assert.equal(await summary(), compiled);
});
