//! Changes of speed, and what they make of an elastic mechanism: with blends, with ramps of the
//! conventional method, and without.

use super::arc::{SEAM, with};
use super::support::{list, near, number};
use serde_json::Value;
use std::f64::consts::{PI, TAU};

const TS: f64 = 0.01;
const MECHANISM: &str = "[mechanism]\nfrequency_hz = 8\n";
/// Half a circle of 10 mm at up to 20 mm/s is 158 samples.
const EVEN: u32 = 158;

fn rows(text: &str) -> [Value; 3] {
    let summary = with(text).json(&["run", "s.toml", "--no-vcd", "--beside"]);
    let rows = list(&summary, "speed_changes").to_vec();
    let rows: [Value; 3] = rows.try_into().unwrap();
    let names = ["patent", "conventional", "conventional, without ramps"];
    assert_eq!(
        rows.each_ref().map(|row| row["method"].as_str().unwrap()),
        names
    );
    rows
}

#[test]
fn without_ramps_the_speed_jumps() {
    let [patent, ramps, even] = rows(SEAM);
    // A command is off by half a count of 0.1 um in each coordinate.
    let rounding = 0.2e-3 / TS;
    let speed = 10.0 * PI / f64::from(EVEN) / TS;
    near(number(&even, "/speed_change_mm_per_s"), speed, rounding);
    near(
        number(&even, "/acceleration_mm_per_s2"),
        speed / TS,
        rounding / TS,
    );
    // Of the ramps 3v/2 in 2ta, in their middle and with half the speed's v2/R across.
    let most = (1.5f64 * speed / 0.2).hypot(speed * speed / 40.0);
    near(
        number(&ramps, "/acceleration_mm_per_s2"),
        most,
        2.0 * rounding / TS,
    );
    // At its joints with the arc the patent's direction jumps, by the chord of half a sample more.
    let jump = (speed * 0.1 / 20.0).asin() + speed * TS / 20.0;
    let most = 2.0 * speed * (jump / 2.0).sin();
    near(
        number(&patent, "/speed_change_mm_per_s"),
        most,
        2.0 * rounding,
    );
    for row in [patent, ramps] {
        let of = number(&row, "/speed_change_mm_per_s");
        near(of / TS, number(&row, "/acceleration_mm_per_s2"), 1e-6);
        assert_eq!(row["moving_um"], Value::Null);
        assert_eq!(row["rest_um"], Value::Null);
    }
}

/// A mass on a spring of 8 Hz, under exact points of the arc without ramps, by small steps: how far
/// it is off its command until the last, and in the second behind.
fn swung() -> [f64; 2] {
    const STEPS: u32 = 2000;
    let (step, natural) = (TS / f64::from(STEPS), TAU * 8.0);
    let point = |sample: u32| {
        let angle = PI * f64::from(sample.min(EVEN)) / f64::from(EVEN);
        [10.0 - 10.0 * angle.cos(), 10.0 * angle.sin()]
    };
    let (mut place, mut speed, mut most) = ([0.0; 2], [0.0; 2], [0f64; 2]);
    for sample in 0..EVEN + 100 {
        let (from, to) = (point(sample), point(sample + 1));
        for part in 1..=STEPS {
            let share = f64::from(part) / f64::from(STEPS);
            let mut off = [0.0; 2];
            for k in 0..2 {
                off[k] = from[k] + share * (to[k] - from[k]) - place[k];
                speed[k] += natural * natural * off[k] * step;
                place[k] += speed[k] * step;
            }
            let far = off[0].hypot(off[1]) * 1e3;
            let phase = usize::from(sample >= EVEN);
            most[phase] = most[phase].max(far);
        }
    }
    most
}

#[test]
fn a_mechanism_vibrates_by_what_jumps() {
    let [patent, ramps, even] = rows(&format!("{SEAM}{MECHANISM}"));
    let [moving, rest] = swung();
    near(number(&even, "/moving_um"), moving, 0.01 * moving);
    near(number(&even, "/rest_um"), rest, 0.02 * rest);
    // A step of the speed swings by v/w.
    let jump = 10.0 * PI / f64::from(EVEN) / TS / (TAU * 8.0) * 1e3;
    near(moving, jump, 0.05 * jump);
    for row in [&patent, &ramps] {
        assert!(number(row, "/rest_um") < 0.2 * rest, "{row} {rest}");
        assert!(number(row, "/moving_um") < 0.4 * moving, "{row} {moving}");
    }
    // Damped, all of it is less.
    let damped = rows(&format!("{SEAM}{MECHANISM}damping = 0.2\n"));
    for (less, more) in damped.iter().zip([patent, ramps, even]) {
        for key in ["/moving_um", "/rest_um"] {
            assert!(number(less, key) < number(&more, key), "{less} {more}");
        }
    }
}

#[test]
fn a_path_without_arcs_has_nothing_beside_it() {
    let line = format!("[[piece]]\nto_mm = [20, 0, 0]\n{MECHANISM}");
    let summary = with(&line).json(&["run", "s.toml", "--no-vcd"]);
    assert_eq!(list(&summary, "speed_changes"), &[] as &[Value]);
}

#[test]
fn bad_mechanisms_are_refused() {
    let cases = [
        (
            "frequency_hz=0",
            "mechanism.frequency_hz: is 0; allowed: 0.1 to 1000",
        ),
        (
            "frequency_hz=nan",
            "mechanism.frequency_hz: is NaN; allowed: 0.1 to 1000",
        ),
        ("damping=1", "mechanism.damping: is 1; allowed: 0 to 0.9"),
        (
            "mass=1",
            "mechanism.mass: unknown key; allowed: one of `frequency_hz`, `damping`",
        ),
    ];
    for (set, refusal) in cases {
        let bench = with(&format!("{SEAM}{MECHANISM}"));
        let set = format!("mechanism.{set}");
        bench.refuse_with(&["run", "s.toml", "--set", &set, "--out", "new"], |text| {
            assert!(text.contains(&format!("--set: {refusal}")), "{set}: {text}");
        });
    }
    let bench = with(&format!("{SEAM}[mechanism]\nfrequency_hz = 1001\n"));
    bench.refuse(
        &["run", "s.toml"],
        "s.toml:11: mechanism.frequency_hz: is 1001; allowed: 0.1 to 1000",
    );
    let bench = with(&format!("{SEAM}[mechanism]\ndamping = 0.1\n"));
    bench.refuse_with(&["run", "s.toml"], |text| {
        assert!(text.contains("frequency_hz: missing"), "{text}");
    });
}
