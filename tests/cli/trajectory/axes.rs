//! What may differ between axes, and what acts on them: acceleration, gains, torques.

use super::*;

/// The time to the feed, and what the axes are allowed, are the acceleration along the path.
#[test]
#[ignore = "takes long"]
fn the_acceleration_is_told_in_other_ways() {
    let bench = with("[[piece]]\nto_mm = [8, 6, 0]\n");
    let run = ["run", "--beside", "s.toml", "--no-vcd", "--set"];
    for (set, acceleration) in [
        ("rapid_mm_per_min=18000", 2000.0),
        ("acceleration_time_ms=50", 1000.0),
        ("axis_acceleration_mm_per_s2=[800,900]", 1000.0),
        ("axis_acceleration_mm_per_s2=480", 600.0),
        ("axis_acceleration_mm_per_s2=[8e5,9e5]", 2000.0),
    ] {
        let summary = bench.json(&[&run[..], &[set]].concat());
        close(
            number(&summary, "/plan/acceleration_mm_per_s2"),
            acceleration,
            1e-6,
        );
        let seconds = 10.0 / 50.0 + 50.0 / acceleration;
        close(number(&summary, "/plan/seconds"), seconds, 1e-6);
    }
}

/// Models of different gains leave a line, and the vector has most of that.
#[test]
#[ignore = "takes long"]
fn each_axis_may_have_its_own_gains() {
    let bench = with("[[piece]]\nto_mm = [24, 18, 0]\n");
    let run = [
        "run",
        "--beside",
        "s.toml",
        "--no-vcd",
        "--set",
        "k1_per_s=[50,40]",
    ];
    let summary = bench.json(&run);
    assert_eq!(summary["settings"]["k1_per_s"], json!([50.0, 40.0]));
    assert_eq!(summary["settings"]["k2_per_s"], json!(200.0));
    // F·sin·cos of the lags' difference, but for the words of the gains.
    let exact = 50.0 * 0.48 * (1.0 / 40.0 - 1.0 / 50.0) * 1e3;
    let contour = |correction| number(of(&summary, correction), "/model/contour_max_um");
    close(contour("none"), exact, 0.01);
    assert!(contour("vector") < 0.5 * exact, "{}", contour("vector"));
    let text = bench.succeed(&run);
    assert!(text.contains("; K1 = 50, 40/s, K2 = 200/s; "), "{text}");
}

/// Across a line the load gives way by the same amount whatever is added to the commands.
#[test]
#[ignore = "takes long"]
fn a_torque_from_outside_is_not_corrected() {
    let bench = with("[[piece]]\nto_mm = [40, 0, 0]\n");
    let run = ["run", "--beside", "s.toml", "--no-vcd", "--set"];
    let set = |value| [&run[..], &[value]].concat();
    let torque = "load_torque=[{axis=\"y\",torque_nm=0.5,from_s=0.3}]";
    let summary = bench.json(&set(torque));
    assert_eq!(summary["settings"]["load_torque"][0]["axis"], "y");
    assert_eq!(summary["settings"]["load_torque"][0]["to_s"], Value::Null);
    let contour = |correction| number(of(&summary, correction), "/load/contour_max_um");
    let plain = contour("none");
    // What the loops leave of the torque, and what the shaft gives way by.
    close(plain, 45.8, 0.03);
    for correction in ["steady", "vector"] {
        near(contour(correction), plain, 1.5);
        let row = of(&summary, correction);
        assert!(number(row, "/model/contour_max_um") < 0.01, "{row}");
        assert!(number(row, "/axes/0/off_model_um") < 12.0, "{row}");
        let off = number(row, "/axes/1/off_model_um");
        // What the shaft gives way by, the load is further off.
        near(plain - off, 0.5 / 200.0 * 10_000.0 / TAU, 2.0);
    }
    let text = bench.succeed(&set(torque));
    assert!(
        text.contains(
            "\na torque of 0.5 Nm on the load of y from 0.3 s on\nmotors off their models by up to x "
        ),
        "{text}"
    );
    let text = bench.succeed(&set("inertia_factor=[0.5,1]"));
    let told = "\nthe feed-forward is told 0.5, 1 of the inertia\nmotors off ";
    assert!(text.contains(told), "{text}");
}

#[test]
fn a_torque_that_is_not_enough_is_said() {
    let weak = MACHINE.replace("max_torque_nm = 10", "max_torque_nm = 1");
    let text = format!("{LINE}[machine]\n{weak}");
    let done = with(&text).run(&["run", "--beside", "s.toml", "--no-vcd"]);
    let warning = "warning: vector: in ";
    let line = done.stderr.lines().find(|line| line.starts_with(warning));
    let line = line.unwrap_or_else(|| panic!("{}", done.stderr));
    assert!(!done.stdout.contains("warning"), "{}", done.stdout);
    assert!(
        line.ends_with(" periods x asks for more than 1 Nm"),
        "{line}"
    );
}
