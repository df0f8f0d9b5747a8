//! Ports out: two files are equal only if every one of golden's was compared, or left out by name.

use super::compare::dump;
use super::support::{Bench, whole};

const GOLDEN: [&str; 4] = [
    "wire 1 go",
    "wire 4 amount [3:0]",
    "reg 1 taken out",
    "wire 1 idle out",
];
const ROWS: [&[&str]; 4] = [
    &["0", "11", "0", "0"],
    &["1", "11", "0", "0"],
    &["1", "100", "1", "0"],
    &["0", "100", "0", "0"],
];
const BOTH: [&str; 3] = ["compare", "g.vcd", "o.vcd"];
const LEAVES: &str = "a map pairs them, --leave or leave in a map leaves out those that it names";

fn bench(other: &str) -> Bench {
    let bench = Bench::with("g.vcd", dump(&["top"], &GOLDEN, &ROWS));
    bench.write("o.vcd", other);
    bench
}

/// First line, last line of the errors, exit code.
fn said(bench: &Bench, more: &[&str]) -> (String, String, i32) {
    let done = bench.run(&[&BOTH[..], more].concat());
    let line = |text: Option<&str>| text.unwrap_or("").to_owned();
    let first = line(done.stdout.lines().next());
    (first, line(done.stderr.lines().last()), done.code)
}

/// Inputs of the other design with outputs that have other names and are wrong in every tick.
#[test]
fn inputs_that_pair_are_no_equality() {
    let renamed = [
        "wire 1 go",
        "wire 4 amount [3:0]",
        "wire 1 o_taken",
        "wire 1 o_idle",
    ];
    let wrong: Vec<Vec<&str>> = ROWS.map(|row| vec![row[0], row[1], "x", "1"]).to_vec();
    let wrong: Vec<&[&str]> = wrong.iter().map(Vec::as_slice).collect();
    let inputs: Vec<&[&str]> = ROWS.iter().map(|row| &row[..2]).collect();
    // A module without anything in it, of which a simulator dumps what goes in; and the interface in
    // a bench that holds the inputs of a design that has another name for all.
    for other in [
        dump(&["tb", "dut"], &renamed, &wrong),
        dump(&["tb", "dut"], &GOLDEN[..2], &inputs),
        dump(&["tb", "bus"], &GOLDEN[..2], &inputs),
    ] {
        let bench = bench(&other);
        for more in [
            &[][..],
            &["--allow-missing"],
            &["--any-length"],
            &["--strict"],
        ] {
            let (first, error, code) = said(&bench, more);
            assert_eq!(
                first,
                "ports out of golden not compared: top.taken, top.idle; what is compared is equal: \
                 4 ticks (0 to 3), 2 signals, 8 values; in golden 2 moved, 0 never changed"
            );
            let text = format!("error: ports out of golden not compared: 2; {LEAVES}");
            assert_eq!((error, code), (text, 1), "{more:?}");
        }
    }
}

#[test]
fn a_port_out_is_compared_or_left_out_by_its_name() {
    let other = [
        "wire 1 go",
        "wire 4 amount [3:0]",
        "wire 1 o_taken",
        "wire 1 idle",
    ];
    let bench = bench(&dump(&["tb", "dut"], &other, &ROWS));
    let (_, error, code) = said(&bench, &[]);
    assert_eq!(
        (error.contains("not compared: 1;"), code),
        (true, 1),
        "{error}"
    );
    bench.write("m.toml", "[signals]\n\"top.taken\" = \"o_taken\"\n");
    let (first, _, code) = said(&bench, &["--map", "m.toml"]);
    let equal = "equal: 4 ticks (0 to 3), 4 signals, 16 values; in golden 3 moved, 1 never changed";
    assert_eq!((&*first, code), (equal, 0));
    // What is left out is named, and is not taken for equal to anything.
    bench.write("m.toml", "leave = [\"top.taken\"]\n");
    for more in [
        ["--map", "m.toml"],
        ["--leave", "taken"],
        ["--leave", "top.taken"],
    ] {
        let (first, error, code) = said(&bench, &more);
        let text = "ports out left out: top.taken; what is compared is equal: 4 ticks (0 to 3), 3 \
                    signals, 12 values; in golden 2 moved, 1 never changed";
        assert_eq!((&*first, &*error, code), (text, "", 0), "{more:?}");
    }
    let report = bench.json(&[&BOTH[..], &["--leave", "taken"]].concat());
    assert_eq!(
        report["ports_out"],
        serde_json::json!(["top.taken", "top.idle"])
    );
    assert_eq!(report["ports_out_left"], serde_json::json!(["top.taken"]));
    assert_eq!(report["ports_out_not_compared"], serde_json::json!([]));
    assert_eq!(report["never_changed"], serde_json::json!(["top.idle"]));
    assert_eq!(whole(&report, "/moved"), 2);
    // `ignore` is for other signals.
    bench.write("m.toml", "ignore = [\"top.taken\"]\n");
    let (first, _, code) = said(&bench, &["--map", "m.toml"]);
    assert!(
        first.starts_with("ports out of golden not compared: top.taken;"),
        "{first}"
    );
    assert_eq!(code, 1);
}

/// A port out with a partner and without a value to compare.
#[test]
fn a_port_out_without_a_value_is_not_compared() {
    let bench = bench(&dump(&["tb"], &GOLDEN, &ROWS));
    bench.write(
        "m.toml",
        "[signals]\n\"top.idle\" = { name = \"tb.idle\", delay = 9 }\n",
    );
    let (first, _, code) = said(&bench, &["--map", "m.toml"]);
    assert!(
        first.starts_with("ports out of golden not compared: top.idle;"),
        "{first}"
    );
    assert_eq!(code, 1);
}

#[test]
fn a_golden_file_that_does_not_tell_its_ports_out_is_refused_unless_they_are_named() {
    let bench = bench(&dump(&["tb"], &GOLDEN, &ROWS));
    let told = bench.read("g.vcd");
    let (before, rest) = told.split_once("$comment").unwrap();
    let (_, rest) = rest.split_once("$end\n").unwrap();
    bench.write("g.vcd", format!("{before}{rest}"));
    bench.refuse(
        &BOTH,
        "g.vcd: ports out: the file does not tell which they are; allowed: --ports-out NAME,… that \
         names them, a VCD or FST of motion-rtl, or an FST or GHW with directions",
    );
    let named = [&BOTH[..], &["--ports-out", "taken,top.idle"]].concat();
    let report = bench.json(&named);
    assert_eq!(
        report["ports_out"],
        serde_json::json!(["top.taken", "top.idle"])
    );
    for (more, text) in [
        (
            &["--ports-out", "tak"][..],
            "--ports-out: there is no tak; allowed: a signal of this file",
        ),
        (
            &["--ports-out", "clk"],
            "ports out: there is none beside the clock; allowed: --ports-out NAME,… that names them, a \
             VCD or FST of motion-rtl, or an FST or GHW with directions",
        ),
        (
            &["--ports-out", "taken", "--leave", "idle"],
            "--leave: top.idle is no port out; allowed: a port out; ignore in a map leaves out other \
             signals",
        ),
        (
            &["--ports-out", "taken", "--leave", "taken"],
            "ports out: all of them are left out; allowed: one port out at least that is compared",
        ),
    ] {
        bench.refuse(&[&BOTH[..], more].concat(), &format!("g.vcd: {text}"));
    }
    bench.write("m.toml", "\nleave = [\"top.go\"]\n");
    bench.refuse(
        &[&named[..], &["--map", "m.toml"]].concat(),
        "m.toml:2: top.go: is no port out; allowed: a port out; ignore in a map leaves out other signals",
    );
    bench.write("g.vcd", &told);
    bench.refuse(
        &named,
        "g.vcd: ports out: the file names them itself; allowed: no --ports-out; --leave leaves some \
         of them out",
    );
    bench.write("g.vcd", told.replace("top.idle $end", "top.busy $end"));
    bench.refuse(
        &BOTH,
        "g.vcd: ports out: the file names top.busy and has no such signal; allowed: a complete file: \
         this one lacks a signal",
    );
}
