import assert from "node:assert/strict";
import { test } from "node:test";
import { ExactNumber, readExactJson } from "../../../src/cli/page/exactjson.js";
import { isPlain, plainText, sortedRows, summaryPart } from "../../../src/cli/page/summaryparts.js";
import { runScenario, scenarios } from "./program.mjs";

/** Texts of all values that are no objects, of the JSON. */
function leaves(value) {
  if (value instanceof Map) return [...value.values()].flatMap(leaves);
  if (Array.isArray(value)) return value.flatMap(leaves);
  return [plainText(value)];
}

/** Texts of all values that a part shows. */
function shown(part) {
  const cells = part.table ? part.table.rows.flat().filter((cell) => cell !== undefined) : [];
  // The first column of a table without a name has the names of the parts.
  const names = part.table?.columns[0] === "" ? part.table.rows.map((row) => row[0]) : [];
  const texts = [...part.plain.map(([, value]) => value), ...cells.filter((cell) => !names.includes(cell))].flatMap(leaves);
  return [...texts, ...part.parts.flatMap(shown)];
}

const summaries = new Map(scenarios.map((name) => [name, runScenario(name).out]));

test("JSON of every summary is read and keeps the text of its numbers", () => {
  const write = (value) => {
    if (value instanceof Map) return `{${[...value].map(([key, each]) => `${JSON.stringify(key)}:${write(each)}`).join(",")}}`;
    if (Array.isArray(value)) return `[${value.map(write).join(",")}]`;
    return value instanceof ExactNumber ? value.text : JSON.stringify(value);
  };
  for (const [name, text] of summaries) {
    const compact = text.split("\n").map((line) => line.trim().replace(/^("(?:[^"\\]|\\.)*"): /, "$1:")).join("");
    assert.equal(write(readExactJson(text)), compact, name);
  }
});

test("a summary shows every value of the JSON, once", () => {
  for (const [name, text] of summaries) {
    const whole = readExactJson(text);
    const part = summaryPart("", whole);
    assert.deepEqual(shown(part).sort(), leaves(whole).sort(), name);
    assert.ok(part.plain.some(([key]) => key === "ticks"), `${name}: plain values stand first`);
    assert.ok(part.plain.every(([, value]) => isPlain(value)));
  }
});

test("lists of objects and alike objects are tables", () => {
  const part = summaryPart("", readExactJson(summaries.get("pocket")));
  const corrections = part.parts.find(({ name }) => name === "corrections");
  assert.ok(corrections?.table?.columns.includes("model.contour_max_um"));
  const axes = summaryPart("", readExactJson(summaries.get("bracket"))).parts.find(({ name }) => name === "axes");
  assert.equal(axes?.table?.columns[0], "");
  assert.deepEqual(axes?.table?.rows.map((row) => row[0]), ["x", "y"]);
});

test("rows are sorted by value, those without one last", () => {
  const { table } = summaryPart("", readExactJson('[{"a": 10}, {"a": 9.5}, {"b": 1}, {"a": null}, {"a": -2e1}, {"a": "x"}]'));
  const order = (falling) => sortedRows(table, 0, falling).map((row) => plainText(row[0]));
  assert.deepEqual(order(false), ["-2e1", "9.5", "10", "x", "–", "–"]);
  assert.deepEqual(order(true), ["x", "10", "9.5", "-2e1", "–", "–"]);
  assert.deepEqual(table.rows.map((row) => plainText(row[0])), ["10", "9.5", "–", "–", "-2e1", "x"]);
});

test("numbers are not rounded and wrong JSON is refused", () => {
  const text = '{"n": 9007199254740993, "f": 1.0, "e": 1e400, "s": "a\\"b\\u00e9", "l": [], "o": {}}';
  const map = readExactJson(text);
  assert.deepEqual([...map.values()].slice(0, 4).map(plainText), ["9007199254740993", "1.0", "1e400", 'a"bé']);
  for (const wrong of ["", "{", "[1,", "[1 2]", '{"a" 1}', '{"a": 1,}', "[1] 2", "nul", "[01]", "[1,]", "{,}", "]"]) {
    assert.throws(() => readExactJson(wrong), SyntaxError, wrong);
  }
});
