// Runs of the program for the tests of the readers.
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

const root = join(dirname(fileURLToPath(import.meta.url)), "../../..");
const program = process.env.MOTION_RTL ?? join(root, "target/release/motion-rtl");

/**
 * Runs a shipped scenario and returns the waves that it wrote, and its save file as text.
 * @param {string} name of the scenario
 * @param {"fst" | "vcd"} format
 * @param {string[]} options
 * @returns {{waves: Uint8Array, save: string}}
 */
export function written(name, format, ...options) {
  const out = mkdtempSync(join(tmpdir(), "motion-rtl-"));
  try {
    const words = ["run", `waves/${name}.toml`, "-q", "--out", out, "--format", format];
    execFileSync(program, [...words, ...options], { cwd: root });
    return {
      waves: new Uint8Array(readFileSync(join(out, `${name}.${format}`))),
      save: readFileSync(join(out, `${name}.gtkw`), "utf8"),
    };
  } finally {
    rmSync(out, { recursive: true });
  }
}

/**
 * Reads a dump that the program wrote, line by line and with nothing in common with the readers:
 * the width and the changes of each path, as lines of a time and bits or a name.
 * @param {Uint8Array} bytes
 * @returns {Map<string, {width: number, changes: string[]}>}
 */
export function plainVcd(bytes) {
  const [head, body] = new TextDecoder().decode(bytes).split("$enddefinitions $end\n");
  const scope = [];
  const signals = new Map();
  const codes = new Map();
  for (const line of head.split("\n")) {
    const words = line.split(" ");
    if (words[0] === "$scope") scope.push(words[2]);
    if (words[0] === "$upscope") scope.pop();
    if (words[0] !== "$var") continue;
    const signal = { width: words[1] === "string" ? 0 : Number(words[2]), changes: [] };
    signals.set([...scope, words[4]].join("."), signal);
    codes.set(words[3], signal);
  }
  let time = 0;
  for (const line of body.split("\n")) {
    if (line === "" || line.startsWith("$")) continue;
    if (line.startsWith("#")) {
      time = Number(line.slice(1));
    } else if (/^[bs]/.test(line)) {
      const [value, code] = line.slice(1).split(" ");
      codes.get(code).changes.push(`${time} ${value}`);
    } else {
      codes.get(line.slice(1)).changes.push(`${time} ${line[0]}`);
    }
  }
  return signals;
}

/**
 * Returns the changes of a signal as `plainVcd` does.
 * @param {import("../../../src/cli/page/dump.js").DumpSignal} signal
 * @param {import("../../../src/cli/page/column.js").Changes} changes
 * @returns {string[]}
 */
export function plainChanges(signal, changes) {
  return Array.from(changes.times, (time, i) => {
    const value = changes.values[i];
    return `${time} ${signal.kind === "text" ? signal.table.get(value) : value.toString(2)}`;
  });
}
