//! Bad drawings, part programs and arguments: their errors, and nothing left behind.

use super::support::{Bench, DRAWINGS, LINE, SHORT};

/// Every file that can be run.
const KNOWN: &str = "a scenario as .toml; HPGL as .hpgl, .hpg, .plt or .hgl; G-code as .ngc, \
     .gcode, .nc, .tap, .gc or .cnc; a position log as .csv";

const SCOPES: &str = "pulse_interpolator, pulse_interpolator.unit_time, \
     pulse_interpolator.counter, pulse_interpolator.port, pulse_interpolator.sequencer, \
     pulse_interpolator.x, pulse_interpolator.x.memory, \
     pulse_interpolator.x.memory.half_periods, pulse_interpolator.x.memory.directions, \
     pulse_interpolator.x.generator, pulse_interpolator.x.sync, pulse_interpolator.y, \
     pulse_interpolator.y.memory, pulse_interpolator.y.memory.half_periods, \
     pulse_interpolator.y.memory.directions, pulse_interpolator.y.generator, \
     pulse_interpolator.y.sync";

#[test]
fn bad_drawings_are_refused() {
    const MNEMONICS: &str =
        "no instruction starts with it; allowed: instructions of two letters, such as PD";
    const WORDS: &str = "a letter without its number, or out of place; allowed: words of a letter and a number, such as X10.5";
    let cases: [(&str, &[u8], String); 17] = [
        ("p.hpgl", b"", "p.hpgl: file: no move in it; allowed: an HPGL drawing with at least one move".into()),
        ("p.hpgl", b"IN;SP1;\nPU0,0;", "p.hpgl: file: no move in it; allowed: an HPGL drawing with at least one move".into()),
        ("p.hpgl", b"IN;\nPD10;", "p.hpgl:2: PD: an X without its Y: an odd count of coordinates; allowed: pairs of X and Y".into()),
        ("p.hpgl", b"PD99999999999,0;", "p.hpgl:1: PD: 99999999999 is out of range; allowed: -1073741824 to 1073741824".into()),
        ("p.hpgl", b"PDnan,0;", "p.hpgl:1: NA: is not known and may move the pen; allowed: instructions of HPGL and HPGL/2; with --lenient it is skipped".into()),
        ("p.hpgl", b"\xff\x00\x01", format!("p.hpgl:1: '\\u{{ff}}': {MNEMONICS}")),
        ("p.hpgl", b"PD1,1;\nLBabc", "p.hpgl:2: LB: no label terminator after it, to the end of the file; allowed: '\\u{3}' at its end".into()),
        ("p.ngc", b"", "p.ngc: file: no move in it; allowed: a G-code program with at least one move".into()),
        ("p.ngc", b"G0 X0\nM2\n", "p.ngc: file: no move in it; allowed: a G-code program with at least one move".into()),
        ("p.ngc", b"G1 Xnan\n", format!("p.ngc:1: X: {WORDS}")),
        ("p.ngc", b"G1 Xinf\n", format!("p.ngc:1: X: {WORDS}")),
        ("p.ngc", b"\nG1 X9999999\n", "p.ngc:2: G1: X would be 9999999 mm; allowed: -1000000 to 1000000 mm".into()),
        ("p.ngc", b"G1 X1 F0\n", "p.ngc:1: F: a feed of 0; allowed: a feed above 0".into()),
        ("p.ngc", b"G1 X1 F100000000\n", "p.ngc:1: F: is 100000000 mm/min; allowed: 0.001 to 10000000 mm/min".into()),
        ("p.ngc", b"G2 X10 R1\n", "p.ngc:1: R: a radius of 1.0000 mm does not span 10.0000 mm; allowed: half the distance to the end, or more".into()),
        ("p.ngc", b"\xff\xfeG1 X1\n", "p.ngc:1: line: characters that are not UTF-8; allowed: ASCII letters, digits and signs, in lines that end in LF, CR or CR LF".into()),
        ("p.txt", b"PD1,1;", format!("p.txt: file: unknown extension .txt; allowed: {KNOWN}")),
    ];
    for (name, text, refusal) in cases {
        let bench = Bench::with(name, text);
        bench.refuse(&["run", name], &refusal);
        bench.refuse(&["table", name, "--out", "t/t.csv"], &refusal);
        bench.refuse(&["run", name, "--out", "new/deep"], &refusal);
    }
}

#[test]
fn files_that_are_none_are_refused() {
    let bench = Bench::with("folder.ngc/x", "");
    bench.refuse(
        &["run", "none.hpgl"],
        "none.hpgl: file: cannot be read: No such file or directory (os error 2); allowed: a readable file",
    );
    bench.refuse(
        &["table", "folder.ngc"],
        "folder.ngc: file: not a regular file; allowed: a readable file",
    );
    bench.refuse(
        &["run", "plain"],
        &format!("plain: file: no extension; allowed: {KNOWN}"),
    );
}

#[test]
fn a_circuit_that_does_not_take_the_input_is_refused_by_its_option() {
    let bench = Bench::with("l.hpgl", LINE);
    bench.write("p.ngc", "G1 X1\n");
    bench.write("log.csv", "t,x\n0,0\n1,1\n");
    for circuit in [
        "pulse_interpolator",
        "linear_interpolator",
        "arc_generator",
        "trajectory_controller",
        "machine",
    ] {
        bench.refuse(
            &["run", "log.csv", "--set", &format!("circuit={circuit}")],
            &format!(
                "--set: circuit: {circuit} does not take log.csv, a position log; allowed: \
                 lead_angle"
            ),
        );
    }
    for name in ["l.hpgl", "p.ngc"] {
        bench.refuse(
            &["run", name, "--set", "circuit=lead_angle"],
            &format!(
                "--set: circuit: lead_angle does not take {name}, a drawing or part program; \
                 allowed: another circuit, or a position log as .csv"
            ),
        );
    }
}

#[test]
fn an_input_of_a_scenario_that_its_circuit_does_not_take_is_refused_by_its_name() {
    let bench = Bench::with("l.hpgl", LINE);
    bench.write("log.csv", "t,x\n0,0\n1,1\n");
    bench.refuse(
        &["run", "waves/bracket.toml", "--set", "input=log.csv"],
        &format!(
            "log.csv: file: is a position log, which pulse_interpolator does not take; allowed: \
             {DRAWINGS}"
        ),
    );
    bench.refuse(
        &["run", "waves/turntable.toml", "--set", "input=l.hpgl"],
        "l.hpgl: file: is a drawing or part program, which lead_angle does not take; allowed: a \
         position log as .csv",
    );
}

#[test]
fn a_default_that_does_not_suit_is_named_with_the_option_that_gives_it() {
    let bench = Bench::with("p.ngc", "G1 X1\n");
    let slow = ["run", "p.ngc", "--set", "circuit=linear_interpolator"];
    bench.refuse(
        &[&slow[..], &["--set", "clock_hz=100000"]].concat(),
        "--set: rated_speed_rev_per_min (default): is 3000 for x; allowed: 0.001 to 1500",
    );
}

#[test]
fn a_position_that_does_not_fit_the_counters_is_refused() {
    // So fast that the second move is over within a unit time.
    let bench = Bench::with("p.ngc", "G1 X0.001 F10000000\nG1 X10\n");
    let sets = ["steps_per_mm=[1e9]", "acceleration_mm_per_s2=1e9"];
    let sets = sets.iter().flat_map(|set| ["--set", set]);
    let arguments: Vec<_> = ["run", "p.ngc"].into_iter().chain(sets).collect();
    bench.refuse(
        &arguments,
        "p.ngc:2: X: is 10000000000 steps at [1000000000.0] steps/mm; allowed: -2147483648 to \
         2147483647 steps",
    );
}

#[test]
fn a_path_that_takes_too_long_is_refused() {
    let bench = Bench::with("p.ngc", "G1 X10\n");
    let slow = [
        "--set",
        "feed_mm_per_min=0.001",
        "--set",
        "clock_hz=10000000000",
    ];
    bench.refuse(
        &[&["run", "p.ngc"], &slow[..]].concat(),
        "p.ngc: path: the path takes 6000000000001 unit times; allowed: 33554432: fewer moves, a \
         higher feed or longer unit times",
    );
}

#[test]
fn a_run_of_more_ticks_than_can_be_counted_is_refused() {
    let bench = Bench::with("log.csv", "t_ms,x\n0,0\n1e30,10\n");
    bench.refuse(
        &["run", "log.csv", "--no-vcd"],
        "log.csv:3: t_ms: is 1000000000000000000000000000 s after the first; allowed: less than \
         18446744073710 s, 2^64 ticks of 1000000 Hz",
    );
    // Some 600 ways of 2 * 10^9 counts, each at a count per scan of 2^24 ticks.
    let zigzag = "G1 X1000000\nG1 X-1000000\n".repeat(300);
    bench.write("z.ngc", zigzag);
    let slow = [
        "circuit=linear_interpolator",
        "clock_hz=10_000_000_000",
        "scan_ticks=16777215",
        "counts_per_mm=[1000,1000]",
        "feed_mm_per_min=36",
        "acceleration_ms=2",
        "deceleration_ms=2",
    ];
    let slow: Vec<_> = slow.iter().flat_map(|set| ["--set", set]).collect();
    bench.refuse(
        &[&["run", "z.ngc", "--no-vcd"], &slow[..]].concat(),
        "--set: clock_hz: is 10000000000: the run takes 2^64 ticks or more; allowed: a run of fewer \
         ticks: a slower clock, or faster motions",
    );
}

#[test]
fn a_path_of_more_periods_than_its_records_can_hold_is_refused() {
    let bench = Bench::with("p.ngc", "G1 X100000 F0.001\n");
    let run = ["run", "p.ngc", "--no-vcd", "--set"];
    bench.refuse(
        &[&run[..], &["circuit=trajectory_controller"]].concat(),
        "--set: period_ms (default): the path takes 6000000000000 periods of 1 ms; allowed: \
         4294967296: a faster or shorter path, or longer periods",
    );
}

#[test]
fn windows_and_scopes_that_are_none_are_refused() {
    let bench = Bench::with("p.hpgl", LINE);
    let refuse = |arguments: &[&str], text: &str| {
        bench.refuse(&[&["run", "p.hpgl"], &SHORT[..], arguments].concat(), text);
    };
    for (from, to) in [("5", "5"), ("5", "4"), ("0", "0")] {
        let text = format!("--from, --to: no tick from {from} to {to}; allowed: --from below --to");
        refuse(&["--from", from, "--to", to], &text);
    }
    let end = "18446744073709551615";
    let text = format!("--from, --to: no tick from {end} to {end}; allowed: --from below --to");
    refuse(&["--from", end], &text);
    let last = "18446744073709551614";
    let done = bench.run(&[&["run", "p.hpgl", "--from", last], &SHORT[..]].concat());
    let text = format!("error: --from: is {last}; allowed: 0 to ");
    assert!(done.stderr.starts_with(&text), "{}", done.stderr);
    assert_eq!((done.code, bench.names()), (2, vec!["p.hpgl".to_owned()]));
    for scope in ["nope", "", "pulse_interpolator.z", "pulse_interpolator.x."] {
        let named = if scope.is_empty() { "\"\"" } else { scope };
        let text = format!("--only: there is no {named}; allowed: a signal, or a scope: {SCOPES}");
        refuse(&["--only", scope], &text);
    }
    let wanted = ["--only", "pulse_interpolator.x", "--only", "nope"];
    let text = format!("--only: there is no nope; allowed: a signal, or a scope: {SCOPES}");
    refuse(&wanted, &text);
}

#[test]
fn a_clock_whose_last_tick_has_no_time_is_refused() {
    let bench = Bench::with("p.ngc", "G1 X10\n");
    // A third of a second is 333333333333334 fs, of which 2^64 fs hold 55340. The 10 mm take
    // 60000 s, or 60 unit times, and a little more to gather speed.
    let slow = [
        "--set",
        "clock_hz=3",
        "--set",
        "line_unit_ticks=3000",
        "--set",
        "feed_mm_per_min=0.01",
        "--set",
        "steps_per_mm=[80]",
    ];
    let run = [&["run", "p.ngc"], &slow[..]].concat();
    bench.refuse(
        &run,
        "--set: clock_hz: is 3: tick 183000 is 2^64 fs or more after tick 0; allowed: a clock \
         whose period is not rounded to 1 fs, an earlier --to, or --no-vcd",
    );
    bench.succeed(&[&run[..], &["--no-vcd"]].concat());
    bench.succeed(&[&run[..], &["--to", "55000"]].concat());
}

#[test]
fn arguments_that_exclude_each_other_or_are_no_numbers_exit_with_2() {
    let bench = Bench::with("p.hpgl", LINE);
    for arguments in [
        &["run", "p.hpgl", "--no-vcd", "--from", "3"][..],
        &["run", "p.hpgl", "--no-vcd", "--to", "3"],
        &["run", "p.hpgl", "--no-vcd", "--only", "x"],
        &["run", "p.hpgl", "--from", "-1"],
        &["run", "p.hpgl", "--to", "18446744073709551616"],
        &["run", "p.hpgl", "other.hpgl"],
        &["run", "p.hpgl", "--set"],
        &["run", "p.hpgl", "--fast"],
        &["walk"],
    ] {
        let done = bench.run(arguments);
        assert_eq!((done.code, done.stdout.as_str()), (2, ""), "{arguments:?}");
        assert!(done.stderr.starts_with("error: "), "{}", done.stderr);
        assert_eq!(bench.names(), ["p.hpgl"], "{arguments:?}");
    }
    let done = bench.run(&["run", "p.hpgl", "--no-vcd", "--from", "3"]);
    let first = "error: --from, --to: given with --no-vcd; allowed: with waves or --series\n";
    assert!(done.stderr.starts_with(first), "{}", done.stderr);
}
