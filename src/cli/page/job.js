// The run that the page asks for: a scenario or a file of the reader's, and changed settings.

/**
 * What is to be run. Files of the reader's have names and contents; one that is no scenario runs on
 * a circuit.
 * @typedef {object} Wanted
 * @property {string} file path of a shipped scenario, or name of one of the reader's files
 * @property {[string, Uint8Array<ArrayBuffer>][]} [given] files of the reader's
 * @property {string} [circuit]
 * @property {string[]} changes KEY=VALUE
 */

/** Directory of what a run writes, and the file of its series. */
const RUN_FILES = "out";
const RUN_SERIES = `${RUN_FILES}/path.csv`;

/** A name that begins as an option does is a path. @param {string} file */
const pathOf = (file) => (file.startsWith("-") ? `./${file}` : file);

/**
 * Words and files of a run.
 * @param {Wanted} wanted
 * @param {"fst" | "vcd"} format of the waves
 * @returns {import("./worker.js").Job}
 */
export function jobOf({ file, given, circuit, changes }, format = "fst") {
  const sets = circuit ? [`circuit=${circuit}`, ...changes] : changes;
  return {
    words: [
      ...["run", pathOf(file), "--json", "--format", format, "--out", RUN_FILES, "--series", RUN_SERIES],
      ...sets.flatMap((change) => ["--set", change]),
    ],
    files: given ?? [],
  };
}

/**
 * The command line that does the same in a shell.
 * @param {Wanted} wanted
 */
export function commandOf({ file, circuit, changes }) {
  const sets = circuit ? [`circuit=${circuit}`, ...changes] : changes;
  const quoted = (/** @type {string} */ word) =>
    /^[\w./=,:+-]+$/.test(word) ? word : `'${word.replaceAll("'", "'\\''")}'`;
  return ["motion-rtl run", quoted(pathOf(file)), ...sets.map((change) => `--set ${quoted(change)}`)].join(" ");
}

/**
 * The file of a result with this extension, if there is one; of these paths, if they are given.
 * @param {import("./worker.js").Result} result
 * @param {string} extension
 * @param {string[]} [paths]
 */
export function fileWith({ files }, extension, paths) {
  const name = (/** @type {string} */ path) => path.replace(/^.*\//, "");
  const names = paths?.map(name);
  for (const [path, bytes] of files) {
    if (path.endsWith(extension) && (names?.includes(name(path)) ?? true)) return bytes;
  }
  return undefined;
}

/**
 * How far a run is, by a line of its standard error: a part of 1, and the line.
 * @param {string} said
 */
export function progressIn(said) {
  const line = said.trim().split("\n").at(-1) ?? "";
  const percent = /(\d+) % of \d+ ticks$/.exec(line);
  return { part: percent ? Number(percent[1]) / 100 : undefined, line };
}

/**
 * What a link to the page says: scenario and changed settings.
 * @param {Wanted} wanted
 */
export function linkOf({ file, changes }) {
  return `#${new URLSearchParams([["run", file], ...changes.map((change) => ["set", change])])}`;
}

/**
 * Reads such a link; `undefined` if it names no run.
 * @param {string} hash
 * @returns {Wanted | undefined}
 */
export function wantedIn(hash) {
  const link = new URLSearchParams(hash.replace(/^#/, ""));
  const file = link.get("run");
  return file === null ? undefined : { file, changes: link.getAll("set") };
}
