import { element } from "./dom.js";

/**
 * A fault in an input or a setting. `file` is `--set` for a setting of the command line.
 * @typedef {object} ProgramFault
 * @property {string} file
 * @property {number | null} line from 1
 * @property {string} field key or word; `step 0: speed_counts_per_s` in the first table of a list
 * @property {string} problem
 * @property {string} allowed
 */

/**
 * What the program said when it failed.
 * @typedef {object} Problem
 * @property {string} message
 * @property {ProgramFault[]} faults none if the failure is of another kind
 * @property {string} text standard error, with the lines of the input
 */

/**
 * Reads what the program printed on a failure: the JSON that it prints with `--json`, or else its
 * standard error.
 * @param {string} out standard output
 * @param {string} errors standard error
 * @returns {Problem}
 */
export function readProblem(out, errors) {
  const text = withoutColours(errors).trim();
  const said = readErrorJson(out);
  if (said) return { message: said.message, faults: said.faults ?? [], text: text || `error: ${said.message}` };
  const first = text.split("\n").find((line) => line.startsWith("error: ")) ?? text.split("\n")[0];
  const message = first.replace(/^error: /, "") || "The program failed without a message.";
  return { message, faults: [], text: text || message };
}

/**
 * Shows a problem: the program's text, in which places and carets stand out.
 * @param {Problem | string} problem or standard error
 * @returns {HTMLElement}
 */
export function problemView(problem) {
  const { text } = typeof problem === "string" ? readProblem("", problem) : problem;
  const lines = text.split("\n").map((line, k, all) => {
    const end = k + 1 < all.length ? "\n" : "";
    const [, place, rest] = /^(error: (?:[^:\s][^:]*:\d+|--set): )(.*)$/.exec(line) ?? [];
    if (place !== undefined) return element("span", {}, element("strong", { class: "problem-place" }, place), rest + end);
    if (/^\s*\|\s*\^+\s*$/.test(line)) return element("span", { class: "problem-caret" }, line + end);
    if (/^\s*\d+ \| /.test(line)) return element("mark", { class: "problem-line" }, line + end);
    return element("span", {}, line + end);
  });
  return element("section", { class: "problem-report" },
    element("h2", {}, "The program reports an error"),
    element("pre", { tabindex: 0, "aria-label": "Error of the program" }, lines));
}

/** @param {string} out */
function readErrorJson(out) {
  try {
    const error = JSON.parse(out)?.error;
    return typeof error?.message === "string" ? /** @type {{ message: string, faults?: ProgramFault[] }} */ (error) : null;
  } catch {
    return null;
  }
}

/** @param {string} text */
function withoutColours(text) {
  return text.replace(/\u001b\[[0-9;]*m/g, "");
}
