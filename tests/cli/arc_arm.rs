//! The arc generator's commands as those of an arm's joints: figures, waves, refusals.

use super::arc::{SEAM, with};
use super::support::{Bench, list, near, number, whole, words};
use std::f64::consts::TAU;

/// Shoulder 350 mm above the origin.
const ARM: &str = "[arm]\nshoulder_mm = [0, 0, 350]\nupper_mm = 300\nfore_mm = 350\n";

#[test]
fn around_the_shoulder_the_base_alone_turns() {
    // A quarter of a circle of 400 mm, at 20 mm/s.
    let (x, y) = (400.0 * 0.6, 400.0 * 0.8);
    let arc = format!(
        "start_mm = [400, 0, 300]\n[[piece]]\nvia_mm = [{x}, {y}, 300]\nto_mm = [0, 400, 300]\n"
    );
    let summary = with(&format!("{arc}{ARM}")).json(&["run", "s.toml", "--no-vcd"]);
    let [base, shoulder, elbow] = list(&summary["arm"], "joints") else {
        panic!("three joints");
    };
    assert_eq!(base["joint"], "base");
    near(number(base, "/range_deg/0"), 0.0, 1e-6);
    near(number(base, "/range_deg/1"), 90.0, 1e-6);
    // v/R: what is not whole in samples makes it a little slower, rounding to 0.1 um a little faster.
    near(
        number(base, "/speed_deg_per_s"),
        (20f64 / 400.0).to_degrees(),
        5e-3,
    );
    // The blends at both ends go along a chord of 2 mm: 1.25 um off the circle.
    for joint in [shoulder, elbow] {
        let [least, most] = [0, 1].map(|k| number(joint, &format!("/range_deg/{k}")));
        assert!(most > least && most - least < 1e-3, "{joint}");
    }
    // By the law of cosines: 400 mm out and 50 mm down.
    let cosine =
        (400f64.powi(2) + 50f64.powi(2) - 300f64.powi(2) - 350f64.powi(2)) / (2.0 * 300.0 * 350.0);
    near(
        number(elbow, "/range_deg/1"),
        -cosine.acos().to_degrees(),
        1e-3,
    );
    assert_eq!(whole(&summary, "/arm/counts_per_rev"), 1 << 20);
}

#[test]
fn joints_follow_their_command_by_a_tick() {
    let bench = Bench::new();
    let run = ["run", "waves/weld.toml"];
    let summary = bench.json(&run);
    let off = number(&summary, "/arm/rounding_um");
    // Half a count of each joint, seen from 500 mm away.
    assert!(
        off > 0.0 && off < 3.0 * 500e3 * TAU / 8_388_608.0 / 2.0,
        "{off}"
    );
    let paths = ["x", "y", "z"].map(|name| format!("arc_generator.{name}"));
    let joints = ["base", "shoulder", "elbow"].map(|name| format!("arc_generator.arm.{name}"));
    let wanted: Vec<&str> = paths.iter().chain(&joints).map(String::as_str).collect();
    let ticks = words(&bench.read("waves/weld.vcd"), &wanted);
    assert_eq!(ticks.len() as i64, whole(&summary, "/ticks"));
    // Before the first command the arm stands where the path begins.
    let (mut command, mut moved) = ([480.0, 40.0, 300.0], 0);
    for (tick, row) in ticks.iter().enumerate() {
        let angles: Vec<f64> = row[3..]
            .iter()
            .map(|&n| n as f64 * TAU / 8_388_608.0)
            .collect();
        let [base, shoulder, elbow] = angles[..] else {
            panic!("three joints");
        };
        let out = 300.0 * shoulder.cos() + 350.0 * (shoulder + elbow).cos();
        let up = 350.0 + 300.0 * shoulder.sin() + 350.0 * (shoulder + elbow).sin();
        let hand = [out * base.cos(), out * base.sin(), up];
        for (hand, command) in hand.iter().zip(command) {
            assert!(
                (hand - command).abs() <= off * 1e-3 + 1e-9,
                "{tick}: {hand} {command}"
            );
        }
        assert!(elbow < 0.0, "{tick}: the elbow is up");
        if row[..3] != [0; 3] {
            let next = [0, 1, 2].map(|k| row[k] as f64 / 1e4);
            moved += usize::from(next != command);
            command = next;
        }
    }
    assert_eq!(moved, 1270);
    // The tick behind the last command shows its joints: the rows above hold there too.
    let [.., before, last] = &ticks[..] else {
        panic!("no ticks");
    };
    assert_eq!(before[..3], last[..3]);
    assert_ne!(before[3..], last[3..]);
}

#[test]
fn poses_that_are_singular_are_refused_with_their_piece() {
    let line = "[[piece]]\nto_mm = [400, 0, 300]\n";
    let cases = [
        // Through the vertical of the shoulder, 350 mm below it.
        (
            "start_mm = [-400, 0, 0]\n[[piece]]\nto_mm = [400, 0, 0]\n".to_owned(),
            "s.toml:9: piece 0: to_mm: 19.54 s from the start the hand is 11.200 mm from the vertical through the shoulder; allowed: at least 11.3441 mm",
        ),
        (
            format!("start_mm = [500, 0, 300]\n{line}[[piece]]\nto_mm = [800, 0, 300]\n"),
            "s.toml:11: piece 1: to_mm: ",
        ),
        // Folded: upper arm and forearm leave 50 mm between them.
        (
            "start_mm = [40, 0, 340]\n[[piece]]\nto_mm = [400, 0, 340]\n".to_owned(),
            "s.toml:9: piece 0: to_mm: 0 s from the start the hand is 41.231 mm from the shoulder, where the elbow is folded or beyond; allowed: at least 50.3189 mm",
        ),
    ];
    for (path, refusal) in cases {
        let bench = with(&format!("{path}{ARM}"));
        bench.refuse_with(&["run", "s.toml", "--out", "new"], |text| {
            assert!(text.contains(refusal), "{text}");
        });
    }
    // In a part program the block is at fault.
    let arm = ARM.replace("[0, 0, 350]", "[-100, 0, 350]");
    let bench = with(&format!("input = \"l.ngc\"\n{arm}"));
    bench.write("l.ngc", "G0 X400 Z300\nG1 X540 F1200\nG1 X700\n");
    bench.refuse_with(&["run", "s.toml", "--out", "new"], |text| {
        assert!(text.contains("l.ngc:3: arm: "), "{text}");
        assert!(
            text.contains("the elbow is straight or beyond; allowed: at most 649.975 mm"),
            "{text}"
        );
    });
}

#[test]
fn bad_arms_are_refused() {
    let cases = [
        (
            "upper_mm=0",
            "arm.upper_mm: is 0; allowed: 0.001 to 1000000",
        ),
        (
            "fore_mm=nan",
            "arm.fore_mm: is NaN; allowed: 0.001 to 1000000",
        ),
        (
            "shoulder_mm=[0,2e6,0]",
            "arm.shoulder_mm: is 2000000; allowed: -1000000 to 1000000",
        ),
        (
            "singular_deg=0",
            "arm.singular_deg: is 0; allowed: 0.01 to 45",
        ),
        (
            "counts_per_rev=0",
            "arm.counts_per_rev: is 0; allowed: 1 to 268435456",
        ),
        (
            "elbow=left",
            "arm.elbow: unknown variant `left`; allowed: `up` or `down`",
        ),
        (
            "wrist=1",
            "arm.wrist: unknown key; allowed: one of `shoulder_mm`, `upper_mm`",
        ),
    ];
    for (set, refusal) in cases {
        let bench = with(&format!("{SEAM}{ARM}"));
        let set = format!("arm.{set}");
        bench.refuse_with(&["run", "s.toml", "--set", &set, "--out", "new"], |text| {
            assert!(text.contains(&format!("--set: {refusal}")), "{set}: {text}");
        });
    }
    let bench = with(&format!(
        "{SEAM}{}",
        ARM.replace("fore_mm = 350", "fore_mm = -1")
    ));
    bench.refuse(
        &["run", "s.toml"],
        "s.toml:13: arm.fore_mm: is -1; allowed: 0.001 to 1000000",
    );
    let bench = with(&format!("{SEAM}[arm]\nupper_mm = 300\n"));
    bench.refuse_with(&["run", "s.toml"], |text| {
        assert!(
            text.contains(
                "fore_mm: missing, and has no default; allowed: a number from 0.001 to 1000000"
            ),
            "{text}"
        );
    });
}
