//! Scenarios of the lead-angle compensator: what is refused, with its line.

use super::support::Bench;

const STEPS: &str = "[[step]]\ntarget = 9000\nspeed_counts_per_s = 20000\n\
                     [[step]]\ntarget = 0\nspeed_counts_per_s = 40000\nlead_ms = 39.9\n";

/// The standard error of a run that must be refused.
fn refusal(bench: &Bench, arguments: &[&str]) -> String {
    let done = bench.run(&[&["run"], arguments].concat());
    assert_eq!((done.code, done.stdout.as_str()), (2, ""));
    done.stderr
}

/// The same of a scenario with these keys before its steps.
fn refused(keys: &str) -> String {
    let good = STEPS.replace("39.9", "40");
    let bench = Bench::with("s.toml", format!("circuit = \"lead_angle\"\n{keys}{good}"));
    bench.write("slow.csv", "ms, a, b\n0, 0, 0\n5, 100, 1\n");
    bench.write("fast.csv", "0,0\n0.001,2\n");
    refusal(&bench, &["s.toml"])
}

#[test]
fn settings_are_checked_and_named_with_their_line() {
    let bench = Bench::with("s.toml", format!("circuit = \"lead_angle\"\n{STEPS}"));
    assert_eq!(
        refusal(&bench, &["s.toml"]),
        "error: s.toml:8: step 1: lead_ms: is 39.9; allowed: 39.8 or 40\n"
    );
    assert_eq!(
        refused("rest_ms = 0\n"),
        "error: s.toml:2: rest_ms: is 0; allowed: 0.1 to 6553.5\n"
    );
    assert_eq!(
        refused("vcd_ticks = 0\n"),
        "error: s.toml:2: vcd_ticks: is 0; allowed: 1 to 9223372036854775807; --no-vcd for none\n"
    );
    assert_eq!(
        refused("brake_torque_nm = -1\n"),
        "error: s.toml:2: brake_torque_nm: is -1; allowed: 0.000000001 to 1000000000\n"
    );
}

#[test]
fn a_log_is_read_and_checked() {
    assert_eq!(
        refused("log_column = \"a\"\n"),
        "error: s.toml:2: log_column: is a; allowed: it with an input, a position log in CSV, \
         only\n"
    );
    assert_eq!(
        refused("input = \"slow.csv\"\nlog_time_unit_ms = 0\n"),
        "error: s.toml:3: log_time_unit_ms: is 0; allowed: 0.000000001 to 10000000\n"
    );
    assert_eq!(
        refused("input = \"slow.csv\"\nlog_column = \"c\"\n"),
        "error: slow.csv:1: c: no such column; allowed: ms, a, b\n"
    );
    assert_eq!(
        refused("input = \"fast.csv\"\n"),
        "error: fast.csv:2: counts: 2000000 counts/s since the sample before; allowed: up to \
         1000000, one count per tick\n"
    );
    assert_eq!(
        refused("input = \"none.csv\"\n"),
        "error: none.csv: file: cannot be read: No such file or directory (os error 2); allowed: \
         a readable file\n"
    );
}

#[test]
fn it_needs_no_drawing_and_has_no_table() {
    let message = "circuit: the lead-angle compensator cannot be run yet; allowed: \
                   pulse_interpolator or linear_interpolator\n";
    assert_eq!(refused(""), format!("error: s.toml:1: {message}"));
    let log = "input = \"slow.csv\"\nlog_column = \"b\"\n";
    assert_eq!(refused(log), format!("error: s.toml:1: {message}"));
    let bench = Bench::new();
    let shipped = refusal(&bench, &["waves/turntable.toml"]);
    assert_eq!(shipped, format!("error: waves/turntable.toml:2: {message}"));
    let done = bench.run(&["table", "waves/turntable.toml"]);
    assert_eq!(
        done.stderr,
        "error: waves/turntable.toml:2: circuit: the lead-angle compensator has no table; \
         allowed: pulse_interpolator, or the command run\n"
    );
}
