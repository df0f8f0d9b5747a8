import assert from "node:assert/strict";
import { test } from "node:test";
import { ChangeColumn, UNKNOWN_X } from "../../../src/cli/page/column.js";
import { Dump, edge, firstAt, indexAt, valueAt } from "../../../src/cli/page/dump.js";
import { Extremes } from "../../../src/cli/page/extremes.js";
import { collectColumns, fixedPointText, pixelColumns, realUnits, shownNumbers, valueText } from "../../../src/cli/page/valueformat.js";
import { ROW_HEIGHT, WaveRows, scopeRows, signalRow } from "../../../src/cli/page/waverows.js";
import { TimeWindow, roundStep, secondsText } from "../../../src/cli/page/waveview.js";

const signal = (width, more = {}) => ({
  path: "top.a",
  scope: ["top"],
  name: "a",
  width,
  kind: "bits",
  role: "net",
  table: null,
  id: 0,
  ...more,
});
const dumpOf = (unit) => new Dump({ signals: [], start: 0, end: 0, unit, load: () => ({}) });

/** Numbers that look random and are always the same. */
function* random() {
  for (let state = 12345; ; ) {
    state = (state * 1103515245 + 12345) % 2 ** 31;
    yield state;
  }
}

test("values and edges at, before and after changes", () => {
  const changes = { times: Float64Array.of(10, 20, 30), values: Float64Array.of(1, 2, 3) };
  const at = [9, 10, 15, 20, 30, 99].map((time) => valueAt(changes, time));
  assert.deepEqual(at, [null, 1, 1, 2, 3, 3]);
  assert.deepEqual([9, 10, 19, 30].map((time) => edge(changes, time, 1)), [10, 20, 20, null]);
  assert.deepEqual([10, 11, 20, 99].map((time) => edge(changes, time, -1)), [null, 10, 10, 30]);
  assert.equal(firstAt(changes.times, 20), 1);
  assert.equal(indexAt(changes, 9), -1);
});

test("columns keep values while they grow", () => {
  for (const width of [8, 64, 100]) {
    const column = new ChangeColumn(width);
    const wanted = [];
    for (let i = 0; i < 1000; i++) {
      const value = width === 8 ? i % 256 : (BigInt(i) << BigInt(width - 20)) + 5n;
      const digits = new TextEncoder().encode(value.toString(2));
      if (i % 37 === 5) column.pushUnknown(i, UNKNOWN_X);
      else column.pushDigits(i, digits, 0, digits.length);
      wanted.push(i % 37 === 5 ? "x" : value);
    }
    const changes = column.finish();
    assert.deepEqual(wanted.map((_, i) => valueAt(changes, i)), wanted);
  }
});

test("ticks begin where the clock rises", () => {
  // Rate, unit, and the period in units: the last one cannot be expressed.
  const clocks = [
    [100_000, 1e-6, 10],
    [160_000, 1e-9, 6250],
    [50_000_000, 1e-8, 2],
    [3_000_000, 1e-15, 333_333_334],
    [33_333_333, 1e-15, 30_000_000],
  ];
  for (const [hz, unit, period] of clocks) {
    const dump = dumpOf(unit);
    dump.setClock(hz);
    assert.equal(dump.period, period, `${hz}`);
    const { length } = [0, 1, 7, 1e6].filter((tick) => {
      const time = dump.timeOfTick(tick);
      return dump.tickOfTime(time) === tick && dump.tickOfTime(time + period - 1) === tick;
    });
    assert.equal(length, 4);
  }
});

test("values as text", () => {
  const text = (value, width, format, more) => valueText(value, signal(width, more), format);
  assert.equal(text(5, 4, { radix: "binary" }), "0101");
  assert.equal(text(5, 9, { radix: "hex" }), "005");
  assert.equal(text(15, 4, { radix: "unsigned" }), "15");
  assert.equal(text(15, 4, { radix: "signed" }), "-1");
  assert.equal(text(7, 4, { radix: "signed" }), "7");
  assert.equal(text(8, 4, { radix: "signed" }), "-8");
  assert.equal(text(2 ** 52 - 1, 52, { radix: "signed" }), "-1");
  assert.equal(text(2n ** 64n - 1n, 64, { radix: "signed" }), "-1");
  assert.equal(text(2n ** 63n, 64, { radix: "hex" }), "8000000000000000");
  assert.equal(text(384, 16, { radix: "unsigned", fraction: 8 }), "1.5");
  assert.equal(text(2 ** 16 - 1, 16, { radix: "signed", fraction: 8 }), "-0.00390625");
  assert.equal(text(300, 16, { radix: "unsigned", scale: 0.01, unit: "mm" }), "3 mm");
  assert.equal(text(2 ** 16 - 3, 16, { radix: "signed", scale: 0.1, unit: "mm" }), "-0.3 mm");
  assert.equal(text(1, 2, { radix: "state" }, { table: new Map([[1, "RUN"]]) }), "RUN");
  assert.equal(text(2, 2, { radix: "state" }, { table: new Map([[1, "RUN"]]) }), "2");
  assert.equal(text(-0.25, 0, { radix: "unsigned" }, { kind: "real" }), "-0.25");
  assert.deepEqual([text("x", 4, {}), text("z", 4, {}), text(null, 4, {})], ["x", "z", ""]);
});

test("fractions have the digits that tell them from their neighbours", () => {
  assert.equal(fixedPointText(0n, 8), "0");
  assert.equal(fixedPointText(1n, 1), "0.5");
  assert.equal(fixedPointText(-5n, 2), "-1.25");
  assert.equal(fixedPointText(1n << 40n, 40), "1");
  for (const fraction of [3, 10, 11, 20, 32, 62]) {
    const values = [1n, 2n, 3n, 1000n, 12345678n];
    for (const value of values) {
      for (const near of [value - 1n, value + 1n]) {
        assert.notEqual(fixedPointText(value, fraction), fixedPointText(near, fraction));
      }
      const shown = Number(fixedPointText(-value, fraction));
      const exact = -Number(value) / 2 ** fraction;
      assert.ok(Math.abs(shown - exact) <= 0.5 / 2 ** fraction, `${value} ${fraction}`);
    }
  }
});

test("numbers of a curve", () => {
  const changes = {
    times: Float64Array.of(0, 1, 2),
    values: Float64Array.of(255, 4, 0),
    unknown: Uint8Array.of(0, 0, 1),
  };
  const numbers = shownNumbers(changes, signal(8), { radix: "signed", fraction: 1, scale: 10 });
  assert.deepEqual([...numbers], [-5, 20, NaN]);
});

test("extremes of any part are those of all its numbers", () => {
  const source = random();
  const numbers = Float64Array.from({ length: 5000 }, () => source.next().value % 100000);
  numbers[77] = NaN;
  const extremes = new Extremes(numbers);
  for (let i = 0; i < 2000; i++) {
    const from = source.next().value % 4990;
    const to = from + 1 + (source.next().value % (i % 2 ? 8 : 4990));
    const part = [...numbers.slice(from, to)].filter((number) => !Number.isNaN(number));
    assert.deepEqual(extremes.between(from, to), [Math.min(...part), Math.max(...part)]);
  }
  assert.deepEqual(extremes.between(3, 3), [Infinity, -Infinity]);
});

test("pixel columns hold all changes of the window, each once", () => {
  const source = random();
  const times = Float64Array.from({ length: 3000 }, () => source.next().value % 100000).sort();
  const distinct = Float64Array.from(new Set(times));
  const columns = pixelColumns(400);
  for (const [start, perPixel] of [[0, 250], [5000, 3], [50000, 0.25], [99000, 40], [-900, 1], [2e5, 1]]) {
    collectColumns(distinct, start, perPixel, 400, columns);
    let next = firstAt(distinct, start);
    for (let i = 0; i < columns.count; i++) {
      assert.equal(columns.first[i], next);
      const pixel = (index) => Math.floor((distinct[index] - start) / perPixel);
      assert.equal(pixel(columns.first[i]), Math.floor(columns.x[i]));
      assert.equal(pixel(columns.last[i]), Math.floor(columns.x[i]));
      next = columns.last[i] + 1;
    }
    assert.equal(next, firstAt(distinct, start + 400 * perPixel));
  }
});

test("a window zooms at a place and stays at the dump", () => {
  const view = new TimeWindow();
  view.resize(1000);
  view.limit(500, 100_500, 10);
  view.fit();
  assert.deepEqual([view.start, view.span], [500, 100_000]);
  view.zoom(0.5, 250);
  assert.ok(Math.abs(view.time(250) - 25_500) < 1e-6);
  assert.equal(view.span, 50_000);
  assert.equal(view.x(view.time(123)), 123);
  view.pan(1e9);
  assert.ok(view.end > 100_500 && view.end < 102_000);
  view.pan(-1e9);
  assert.ok(view.start < 500 && view.start > -1500);
  view.zoom(1e-9, 0);
  assert.equal(view.span, 20);
  view.reveal(60_000);
  assert.equal(view.time(500), 60_000);
});

test("steps and times of the axis", () => {
  assert.deepEqual([0.7, 1, 1.1, 3, 7, 480].map(roundStep), [1, 1, 2, 5, 10, 500]);
  assert.equal(secondsText(0.0123, 1e-4), "12.3 ms");
  assert.equal(secondsText(1.5, 0.5), "1.5 s");
  assert.equal(secondsText(3e-6, 1e-6), "3 µs");
  assert.equal(secondsText(-2e-9, 1e-9), "-2 ns");
});

test("rows move with their groups", () => {
  const rows = new WaveRows();
  const inner = { name: "in", path: "top.in", scopes: [], signals: [signal(1), signal(1)] };
  const group = scopeRows(inner, 0);
  const [first, last] = [signalRow(signal(4), 0), signalRow(signal(4), 0)];
  rows.reset([first, ...group, last]);
  assert.deepEqual(rows.visible, [first, ...group, last]);
  rows.shift(group[0], 1);
  assert.deepEqual(rows.all, [first, last, ...group]);
  rows.shift(group[0], -1);
  rows.shift(group[0], -1);
  assert.deepEqual(rows.all, [...group, first, last]);
  // Up into the group, and out of it again.
  rows.shift(first, -1);
  assert.deepEqual(rows.all, [group[0], group[1], first, group[2], last]);
  assert.equal(first.depth, 1);
  rows.moveBefore(first, null);
  assert.equal(first.depth, 0);
  rows.toggle(group[0]);
  assert.deepEqual(rows.visible, [group[0], last, first]);
  assert.equal(rows.height, 3 * ROW_HEIGHT);
  assert.deepEqual([-1, 0, ROW_HEIGHT, 3 * ROW_HEIGHT].map((y) => rows.at(y)), [-1, 0, 1, -1]);
  rows.add([signalRow(signal(2), 0)], group[1]);
  assert.equal(rows.all.indexOf(last), 4);
  rows.remove(group[0]);
  assert.equal(rows.all.length, 3);
});

test("counts are real units by the settings of the run", () => {
  const units = (settings) => realUnits({ settings }).map(({ name, scale }) => [name, scale]);
  assert.deepEqual(units({ counts_per_mm: 5000 }), [["mm", 1 / 5000]]);
  assert.deepEqual(units({ counts_per_mm: [200, 200, 100], counts_per_rev: 90000 }), [["mm", 1 / 200], ["mm", 1 / 100], ["deg", 360 / 90000]]);
  assert.deepEqual(units(undefined), []);
  const signal = /** @type {any} */ ({ kind: "bits", width: 16, table: null });
  const [{ name, scale }] = realUnits({ settings: { counts_per_mm: 200 } });
  assert.equal(valueText(0xffff - 99, signal, { radix: "signed", fraction: 2, scale, unit: name }), "-0.125 mm");
});
