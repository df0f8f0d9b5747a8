//! `compare` by the ends of names, by names of other widths, and the map to fill in.

use super::compare::dump;
use super::support::{Bench, whole};
use expect_test::{Expect, expect};

const GOLDEN: [&str; 3] = ["wire 1 go", "reg 4 count [3:0]", "wire 1 last out"];
const OTHER: [&str; 4] = [
    "wire 1 run_n",
    "reg 8 cnt_q [7:0]",
    "wire 1 done",
    "wire 1 spare",
];
const ROWS: [&[&str]; 2] = [&["1", "1", "0"], &["0", "10", "1"]];
const OTHER_ROWS: [&[&str]; 2] = [&["0", "1", "0", "0"], &["1", "10", "1", "0"]];

fn bench(scopes: &[&str], map: &str) -> Bench {
    let bench = Bench::with("g.vcd", dump(&["top"], &GOLDEN, &ROWS));
    bench.write("o.vcd", dump(scopes, &OTHER, &OTHER_ROWS));
    bench.write("m.toml", map);
    bench
}

#[track_caller]
fn shows(bench: &Bench, more: &[&str], code: i32, text: &Expect) {
    let done = bench.run(&[&["compare", "g.vcd", "o.vcd"], more].concat());
    text.assert_eq(&format!("{}{}", done.stdout, done.stderr));
    assert_eq!(done.code, code, "{more:?}");
}

#[test]
fn one_map_serves_two_simulators() {
    let map = "[signals]\n\"top.go\" = \"!tb.dut.run_n\"\n\"top.count\" = \"dut.cnt_q[3:0]\"\n\"top.last\" = \"done\"\n";
    for scopes in [&["tb", "dut"][..], &["TOP", "tb", "dut"]] {
        let bench = bench(scopes, map);
        let arguments = ["compare", "g.vcd", "o.vcd", "--map", "m.toml", "--strict"];
        let report = bench.json(&arguments);
        assert_eq!(whole(&report, "/signals"), 3);
        let spare = format!("{}.spare", scopes.join("."));
        assert_eq!(report["other_without_partner"][0], spare);
    }
}

#[test]
fn ends_are_whole_components_and_only_one_path_has_them() {
    let two = ["wire 4 u.count [3:0]", "wire 4 v.u.count [3:0]"];
    let two = dump(&["tb"], &two, &[&["1", "1"], &["10", "10"]]);
    let golden = dump(&["top"], &["reg 4 count [3:0] out"], &[&["1"], &["10"]]);
    let refused = |map: &str, more: &[&str], text: &Expect| {
        let bench = Bench::with("g.vcd", &golden);
        bench.write("o.vcd", &two);
        bench.write("m.toml", map);
        shows(&bench, &[&["--map", "m.toml"], more].concat(), 2, text);
    };
    refused(
        "[signals]\n\"top.count\" = \"count[3:0]\"",
        &[],
        &expect![[r#"
            error: m.toml:2: top.count: 2 signals are called count; allowed: more of its path, so that it is one of tb.u.count, tb.v.u.count
        "#]],
    );
    refused(
        "[signals]\n\"top.count\" = \"ount\"",
        &[],
        &expect![[r#"
        error: m.toml:2: top.count: no signal of the other file is called ount; allowed: a signal of o.vcd
    "#]],
    );
    refused(
        "[scopes]\n\"top\" = \"u\"",
        &[],
        &expect![[r#"
        error: m.toml:2: top: 2 scopes are called u; allowed: more of its path, so that it is one of tb.u, tb.v.u
    "#]],
    );
    refused(
        "",
        &["--scope", "u"],
        &expect![[r#"
        error: o.vcd: --scope: 2 scopes are called u; allowed: more of its path, so that it is one of tb.u, tb.v.u
    "#]],
    );
    let bench = Bench::with("g.vcd", &golden);
    bench.write("o.vcd", &two);
    bench.write("m.toml", "[scopes]\n\"top\" = \"v.u\"");
    for more in [["--map", "m.toml"], ["--scope", "v.u"]] {
        let report = bench.json(&[&["compare", "g.vcd", "o.vcd"][..], &more].concat());
        assert_eq!(report["other_without_partner"][0], "tb.u.count");
    }
}

#[test]
fn every_other_width_of_a_map_is_a_difference() {
    let map = "[signals]\n\"top.go\" = \"dut.cnt_q[7:6]\"\n\"top.count\" = \"dut.cnt_q\"\n\"top.last\" = \"done\"\n";
    let text = expect![[r#"
        different: 0 of 1 signal, in 2 ticks (0 to 1), 2 values; in golden 1 moved, 0 never changed
        golden g.vcd: clock top.clk, 2 ticks
        other  o.vcd: clock tb.dut.clk, 2 ticks

        different width in bits, not compared: 2
          top.go: 1 | tb.dut.cnt_q[7:6]: 2
          top.count: 4 | tb.dut.cnt_q: 8

        signals not compared: 2 without partner in other, 2 of different width
        error: the files differ
    "#]];
    let bench = bench(&["tb", "dut"], map);
    shows(&bench, &["--map", "m.toml"], 1, &text);
}

#[test]
fn all_lists_the_names_of_both_sides_and_a_template_has_them() {
    let bench = bench(&["tb", "dut"], "[signals]\n\"top.last\" = \"done\"\n");
    shows(
        &bench,
        &["--map", "m.toml", "--all", "--allow-missing"],
        0,
        &expect![[r#"
            ports in of golden without partner: top.go; what is compared is equal: 2 ticks (0 to 1), 1 signal, 2 values; in golden 1 moved, 0 never changed
            golden g.vcd: clock top.clk, 2 ticks
            other  o.vcd: clock tb.dut.clk, 2 ticks

            golden signals without partner: 2
              top.go
              top.count

            signals of the other file without partner: 3
              tb.dut.run_n
              tb.dut.cnt_q
              tb.dut.spare

            signals not compared: 2 without partner in golden, 3 without partner in other
        "#]],
    );
    shows(
        &bench,
        &["--template"],
        0,
        &expect![[r##"
            # Names of o.vcd that stand for those of g.vcd.
            # Fill in a name and take the # away. The end of a path will do if it is the only one.
            # What has no partner on purpose goes into ignore, a port out into leave.

            ignore = []
            leave = []

            [signals]
            #"top.go" = "" # 1 bit
            #"top.count" = "" # 4 bits
            #"top.last" = "" # 1 bit, port out

            # There without partner:
            #   tb.dut.run_n # 1 bit
            #   tb.dut.cnt_q # 8 bits
            #   tb.dut.done # 1 bit
            #   tb.dut.spare # 1 bit
        "##]],
    );
    // With a map it has what is left, and it is a map.
    let left = bench.succeed(&["compare", "g.vcd", "o.vcd", "--map", "m.toml", "--template"]);
    assert!(!left.contains("top.last") && !left.contains("done"));
    let filled = left
        .replace("#\"top.go\" = \"\"", "\"top.go\" = \"!run_n\"")
        .replace("#\"top.count\" = \"\"", "\"top.count\" = \"cnt_q[3:0]\"");
    bench.write("m.toml", filled + "\"top.last\" = \"done\"\n");
    let report = bench.json(&["compare", "g.vcd", "o.vcd", "--map", "m.toml"]);
    assert_eq!(whole(&report, "/signals"), 3);
}

#[test]
fn the_table_begins_where_it_is_asked_to_and_has_what_surrounds_the_mismatch() {
    let variables = [
        "wire 1 go",
        "reg 1 state out",
        "wire 1 net",
        "wire 1 a.in",
        "reg 1 a.b.count",
        "wire 1 a.b.next",
    ];
    let mut rows = vec![&["0", "1", "0", "1", "0", "1"][..]; 7];
    let golden = dump(&["top"], &variables, &rows);
    rows[6] = &["0", "1", "0", "1", "0", "0"];
    let bench = Bench::with("g.vcd", golden);
    let other = dump(&["top"], &variables, &rows).replace("1 ns", "100 ps");
    bench.write("o.vcd", other);
    shows(
        &bench,
        &["--around", "1"],
        1,
        &expect![[r#"
            different: 1 of 6 signals, in 7 ticks (0 to 6), 42 values; in golden 0 moved, 6 never changed
            golden g.vcd: clock top.clk, 7 ticks
            other  o.vcd: clock top.clk, scope top, 7 ticks

            first in tick 6, in which 1 signal differs:
              golden  top.a.b.next  1  at 60 ns
              other   top.a.b.next  0  at 6 ns

            tick           5  6
            top.a.b.next   1  1!0
            top.a.b.count  0  0
            top.state      1  1
            top.go         0  0
            top.a.in       1  1
            (hexadecimal, golden!other where they differ)

            first tick  ticks  signal
                     6      1  top.a.b.next | top.a.b.next
            error: the files differ
        "#]],
    );
    let report = bench.run(&["compare", "g.vcd", "o.vcd", "--around", "9", "--json"]);
    let report = serde_json::from_str(&report.stdout).unwrap();
    assert_eq!(whole(&report, "/first/shown_ticks/0"), 0);
}

/// What is a scope deeper in the other design must not be equal because of what happens to pair.
#[test]
fn ports_without_partner_are_named_first_and_no_equality() {
    let golden = ["wire 4 period [3:0]", "reg 1 u.x out", "reg 1 u.y"];
    let rows: [&[&str]; 2] = [&["11", "0", "1"], &["11", "1", "0"]];
    let bench = Bench::with("g.vcd", dump(&["top"], &golden, &rows));
    let other = ["wire 4 period [3:0]", "reg 1 g.u.x", "reg 1 g.u.y"];
    bench.write("o.vcd", dump(&["tb", "dut"], &other, &rows));
    shows(
        &bench,
        &[],
        1,
        &expect![[r#"
            ports in of golden without partner: top.period; what is compared is equal: 2 ticks (0 to 1), 2 signals, 4 values; in golden 2 moved, 0 never changed
            golden g.vcd: clock top.clk, 2 ticks
            other  o.vcd: clock tb.dut.clk, scope tb.dut.g, 2 ticks

            golden signals without partner: 1
              top.period

            signals not compared: 1 without partner in golden, 1 without partner in other
            error: ports in of golden without partner: 1; a map pairs them, --allow-missing takes the rest as equal
        "#]],
    );
    shows(
        &bench,
        &["--allow-missing"],
        0,
        &expect![[r#"
            ports in of golden without partner: top.period; what is compared is equal: 2 ticks (0 to 1), 2 signals, 4 values; in golden 2 moved, 0 never changed
            golden g.vcd: clock top.clk, 2 ticks
            other  o.vcd: clock tb.dut.clk, scope tb.dut.g, 2 ticks

            golden signals without partner: 1
              top.period

            signals not compared: 1 without partner in golden, 1 without partner in other
        "#]],
    );
    let report = bench.json(&["compare", "g.vcd", "o.vcd", "--allow-missing"]);
    assert_eq!(report["ports_in_without_partner"][0], "top.period");
    // Where the port in pairs, it is the port out that has no partner.
    let done = bench.run(&["compare", "g.vcd", "o.vcd", "--scope", "tb.dut"]);
    let first = "ports out of golden not compared: top.u.x; what is compared is equal: ";
    assert!(done.stdout.starts_with(first), "{}", done.stdout);
    assert_eq!(done.code, 1);
    // And where it is said to be another one.
    bench.write("m.toml", "ignore = [\"top.period\"]\n");
    bench.json(&["compare", "g.vcd", "o.vcd", "--map", "m.toml"]);
}

/// Dumps that have nothing to do with each other but a name or two.
#[test]
fn that_almost_nothing_pairs_is_said_first() {
    let names: Vec<String> = (0..30).map(|at| format!("reg 1 r{at}")).collect();
    let mut names: Vec<&str> = names.iter().map(String::as_str).collect();
    names[0] = "reg 1 r0 out";
    let row = vec!["0"; 30];
    let golden = dump(&["top"], &names, &[&row, &row]);
    for (paired, code) in [(1, 1), (2, 1), (3, 0), (30, 0)] {
        let bench = Bench::with("g.vcd", &golden);
        bench.write(
            "o.vcd",
            dump(
                &["top"],
                &names[..paired],
                &[&row[..paired], &row[..paired]],
            ),
        );
        let done = bench.run(&["compare", "g.vcd", "o.vcd"]);
        assert_eq!(done.code, code, "{paired}: {}{}", done.stdout, done.stderr);
        let first =
            format!("almost nothing pairs, {paired} of 30 signals; what is compared is equal: ");
        assert_eq!(
            done.stdout.starts_with(&first),
            code == 1,
            "{}",
            done.stdout
        );
        let allowed = ["compare", "g.vcd", "o.vcd", "--allow-missing"];
        bench.succeed(&allowed);
    }
}
