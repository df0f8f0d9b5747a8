//! `compare` on dumps that are right and not as this crate writes them: unset clocks, switched off,
//! cut, larger than there is room for.

use super::compare::dump;
use super::support::{Bench, whole};
use expect_test::expect;
use std::fs::File;
use std::time::{Duration, Instant};

const VARIABLES: [&str; 2] = ["reg 4 count [3:0]", "wire 1 last out"];
const ROWS: [&[&str]; 8] = [
    &["0", "0"],
    &["1", "0"],
    &["10", "0"],
    &["11", "0"],
    &["100", "1"],
    &["101", "0"],
    &["110", "0"],
    &["111", "1"],
];

fn golden() -> String {
    dump(&["top"], &VARIABLES, &ROWS)
}

/// Golden's values from a bench whose clock is low at first: edges at 5, 15, 25 ns and so on.
fn simulated(clock: &str) -> String {
    let mut text = golden();
    let body = text.find("#0\n").unwrap();
    text.truncate(body);
    text += &format!("#0\n$dumpvars\n{clock}!\nb0 v0\nb0 v1\n$end\n#2\n0!\n");
    for (tick, row) in ROWS.iter().enumerate().skip(1) {
        text += &format!("#{}\n1!\nb{} v0\nb{} v1\n", 10 * tick - 5, row[0], row[1]);
        text += &format!("#{}\n0!\n", 10 * tick);
    }
    text
}

fn bench(other: impl AsRef<[u8]>) -> Bench {
    let bench = Bench::with("g.vcd", golden());
    bench.write("o.vcd", other);
    bench
}

const BOTH: [&str; 3] = ["compare", "g.vcd", "o.vcd"];

#[track_caller]
fn equal(other: impl AsRef<[u8]>) {
    let report = bench(other).json(&BOTH);
    assert_eq!(
        (whole(&report, "/ticks"), whole(&report, "/values")),
        (8, 16)
    );
}

#[test]
fn a_clock_may_be_unset_before_its_first_edge() {
    for clock in ["0", "x", "z"] {
        equal(simulated(clock));
    }
    // Up to that edge, which is one to a simulator's flip-flops too.
    equal(simulated("x").replace("#2\n0!\n", ""));
    // A first value is none.
    let late = simulated("x").replace("x!\n", "").replace("#2\n0!\n", "");
    let report = bench(late).run(&[&BOTH[..], &["--any-length"]].concat());
    assert_eq!(report.code, 1, "{}", report.stdout);
}

#[test]
fn marks_and_ends_of_other_programs_are_no_fault() {
    let text = simulated("0");
    equal([b"\xef\xbb\xbf", text.as_bytes()].concat());
    equal(text.trim_end());
    let version = "$version one $end\n$date now $end\n$version two $end\n$date then $end\n";
    equal(format!("{version}{text}"));
    // Ours has a last line that is whole.
    let ours = format!("$version motion-rtl 0.1.0 $end\n{}", golden());
    equal(&ours);
    let done = bench(ours.trim_end()).run(&BOTH);
    assert_eq!(
        done.stderr,
        "error: o.vcd:58: file: the file ends within this line; allowed: a complete VCD: this one \
         is cut off\n"
    );
}

/// All values once more in the middle of a tick.
#[test]
fn values_may_be_written_again() {
    let again = "#33\n$dumpall\n0!\nb11 v0\nb0 v1\n$end\n#35\n";
    let text = simulated("0");
    assert!(text.contains("#35\n"));
    equal(text.replace("#35\n", again));
    let again = "#27\n$dumpall\n1!\nb11 v0\nb0 v1\n$end\n#30\n";
    equal(text.replace("#30\n", again));
}

/// Switched off from 22 ns to a while after 50 ns: edges at 25, 35, 45 and 55 ns.
fn switched_off(on: &str) -> String {
    let text = simulated("0");
    let (before, rest) = text.split_once("#25\n").unwrap();
    let (_, after) = rest.split_once("#55\n").unwrap();
    format!("{before}#22\n$dumpoff\nx!\nbx v0\nbx v1\n$end\n{on}#55\n{after}")
}

#[test]
fn ticks_of_a_dump_that_is_switched_off_are_counted_and_not_compared() {
    let on = "#52\n$dumpon\n0!\nb101 v0\nb0 v1\n$end\n";
    let other = bench(switched_off(on));
    let done = other.run(&BOTH);
    expect![[r#"
        equal: 8 ticks (0 to 7), 2 signals, 10 values; in golden 2 moved, 0 never changed
        golden g.vcd: clock top.clk, 8 ticks
        other  o.vcd: clock top.clk, scope top, 8 ticks, 3 switched off, not compared
    "#]]
    .assert_eq(&done.stdout);
    assert_eq!(done.code, 0, "{}", done.stderr);
    // The golden one's too, and what is known again is compared.
    let report = other.json(&["compare", "o.vcd", "g.vcd"]);
    assert_eq!(whole(&report, "/golden/switched_off"), 3);
    assert_eq!(whole(&report, "/values"), 10);
    let wrong = switched_off(&on.replace("b101", "b100"));
    let done = bench(wrong).run(&BOTH);
    assert!(done.stdout.contains("first in tick 5, "), "{}", done.stdout);
    let nothing = [&BOTH[..], &["--from", "3", "--ticks", "2"]].concat();
    let done = other.run(&nothing);
    assert_eq!(
        done.stderr,
        "error: o.vcd: values: nothing to compare: in ticks 3 to 4 one of the two dumps is switched \
         off; allowed: dumps that are both on in a tick\n"
    );
    // Half a period more, so that nothing tells how many there are.
    let late = switched_off(on).replace("#55\n", "#57\n");
    let done = bench(late).run(&BOTH);
    assert_eq!(
        done.stderr,
        "error: o.vcd: top.clk: its edges between 15 ns and 57 ns cannot be counted: the dump is \
         switched off; allowed: a clock of which a whole number of periods fits in between\n"
    );
    assert_eq!(done.code, 2);
}

#[test]
fn a_dump_that_stays_switched_off_is_shorter() {
    let text = switched_off("");
    let cut = &text[..text.find("#55\n").unwrap()];
    let done = bench(cut).run(&BOTH);
    expect![[r#"
        golden is 5 ticks longer; what both have is equal: 3 ticks (0 to 2), 2 signals, 6 values; in golden 1 moved, 1 never changed
        golden g.vcd: clock top.clk, 8 ticks, 5 only here
        other  o.vcd: clock top.clk, scope top, 3 ticks
        error: the files end in different ticks; --ticks chooses those of both, --any-length takes the rest as equal
    "#]]
    .assert_eq(&format!("{}{}", done.stdout, done.stderr));
    assert_eq!(done.code, 1);
}

/// A file that is cut off behind a time.
#[test]
fn a_difference_in_length_is_one_unless_asked_for() {
    let whole_text = golden();
    let cut = &whole_text[..whole_text.find("#60\n").unwrap() + 4];
    let bench = bench(cut);
    for [one, two] in [["g.vcd", "o.vcd"], ["o.vcd", "g.vcd"]] {
        let run = |more: &[&str]| bench.run(&[&["compare", one, two], more].concat());
        let done = run(&[]);
        assert_eq!(done.code, 1);
        let longer = if one == "g.vcd" { "golden" } else { "other" };
        let first = format!("{longer} is 2 ticks longer; what both have is equal: 6 ticks");
        assert!(done.stdout.starts_with(&first), "{}", done.stdout);
        for more in [&["--any-length"][..], &["--ticks", "6"]] {
            assert_eq!(run(more).code, 0, "{more:?}");
        }
        assert_eq!(run(&["--ticks", "7"]).code, 1);
        // What is left out at the beginning is asked for.
        assert_eq!(run(&["--from", "3", "--ticks", "3"]).code, 0);
    }
    // Other values are what is said first.
    let report = bench.json(&["compare", "g.vcd", "o.vcd", "--any-length"]);
    assert_eq!(whole(&report, "/golden/longer"), 2);
    assert_eq!(whole(&report, "/other/longer"), 0);
}

/// Neither is read, which would take longer than a second.
#[test]
fn files_that_are_too_large_are_refused_by_their_size() {
    let bench = Bench::with("g.vcd", golden());
    for name in ["one.vcd", "two.fst"] {
        let file = File::create(bench.path(name)).unwrap();
        // Sparse: takes no room on disk.
        file.set_len(2 << 30).unwrap();
    }
    let begun = Instant::now();
    for (one, two, large) in [
        ("one.vcd", "two.fst", "one.vcd"),
        ("g.vcd", "two.fst", "two.fst"),
    ] {
        let text = format!("{large}: file: too large; allowed: at most 1073741824 bytes");
        bench.refuse(&["compare", one, two], &text);
    }
    assert!(begun.elapsed() < Duration::from_secs(2));
}

/// As many changes of a million bits as 5 GB hold, in a file of 200 kB.
#[cfg(target_os = "linux")]
#[test]
fn values_that_are_wider_than_they_are_written_have_a_bound() {
    use super::support::PROGRAM;
    let wide = |changes: usize| {
        let mut text = golden().replace(
            "$upscope",
            "$var wire 1000000 w wide [999999:0] $end\n$upscope",
        );
        text.truncate(text.find("#0\n").unwrap());
        text += "#0\n0!\nb0 v0\nb0 v1\n";
        for at in 0..changes {
            text += &format!("#{}\n{}!\nb{} w\n", at + 1, at % 2, at % 2);
        }
        text
    };
    let bench = Bench::with("wide.vcd", wide(20_000));
    bench.write("some.vcd", wide(200));
    let compare = |name: &str| {
        let script = "ulimit -c 0; ulimit -v 3000000; exec \"$0\" \"$@\"";
        let mut command = std::process::Command::new("sh");
        command.args(["-c", script, PROGRAM, "compare", name, name]);
        command.env("RAYON_NUM_THREADS", "1");
        let output = command.current_dir(bench.path(".")).output().unwrap();
        let text = String::from_utf8(output.stderr).unwrap();
        (output.status.code(), text)
    };
    let (code, text) = compare("wide.vcd");
    assert!(
        text.starts_with("error: wide.vcd:")
            && text.contains("w: more values of a signal of 1000000 bits than fit"),
        "{text}"
    );
    assert_eq!(code, Some(2));
    assert_eq!(compare("some.vcd"), (Some(0), String::new()));
}

/// The outermost scope beside an inner one that is named.
#[test]
fn a_scope_that_is_named_pairs_no_other_beside_it() {
    let golden = ["wire 1 go", "reg 1 u.x out", "reg 1 v.x"];
    let rows: [&[&str]; 2] = [&["1", "0", "1"], &["0", "1", "0"]];
    let bench = Bench::with("g.vcd", dump(&["top"], &golden, &rows));
    // What is called `go` and `v.x` here has other values: it is something else.
    let other = ["wire 1 go", "reg 1 mine.x", "reg 1 v.x"];
    let rows: [&[&str]; 2] = [&["0", "0", "0"], &["0", "1", "0"]];
    bench.write("o.vcd", dump(&["tb"], &other, &rows));
    bench.write("m.toml", "[scopes]\n\"top.u\" = \"tb.mine\"\n");
    let mapped = ["compare", "g.vcd", "o.vcd", "--map", "m.toml"];
    let done = bench.run(&mapped);
    expect![[r#"
        ports in of golden without partner: top.go; what is compared is equal: 2 ticks (0 to 1), 1 signal, 2 values; in golden 1 moved, 0 never changed
        golden g.vcd: clock top.clk, 2 ticks
        other  o.vcd: clock tb.clk, 2 ticks

        golden signals without partner: 2
          top.go
          top.v.x

        signals not compared: 2 without partner in golden, 2 without partner in other
        error: ports in of golden without partner: 1; a map pairs them, --allow-missing takes the rest as equal
    "#]]
    .assert_eq(&format!("{}{}", done.stdout, done.stderr));
    assert_eq!(done.code, 1);
    // Asked for, it pairs: on the command line or in the map.
    for (map, more) in [("", &["--scope", "tb"][..]), ("\"top\" = \"tb\"\n", &[])] {
        bench.write(
            "m.toml",
            format!("[scopes]\n\"top.u\" = \"tb.mine\"\n{map}"),
        );
        let done = bench.run(&[&mapped[..], more].concat());
        assert!(
            done.stdout.starts_with("different: 2 of 3 signals"),
            "{}",
            done.stdout
        );
    }
}
