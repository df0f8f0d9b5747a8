import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { DumpError, valueOf } from "../../../src/cli/page/dump.js";
import { readFst } from "../../../src/cli/page/fst.js";
import { ByteReader, unpackLz4 } from "../../../src/cli/page/unpack.js";
import { readVcd } from "../../../src/cli/page/vcd.js";
import { plainChanges, plainVcd, written } from "./waveruns.mjs";

const windows = [
  ["bracket", "0", "20000"],
  ["bracket", "3000", "5000"],
  ["machine", "0", "5000"],
  ["machine", "4999", "5003"],
];

for (const [name, from, to] of windows) {
  test(`${name} from ${from} to ${to}: each change of each signal is that of the VCD`, async () => {
    const ticks = ["--from", from, "--to", to];
    const text = written(name, "vcd", ...ticks).waves;
    const expected = plainVcd(text);
    const fst = await readFst(written(name, "fst", ...ticks).waves);
    const vcd = readVcd(text);
    await fst.findClock();
    await vcd.findClock();
    assert.equal(fst.period, vcd.period);
    assert.equal(fst.unit, vcd.unit);
    assert.deepEqual([fst.start, fst.end], [vcd.start, vcd.end]);
    assert.equal(fst.start, fst.timeOfTick(Number(from)));
    assert.equal(fst.end, fst.timeOfTick(Number(to)));

    let changes = 0;
    let words = 0;
    for (const dump of [fst, vcd]) {
      assert.deepEqual(
        dump.signals.map(({ path }) => path),
        [...expected.keys()],
      );
      for (const signal of dump.signals) {
        const { width, changes: wanted } = expected.get(signal.path);
        const found = await dump.changes(signal);
        assert.equal(signal.width, width, signal.path);
        assert.equal(found.unknown, undefined, signal.path);
        assert.equal(plainChanges(signal, found).join("\n"), wanted.join("\n"), signal.path);
        changes += wanted.length;
        if (found.values instanceof BigUint64Array) words += found.values.length;
      }
    }
    assert.ok(changes > 2 * expected.size, `${changes}`);
    if (name === "machine") assert.ok(words > 1000, `${words}`);
  });
}

// Written by GTKWave: `vcd2fst -4 foreign.vcd lz4.fst`, likewise with -Z and -c. Unlike the program's
// files they have initial values that are no changes, and signals that share a chain or have two names.
for (const name of ["lz4", "zlib", "whole"]) {
  test(`a file by GTKWave, packed by ${name}, has the values of its VCD`, async () => {
    const data = (file) => new Uint8Array(readFileSync(new URL(`data/${file}`, import.meta.url)));
    const vcd = readVcd(data("foreign.vcd"));
    const fst = await readFst(data(`${name}.fst`));
    assert.deepEqual([fst.start, fst.end, fst.unit], [0, 119, 1e-8]);
    assert.deepEqual([vcd.start, vcd.end, vcd.unit], [0, 119, 1e-8]);
    assert.deepEqual(fst.signals.map(({ path }) => path), vcd.signals.map(({ path }) => path));
    const list = async (dump, path) => {
      const changes = await dump.changes(dump.find(path));
      return Array.from(changes.times, (time, i) => `${time} ${valueOf(changes, i)}`);
    };
    for (const { path } of vcd.signals) {
      assert.deepEqual(await list(fst, path), await list(vcd, path), path);
    }
    assert.deepEqual(await list(fst, "top.still"), ["0 1"]);
    assert.deepEqual(await list(fst, "top.inner.tri"), ["0 z", "40 x", "60 0", "80 1", "100 x"]);
    assert.equal((await list(fst, "top.same")).length, 34);
    assert.equal(fst.find("top.twin").id, fst.find("top.count").id);
    assert.equal((await list(fst, "top.voltage"))[1], "40 50");
  });
}

test("states have the names that their texts say", async () => {
  const ticks = ["--from", "0", "--to", "20000"];
  const fst = await readFst(written("machine", "fst", ...ticks).waves);
  const vcd = readVcd(written("machine", "vcd", ...ticks).waves);
  let states = 0;
  for (const signal of fst.signals.filter(({ table, kind }) => table && kind === "bits")) {
    const names = fst.find(`${signal.path}_name`);
    const own = await fst.changes(signal);
    const texts = await fst.changes(names);
    assert.deepEqual(own.times, texts.times);
    own.values.forEach((code, i) => {
      assert.equal(signal.table.get(Number(code)), names.table.get(texts.values[i]));
      const inVcd = vcd.find(signal.path).table;
      assert.equal(inVcd.get(Number(code)), signal.table.get(Number(code)));
      states++;
    });
  }
  assert.ok(states > 100, `${states}`);
});

test("roles and scopes are those of the circuit", async () => {
  const dump = await readFst(written("bracket", "fst", "--to", "10").waves);
  const role = (path) => dump.find(`pulse_interpolator.${path}`).role;
  assert.equal(role("command"), "input");
  assert.equal(role("step_x"), "output");
  assert.equal(role("counter.count"), "register");
  assert.equal(role("counter.next"), "net");
  const [top] = dump.scopes;
  assert.equal(top.path, "pulse_interpolator");
  assert.deepEqual(
    top.scopes.map(({ name }) => name),
    ["unit_time", "counter", "port", "sequencer", "x", "y"],
  );
  assert.equal(dump.find("pulse_interpolator.counter.count[23:0]").width, 24);
});

test("changes are read once", async () => {
  const dump = await readFst(written("bracket", "fst", "--to", "10").waves);
  const signal = dump.find("pulse_interpolator.clk");
  assert.equal(dump.loaded(signal), undefined);
  const changes = await dump.changes(signal);
  assert.equal(await dump.changes(signal), changes);
  assert.equal(dump.loaded(signal), changes);
});

test("a file that is cut off, or none, is an error", async () => {
  const only = ["--only", "pulse_interpolator.counter"];
  const bytes = written("bracket", "fst", "--to", "50", ...only).waves;
  for (let length = 0; length < bytes.length; length += 7) {
    const cut = bytes.subarray(0, length);
    await readFst(cut).then(
      // Between two blocks nothing is missing but values.
      (dump) => assert.ok(dump.signals.length > 0),
      (error) => assert.ok(error instanceof DumpError, `${length}: ${error.stack}`),
    );
  }
  await assert.rejects(readFst(new TextEncoder().encode("$date today $end")), DumpError);
});

test("LZ4 repeats what it has just written", () => {
  // Two letters, a copy of nine that overlaps, and a literal.
  const packed = Uint8Array.of(0x25, 0x61, 0x62, 2, 0, 0x10, 0x63);
  assert.equal(new TextDecoder().decode(unpackLz4(packed, 12)), "abababababac");
  assert.throws(() => unpackLz4(packed, 11), RangeError);
  assert.throws(() => unpackLz4(Uint8Array.of(0x15, 0x61, 2, 0), 10), RangeError);
  // Lengths of more than 15: bytes are added up to one below 255.
  const long = Uint8Array.of(0xf0, 255, 2, ...new Uint8Array(272).fill(7));
  assert.deepEqual(unpackLz4(long, 272), new Uint8Array(272).fill(7));
});

test("signed numbers of seven bits per byte", () => {
  const read = (...bytes) => new ByteReader(Uint8Array.from(bytes), 0).signed();
  assert.deepEqual([read(0x3f), read(0x40), read(0x7f)], [63, -64, -1]);
  assert.deepEqual([read(0xc0, 0x00), read(0xbf, 0x7f), read(0x80, 0x40)], [64, -65, -8192]);
});
