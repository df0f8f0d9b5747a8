import assert from "node:assert/strict";
import { test } from "node:test";
import { readFst } from "../../../src/cli/page/fst.js";
import { readSave } from "../../../src/cli/page/savefile.js";
import { savedRows } from "../../../src/cli/page/waverows.js";
import { written } from "./waveruns.mjs";

const flat = (rows) => rows.flatMap((row) => [row, ...(row.rows ? flat(row.rows) : [])]);

/** Number of lines that begin a group: those with bit 23 in the flags. */
function begun(save) {
  let flags = 0;
  return save.split("\n").filter((line) => {
    if (line.startsWith("@")) flags = parseInt(line.slice(1), 16);
    return line.startsWith("-") && flags & 0x800000;
  }).length;
}

for (const name of ["bracket", "machine", "plotter"]) {
  test(`${name}: every signal of the save file is a row with a signal of the dump`, async () => {
    const { waves, save } = written(name, "fst", "--from", "0", "--to", "10");
    const dump = await readFst(waves);
    const saved = readSave(save);
    const colors = save.match(/^\[color\]/gm).length;
    const clk = save.match(/\.clk$/gm).length;
    const signals = flat(saved.rows).filter(({ type }) => type === "signal");
    assert.equal(signals.length, colors + clk);
    const rows = savedRows(saved.rows, dump);
    assert.equal(rows.filter(({ type }) => type === "signal").length, signals.length);
    const lines = signals.reduce((sum, row) => sum + row.lines - 1, 0);
    assert.equal(lines, 3 * signals.filter(({ curve }) => curve === "step").length);
    const groups = flat(saved.rows).filter(({ type }) => type === "group");
    assert.equal(groups.length, begun(save));
    const fractions = save.match(/^\[fpshift_count\] \d+/gm) ?? [];
    assert.deepEqual(
      signals.filter(({ format }) => format.fraction).map(({ format }) => format.fraction),
      fractions.map((line) => Number(line.split(" ")[1])),
    );
    assert.ok(saved.shown.end > saved.shown.start);
  });
}

test("rows have formats, curves, colours and groups", () => {
  const save = readSave(`[*] top
[timestart] 4000
[size] 1600 900
*-10.000000 -1 -1
[sst_width] 220
[signals_width] 380
@200
-overview
@40008420
[color] 3
[fpshift_count] 8
+{a/speed[15:0]} top.a.speed[15:0]
@20000
-
-
@22
[color] 4
top.word[7:0]
top.plain[3:0]
@28
top.bit
@820
[color] 2
top.state_name
@c00200
-closed
@24
top.in[3:0]
@800200
-open
@10420
top.deep[3:0]
@1000200
-open
@1401200
-closed
@420
top.last[1:0]
`);
  const signal = (path, label, format, more) => ({
    type: "signal",
    path,
    label,
    format,
    curve: "no",
    lines: 1,
    color: 0,
    ...more,
  });
  assert.deepEqual(save.rows, [
    { type: "comment", label: "overview" },
    signal("top.a.speed", "a/speed", { radix: "signed", fraction: 8 }, { curve: "step", lines: 3, color: 3 }),
    signal("top.word", "word", { radix: "hex" }, { color: 4 }),
    signal("top.plain", "plain", { radix: "hex" }),
    signal("top.bit", "bit", { radix: "binary" }),
    signal("top.state_name", "state_name", { radix: "state" }, { color: 2 }),
    {
      type: "group",
      label: "closed",
      open: false,
      rows: [
        signal("top.in", "in", { radix: "unsigned" }),
        {
          type: "group",
          label: "open",
          open: true,
          rows: [signal("top.deep", "deep", { radix: "signed" }, { curve: "line" })],
        },
      ],
    },
    signal("top.last", "last", { radix: "signed" }),
  ]);
  // 900 pixels of 1024 / 200 times each.
  assert.deepEqual(save.shown, { start: 4000, end: 4000 + (900 * 1024) / 200 });
});
