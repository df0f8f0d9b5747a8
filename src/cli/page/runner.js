// Runs of the program: in the browser, or by the program that serves the page.

/** @typedef {import("./worker.js").Job} Job */
/** @typedef {import("./worker.js").Word} Word */
/** @typedef {import("./worker.js").Result} Result */

/**
 * Who wants to know how a run goes: text on standard error as it comes, and the series so far.
 * @typedef {{ said?: (text: string) => void, grown?: (series: Uint8Array) => void }} Listener
 */

/** Thrown when a run is cancelled. */
export class Cancelled extends Error {
  constructor() {
    super("cancelled");
  }
}

/** Runs the program in workers, each run in a worker of its own. */
export class BrowserRunner {
  /**
   * @param {string} script address of the worker's script
   * @param {() => Promise<WebAssembly.Module>} compile
   */
  constructor(script, compile) {
    this.script = script;
    this.compile = compile;
    /** @type {Promise<WebAssembly.Module> | undefined} */
    this.module = undefined;
  }

  /** The compiled program; compiled once. */
  ready() {
    this.module ??= this.compile();
    return this.module;
  }

  /**
   * Runs a job to its end.
   * @param {Job} job
   * @param {Listener} [listener]
   * @param {AbortSignal} [signal] cancels it
   * @returns {Promise<Result>}
   */
  async run(job, listener = {}, signal) {
    const module = await this.ready();
    if (signal?.aborted) throw new Cancelled();
    const worker = new Worker(this.script);
    try {
      return await new Promise((resolve, reject) => {
        signal?.addEventListener("abort", () => reject(new Cancelled()));
        worker.onerror = (event) => reject(new Error(event.message));
        worker.onmessage = ({ data }) => {
          const word = /** @type {Word} */ (data);
          if ("said" in word) listener.said?.(word.said);
          else if ("grown" in word) listener.grown?.(word.grown);
          else if ("broken" in word) reject(new Error(word.broken));
          else resolve(word.ended);
        };
        worker.postMessage({ module, job });
      });
    } finally {
      worker.terminate();
    }
  }
}

/** Time between two looks at a run of the serving program, in ms: it grows from the first to the last. */
const LOOKS = [20, 150];

/** Time from one look at the growing series to the next, in ms. */
const SERIES_LOOKS = 500;

/** Has the program run that serves the page. */
export class ServedRunner {
  /** @param {string} address where jobs are posted */
  constructor(address) {
    this.address = address;
  }

  async ready() {}

  /**
   * Runs a job to its end.
   * @param {Job} job
   * @param {Listener} [listener]
   * @param {AbortSignal} [signal] cancels it: the program is ended
   * @returns {Promise<Result>}
   */
  async run({ words, files: given, input }, listener = {}, signal) {
    const body = JSON.stringify({
      words,
      files: given.map(([path, bytes]) => [path, toBase64(bytes)]),
      input: input ? toBase64(input) : null,
    });
    const { id } = await (await answered(fetch(this.address, { method: "POST", body }))).json();
    const run = `${this.address}/${id}`;
    let [errors, from, series, pause] = ["", 0, "", LOOKS[0]];
    let seriesFrom = performance.now() + SERIES_LOOKS;
    try {
      for (;;) {
        if (signal?.aborted) throw new Cancelled();
        const wantsSeries = listener.grown !== undefined && performance.now() >= seriesFrom;
        const seen = wantsSeries ? `from=${from}&series=${series.length}` : `from=${from}`;
        const state = await (await answered(fetch(`${run}?${seen}`))).json();
        errors += state.said;
        from = state.next;
        if (state.said !== "") listener.said?.(state.said);
        if (state.ended) {
          const { code, out, files } = state.ended;
          return { code, out, errors, files: await filesOf(run, files) };
        }
        if (wantsSeries) seriesFrom = performance.now() + SERIES_LOOKS;
        if (state.series !== "") {
          series += state.series;
          listener.grown?.(new TextEncoder().encode(series));
        }
        await new Promise((resolve) => setTimeout(resolve, pause));
        pause = Math.min(1.5 * pause, LOOKS[1]);
      }
    } finally {
      // Ends it if it still runs, and removes its files.
      await fetch(run, { method: "DELETE" });
    }
  }
}

/**
 * An answer, unless it is a refusal.
 * @param {Promise<Response>} asked
 */
async function answered(asked) {
  const response = await asked;
  if (!response.ok) throw new Error(await response.text());
  return response;
}

/**
 * The files of a run.
 * @param {string} run
 * @param {string[]} paths
 */
async function filesOf(run, paths) {
  const fetched = paths.map(async (path) => {
    const response = await answered(fetch(`${run}/${encodeURIComponent(path)}`));
    return /** @type {const} */ ([path, new Uint8Array(await response.arrayBuffer())]);
  });
  return new Map(await Promise.all(fetched));
}

/** @param {Uint8Array} bytes */
export function toBase64(bytes) {
  let text = "";
  // Arguments of a call are limited in number.
  for (let from = 0; from < bytes.length; from += 0x8000) {
    text += String.fromCharCode(...bytes.subarray(from, from + 0x8000));
  }
  return btoa(text);
}

/** @param {string} text */
export function fromBase64(text) {
  const letters = atob(text);
  const bytes = new Uint8Array(letters.length);
  for (let place = 0; place < letters.length; place++) bytes[place] = letters.charCodeAt(place);
  return bytes;
}
