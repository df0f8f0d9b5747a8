import assert from "node:assert/strict";
import { test } from "node:test";
import { changeOf, faultIn, fromDirectory, sameValue, settingNamed, settingsOf, shownText } from "../../../src/cli/page/settingkeys.js";
import { readProblem } from "../../../src/cli/page/problem.js";
import { givenIn } from "../../../src/cli/page/toml.js";
import { listsOfTables, readTomlValue, tomlText } from "../../../src/cli/page/tomlvalue.js";
import { run, runScenario, scenarioText, scenarios } from "./program.mjs";

/** A scenario of each job, for its keys. */
const JOBS = new Map([
  ["pulse_interpolator", "bracket"],
  ["linear_interpolator", "plotter"],
  ["lead_angle", "turntable"],
  ["arc_generator", "weld"],
  ["trajectory_controller", "corner"],
  ["machine", "machine"],
]);

const printed = new Map([...JOBS.keys()].map((job) => [job, JSON.parse(run("keys", job, "--json").out).scenario]));

/** Values that a scenario sets, as the page reads them. */
function givenBy(name) {
  const text = scenarioText(name);
  return { ...givenIn(text), ...listsOfTables(text) };
}

/** The setting of a key. */
function settingOf(job, key) {
  const found = settingsOf(printed.get(job)).settings.find((setting) => setting.key === key);
  assert.ok(found, key);
  return found;
}

test("every key is a setting, a table, or a key of a list of tables", () => {
  for (const [job, rows] of printed) {
    const { settings, tables } = settingsOf(rows);
    const shown = [...settings.map(({ key }) => key), ...tables.keys(), ...settings.flatMap(({ parts }) => parts.map(({ key }) => key))];
    assert.deepEqual(shown.sort(), rows.map(({ key }) => key).sort(), job);
    for (const setting of settings) {
      assert.equal([setting.group, setting.name].filter((part) => part !== "").join("."), setting.key);
      if (setting.input === "choice") assert.ok(setting.choices.length > 1, setting.key);
      if (setting.standard !== "") {
        const fault = faultIn(setting, setting.standard);
        assert.equal(fault, "", `${job}: ${setting.key} = ${setting.standard}`);
      }
    }
  }
});

test("values of every shipped scenario are right and none is changed", () => {
  for (const name of scenarios) {
    const given = givenBy(name);
    const job = readTomlValue(given.circuit);
    const { settings } = settingsOf(printed.get(job));
    const read = Object.keys(given).filter((key) => !key.includes("[]"));
    for (const key of read) {
      const setting = settings.find((each) => each.key === key);
      assert.ok(setting, `${name}: ${key} has no setting`);
      const text = shownText(setting, given[key]);
      assert.equal(faultIn(setting, text), "", `${name}: ${key} = ${text}`);
      assert.ok(sameValue(setting, text, text));
    }
    const lines = scenarioText(name).match(/^[a-z_0-9.]+ *=/gm) ?? [];
    const tables = scenarioText(name).match(/^\[\[/gm) ?? [];
    const inLists = read.filter((key) => given[key].startsWith("[\n")).map((key) => readTomlValue(given[key]));
    assert.equal(inLists.flat().length, tables.length, `${name}: tables of lists`);
    const plain = read.filter((key) => !given[key].startsWith("[\n")).length;
    const ofTables = inLists.flat().reduce((sum, table) => sum + Object.keys(table).length, 0);
    assert.equal(plain + ofTables, lines.length, `${name}: keys`);
  }
});

test("a run with every value given by --set is the run of the file", () => {
  for (const [name, ...options] of [["rewrite"], ["groups"], ["joint"], ["weld"], ["corner"], ["turntable", "positionings=2"]]) {
    const given = givenBy(name);
    const { settings } = settingsOf(printed.get(readTomlValue(given.circuit)));
    const quick = options.flatMap((option) => ["--set", option, "--set", "load_change_after=1", "--set", "beside=false"]);
    const changes = settings
      .filter((setting) => given[setting.key] !== undefined)
      .filter(({ key }) => quick.length === 0 || !["positionings", "load_change_after", "beside"].includes(key))
      .flatMap((setting) => ["--set", changeOf(setting, shownText(setting, given[setting.key]))]);
    assert.ok(changes.length > 4, name);
    const [plain, set] = [runScenario(name, ...quick), runScenario(name, ...quick, ...changes)];
    assert.equal(set.code, plain.code, set.errors);
    assert.deepEqual(set.series, plain.series, name);
    assert.deepEqual(JSON.parse(set.out).settings, JSON.parse(plain.out).settings, name);
  }
});

test("what the form refuses the program refuses too, and names the key", () => {
  let refused = 0;
  for (const [job, name] of JOBS) {
    for (const setting of settingsOf(printed.get(job)).settings) {
      if (setting.group !== "" || setting.key === "circuit") continue;
      for (const text of wrongTexts(setting)) {
        assert.notEqual(faultIn(setting, text), "", `${setting.key} = ${text}`);
        const { code, out, errors } = run("run", `${name}.toml`, "--json", "--no-vcd", "--set", changeOf(setting, text));
        assert.equal(code, 2, `${job} takes ${setting.key} = ${text}`);
        const { faults, message } = readProblem(out, errors);
        assert.equal(settingNamed(settingsOf(printed.get(job)).settings, faults[0]?.field)?.key, setting.key, message);
        refused += 1;
      }
    }
  }
  assert.ok(refused > 150, `${refused} values`);
});

/** Texts that a setting must not have. */
function wrongTexts(setting) {
  const texts = [];
  if (Number.isFinite(setting.least) && setting.input !== "toml") texts.push(tomlText(setting.least - 1));
  if (setting.most < 1e15 && setting.input !== "toml") texts.push(tomlText(setting.most + 1));
  if (setting.input === "whole") texts.push("1.5");
  if (setting.input === "whole" || setting.input === "number") texts.push('"a"');
  if (setting.input === "boolean") texts.push("1");
  if (setting.input === "choice") texts.push("no_such_name");
  if (setting.input === "tables") texts.push("7");
  if (/^list of \d+ (whole )?numbers/.test(setting.kind)) texts.push("[1]", '"a"');
  return texts;
}

test("bounds are taken from ranges in the key's own unit only", () => {
  const bounds = (job, key) => [settingOf(job, key).least, settingOf(job, key).most];
  assert.deepEqual(bounds("lead_angle", "clock_hz"), [1, 1e10]);
  assert.deepEqual(bounds("lead_angle", "standstill_ms"), [-Infinity, Infinity]);
  assert.deepEqual(bounds("linear_interpolator", "feed_mm_per_min"), [0.001, Infinity]);
  assert.deepEqual(bounds("pulse_interpolator", "steps_per_mm"), [-Infinity, Infinity]);
  assert.deepEqual(bounds("lead_angle", "pole_pairs"), [1, 64]);
});

test("a table's default gives the defaults of its keys", () => {
  assert.equal(settingOf("trajectory_controller", "machine.max_torque_nm").standard, "10");
  assert.equal(settingOf("machine", "lift.brake_dead_time_s").standard, "0.012");
  assert.equal(settingOf("pulse_interpolator", "motor.inertia_kg_m2").standard, "");
});

test("keys of a circuit make a form too", () => {
  const { circuit } = JSON.parse(run("keys", "mul_div", "--json").out);
  const { settings } = settingsOf(circuit);
  assert.deepEqual(settings.map(({ key, input, standard }) => [key, input, standard]), [
    ["architecture", "choice", "radix2"], ["multiplier", "whole", "25"], ["word", "whole", "58"],
  ]);
  assert.deepEqual(settings[0].choices, ["radix2", "radix4", "combinational"]);
});

test("a fault finds its setting by key, list or the end of its key", () => {
  const { settings } = settingsOf(printed.get("pulse_interpolator"));
  const named = (field) => settingNamed(settings, field)?.key;
  assert.equal(named("clock_hz"), "clock_hz");
  assert.equal(named("motor.microsteps"), "motor.microsteps");
  assert.equal(named("microsteps"), "motor.microsteps");
  assert.equal(named("pattern 2: scale"), "pattern");
  assert.equal(named("no_such_key"), undefined);
});

test("equal values in other words are no change", () => {
  const [clock, list] = [settingOf("lead_angle", "clock_hz"), settingOf("pulse_interpolator", "steps_per_mm")];
  assert.equal(shownText(clock, "200_000"), "200000");
  assert.ok(sameValue(clock, "200000", "2e5"));
  assert.ok(!sameValue(clock, "200000", "200001"));
  assert.ok(sameValue(list, "[40, 40]", "[ 40.0,40.0, ] # both"));
  assert.ok(!sameValue(list, "[40, 40]", "[40, 41]"));
  const detector = settingOf("lead_angle", "detector");
  assert.equal(shownText(detector, '"resolver"'), "resolver");
  assert.equal(changeOf(detector, "resolver"), 'detector="resolver"');
});

test("values of TOML are read and written", () => {
  const values = [["1_000", 1000], ["-0.5e-3", -0.0005], ["+7", 7], ["0x_f", null], ["0xff", 255], ["0b101", 5], ["true", true],
    ['"a\\n\\"b"', 'a\n"b'], ["'c:\\d'", "c:\\d"], ["[1, [2, 3],]", [1, [2, 3]]], ["[]", []], ["{ a = 1, 'b c' = \"x\" }", { a: 1, "b c": "x" }],
    ["[\n  { a = 1 }, # one\n]", [{ a: 1 }]], ["01", null], ["1.", null], ["[1 2]", null], ["{ a 1 }", null], ['"a', null], ["1 2", null], ["", null], ["yes", null], ["{ a = 1, a = 2 }", null]];
  for (const [text, value] of values) {
    if (value === null) {
      assert.throws(() => readTomlValue(text), SyntaxError, text);
    } else {
      assert.deepEqual(readTomlValue(text), value, text);
      assert.deepEqual(readTomlValue(tomlText(value)), value, text);
    }
  }
});

test("problems are read from JSON and from text", () => {
  const bad = run("run", "turntable.toml", "--json", "--no-vcd", "--set", "detector=foo");
  const problem = readProblem(bad.out, bad.errors);
  assert.equal(problem.faults[0].field, "detector");
  assert.match(problem.text, /^error: --set: detector/);
  const plain = run("run", "turntable.toml", "--no-vcd", "--set", "detector=foo");
  assert.equal(readProblem(plain.out, plain.errors).message, problem.message);
  assert.equal(readProblem("", "\u001b[31merror: \u001b[0mno\n").message, "no");
  assert.notEqual(readProblem("", "").message, "");
});

test("paths of a scenario are those from the working directory, and nothing else changes", () => {
  const given = { ...givenBy("patterns"), input: '"a.ngc"', "program.subroutine_path": '["subs", "/usr/subs"]' };
  const placed = fromDirectory(given, printed.get("pulse_interpolator"), "waves/patterns.toml");
  assert.equal(placed.input, '"waves/a.ngc"');
  assert.equal(placed["program.subroutine_path"], '["waves/subs", "/usr/subs"]');
  assert.equal(placed.pattern, given.pattern.replaceAll(/table = "/g, 'table = "waves/'));
  assert.notEqual(placed.pattern, given.pattern);
  const others = Object.keys(given).filter((key) => given[key] !== placed[key]);
  assert.deepEqual(others.sort(), ["input", "pattern", "program.subroutine_path"]);
  assert.deepEqual(fromDirectory(given, printed.get("pulse_interpolator"), "mine.toml"), given);
});
