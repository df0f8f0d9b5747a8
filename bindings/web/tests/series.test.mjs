import assert from "node:assert/strict";
import { test } from "node:test";
import { countUpTo, initialMagnification, readSeries } from "../../../src/cli/page/series.js";
import { Extremes } from "../../../src/cli/page/extremes.js";
import { LineMask } from "../../../src/cli/page/linemask.js";
import { Polyline } from "../../../src/cli/page/reduction.js";
import { displaced, pathViews } from "../../../src/cli/page/pathviews.js";
import { Playhead } from "../../../src/cli/page/playhead.js";
import { readNpy } from "../../../src/cli/page/npy.js";
import { runScenario, runScenarioAs, scenarios } from "./program.mjs";

/** Takes the points that are drawn, as lines of pixels. */
class Recorder {
  /** @type {[number, number][][]} */
  lines = [];
  beginPath() {}
  stroke() {}
  moveTo(right, down) {
    this.lines.push([[right, down]]);
  }
  lineTo(right, down) {
    this.lines.at(-1)?.push([right, down]);
  }
}

/** Pixels from a point to the nearest drawn line. */
function pixelsTo(lines, [right, down]) {
  let least = Infinity;
  for (const line of lines) {
    for (let k = 0; k < line.length; k += 1) {
      const [x, y] = line[k];
      const [nextX, nextY] = line[Math.min(k + 1, line.length - 1)];
      const square = (nextX - x) ** 2 + (nextY - y) ** 2;
      const part = square > 0 ? Math.min(1, Math.max(0, ((right - x) * (nextX - x) + (down - y) * (nextY - y)) / square)) : 0;
      least = Math.min(least, Math.hypot(right - x - part * (nextX - x), down - y - part * (nextY - y)));
    }
  }
  return least;
}

const HEAD = "tick,time_s,x_commanded_mm,x_actual_mm,x_error_mm";

test("a series of NumPy is that of the CSV", () => {
  const csv = readSeries(runScenario("weld").series);
  const bytes = runScenarioAs("npy", "weld").series;
  const npy = readNpy(bytes);
  assert.deepEqual(npy.axes.map(({ name, unit }) => [name, unit]), csv.axes.map(({ name, unit }) => [name, unit]));
  const columns = (series) => [series.ticks, series.times, ...series.axes.flatMap(({ commanded, actual, error }) => [commanded, actual, error])];
  const pairs = columns(npy).map((column, k) => [column, columns(csv)[k]]);
  for (const [exact, printed] of pairs) {
    assert.equal(exact.length, printed.length);
    exact.forEach((value, row) => assert.ok(Math.abs(value - printed[row]) < 1e-6 * Math.max(1, Math.abs(value))));
  }
  assert.throws(() => readNpy(bytes.subarray(1)), /NumPy/);
  assert.throws(() => readNpy(bytes.subarray(0, -8)), /as long as/);
});

/** Options that leave out the systems with which a circuit is compared; a machine has none. */
function alone(name) {
  return name === "machine" ? [] : ["--set", "beside=false"];
}

test("columns of every shipped scenario are the numbers of the file", () => {
  for (const name of scenarios) {
    const { series: bytes, errors, out } = runScenario(name, ...alone(name));
    assert.ok(bytes.length > 0, `${name}: ${errors}`);
    const series = readSeries(bytes);
    const [head, ...lines] = new TextDecoder().decode(bytes).trimEnd().split("\n");
    const columns = [series.ticks, series.times, ...series.axes.flatMap(({ commanded, actual, error }) => [commanded, actual, error])];
    assert.equal(series.rows, lines.length, name);
    assert.equal(columns.length, head.split(",").length, `${name}: a column is not read`);
    lines.forEach((line, row) => {
      line.split(",").forEach((cell, k) => {
        if (!Object.is(columns[k][row], Number(cell))) assert.fail(`${name}, line ${row + 2}, column ${k + 1}: ${cell} is read as ${columns[k][row]}`);
      });
    });
    for (const { commanded, actual, error, name: axis } of series.axes) {
      const row = series.rows >> 1;
      assert.ok(Math.abs(commanded[row] - actual[row] - error[row]) < 1e-6, `${name}: sign of the error of ${axis}`);
    }
    assert.ok(Math.abs(series.clockHz - JSON.parse(out).clock_hz) / series.clockHz < 1e-3, `${name}: clock`);
  }
});

test("axes are grouped into machines", () => {
  const groups = (name) => readSeries(runScenario(name, ...alone(name)).series).groups
    .map((group) => [group.name, group.unit, group.axes.map((axis) => axis.name)]);
  assert.deepEqual(groups("machine"), [
    ["", "counts", ["x", "y"]],
    ["stepper", "steps", ["stepper_x", "stepper_y"]],
    ["lift", "counts", ["lift"]],
  ]);
  assert.deepEqual(groups("weld"), [["", "counts", ["x", "y", "z"]]]);
  assert.deepEqual(groups("turntable"), [["body", "counts", ["body"]]]);
});

test("a circle is as long as its circumference, and passed at its feed", () => {
  const series = readSeries(runScenario("circle", ...alone("circle")).series);
  const [group] = series.groups;
  const distance = series.distance(group);
  // Whole turns of 10 mm at 5000 counts/mm.
  const turns = distance[series.rows - 1] / (2 * Math.PI * 50_000);
  assert.ok(Math.abs(turns - Math.round(turns)) < 1e-3 && turns > 0.9, `${turns} turns`);
  const speed = series.speed(group)[series.rows >> 1];
  assert.ok(Math.abs(speed - 500_000) < 100, `${speed} counts/s`);
  assert.equal(speed, (distance[series.rows >> 1] - distance[(series.rows >> 1) - 1]) / (series.times[series.rows >> 1] - series.times[(series.rows >> 1) - 1]));
});

test("cells of all forms are read, and wrong ones refused with their line", () => {
  const { axes } = readSeries(`${HEAD}\r\n0,0,-0.5,1e-7,9007199254740993\r\n1,1e-3,,123456789012345678,0.1000000000000000055511151231257827\r\n`);
  const [{ commanded, actual, error }] = axes;
  assert.deepEqual([...commanded], [-0.5, NaN]);
  assert.deepEqual([...actual], [1e-7, 123456789012345678]);
  assert.deepEqual([...error], [9007199254740993, 0.1]);
  assert.equal(readSeries(`${HEAD}\n`).rows, 0);
  assert.equal(readSeries(`${HEAD}\n7,0,1,1,0`).ticks[0], 7);
  for (const [cells, message] of [["1,2,3,4", /Line 2: fewer/], ["1,2,3,4,5,6", /Line 2: more/], ["1,2,3,4,five", /Line 2: five/]]) {
    assert.throws(() => readSeries(`${HEAD}\n${cells}\n`), message);
  }
  assert.throws(() => readSeries("tick,time_s,x_commanded_mm\n"), /x_actual_mm/);
  assert.throws(() => readSeries("tick,time_s\n"), /no column/);
});

test("the row of a tick is the last one that has begun", () => {
  const series = readSeries(`${HEAD}\n10,0,0,0,0\n20,0,0,0,0\n30,0,0,0,0\n`);
  assert.deepEqual([0, 10, 19, 20, 29, 30, 99].map((tick) => series.rowAtTick(tick)), [0, 0, 0, 1, 1, 2, 2]);
  assert.deepEqual([9, 10, 30].map((limit) => countUpTo(series.ticks, limit)), [0, 1, 3]);
});

test("a run that goes on continues its rows", () => {
  const rows = ["0,0,0,0,0", "1,1,1,1,0", "2,2,2,2,0", "3,3,3,3,0"];
  const of = (lines) => readSeries([HEAD, ...lines].join("\n"));
  assert.ok(of(rows).continues(of(rows.slice(0, 2))));
  assert.ok(!of(rows.slice(0, 2)).continues(of(rows)));
  assert.ok(!of(rows).continues(of(["0,0,0,0,0", "1,1,5,1,4"])));
});

test("errors are magnified to a round multiple that is visible", () => {
  // A sixteenth of 32 mm is 2 mm.
  const cases = [[2, 1], [50, 1], [1, 2], [0.5, 2], [0.4, 5], [0.2, 10], [0.0021, 500], [0.0019, 1000]];
  for (const [largest, factor] of cases) assert.equal(initialMagnification(largest, 32), factor, `${largest}`);
  assert.equal(initialMagnification(0, 100), 1);
  assert.equal(initialMagnification(0, 0), 1);
});

test("the actual path is drawn at commanded plus a multiple of the way to actual", () => {
  const series = readSeries(`${HEAD}\n0,0,10,9,1\n1,1,20,21,-1\n`);
  const [group] = series.groups;
  assert.deepEqual([0, 1, 5].map((factor) => [...displaced(group, factor)[0]]), [[10, 20], [9, 21], [5, 25]]);
  assert.deepEqual(pathViews(series).map((view) => view.label), ["x over time"]);
});

test("three axes have three planes and a space seen from the front, the right and above", () => {
  const series = readSeries(runScenario("weld").series);
  const views = pathViews(series);
  assert.deepEqual(views.map((view) => view.label), ["Plane x, y", "Plane x, z", "Plane y, z", "Isometric x, y, z", "x over time", "y over time", "z over time"]);
  const unit = (k) => [0, 1, 2].map((axis) => Float64Array.of(axis === k ? 1 : 0));
  const [x, y, z] = [0, 1, 2].map((k) => views[3].project(unit(k), new Float64Array(1)).map((column) => column[0]));
  assert.ok(x[0] > 0 && x[1] < 0 && y[0] > 0 && y[1] > 0 && z[0] === 0 && z[1] > 0);
  for (const [right, up] of [x, y, z]) assert.ok(Math.abs(right * right + up * up - 2 / 3) < 1e-12);
  assert.deepEqual(views[1].project(series.groups[0].axes.map((axis) => axis.actual), series.times), [series.axes[0].actual, series.axes[2].actual]);
});

test("a line is drawn with few points and misses none by half a pixel", () => {
  const count = 20_000;
  const xs = Float64Array.from({ length: count }, (_, k) => 400 * Math.cos(k / 700) + 30 * Math.sin(k / 41));
  // A part that rests, one that goes back on itself, and one without a position.
  const ys = Float64Array.from({ length: count }, (_, k) => 300 * Math.sin(k / 500) + (k % 977 < 20 ? 12 * Math.sin(k) : 0));
  xs.fill(20, 5000, 6000);
  ys.fill(10, 5000, 6000);
  for (let k = 6000; k < 6400; k += 1) [xs[k], ys[k]] = [20 + 150 * Math.abs(((k - 6000) / 100) % 2 - 1) - 150, 10];
  ys[9000] = NaN;
  for (const scale of [0.1, 0.7, 1]) {
    const view = { x0: 0, y0: 0, scaleX: scale, scaleY: scale, width: 1000, height: 800 };
    const recorder = new Recorder();
    new Polyline(xs, ys).stroke(/** @type {any} */ (recorder), view);
    const drawn = recorder.lines.reduce((sum, line) => sum + line.length, 0);
    assert.ok(drawn < count / 3, `${drawn} points at ${scale}`);
    for (let k = 0; k < count; k += 7) {
      if (k === 9000 || Number.isNaN(ys[k])) continue;
      const missed = pixelsTo(recorder.lines, [500 + xs[k] * scale, 400 - ys[k] * scale]);
      assert.ok(missed < 0.5, `row ${k} is missed by ${missed} pixels at ${scale}`);
    }
  }
});

test("of a line only what the window shows is drawn, and its effort is known", () => {
  const xs = Float64Array.from({ length: 100_000 }, (_, k) => k / 10);
  const ys = Float64Array.from({ length: 100_000 }, (_, k) => 50 * Math.sin(k / 3));
  const line = new Polyline(xs, ys);
  const drawn = (x0) => {
    const recorder = new Recorder();
    const view = { x0, y0: 0, scaleX: 10, scaleY: 10, width: 1000, height: 800 };
    line.stroke(/** @type {any} */ (recorder), view);
    const effort = recorder.lines.flatMap((each) => each.slice(1).map(([x, y], k) => 8 + Math.abs(x - each[k][0]) + Math.abs(y - each[k][1])))
      .reduce((sum, part) => sum + part, 0);
    // The scale of the points is the next power of two.
    assert.ok(line.effort(view) >= effort && line.effort(view) <= 1.7 * effort, `${line.effort(view)} for ${effort}`);
    return recorder.lines.flat();
  };
  const points = drawn(5000);
  assert.ok(points.length > 300 && points.length < 3000, `${points.length}`);
  assert.ok(Math.min(...points.map(([right]) => right)) <= 0 && Math.max(...points.map(([right]) => right)) >= 1000);
  assert.equal(drawn(-5000).length, 0);
});

test("a mask covers the pixels of a line as far as it is in them", () => {
  const mask = new LineMask(60, 40, 3);
  const ends = [[5.5, 10.5, 50.5, 10.5], [20.2, 35.7, 33.1, 2.4], [-30, 20, 90, 38], [40, 30, 40, 30]];
  for (const [x0, y0, x1, y1] of ends) mask.line(x0, y0, x1, y1);
  const lines = ends.map(([x0, y0, x1, y1]) => [[x0, y0], [x1, y1]]);
  for (let down = 0; down < 40; down += 1) {
    for (let right = 0; right < 60; right += 1) {
      const distance = pixelsTo(lines, [right + 0.5, down + 0.5]);
      const covered = mask.coverage[60 * down + right];
      if (distance < 0.9) assert.equal(covered, 255, `${right}, ${down}`);
      if (distance > 4.2) assert.equal(covered, 0, `${right}, ${down}`);
    }
  }
  // The line is three pixels wide.
  assert.deepEqual([8, 9, 11, 12].map((down) => mask.coverage[60 * down + 10]), [0, 255, 255, 0]);
  const pixels = new Uint8ClampedArray(4 * 60 * 40);
  mask.over(pixels, [10, 20, 30]);
  assert.deepEqual([...pixels.subarray(4 * (60 * 10 + 10), 4 * (60 * 10 + 10) + 4)], [10, 20, 30, 255]);
  assert.deepEqual([...pixels.subarray(0, 4)], [0, 0, 0, 0]);
});

test("the nearest row is found, and of two passes the one next to the play head", () => {
  // There and back along a line.
  const xs = Float64Array.from({ length: 2001 }, (_, k) => 500 - Math.abs(k - 1000) / 2);
  const line = new Polyline(xs, new Float64Array(2001));
  const view = { x0: 250, y0: 0, scaleX: 1, scaleY: 1, width: 1000, height: 800 };
  assert.equal(line.nearest(view, 500 - 250 + 123, 405, 10, 0), 246);
  assert.equal(line.nearest(view, 500 - 250 + 123, 405, 10, 2000), 1754);
  assert.equal(line.nearest(view, 500 - 250 + 123, 415, 10, 0), null);
  assert.equal(line.nearest(view, 500 - 250 - 8, 400, 10, 0), 0);
});

test("extremes of ranges are those of their rows", () => {
  const values = Float64Array.from({ length: 1000 }, (_, k) => Math.sin(k * k));
  values[500] = NaN;
  const extremes = new Extremes(values);
  for (const [from, to] of [[0, 1000], [0, 1], [63, 65], [64, 128], [1, 999], [499, 502], [130, 131], [700, 1000], [5, 5]]) {
    const part = [...values.slice(from, to)].filter((value) => !Number.isNaN(value));
    assert.deepEqual(extremes.between(from, to), [Math.min(...part), Math.max(...part)], `${from} to ${to}`);
  }
});

test("extremes are found at both ends of any range", () => {
  const values = Float64Array.from({ length: 300 }, (_, k) => k);
  const extremes = new Extremes(values);
  for (let from = 0; from < 300; from += 3) {
    for (let to = from + 1; to <= 300; to += 1) {
      const [least, greatest] = extremes.between(from, to);
      if (least !== from || greatest !== to - 1) assert.fail(`${from} to ${to}`);
    }
  }
});

test("the play head is a whole tick within its range and tells of changes only", () => {
  const playhead = new Playhead();
  const heard = [];
  playhead.addEventListener("change", (event) => heard.push([event.detail.tick, event.detail.from]));
  playhead.limit(10, 100);
  playhead.set(50.9, "a");
  playhead.set(50, "b");
  playhead.set(1000, "c");
  playhead.set(NaN, "d");
  playhead.limit(0, 20);
  assert.deepEqual(heard, [[10, null], [50, "a"], [100, "c"], [20, null]]);
});
