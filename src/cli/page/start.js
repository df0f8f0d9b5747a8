// Data inside the page, with which it starts: the program, the shipped scenarios, and a finished run.
import { BrowserRunner, ServedRunner, fromBase64 } from "./runner.js";

/** @typedef {import("./worker.js").Result} Result */

/**
 * A shipped scenario: the name of its file, what it is in a line, and its text.
 * @typedef {{ file: string, about: string, text: string }} Scenario
 */

/**
 * A finished run: the words of its command line and what came of it.
 * @typedef {{ words: string[], result: Result }} Finished
 */

/**
 * Data inside the page. The program is within the page (base64 of a zlib stream), beside it (an
 * address), served (where jobs are posted), or there is none.
 * @typedef {object} Start
 * @property {{ within: string } | { beside: string } | { served: string } | null} program
 * @property {Scenario[]} scenarios
 * @property {{ words: string[], code: number, out: string, errors: string, files: [string, string][] } | null} run
 * @property {string} version
 */

/** Reads the data inside the page. */
export function readStart() {
  return /** @type {Start} */ (JSON.parse(textOf("start")));
}

/**
 * The runner of a page, if it has a program.
 * @param {Start["program"]} program
 */
export function runnerOf(program) {
  if (program === null) return undefined;
  if ("served" in program) return new ServedRunner(program.served);
  // From a file, too, a worker may be made of a blob.
  const script = URL.createObjectURL(new Blob([textOf("worker")], { type: "text/javascript" }));
  return new BrowserRunner(script, async () => {
    const bytes = "within" in program ? await unzipped(program.within) : await fetched(program.beside);
    return WebAssembly.compile(bytes);
  });
}

/**
 * A run that the page was made with.
 * @param {NonNullable<Start["run"]>} run
 * @returns {Finished}
 */
export function finished({ words, code, out, errors, files }) {
  const unpacked = files.map(([path, text]) => /** @type {const} */ ([path, fromBase64(text)]));
  return { words, result: { code, out, errors, files: new Map(unpacked) } };
}

/** @param {string} id */
function textOf(id) {
  return document.getElementById(id)?.textContent ?? "";
}

/** @param {string} text */
async function unzipped(text) {
  const stream = new Blob([fromBase64(text)]).stream();
  return new Response(stream.pipeThrough(new DecompressionStream("deflate"))).arrayBuffer();
}

/** @param {string} address */
async function fetched(address) {
  const response = await fetch(address);
  if (!response.ok) throw new Error(`${address}: ${response.status} ${response.statusText}`);
  return response.arrayBuffer();
}
