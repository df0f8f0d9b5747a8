//! `run` of the linear interpolator with one master axis and with another.

use super::linear::run;
use super::support::{Bench, whole};
use expect_test::expect;
use serde_json::{Value, json};

#[test]
fn another_master_axis_runs_beside_and_makes_a_longer_slave_accelerate() {
    // 10 mm along X, 100 mm along Y.
    let bench = Bench::with("steep.hpgl", "PD400,4000;");
    let longer = bench.json(&run("steep.hpgl", &["--beside"]));
    assert_eq!(
        (&longer["settings"]["master"], &longer["other_master"]),
        (&json!("longer"), &json!("x"))
    );
    assert_eq!(longer["segments"][0]["master"], "y");
    let accelerations = |system: &Value| {
        let of = |axis: &str| {
            whole(
                system,
                &format!("/{axis}_acceleration_max_counts_per_scan2"),
            )
        };
        (of("master"), of("slave"))
    };
    let (master, slave) = accelerations(&longer["interpolator"]);
    assert!(slave <= master + 1 && master <= 3, "{master}, {slave}");
    let other = &longer["interpolator_other_master"];
    let (master, slave) = accelerations(other);
    // A count of X is ten of Y, and its speed changes by a count at times.
    assert!(master <= 2 && slave >= 10 * master, "{master}, {slave}");
    assert_eq!(other["end_position"], json!([2000, 20_000]));
    assert!(other["deviation_max_lsb"].as_f64().unwrap() < 1.0);

    let fixed = bench.json(&run("steep.hpgl", &["--beside", "--set", "master=x"]));
    assert_eq!(
        (&fixed["settings"]["master"], &fixed["other_master"]),
        (&json!("x"), &json!("longer"))
    );
    assert_eq!(fixed["segments"][0]["master"], "x");
    assert_eq!(&fixed["interpolator"], other);
    assert_eq!(fixed["interpolator_other_master"], longer["interpolator"]);
    for conventional in ["conventional", "conventional_in_proportion"] {
        assert_eq!(fixed[conventional], longer[conventional]);
    }
}

#[test]
fn a_line_too_steep_for_a_fixed_master_is_told_or_refused() {
    // 5 counts along X, 40,000 along Y.
    let bench = Bench::with("steep.hpgl", "PD1,8000;");
    let summary = bench.json(&run("steep.hpgl", &["--beside"]));
    assert_eq!(summary["interpolator_other_master"], Value::Null);
    assert_eq!(summary["segments"][0]["other_master"], Value::Null);
    expect![[r#"["steep.hpgl: not drawn with x as the master axis for comparison: line 1: feed 6000 mm/min: allowed are 58593.8 and more in this direction"]"#]].assert_eq(&summary["warnings"].to_string());
    let done = bench.run(&run("steep.hpgl", &["--set", "master=x"]));
    assert_eq!((done.code, done.stdout.as_str()), (2, ""));
    expect![[r#"
        error: steep.hpgl:1: feed_mm_per_min: at 6000 mm/min the master axis goes too few counts in a scan; allowed: at least 58593.8 mm/min on this way, or a longer scan (scan_ticks)
    "#]].assert_eq(&done.stderr);
    // Where X stands, Y leads.
    let bench = Bench::with("up.hpgl", "PD0,400;");
    let summary = bench.json(&run("up.hpgl", &["--set", "master=x"]));
    assert_eq!(summary["segments"][0]["master"], "y");
    assert_eq!(summary["exact"], true);
}
