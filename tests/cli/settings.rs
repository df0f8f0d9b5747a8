//! `--set`: types, strings without quotes, and what is refused.

use super::support::{Bench, LINE, whole};

/// The report of `table` on the line with these overrides.
fn table(sets: &[&str]) -> serde_json::Value {
    let bench = Bench::with("line.hpgl", LINE);
    let sets = sets.iter().flat_map(|set| ["--set", set]);
    let arguments: Vec<_> = ["table", "line.hpgl"].into_iter().chain(sets).collect();
    bench.json(&arguments)
}

#[test]
fn whole_numbers_fractions_lists_and_strings_are_taken() {
    assert_eq!(whole(&table(&["clock_hz=50_000"]), "/clock_hz"), 50_000);
    let steps = |sets: &[&str]| whole(&table(sets), "/axes/0/steps_demanded");
    assert_eq!(steps(&[]), 800);
    assert_eq!(steps(&["steps_per_mm=[12.5]"]), 125);
    assert_eq!(steps(&[" steps_per_mm = [ -1, 2 ] "]), -10);
    let ticks = |sets: &[&str]| whole(&table(sets), "/total_ticks");
    assert!(ticks(&["feed_mm_per_min=600"]) > ticks(&["feed_mm_per_min=1200.5"]));
    for variant in [
        "variant=literal",
        "variant=\"literal\"",
        "variant='literal'",
    ] {
        table(&[variant]);
    }
}

#[test]
fn the_last_of_two_overrides_counts() {
    let sets = ["clock_hz=50000", "variant=safe", "clock_hz=200000"];
    assert_eq!(whole(&table(&sets), "/clock_hz"), 200_000);
    let bench = Bench::with("line.hpgl", LINE);
    bench.refuse(
        &[
            "table",
            "line.hpgl",
            "--set",
            "clock_hz=1000",
            "--set",
            "clock_hz=0",
        ],
        "--set: clock_hz: is 0; allowed: 1 to 10000000000",
    );
    bench.refuse(
        &[
            "table",
            "line.hpgl",
            "--set",
            "clock_hz=fast",
            "--set",
            "clock_hz=1000",
        ],
        "--set: clock_hz: invalid type: string \"fast\"; allowed: a whole number from 1 to 10000000000",
    );
}

#[test]
fn bad_overrides_are_refused() {
    const WHOLE: &str = "allowed: a whole number from 1 to 10000000000";
    const KEYS: &str = "`motion-rtl keys pulse_interpolator` lists all";
    const KEY_VALUE: &str = "allowed: key=value with a key of the scenario";
    const STEPS: &str = "allowed: 0.000001 to 1000000000, or the negative of that";
    let range = |text: &str| format!("is {text}");
    let cases = [
        ("clock_hz", format!("clock_hz: no '='; {KEY_VALUE}")),
        ("", format!("\"\": no '='; {KEY_VALUE}")),
        ("clock_hz=18446744073709551616", format!("clock_hz: is 18446744073709551616: too large; {WHOLE}")),
        ("clock_hz=-9223372036854775809", format!("clock_hz: is -9223372036854775809: too small; {WHOLE}")),
        ("=3", format!("=3: no key; {KEY_VALUE}")),
        ("clock_mhz=1", format!("clock_mhz: unknown key; did you mean clock_hz?; allowed: {KEYS}")),
        ("a.b.c.d=1", format!("a: unknown key; allowed: {KEYS}")),
        ("clock_hz=", format!("clock_hz: invalid type: string \"\"; {WHOLE}")),
        ("clock_hz=true", format!("clock_hz: invalid type: boolean `true`; {WHOLE}")),
        ("clock_hz=1e6", format!("clock_hz: invalid type: floating point `1000000.0`; {WHOLE}")),
        ("clock_hz=-1", format!("clock_hz: is -1; {WHOLE}")),
        ("clock_hz=1\nvcd_ticks=9", format!("clock_hz: invalid type: string \"1\\nvcd_ticks=9\"; {WHOLE}")),
        ("line_unit_ticks=4294967296", "line_unit_ticks: is 4294967296; allowed: a whole number from 2 to 196605".into()),
        ("steps_per_mm=80", "steps_per_mm: invalid type: integer `80`; allowed: a list of numbers, one for each axis".into()),
        ("pattern=3", "pattern: invalid type: integer `3`; allowed: tables [[pattern]]".into()),
        ("play=ring", "play: invalid type: string \"ring\"; allowed: a list of names of patterns".into()),
        ("variant=wild", "variant: unknown variant `wild`; allowed: `safe` or `literal`".into()),
        ("circuit=cam", "circuit: unknown variant `cam`; allowed: one of `pulse_interpolator`, `linear_interpolator`, `lead_angle`, `arc_generator`, `trajectory_controller`, `machine`".into()),
        ("input=other.ngc", "input: line.hpgl is the input; allowed: input with a scenario only".into()),
        ("clock_hz=0", format!("clock_hz: {}; allowed: 1 to 10000000000", range("0"))),
        ("clock_hz=10000000001", format!("clock_hz: {}; allowed: 1 to 10000000000", range("10000000001"))),
        ("steps_per_mm=[]", "steps_per_mm: has 0 numbers; allowed: 1 to 3 numbers, one for each axis".into()),
        ("steps_per_mm=[1,1,1,1]", "steps_per_mm: has 4 numbers; allowed: 1 to 3 numbers, one for each axis".into()),
        ("steps_per_mm=[1,0]", format!("steps_per_mm: is 0 for y; {STEPS}")),
        ("steps_per_mm=[nan]", format!("steps_per_mm: is NaN for x; {STEPS}")),
        ("steps_per_mm=[1,inf]", format!("steps_per_mm: is inf for y; {STEPS}")),
        ("feed_mm_per_min=0", "feed_mm_per_min: is 0; allowed: 0.001 to 10000000".into()),
        ("feed_mm_per_min=-inf", "feed_mm_per_min: is -inf; allowed: 0.001 to 10000000".into()),
        ("rapid_mm_per_min=1e8", "rapid_mm_per_min: is 100000000; allowed: 0.001 to 10000000".into()),
        ("corner_mm_per_min=-1", "corner_mm_per_min: is -1; allowed: 0 to 10000000".into()),
        ("acceleration_mm_per_s2=nan", "acceleration_mm_per_s2: is NaN; allowed: 0.001 to 1000000000".into()),
        ("line_unit_ticks=1", "line_unit_ticks: is 1; allowed: 2 to 196605".into()),
        ("arc_unit_ticks=196606", "arc_unit_ticks: is 196606; allowed: 2 to 196605".into()),
        ("step_high_ticks=501", "step_high_ticks: is 501; allowed: 0 to 500".into()),
        ("step_low_ticks=999", "step_low_ticks: is 999; allowed: 0 to 998".into()),
        ("dir_setup_ticks=999", "dir_setup_ticks: is 999; allowed: 0 to 998".into()),
        ("dir_hold_ticks=1001", "dir_hold_ticks: is 1001; allowed: 0 to 1000".into()),
        ("vcd_ticks=0", "vcd_ticks: is 0; allowed: 1 to 9223372036854775807; --no-vcd for none".into()),
    ];
    let bench = Bench::with("line.hpgl", LINE);
    for (set, refusal) in cases {
        bench.refuse(
            &["run", "line.hpgl", "--set", set],
            &format!("--set: {refusal}"),
        );
    }
}
