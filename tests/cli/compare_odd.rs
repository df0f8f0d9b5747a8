//! `compare` on dumps with something odd in them that is not compared, and on clocks that are one.

use super::compare::dump;
use super::support::{Bench, whole};

const VARIABLES: [&str; 2] = ["reg 4 count [3:0]", "wire 1 last out"];
const ROWS: [&[&str]; 4] = [&["0", "0"], &["1", "0"], &["10", "1"], &["11", "0"]];

fn golden() -> String {
    dump(&["top"], &VARIABLES, &ROWS)
}

/// Equal with these two files in every value, and without bits are that many variables.
#[track_caller]
fn equal(golden: &str, other: &str, without_bits: i64) {
    let bench = Bench::with("g.vcd", golden);
    bench.write("o.vcd", other);
    let report = bench.json(&["compare", "g.vcd", "o.vcd"]);
    assert_eq!(
        (whole(&report, "/ticks"), whole(&report, "/values")),
        (4, 8)
    );
    assert_eq!(whole(&report, "/other/without_bits"), without_bits);
}

/// The golden dump with a variable more and these lines behind the first values of a tick.
fn with(variable: &str, lines: &str) -> String {
    let text = golden().replace("$upscope", &format!("$var {variable} $end\n$upscope"));
    text.replace("#10\n", &format!("#10\n{lines}"))
}

#[test]
fn variables_that_are_not_compared_may_be_odd() {
    // As yosys writes it, and with values of all kinds.
    for lines in [
        "", "b Z\n", "b0 Z\n", "0Z\n", "0 Z\n", "bx1 Z\n", "r1 Z\n", "sa b Z\n",
    ] {
        equal(&golden(), &with("wire 0 Z foo", lines), 1);
        equal(&golden(), &with("wire 4294967296 Z foo", lines), 1);
    }
    for lines in [
        "r1.5 Z\n",
        "rinf Z\n",
        "rnone Z\n",
        "r Z\n",
        "rnot a number Z\n",
        "b1 Z\n",
        "1Z\n",
    ] {
        equal(&golden(), &with("real 64 Z voltage", lines), 1);
    }
    for lines in [
        "sIDLE Z\n",
        "s Z\n",
        "stwo words Z\n",
        "sa\tb 1! Z\n",
        "1Z\n",
    ] {
        equal(&golden(), &with("string 1 Z state", lines), 1);
    }
    // Of its code there is another one, with a width: that one is compared.
    let both = golden().replace("$var reg 4 v0", "$var wire 0 v0 none $end\n$var reg 4 v0");
    equal(&golden(), &both, 1);
    // More than one value in a line.
    let lines = golden().replace("b0 v0\nb0 v1\n", "b0 v0 b0 v1 ");
    equal(&golden(), &lines, 0);
}

#[test]
fn white_space_may_be_any() {
    equal(
        &golden(),
        &golden().replace("count [3:0]", "count\t[3:0]"),
        0,
    );
    equal(&golden(), &golden().replace("$var wire", "$var\twire"), 0);
    let spaced = golden()
        .replace("1!", "1 !")
        .replace("0!", "0\t !")
        .replace("b1 v1", "1 v1");
    assert_ne!(spaced, golden());
    equal(&golden(), &spaced, 0);
    equal(&spaced, &golden(), 0);
    let lines = golden().replace("1!", "1\n!").replace('\n', "\r\n");
    equal(&golden(), &lines, 0);
}

#[test]
fn scopes_may_have_no_name() {
    let text = golden().replace("$scope module top", "$scope module $end\n$scope module top");
    let text = text.replace("$upscope $end\n", "$upscope $end\n$upscope $end\n");
    equal(&golden(), &text, 0);
    equal(&text, &golden(), 0);
    let inner = golden().replace("$var wire 1 !", "$scope begin $end\n$var wire 1 !");
    let inner = inner.replace("$upscope $end\n", "$upscope $end\n$upscope $end\n");
    equal(&golden(), &inner, 0);
}

/// A dump that is switched off at its very end has all ticks before that.
#[test]
fn a_dump_may_end_with_being_switched_off() {
    for (end, off) in [
        ("#40\n", "$dumpoff\n"),
        ("#40\n", "$dumpoff\nx!\nbx v0\nbx v1\n$end\n"),
        ("#40\n", "#41\n$dumpoff\nx!\nbx v0\nbx v1\n$end\n#99\n"),
        ("#40\n", "#41\n$dumpoff $end\nx!\nbx v0\nbx v1"),
    ] {
        let text = golden();
        assert!(text.ends_with(end));
        equal(&golden(), &(text + off), 0);
    }
}

/// Each level of a design has a code of its own for its clock.
#[test]
fn clocks_with_the_same_edges_are_one() {
    let levels = ["reg 4 count [3:0]", "wire 1 last", "wire 1 u.clk"];
    // Half a tick behind the rise the clock falls; this one has its values where that one has them.
    let text = dump(&["tb"], &levels, &[&["0", "0", "1"][..]; 4]);
    let mut other = text
        .split("#0\n")
        .next()
        .unwrap()
        .replace(" clk $end", " v.clk $end");
    for (tick, row) in ROWS.iter().enumerate() {
        let (rise, fall) = (10 * tick, 10 * tick + 5);
        other += &format!(
            "#{rise}\n1!\n1v2\nb{} v0\nb{} v1\n#{fall}\n0!\n0v2\n",
            row[0], row[1]
        );
    }
    other += "#40\n";
    equal(&golden(), &other, 0);
    // In another order within a time, and unset at first.
    equal(&golden(), &other.replace("#0\n1!", "#0\nx!\n1!"), 0);
    let bench = Bench::with("g.vcd", golden());
    bench.write("o.vcd", &other);
    let report = bench.json(&["compare", "g.vcd", "o.vcd"]);
    assert_eq!(report["other"]["clock"], "tb.v.clk");
    // The second is a clock too, and nothing without partner.
    assert_eq!(report["other_without_partner"], serde_json::json!([]));
    // One edge is missing in one of them.
    bench.write("o.vcd", other.replace("#20\n1!\n1v2\n", "#20\n1!\n"));
    bench.refuse(
        &["compare", "g.vcd", "o.vcd"],
        "o.vcd: --other-clock: 2 signals of different edges are called clk; allowed: one of them by \
         its path: tb.v.clk, tb.u.clk",
    );
}

#[test]
fn names_of_another_case_pair_where_that_is_asked_for() {
    let other = dump(&["TB", "Dut"], &["reg 4 COUNT [3:0]", "wire 1 Last"], &ROWS);
    let other = other.replace(" clk $end", " CLK $end");
    let bench = Bench::with("g.vcd", golden());
    bench.write("o.vcd", &other);
    let both = ["compare", "g.vcd", "o.vcd"];
    assert_eq!(bench.run(&both).code, 2);
    let report = bench.json(&[&both[..], &["--ignore-case"]].concat());
    assert_eq!(
        (whole(&report, "/signals"), whole(&report, "/values")),
        (2, 8)
    );
    assert_eq!(report["scope"], "TB.Dut");
    assert_eq!(report["other"]["clock"], "TB.Dut.CLK");
    // Two that differ in case only are two; the one of the same case is meant.
    let twice = ["wire 4 COUNT [3:0]", "wire 1 Last", "reg 4 count [3:0]"];
    let rows = ROWS.map(|row| vec!["1111", row[1], row[0]]);
    let rows: Vec<&[&str]> = rows.iter().map(Vec::as_slice).collect();
    bench.write("o.vcd", dump(&["TB"], &twice, &rows));
    let report = bench.json(&[&both[..], &["--ignore-case"]].concat());
    assert_eq!(whole(&report, "/values"), 8);
    let twice = ["wire 4 COUNT [3:0]", "wire 1 last", "reg 4 Count [3:0]"];
    bench.write("o.vcd", dump(&["TB"], &twice, &rows));
    let report = bench.json(&[&both[..], &["--ignore-case"]].concat());
    assert_eq!(report["without_partner"], serde_json::json!(["top.count"]));
}

/// A map whose pairs all differ in width.
#[test]
fn a_pair_of_different_widths_is_a_pair() {
    let bench = Bench::with("g.vcd", golden());
    let other = dump(&["tb"], &["reg 8 cnt [7:0]", "wire 1 done"], &ROWS);
    bench.write("o.vcd", other);
    bench.write("m.toml", "[signals]\n\"top.count\" = \"cnt\"\n");
    let done = bench.run(&["compare", "g.vcd", "o.vcd", "--map", "m.toml"]);
    assert_eq!((done.code, &*done.stderr), (1, "error: the files differ\n"));
    let text = "different width in bits, not compared: 1\n  top.count: 4 | tb.cnt: 8\n";
    assert!(done.stdout.contains(text), "{}", done.stdout);
    // Nothing but what is too wide.
    let wide = dump(&["top"], &["reg 65 count [64:0] out"], &[&["0"], &["1"]]);
    bench.write("g.vcd", &wide);
    bench.write("o.vcd", wide.replace("count", "cnt"));
    bench.refuse(
        &["compare", "g.vcd", "o.vcd", "--map", "m.toml"],
        "o.vcd: file: nothing pairs but signals of more than 64 bits; allowed: a narrower signal \
         beside top.count",
    );
}
