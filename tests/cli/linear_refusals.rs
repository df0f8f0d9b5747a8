//! What the linear interpolator refuses, and what is left behind: nothing.

use super::linear::{LINEAR, run};
use super::support::{Bench, LINE};

/// What stands behind the nearest key.
const KEYS: &str = "`motion-rtl keys linear_interpolator` lists all";

#[test]
fn the_table_is_refused() {
    let bench = Bench::with("l.hpgl", LINE);
    const PROBLEM: &str = "circuit: the linear interpolator has no table; allowed: pulse_interpolator, or the \
         command run";
    let arguments = [&["table", "l.hpgl", "--out", "t/t.csv"], &LINEAR[..]].concat();
    bench.refuse(&arguments, &format!("--set: {PROBLEM}"));
    let scenario = "# one\ncircuit = \"linear_interpolator\"\ninput = \"l.hpgl\"\n";
    bench.write("s.toml", scenario);
    bench.refuse(&["table", "s.toml"], &format!("s.toml:2: {PROBLEM}"));
    bench.refuse(
        &["table", "waves/plotter.toml"],
        &format!("waves/plotter.toml:3: {PROBLEM}"),
    );
}

#[test]
fn segments_are_of_this_circuit_alone() {
    let bench = Bench::with("l.hpgl", LINE);
    bench.refuse(
        &["run", "l.hpgl", "--segments"],
        "--segments: the pulse interpolator has no segments; allowed: a scenario of another \
         circuit",
    );
}

#[test]
fn bad_overrides_are_refused() {
    const PAIR: &str = "allowed: a list of two numbers, of X and of Y";
    let cases = [
        ("feed=1", format!("feed: unknown key; did you mean feed_mm_per_min?; allowed: {KEYS}")),
        ("steps_per_mm=[80,80]", format!("steps_per_mm: is not a key of linear_interpolator, but of pulse_interpolator and machine; allowed: {KEYS}")),
        ("variant=safe", "variant: unknown variant `safe`; allowed: one of `floor`, `truncating`, `centred`".into()),
        ("master=z", "master: unknown variant `z`; allowed: one of `longer`, `x`, `y`".into()),
        ("short_moves=slow", "short_moves: unknown variant `slow`; allowed: `constant_acceleration` or `constant_time`".into()),
        ("exact_stop=1", "exact_stop: invalid type: integer `1`; allowed: true or false".into()),
        ("scan_ticks=1.5", "scan_ticks: invalid type: floating point `1.5`; allowed: a whole number from 186 to 16777215".into()),
        ("counts_per_mm=80", format!("counts_per_mm: invalid type: integer `80`; {PAIR}")),
        ("counts_per_mm=[80]", format!("counts_per_mm: invalid length 1; {PAIR}")),
        ("counts_per_mm=[1,2,3]", format!("counts_per_mm: invalid length 3; {PAIR}")),
        ("clock_hz=0", "clock_hz: is 0; allowed: 1 to 10000000000".into()),
        ("scan_ticks=185", "scan_ticks: is 185; allowed: 186 to 16777215".into()),
        ("counts_per_mm=[80,-80]", "counts_per_mm: is -80 for y; allowed: 0.000001 to 1000000000".into()),
        ("counts_per_mm=[nan,80]", "counts_per_mm: is NaN for x; allowed: 0.000001 to 1000000000".into()),
        ("feed_mm_per_min=300001", "feed_mm_per_min: is 300001; allowed: 0.001 to 300000".into()),
        ("rapid_mm_per_min=0", "rapid_mm_per_min: is 0; allowed: 0.001 to 300000".into()),
        ("acceleration_ms=4096", "acceleration_ms: is 4096; allowed: 0 to 4095".into()),
        ("deceleration_ms=-1", "deceleration_ms: is -1; allowed: 0 to 4095".into()),
        ("chord_tolerance_mm=0", "chord_tolerance_mm: is 0; allowed: 0.000001 to 1000".into()),
        ("in_position_counts=0", "in_position_counts: is 0; allowed: 1 to 1000000".into()),
        ("position_gain_per_s=[40,1001]", "position_gain_per_s: is 1001 for y; allowed: 0.001 to 1000".into()),
        ("counts_per_rev=[1,4000]", "counts_per_rev: is 1 for x; allowed: 4 to 100000000".into()),
        ("rated_speed_rev_per_min=[15001,1]", "rated_speed_rev_per_min: is 15001 for x; allowed: 0.001 to 15000".into()),
        ("velocity_loop_ms=[2,0]", "velocity_loop_ms: is 0 for y; allowed: 0.001 to 10000".into()),
        ("inertia_kg_m2=[0,1]", "inertia_kg_m2: is 0 for x; allowed: 0.000000001 to 1000".into()),
        ("max_torque_nm=[1,inf]", "max_torque_nm: is inf for y; allowed: 0.000001 to 1000000".into()),
        ("friction_nm=[0,0.9]", "friction_nm: is 0.9 for y; allowed: 0 to below max_torque_nm, 0.9".into()),
        ("vcd_ticks=0", "vcd_ticks: is 0; allowed: 1 to 9223372036854775807; --no-vcd for none".into()),
        ("input=other.ngc", "input: line.hpgl is the input; allowed: input with a scenario only".into()),
    ];
    let bench = Bench::with("line.hpgl", LINE);
    for (set, refusal) in cases {
        bench.refuse(
            &run("line.hpgl", &["--set", set]),
            &format!("--set: {refusal}"),
        );
    }
}

#[test]
fn bad_scenarios_are_refused_with_their_line() {
    let cases = [
        (
            "",
            "s.toml: input: missing; allowed: the path of an HPGL drawing or a G-code program"
                .into(),
        ),
        (
            "scan_ticks = 100",
            "s.toml:2: scan_ticks: is 100; allowed: 186 to 16777215".into(),
        ),
        (
            "# gains\nposition_gain_per_s = [1, 0]",
            "s.toml:3: position_gain_per_s: is 0 for y; allowed: 0.001 to 1000".into(),
        ),
        (
            "line_unit_ticks = 100",
            format!(
                "s.toml:2: line_unit_ticks: is not a key of linear_interpolator, but of pulse_interpolator; allowed: {KEYS}"
            ),
        ),
        (
            "friction_nm = [\n  0.1,\n  \"a\",\n]",
            "s.toml:4: friction_nm: invalid type: string \"a\"; allowed: a number from 0 to 1000000".into(),
        ),
    ];
    let bench = Bench::with("l.hpgl", LINE);
    for (text, refusal) in cases {
        let input = if text.is_empty() {
            ""
        } else {
            "input = \"l.hpgl\"\n"
        };
        let head = "circuit = \"linear_interpolator\"\n";
        bench.write("s.toml", format!("{head}{text}\n{input}"));
        bench.refuse(&["run", "s.toml"], &refusal);
    }
    // The keys of one circuit are not those of the other.
    let done = bench.run(&[&["run", "waves/bracket.toml"], &LINEAR[..]].concat());
    assert_eq!(done.code, 2);
    let start = "error: waves/bracket.toml:";
    assert!(done.stderr.starts_with(start), "{}", done.stderr);
}

#[test]
fn drawings_that_cannot_be_played_are_refused() {
    let cases = [
        (
            "G1 X1 F1000\nG1 X2 F300001\n",
            &[][..],
            "p.ngc:2: F: is 300001 mm/min; allowed: up to 18000 mm/min: 100 % speed (full_speed_mm_per_min)",
        ),
        (
            "G1 X1 F1000\nG1 X2 F7.3\n",
            &[][..],
            "p.ngc:2: F: at 7.3 mm/min the master axis goes too few counts in a \
             scan; allowed: at least 7.32422 mm/min on this way, or a longer scan (scan_ticks)",
        ),
        (
            "G1 X1 F1000\nG1 Y-1000000\n",
            &["--set", "counts_per_mm=[100, 2000]"],
            "p.ngc:2: y: is -2000000000 counts at [100.0, 2000.0] counts/mm; allowed: \
             -1073741824 to 1073741824 counts",
        ),
        (
            "G1 X1 F1000\nG2 X1 I300000\n",
            &[
                "--set",
                "chord_tolerance_mm=0.000001",
                "--set",
                "counts_per_mm=[900, 900]",
            ],
            "p.ngc:2: path: more than 1048576 cycles up to here; allowed: fewer moves, or a \
             larger chord_tolerance_mm",
        ),
    ];
    for (text, sets, refusal) in cases {
        let bench = Bench::with("p.ngc", text);
        bench.refuse(&run("p.ngc", sets), refusal);
        bench.refuse(
            &run("p.ngc", &[sets, &["--out", "new/deep"]].concat()),
            refusal,
        );
    }
}

#[test]
fn files_that_cannot_be_written_leave_nothing() {
    const WRITABLE: &str = "allowed: a directory that can be written";
    let bench = Bench::with("l.hpgl", LINE);
    let text = format!("--out: l.hpgl: File exists (os error 17); {WRITABLE}");
    bench.refuse(&run("l.hpgl", &["--out", "l.hpgl"]), &text);
    bench.write("o/l.svg/inside", "");
    let text = format!("--out: o/l.svg: is a directory; {WRITABLE}");
    bench.refuse(&run("l.hpgl", &["--out", "o"]), &text);
}
