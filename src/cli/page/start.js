// Data inside the page, with which it starts: the program, the shipped scenarios, and a finished run.
import { Notes } from "./notes.js";
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
 * A part of the page: within it (base64 of a zlib stream), or beside it (an address).
 * @typedef {{ within: string } | { beside: string }} Part
 */

/**
 * Data inside the page. The program is a part of the page, served (where jobs are posted), or there
 * is none. The page of a run has no notes.
 * @typedef {object} Start
 * @property {Part | { served: string } | null} program
 * @property {Part | null} notes
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
    return WebAssembly.compile(await bytesOf(program));
  });
}

/**
 * The notes of a page, if it has them. They are loaded when they are first asked for.
 * @param {Start["notes"]} notes
 */
export function notesOf(notes) {
  return notes ? new Notes(() => bytesOf(notes)) : undefined;
}

/** @param {Part} part */
function bytesOf(part) {
  return "within" in part ? unzipped(part.within) : fetched(part.beside);
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
  const response = await fetch(address).catch(() => undefined);
  if (!response?.ok) {
    const why = response ? `${response.status} ${response.statusText}` : "it cannot be read";
    throw new Error(`${address}: ${why}. This page needs a server of files; motion-rtl.html needs none`);
  }
  return response.arrayBuffer();
}
