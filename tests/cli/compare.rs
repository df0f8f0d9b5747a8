//! `compare` on small dumps: what it pairs, counts and shows.

use super::support::{Bench, whole};
use expect_test::{Expect, expect};

/// A dump as this crate writes it: 10 ns a tick, the values of a tick in a row. Behind a port out
/// stands `out`.
pub fn dump(scopes: &[&str], variables: &[&str], rows: &[&[&str]]) -> String {
    let mut text = "$timescale 1 ns $end\n".to_owned();
    let ports = variables.iter().filter_map(|it| it.strip_suffix(" out"));
    let name = |port: &str| format!(" {}.{}", scopes.join("."), port.split(' ').nth(2).unwrap());
    let ports: String = ports.map(name).collect();
    if !ports.is_empty() {
        text += &format!("$comment ports out:{ports} $end\n");
    }
    for scope in scopes {
        text += &format!("$scope module {scope} $end\n");
    }
    text += "$var wire 1 ! clk $end\n";
    for (place, variable) in variables.iter().enumerate() {
        let variable = variable.strip_suffix(" out").unwrap_or(variable);
        let (declared, name) = variable.split_once(' ').unwrap();
        let (width, name) = name.split_once(' ').unwrap();
        text += &format!("$var {declared} {width} v{place} {name} $end\n");
    }
    text += &"$upscope $end\n".repeat(scopes.len());
    text += "$enddefinitions $end\n";
    for (tick, row) in rows.iter().enumerate() {
        text += &format!("#{}\n1!\n", 10 * tick);
        for (place, value) in row.iter().enumerate() {
            text += &format!("b{value} v{place}\n");
        }
        text += &format!("#{}\n0!\n", 10 * tick + 5);
    }
    text + &format!("#{}\n", 10 * rows.len())
}

const VARIABLES: [&str; 2] = ["reg 4 count [3:0]", "wire 1 last out"];
const ROWS: [&[&str]; 4] = [&["0", "0"], &["1", "0"], &["10", "1"], &["0", "0"]];

fn golden() -> String {
    dump(&["counter"], &VARIABLES, &ROWS)
}

fn bench(other: &str) -> Bench {
    let bench = Bench::with("golden.vcd", golden());
    bench.write("other.vcd", other);
    bench
}

fn shows(bench: &Bench, more: &[&str], code: i32, text: &Expect) {
    let done = bench.run(&[&["compare", "golden.vcd", "other.vcd"], more].concat());
    text.assert_eq(&format!("{}{}", done.stdout, done.stderr));
    assert_eq!(done.code, code, "{more:?}");
}

#[cfg(target_os = "linux")]
#[test]
fn a_waveform_may_come_through_a_pipe() {
    let bench = bench(&golden());
    let files = bench.succeed(&["compare", "golden.vcd", "other.vcd"]);
    let mut compare = bench.command(&["compare", "golden.vcd", "/dev/stdin"]);
    let output = compare.write_stdin(golden()).output().unwrap();
    let text = |bytes| String::from_utf8(bytes).unwrap();
    assert_eq!(text(output.stderr), "");
    let piped = text(output.stdout).replace("/dev/stdin", "other.vcd");
    assert_eq!(piped, files);
}

#[cfg(target_os = "linux")]
#[test]
fn a_map_may_come_through_a_pipe() {
    let bench = bench(&golden());
    let map = "ignore = [\"counter.count\"]\n";
    bench.write("map.toml", map);
    let files = bench.succeed(&["compare", "golden.vcd", "other.vcd", "--map", "map.toml"]);
    assert!(files.contains("ignored: 1\n  counter.count\n"), "{files}");
    let arguments = ["compare", "golden.vcd", "other.vcd", "--map", "/dev/stdin"];
    let output = bench.command(&arguments).write_stdin(map).output().unwrap();
    let text = |bytes| String::from_utf8(bytes).unwrap();
    assert_eq!(text(output.stderr), "");
    assert_eq!(text(output.stdout), files);
}

#[test]
fn equal_waves_are_equal() {
    let other = dump(
        &["tb", "dut"],
        &["wire 1 last", "wire 4 count [3:0]", "wire 1 spare"],
        &[
            &["0", "0", "1"],
            &["0", "1", "1"],
            &["1", "10", "0"],
            &["0", "0", "0"],
            &["0", "1", "0"],
        ],
    );
    let text = expect![[r#"
        other is 1 tick longer; what both have is equal: 4 ticks (0 to 3), 2 signals, 8 values; in golden 2 moved, 0 never changed
        golden golden.vcd: clock counter.clk, 4 ticks
        other  other.vcd: clock tb.dut.clk, scope tb.dut, 5 ticks, 1 only here

        signals not compared: 1 without partner in other
    "#]];
    shows(&bench(&other), &["--any-length"], 0, &text);
    let text = expect![[r#"
        equal: 4 ticks (0 to 3), 2 signals, 8 values; in golden 2 moved, 0 never changed
        golden golden.vcd: clock counter.clk, 4 ticks
        other  other.vcd: clock tb.dut.clk, scope tb.dut, 5 ticks

        signals not compared: 1 without partner in other
    "#]];
    shows(&bench(&other), &["--ticks", "4"], 0, &text);
}

#[test]
fn the_first_difference_is_shown_with_what_surrounds_it() {
    let mut rows = ROWS;
    rows[2] = &["11", "x"];
    let other = dump(&["tb", "dut"], &VARIABLES, &rows);
    let text = expect![[r#"
        different: 2 of 2 signals, in 4 ticks (0 to 3), 8 values; in golden 2 moved, 0 never changed
        golden golden.vcd: clock counter.clk, 4 ticks
        other  other.vcd: clock tb.dut.clk, scope tb.dut, 4 ticks

        first in tick 2, in which 2 signals differ:
          golden  counter.count  0x2 = 2  at 20 ns
          other   tb.dut.count   0x3 = 3  at 20 ns

        tick           0  1  2    3
        counter.count  0  1  2!3  0
        counter.last   0  0  1!x  0
        (hexadecimal, golden!other where they differ)

        first tick  ticks  signal
                 2      1  counter.count | tb.dut.count
                 2      1  counter.last | tb.dut.last
        error: the files differ
    "#]];
    shows(&bench(&other), &[], 1, &text);
    let report = bench(&other).run(&["compare", "golden.vcd", "other.vcd", "--json"]);
    assert_eq!(
        (report.code, report.stderr.as_str()),
        (1, "error: the files differ\n")
    );
    let report = serde_json::from_str(&report.stdout).unwrap();
    assert_eq!(whole(&report, "/first/tick"), 2);
    assert_eq!(whole(&report, "/differences/1/ticks"), 1);
    assert_eq!(whole(&report, "/values"), 8);
}

#[test]
fn ticks_are_skipped_and_selected() {
    let reset: [&[&str]; 2] = [&["xxxx", "x"], &["0", "0"]];
    let other = dump(&["tb"], &VARIABLES, &[&reset[..], &ROWS[..]].concat());
    let bench = bench(&other);
    shows(
        &bench,
        &["--skip", "2"],
        0,
        &expect![[r#"
            equal: 4 ticks (0 to 3), 2 signals, 8 values; in golden 2 moved, 0 never changed
            golden golden.vcd: clock counter.clk, 4 ticks
            other  other.vcd: clock tb.clk, scope tb, 6 ticks, skip 2
        "#]],
    );
    shows(
        &bench,
        &["--skip", "2", "--from", "1", "--ticks", "2"],
        0,
        &expect![[r#"
            equal: 2 ticks (1 to 2), 2 signals, 4 values; in golden 2 moved, 0 never changed
            golden golden.vcd: clock counter.clk, 4 ticks
            other  other.vcd: clock tb.clk, scope tb, 6 ticks, skip 2
        "#]],
    );
    // The other file begins with golden's tick 1.
    bench.write("other.vcd", dump(&["tb"], &VARIABLES, &ROWS[1..]));
    shows(
        &bench,
        &["--skip", "-1"],
        0,
        &expect![[r#"
            equal: 3 ticks (1 to 3), 2 signals, 6 values; in golden 2 moved, 0 never changed
            golden golden.vcd: clock counter.clk, 4 ticks, 1 only here
            other  other.vcd: clock tb.clk, scope tb, 3 ticks, skip -1
        "#]],
    );
}

#[test]
fn a_map_pairs_what_has_other_names() {
    let variables = [
        "reg 1 step",
        "reg 4 period [3:0]",
        "reg 2 x [1:0]",
        "reg 3 count [2:0] out",
        "wire 1 debug",
    ];
    let rows: [&[&str]; 4] = [
        &["0", "101", "1", "1", "0"],
        &["1", "101", "10", "10", "0"],
        &["1", "110", "11", "11", "0"],
        &["0", "110", "0", "100", "1"],
    ];
    let bench = Bench::with("golden.vcd", dump(&["top"], &variables, &rows));
    let variables = [
        "wire 1 step_n",
        "wire 8 bus [9:2]",
        "wire 2 late [1:0]",
        "wire 3 count [2:0]",
    ];
    let rows: [&[&str]; 4] = [
        &["1", "1010", "xx", "1"],
        &["0", "1010", "1", "10"],
        &["0", "101101", "10", "11"],
        &["1", "1101", "11", "100"],
    ];
    bench.write("other.vcd", dump(&["tb", "dut"], &variables, &rows));
    bench.write(
        "names.toml",
        r#"
ignore = ["top.debug"]

[signals]
"top.step" = "!tb.dut.step_n"
"top.period" = "tb.dut.bus[6:3]"
"top.x" = { name = "tb.dut.late", delay = 1 }
"#,
    );
    shows(
        &bench,
        &["--map", "names.toml"],
        0,
        &expect![[r#"
            equal: 4 ticks (0 to 3), 4 signals, 15 values; in golden 4 moved, 0 never changed
            golden golden.vcd: clock top.clk, 4 ticks
            other  other.vcd: clock tb.dut.clk, scope tb.dut, 4 ticks

            ignored: 1
              top.debug

            signals not compared: 1 ignored
        "#]],
    );
    bench.write(
        "scopes.toml",
        "ignore = [\"top.*\"]\n[scopes]\n\"top\" = \"tb.dut\"\n",
    );
    shows(
        &bench,
        &["--map", "scopes.toml"],
        2,
        &expect![[r#"
            error: other.vcd: file: no signal of the golden file has a partner here; allowed: a map that leaves something to compare
        "#]],
    );
    bench.write("scopes.toml", "[scopes]\n\"top\" = \"tb.dut\"\n");
    shows(
        &bench,
        &["--map", "scopes.toml"],
        0,
        &expect![[r#"
            equal: 4 ticks (0 to 3), 1 signal, 4 values; in golden 1 moved, 0 never changed
            golden golden.vcd: clock top.clk, 4 ticks
            other  other.vcd: clock tb.dut.clk, 4 ticks

            golden signals without partner: 4
              top.step
              top.period
              top.x
              top.debug

            signals not compared: 4 without partner in golden, 3 without partner in other
        "#]],
    );
    shows(
        &bench,
        &["--map", "scopes.toml", "--strict", "--ticks", "1"],
        1,
        &expect![[r#"
            equal: 1 tick (0 to 0), 1 signal, 1 value; in golden 0 moved, 1 never changed
            golden golden.vcd: clock top.clk, 4 ticks
            other  other.vcd: clock tb.dut.clk, 4 ticks

            golden signals without partner: 4
              top.step
              top.period
              top.x
              top.debug

            signals not compared: 4 without partner in golden, 3 without partner in other
            error: golden signals without partner: 4, and --strict is given
        "#]],
    );
}

#[test]
fn widths_unknowns_and_strings_are_counted() {
    let variables = [
        "reg 4 count [3:0]",
        "reg 2 a [1:0]",
        "reg 1 b out",
        "string 1 b_name",
    ];
    let text = dump(&["top"], &variables, &[&["x", "0", "z"], &["1", "1", "1"]]);
    let text = text.replace("bz v2\n", "bz v2\nsidle v3\n");
    let bench = Bench::with("golden.vcd", text);
    let variables = ["reg 4 count [3:0]", "reg 3 a [2:0]", "reg 1 b"];
    bench.write(
        "other.vcd",
        dump(&["top"], &variables, &[&["1", "0", "0"], &["1", "1", "1"]]),
    );
    shows(
        &bench,
        &[],
        1,
        &expect![[r#"
            different: 0 of 2 signals, in 2 ticks (0 to 1), 2 values; in golden 0 moved, 2 never changed
            golden golden.vcd: clock top.clk, 2 ticks
            other  other.vcd: clock top.clk, scope top, 2 ticks

            different width in bits, not compared: 1
              top.a: 2 | top.a: 3

            signals not compared: 1 of different width, 1 without bits in golden
            values not compared: 2 unknown in golden
            error: the files differ
        "#]],
    );
    bench.write("map.toml", "ignore = [\"top.a\"]\n");
    shows(
        &bench,
        &["--map", "map.toml"],
        0,
        &expect![[r#"
            equal: 2 ticks (0 to 1), 2 signals, 2 values; in golden 0 moved, 2 never changed
            golden golden.vcd: clock top.clk, 2 ticks
            other  other.vcd: clock top.clk, scope top, 2 ticks

            ignored: 1
              top.a

            signals not compared: 1 without partner in other, 1 ignored, 1 without bits in golden
            values not compared: 2 unknown in golden
        "#]],
    );
}

#[test]
fn a_pair_without_a_value_to_compare_is_named() {
    let bench = Bench::with(
        "golden.vcd",
        dump(
            &["top"],
            &["reg 1 a", "reg 1 b", "reg 1 c out"],
            &[&["x", "0", "1"], &["z", "1", "1"]],
        ),
    );
    bench.write(
        "other.vcd",
        dump(
            &["top"],
            &["reg 1 a", "reg 1 b", "reg 1 c"],
            &[&["1", "0", "1"], &["0", "1", "1"]],
        ),
    );
    bench.write(
        "map.toml",
        "[signals]\n\"top.b\" = { name = \"top.b\", delay = 99 }\n",
    );
    let text = expect![[r#"
        equal: 2 ticks (0 to 1), 1 signal, 2 values; in golden 0 moved, 1 never changed
        golden golden.vcd: clock top.clk, 2 ticks
        other  other.vcd: clock top.clk, scope top, 2 ticks

        pairs without a value to compare: 2
          top.a
          top.b

        signals not compared: 2 without a value
        values not compared: 2 unknown in golden
    "#]];
    shows(&bench, &["--map", "map.toml"], 0, &text);
    let text = expect![[r#"
        equal: 2 ticks (0 to 1), 1 signal, 2 values; in golden 0 moved, 1 never changed
        golden golden.vcd: clock top.clk, 2 ticks
        other  other.vcd: clock top.clk, scope top, 2 ticks

        pairs without a value to compare: 2
          top.a
          top.b

        signals not compared: 2 without a value
        values not compared: 2 unknown in golden
        error: pairs without a value to compare: 2, and --strict is given
    "#]];
    shows(&bench, &["--map", "map.toml", "--strict"], 1, &text);
    let report = bench.json(&["compare", "golden.vcd", "other.vcd", "--map", "map.toml"]);
    assert_eq!(
        report["without_values"],
        serde_json::json!(["top.a", "top.b"])
    );
    assert_eq!(
        (whole(&report, "/signals"), whole(&report, "/values")),
        (1, 2)
    );
}

#[test]
fn nothing_to_compare_is_not_equal() {
    let bench = bench(&golden());
    let map = "[signals]\n\"counter.count\" = { name = \"counter.count\", delay = 99 }\n\"counter.last\" = { name = \"counter.last\", delay = 4 }\n";
    bench.write("map.toml", map);
    let text = expect![[r#"
        error: other.vcd: values: nothing to compare: by the map's delays ticks 0 to 3 are behind the end of this file; allowed: delays that leave a tick of both; --from and --ticks choose other ticks
    "#]];
    shows(&bench, &["--map", "map.toml"], 2, &text);
    bench.write("map.toml", map.replace("delay = 4", "delay = 3"));
    let report = bench.json(&["compare", "golden.vcd", "other.vcd", "--map", "map.toml"]);
    assert_eq!(whole(&report, "/values"), 1);

    let unknown: [&[&str]; 2] = [&["x", "z"], &["0x0", "x"]];
    bench.write("golden.vcd", dump(&["counter"], &VARIABLES, &unknown));
    let text = expect![[r#"
        error: golden.vcd: values: nothing to compare: in ticks 0 to 1 all 4 values are x, z or not yet set; allowed: a golden file with known values there; --from and --ticks choose other ticks
    "#]];
    shows(&bench, &[], 2, &text);
    // A partner of another width is a difference all the same.
    let other = dump(
        &["counter"],
        &["reg 4 count [3:0]", "wire 2 last [1:0]"],
        &ROWS,
    );
    bench.write("other.vcd", other);
    let done = bench.run(&["compare", "golden.vcd", "other.vcd"]);
    assert_eq!(
        (done.code, done.stderr.as_str()),
        (1, "error: the files differ\n")
    );
}

#[test]
fn words_of_memories_are_elements() {
    let words = ["wire 4 word0 [3:0] out", "wire 4 word1 [3:0]"];
    let rows: [&[&str]; 2] = [&["1", "10"], &["11", "10"]];
    let bench = Bench::with("golden.vcd", dump(&["top", "mem"], &words, &rows));
    for words in [
        ["reg 4 \\mem[0] [3:0]", "reg 4 \\mem[1] [3:0]"],
        ["wire 4 mem[0] [3:0]", "wire 4 mem[1] [3:0]"],
    ] {
        bench.write("other.vcd", dump(&["tb", "dut"], &words, &rows));
        let report = bench.json(&["compare", "golden.vcd", "other.vcd"]);
        assert_eq!(whole(&report, "/signals"), 2);
        assert_eq!(report["scope"], "tb.dut");
    }
    // Single bits, which a reader may take for bits of one vector.
    let words = ["wire 1 word0", "wire 1 word1 out"];
    let rows: [&[&str]; 2] = [&["1", "0"], &["1", "1"]];
    bench.write("golden.vcd", dump(&["top", "mem"], &words, &rows));
    bench.write(
        "other.vcd",
        dump(&["tb", "dut"], &["reg 1 \\mem[0]", "reg 1 \\mem[1]"], &rows),
    );
    let report = bench.json(&["compare", "golden.vcd", "other.vcd", "--scope", "tb.dut"]);
    assert_eq!(whole(&report, "/signals"), 2);
}
