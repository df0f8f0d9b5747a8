// Runs the program in a worker, so that the page never waits for it.
import { MemoryTree } from "./files.js";
import { System } from "./wasi.js";

/**
 * A run that the page asks for: words of the command line, files by path, and standard input.
 * @typedef {{ words: string[], files: [string, Uint8Array<ArrayBuffer>][], input?: Uint8Array }} Job
 */

/**
 * What a worker says of its run: text on standard error, how much of a growing file there is, the
 * end, or a fault of its own.
 * @typedef {{ said: string } | { grown: Uint8Array } | { ended: Result } | { broken: string }} Word
 */

/**
 * A run that has ended: exit code, standard output and error, and files by path.
 * @typedef {{ code: number, out: string, errors: string, files: Map<string, Uint8Array<ArrayBuffer>> }} Result
 */

/** Time from one copy of the growing series to the next, in ms. */
const COPIES = 500;

/** Beginning of a series. */
const SERIES_HEAD = "tick,";

/**
 * Runs a job.
 * @param {WebAssembly.Module} module the program
 * @param {Job} job
 * @param {(word: Word, transferred?: Transferable[]) => void} say
 */
export async function work(module, { words, files, input }, say) {
  const tree = new MemoryTree();
  for (const [path, bytes] of files) tree.put(path, bytes);
  const given = new Set(tree.list().map(([path]) => path));
  const texts = [new TextDecoder(), new TextDecoder()];
  const printed = ["", ""];
  let copied = performance.now();
  const system = new System({
    words: ["motion-rtl", ...words],
    tree,
    input,
    print(bytes, stream) {
      const text = texts[stream - 1].decode(bytes, { stream: true });
      printed[stream - 1] += text;
      if (stream === 2) say({ said: text });
    },
    wrote(_, file) {
      const now = performance.now();
      if (now - copied < COPIES || !startsWith(file.bytes, SERIES_HEAD)) return;
      copied = now;
      say({ grown: file.bytes.slice() });
    },
  });
  const code = await system.run(module);
  // Hidden files are the program's own.
  const written = tree.list().filter(([path]) => !given.has(path) && !/(^|\/)\./.test(path));
  // Each with a buffer of its own size, which is handed over and not copied again.
  const results = written.map(([path, bytes]) => /** @type {const} */ ([path, bytes.slice()]));
  const [out, errors] = printed;
  say({ ended: { code, out, errors, files: new Map(results) } }, results.map(([, bytes]) => bytes.buffer));
}

/** @param {Uint8Array} bytes @param {string} text */
function startsWith(bytes, text) {
  return [...text].every((letter, place) => bytes[place] === letter.charCodeAt(0));
}

// Neither a page nor a test.
if (typeof document === "undefined" && typeof self !== "undefined") {
  self.addEventListener("message", async ({ data: { module, job } }) => {
    /** @param {Word} word @param {Transferable[]} [transferred] */
    const say = (word, transferred = []) => self.postMessage(word, { transfer: transferred });
    try {
      await work(module, job, say);
    } catch (error) {
      say({ broken: String(error) });
    }
  });
}
