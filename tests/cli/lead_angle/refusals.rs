//! What is refused, and how.

use super::*;

/// The first line of the standard error of a run that must be refused.
pub(super) fn refusal(bench: &Bench, arguments: &[&str]) -> String {
    let before = bench.names();
    let done = bench.run(&[&["run"], arguments].concat());
    assert_eq!((done.code, done.stdout.as_str()), (2, ""));
    assert_eq!(bench.names(), before);
    done.stderr.split_inclusive('\n').take(1).collect()
}

/// The same of a scenario with these keys before its steps.
pub(super) fn refused(keys: &str) -> String {
    let good = STEPS.replace("39.9", "40");
    let bench = Bench::with("s.toml", format!("circuit = \"lead_angle\"\n{keys}{good}"));
    bench.write("slow.csv", "ms, a, b\n0, 0, 0\n5, 100, 1\n");
    bench.write("fast.csv", "ms,c\n0,0\n0.001,2\n");
    bench.write("word.csv", "time,counts\n0,0\n\n5,many\n");
    bench.write("back.csv", "0,0\n5,1\n4,2\n");
    bench.write("short.csv", "time,counts\n0,0\n5\n");
    bench.write("high.csv", "0,-5000000\n5,-5000001\n");
    bench.write("long.csv", "0,0\n9000,2097152\n18000,2097153\n");
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
        "error: s.toml:2: brake_torque_nm: is -1; allowed: 0.000000001 to 2147483\n"
    );
    assert_eq!(
        refused("load_change_after = 25\n"),
        "error: s.toml:2: load_change_after: is 25; allowed: 1 to 24\n"
    );
    assert_eq!(
        refused("sign = \"both\"\n"),
        "error: s.toml:2: sign: unknown variant `both`; allowed: `converging` or `literal`\n"
    );
    assert_eq!(
        refused("lead = \"way\"\n"),
        "error: s.toml:2: lead: unknown variant `way`; allowed: one of `time`, `speed`, `table`\n"
    );
    assert_eq!(
        refused("lead = \"table\"\ninput = \"slow.csv\"\n"),
        "error: s.toml:2: lead: is table; allowed: time or speed with a log, of whose body no stop is \
         known\n"
    );
    assert_eq!(
        refused("action = \"cam\"\n"),
        "error: s.toml:2: action: unknown variant `cam`; allowed: `stop` or `operate`\n"
    );
    assert_eq!(
        refused("action = \"operate\"\ncompletion = \"fixed_time\"\n"),
        "error: s.toml:3: completion: is fixed_time; allowed: standstill with action = \"operate\": \
         its effect is what it waits for\n"
    );
    assert_eq!(
        refused("operation_delay_s = 11\n"),
        "error: s.toml:2: operation_delay_s: is 11; allowed: 0 to 10\n"
    );
    assert_eq!(
        refused("load_delay_factor = 0\n"),
        "error: s.toml:2: load_delay_factor: is 0; allowed: 0.001 to 1000\n"
    );
    assert_eq!(
        refused("targets = \"turn\"\n"),
        "error: s.toml:2: targets: unknown variant `turn`; allowed: `absolute` or `relative`\n"
    );
    assert_eq!(
        refused("targets = \"relative\"\n"),
        "error: s.toml:7: step 1: target: is 0; allowed: a way other than 0\n"
    );
    assert_eq!(
        refused("switch_counts = 9000\n"),
        "error: s.toml:2: switch_counts: is 9000; allowed: 0 to 8999\n"
    );
    assert_eq!(
        refused("function = \"quadratic\"\n"),
        "error: s.toml:2: function: unknown variant `quadratic`; allowed: one of `first_order`, \
         `second_order`, `exact`\n"
    );
    let bench = small();
    let one = "step=[{target=9000,speed_counts_per_s=20000}]";
    assert_eq!(
        refusal(&bench, &["s.toml", "--set", one]),
        "error: --set: step: 1 table is given; allowed: 2 to 16 tables [[step]], or targets = \"relative\", or \
         positionings = 1\n"
    );
    let set = ["s.toml", "--set", "common_time=true"];
    assert_eq!(
        refusal(&bench, &set),
        "error: s.toml:14: step 1: lead_ms: is 15; allowed: 0: with common_time all steps take \
         that of step 0\n"
    );
}

#[test]
fn it_has_no_table() {
    let bench = Bench::new();
    let done = bench.run(&["table", "waves/turntable.toml"]);
    assert_eq!(
        done.stderr,
        "error: waves/turntable.toml:2: circuit: the lead-angle compensator has no table; \
         allowed: pulse_interpolator, or the command run\n  |\n2 | circuit = \"lead_angle\"\n  \
         |           ^^^^^^^^^^^^\n"
    );
}
