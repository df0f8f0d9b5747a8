import assert from "node:assert/strict";
import { test } from "node:test";
import { DumpError, valueAt } from "../../../src/cli/page/dump.js";
import { readVcd } from "../../../src/cli/page/vcd.js";

const DUMP = `$date today $end
$comment clk 1000000 Hz, period 10 x 100 ns $end
$comment ports out: top.led $end
$timescale 100 ns $end
$scope module top $end
$var wire 1 ! clk $end
$var reg 8 " count [7:0] $end
$var wire 8 " same [7:0] $end
$var wire 1 # bus [0] $end
$var wire 1 $ bus [1] $end
$var wire 1 % led $end
$var real 64 & voltage $end
$var wire 70 ' wide[69:0] $end
$var wire 53 ( word [52:0] $end
$scope begin inner $end
$var reg 2 ) state [1:0] $end
$var string 1 * state_name $end
$upscope $end
$upscope $end
$enddefinitions $end
#20
$dumpvars
0!
bx "
x#
z$
0%
r-1.5e3 &
bz '
b0 (
b1 )
sRUN *
$end
#25
1!
B101 "
1#
#30
$comment 1! is not read $end
0!
bX01 "
b1 '
b10000000000000000000000000000000000000000000000000001 (
b10 )
sSTOP *
R2.25 &
#40
b1${"0".repeat(68)}1 '
#50
`;

const dump = readVcd(new TextEncoder().encode(DUMP));
const changes = (path) => dump.changes(dump.find(path));
const values = async (path) => {
  const found = await changes(path);
  return [20, 25, 30, 40, 49].map((time) => valueAt(found, time));
};

test("declarations", async () => {
  assert.deepEqual([dump.start, dump.end, dump.unit], [20, 50, 1e-7]);
  await dump.findClock();
  assert.equal(dump.period, 10);
  assert.equal(dump.find("top.led").role, "output");
  assert.equal(dump.find("top.count").role, "register");
  assert.equal(dump.find("top.wide").width, 70);
  assert.equal(dump.find("top.wide[69:0]"), dump.find("top.wide"));
  assert.deepEqual(
    dump.scopes.map(({ path, signals, scopes }) => [path, signals.length, scopes[0].path]),
    [["top", 9, "top.inner"]],
  );
  assert.notEqual(dump.find("top.bus[0]"), dump.find("top.bus[1]"));
});

test("known and unknown values", async () => {
  assert.deepEqual(await values("top.clk"), [0, 1, 0, 0, 0]);
  assert.deepEqual(await values("top.count"), ["x", 5, "x", "x", "x"]);
  assert.equal(await changes("top.count"), await changes("top.same"));
  assert.deepEqual(await values("top.bus[0]"), ["x", 1, 1, 1, 1]);
  assert.deepEqual(await values("top.bus[1]"), ["z", "z", "z", "z", "z"]);
  assert.equal(valueAt(await changes("top.clk"), 19), null);
});

test("real numbers and long words", async () => {
  assert.deepEqual(await values("top.voltage"), [-1500, -1500, 2.25, 2.25, 2.25]);
  const wide = (1n << 69n) + 1n;
  assert.deepEqual(await values("top.wide"), ["z", "z", 1n, wide, wide]);
  const word = (1n << 52n) + 1n;
  assert.deepEqual(await values("top.word"), [0n, 0n, word, word, word]);
});

test("a text beside a state names it", () => {
  const { table } = dump.find("top.inner.state");
  assert.deepEqual([...table], [[1, "RUN"], [2, "STOP"]]);
});

test("what is no dump is an error that says so", () => {
  const read = (text) => () => readVcd(new TextEncoder().encode(text));
  assert.throws(read("hello"), new DumpError("This is no VCD file."));
  assert.throws(read(""), DumpError);
  assert.throws(read("$scope module a"), DumpError);
  assert.throws(read("$timescale 3 parsec $end $enddefinitions $end"), /3parsec/);
  const head = "$var wire 1 ! a $end $enddefinitions $end\n";
  assert.throws(read(`${head}#5\n1"\n`), /does not declare: "/);
  assert.throws(read(`${head}#5\n#4\n`), /wrong time: #4/);
  assert.equal(read(head)().end, 0);
});

test("values that change twice at a time are the last ones", async () => {
  const twice = readVcd(
    new TextEncoder().encode("$var wire 1 ! a $end $enddefinitions $end\n#1\nx!\n0!\n#2\n1!\n"),
  );
  const { times, values: found, unknown } = await twice.changes(twice.signals[0]);
  assert.deepEqual([[...times], [...found], [...unknown]], [[1, 2], [0, 1], [0, 0]]);
});
