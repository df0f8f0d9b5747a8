// The program that the tests run, and its shipped scenarios.

import { spawnSync } from "node:child_process";
import { mkdtempSync, readFileSync, readdirSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

const root = join(dirname(fileURLToPath(import.meta.url)), "../../..");
const program = process.env.MOTION_RTL ?? join(root, "target/release/motion-rtl");

/** Directory of the shipped scenarios. */
export const waves = join(root, "waves");

/** Names of the shipped scenarios. */
export const scenarios = readdirSync(waves).filter((file) => file.endsWith(".toml")).map((file) => file.slice(0, -5));

/**
 * Text of a shipped scenario.
 * @param {string} name
 */
export function scenarioText(name) {
  return readFileSync(join(waves, `${name}.toml`), "utf8");
}

/**
 * Runs the program in the directory of the scenarios.
 * @param {string[]} words
 * @returns {{ code: number, out: string, errors: string }}
 */
export function run(...words) {
  const { status, stdout, stderr, error } = spawnSync(program, words, { cwd: waves, encoding: "utf8", maxBuffer: 1 << 28 });
  if (error) throw error;
  return { code: status ?? -1, out: stdout, errors: stderr };
}

/**
 * Runs a scenario without waves; returns its summary as text and its series in CSV.
 * @param {string} name
 * @param {string[]} options
 */
export function runScenario(name, ...options) {
  return runScenarioAs("csv", name, ...options);
}

/**
 * Runs a scenario without waves; returns its summary as text and its series.
 * @param {"csv" | "npy"} format
 * @param {string} name
 * @param {string[]} options
 */
export function runScenarioAs(format, name, ...options) {
  const out = mkdtempSync(join(tmpdir(), "motion-rtl-"));
  try {
    const series = join(out, `series.${format}`);
    const result = run("run", `${name}.toml`, "--json", "--no-vcd", "--out", out, "--series", series, ...options);
    return { ...result, series: result.code === 2 ? new Uint8Array() : new Uint8Array(readFileSync(series)) };
  } finally {
    rmSync(out, { recursive: true });
  }
}
