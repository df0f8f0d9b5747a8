import assert from "node:assert/strict";
import { test } from "node:test";
import { numerals } from "../../../src/cli/page/diagram.js";

test("figure numerals stand without the patent of the circuit around", () => {
  const cases = [
    ["JP3640909B2 20 = 201 + 202", "JP3640909B2 1", "20 = 201 + 202"],
    ["JPH0646367B2, step numbers", "JPH0646367B2, Figs 1, 5 and 6", "step numbers"],
    ["JP3640909B2 1", "system", "JP3640909B2 1"],
    ["CN104204977 10", "JP3640909B2 1", "CN104204977 10"],
    ["JPH0743606B2", "JPH0743606B2 [5]", "JPH0743606B2"],
    ["block: sine and cosine", "CN104204977 2, 3", "block: sine and cosine"],
  ];
  for (const [source, around, expected] of cases) assert.equal(numerals(source, around), expected, source);
});
