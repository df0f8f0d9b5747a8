//! Comparisons: played where they are asked for, left out without a trace where not.

use super::support::{Bench, LINE, SHORT, keys, list};
use serde_json::{Value, json};

const ARC: &str = "\
circuit = \"arc_generator\"
feed_mm_per_min = 1200
clock_hz = 10_000
sample_period_ms = 10
acceleration_ms = 100
[[piece]]
via_mm = [5, 5, 0]
to_mm = [10, 0, 0]
";

const PATH: &str = "\
circuit = \"trajectory_controller\"
feed_mm_per_min = 6000
contour_tolerance_mm = 0.05
[[piece]]
via_mm = [5, 5, 0]
to_mm = [10, 0, 0]
";

const STEPS: &str = "\
circuit = \"lead_angle\"
clock_hz = 200_000
ck_ticks = 20
positionings = 2
[[step]]
target = 3000
speed_counts_per_s = 20000
lead_ms = 15
[[step]]
target = 0
speed_counts_per_s = 40000
lead_ms = 15
";

/// The arguments of a short run of each circuit that is compared with something, the summary's key
/// with the rows of all systems, and how many these are without a comparison and with it.
pub fn runs() -> Vec<(Vec<&'static str>, &'static str, [usize; 2])> {
    let pulse = [&["l.hpgl"], &SHORT[..]].concat();
    let linear = [
        "l.hpgl",
        "--set",
        "circuit=linear_interpolator",
        "--set",
        "clock_hz=200000",
        "--set",
        "scan_ticks=200",
    ];
    vec![
        (pulse, "circuits", [1, 2]),
        (linear.to_vec(), "", [0, 0]),
        (vec!["steps.toml"], "systems", [1, 10]),
        (vec!["arc.toml"], "circuits", [1, 2]),
        (vec!["path.toml"], "corrections", [1, 5]),
    ]
}

pub fn bench() -> Bench {
    let bench = Bench::with("l.hpgl", LINE);
    bench.write("arc.toml", ARC);
    bench.write("path.toml", PATH);
    bench.write("steps.toml", STEPS);
    bench
}

/// The summary without the files, and the picture.
fn run(bench: &Bench, arguments: &[&str], more: &[&str]) -> (Value, String) {
    let arguments = [&["run"], arguments, &["--no-vcd", "--out", "o"], more].concat();
    let mut summary = bench.json(&arguments);
    let file = summary["files"][0]["path"].as_str().unwrap().to_owned();
    summary["files"] = json!([]);
    (summary, bench.read(&file))
}

#[test]
fn comparisons_are_played_where_they_are_asked_for_only() {
    let bench = bench();
    for (arguments, rows, [alone, compared]) in runs() {
        let (without, picture) = run(&bench, &arguments, &[]);
        let (with, with_picture) = run(&bench, &arguments, &["--beside"]);
        let set = run(&bench, &arguments, &["--set", "beside=true"]);
        assert_eq!((&with, &with_picture), (&set.0, &set.1), "{arguments:?}");
        let not = run(&bench, &arguments, &["--set", "beside=false"]);
        assert_eq!((&without, &picture), (&not.0, &not.1), "{arguments:?}");
        if !rows.is_empty() {
            let found = [&without, &with].map(|summary| list(summary, rows).len());
            assert_eq!(found, [alone, compared], "{arguments:?}");
        }
        // Its own figures are the same, and nothing stands for what did not run.
        for key in ["ticks", "seconds", "complaints", "exact", "clock_hz"] {
            assert_eq!(without[key], with[key], "{arguments:?}: {key}");
        }
        let nulls = |text: &str| text.matches("null").count();
        assert!(nulls(&without.to_string()) <= nulls(&with.to_string()));
        assert!(!picture.contains("NaN"), "{arguments:?}");
        assert!(!picture.contains("conventional"), "{arguments:?}");
        let text = [&["run"], &arguments[..], &["--no-vcd", "--out", "o"]].concat();
        let [without, with] = [&[][..], &["--beside"]].map(|more| {
            let text = bench.succeed(&[&text[..], more].concat());
            assert!(!text.contains("\n\n\n"), "{text}");
            text
        });
        assert!(!without.contains("conventional"), "{without}");
        assert!(with.len() > without.len(), "{with}");
    }
}

#[test]
fn the_circuits_own_rows_are_the_same_in_both() {
    let bench = bench();
    let own = |arguments: &[&str], key: &str, place: usize| {
        let (without, _) = run(&bench, arguments, &[]);
        let (with, _) = run(&bench, arguments, &["--beside"]);
        let mut compared = list(&with, key)[place].clone();
        let alone = list(&without, key)[0].clone();
        if let Some(row) = compared.as_object_mut() {
            // It is searched for, which takes many runs.
            row.remove("unit_ticks_least");
        }
        assert_eq!(alone, compared, "{arguments:?}");
        without
    };
    own(&runs()[0].0, "circuits", 0);
    own(&["steps.toml"], "systems", 6);
    own(&["arc.toml"], "circuits", 0);
    own(&["arc.toml"], "speed_changes", 0);
    let path = own(&["path.toml"], "corrections", 3);
    // A segment has an error by each correction that was played.
    assert_eq!(list(&path["segments"][0], "contour_um").len(), 1);
    let steps = own(&["steps.toml", "--set", "lead=speed"], "systems", 2);
    // No time is learned, and none is shown.
    assert!(!keys(&steps).contains(&"lead_times_of"));
    assert!(!keys(&steps["positionings"][0]).contains(&"lead_ms"));
    assert!(!keys(&steps["phases"][0]["steps"][0]).contains(&"settled_after"));
    let fixed = own(&["steps.toml", "--set", "learn=false"], "systems", 5);
    assert_eq!(fixed["lead_times_of"], "fixed lead");
}

#[test]
fn the_linear_interpolators_rows_have_only_what_was_played() {
    let bench = bench();
    let linear = &runs()[1].0;
    let (without, _) = run(&bench, linear, &[]);
    let (with, _) = run(&bench, linear, &["--beside"]);
    let only = |of: &Value| {
        let all = keys(of).into_iter().map(str::to_owned);
        all.collect::<Vec<_>>()
    };
    let missing = |a: &Value, b: &Value| {
        let had = only(a);
        let lost = only(b).into_iter().filter(|key| !had.contains(key));
        lost.collect::<Vec<_>>()
    };
    assert_eq!(
        missing(&without, &with),
        [
            "conventional",
            "conventional_in_proportion",
            "interpolator_other_master",
            "other_master"
        ]
    );
    let [short, full] = [&without, &with].map(|summary| &list(summary, "segments")[0]);
    assert_eq!(
        missing(short, full),
        ["conventional", "conventional_in_proportion", "other_master"]
    );
    assert_eq!(short["interpolator"], full["interpolator"]);
    assert_eq!(without["interpolator"], with["interpolator"]);
}

#[test]
fn what_is_compared_with_nothing_refuses_the_key() {
    let bench = bench();
    let refused = "--set: beside: given beside [[pattern]]; \
                   allowed: a drawing, which the conventional device plays too";
    bench.refuse(&["run", "waves/patterns.toml", "--beside"], refused);
    bench.refuse_with(&["run", "--beside"], |stderr| {
        let text = "error: --set: beside: is not a key of machine, but of ";
        assert!(stderr.starts_with(text), "{stderr}");
    });
}
