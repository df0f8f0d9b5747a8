//! Step motors on the drivers of the pulse interpolator: rates, steps that are lost, waves.

use super::support::{Bench, near, number, whole, words};
use serde_json::json;
use std::fmt::Write as _;

const HEAD: &str = "circuit = \"pulse_interpolator\"\nclock_hz = 100_000\n";
const PATTERN: &str = "[[pattern]]\nname = \"a\"\ntable = \"t.csv\"\n";
const MOTOR: &str = "[motor]\nholding_torque_nm = 1\ninertia_kg_m2 = 5e-5\ndamping_nm_s = 0.01\n";

/// Unit times of 500 ticks with these half-periods; those below 0 are down.
fn table(half_periods: &[i32]) -> String {
    let header = "unit,period_ticks,x_half_period_ticks,x_down\n".to_owned();
    half_periods
        .iter()
        .enumerate()
        .fold(header, |mut text, (unit, half)| {
            let down = i32::from(*half < 0);
            let _ = writeln!(text, "{unit},500,{},{down}", half.abs());
            text
        })
}

fn bench(half_periods: &[i32], motor: &str) -> Bench {
    let bench = Bench::with("s.toml", format!("{HEAD}{PATTERN}{motor}"));
    bench.write("t.csv", table(half_periods));
    bench
}

/// What is complained of in a run that fails for it.
fn complaints(bench: &Bench, arguments: &[&str]) -> String {
    let done = bench.run(arguments);
    assert_eq!(done.code, 1, "{}{}", done.stdout, done.stderr);
    done.stderr
}

/// At 100 kHz: a start at once with the clock by twice the half-period.
fn start(half: i32) -> (Bench, [&'static str; 3]) {
    let mut units = vec![half; 100];
    units.extend([0; 20]);
    (bench(&units, MOTOR), ["run", "s.toml", "--no-vcd"])
}

#[test]
fn a_start_below_the_pull_in_rate_is_followed_and_one_above_it_is_lost() {
    // p = 50, w0 = 1000 rad/s; a field that moves evenly pulls the rotor in up to 4 w0/pi = 1273
    // full steps a second, one that moves in full steps up to somewhat less.
    let (bench, run) = start(50);
    let summary = bench.json(&run);
    let of = |key: &str| number(&summary, &format!("/step_rates/x/{key}"));
    near(of("largest_per_s"), 1000.0, 1e-9);
    near(of("change_per_s"), 1000.0, 1e-9);
    assert_eq!(whole(&summary, "/step_rates/x/change_unit"), 0);
    let motor = &summary["step_rates"]["x"]["motor"];
    assert_eq!(
        (&motor["lost_steps"], &motor["lost_unit"]),
        (&json!(0), &json!(null))
    );
    assert!(of("motor/off_full_steps") < 2.0, "{motor}");

    let (bench, run) = start(36);
    let text = complaints(&bench, &run);
    assert!(text.contains("x: the motor loses "), "{text}");
    assert!(text.contains(" steps, the first in unit time "), "{text}");
    // In microsteps of a half it is half as many full steps a second.
    let set = "motor.microsteps=2";
    let summary = bench.json(&[&run[..], &["--set", set]].concat());
    assert_eq!(summary["step_rates"]["x"]["motor"]["lost_steps"], 0);
    // The pulses are there, whatever becomes of the motor.
    assert_eq!(summary["exact"], true);
}

#[test]
fn the_waves_have_the_motor_that_the_summary_speaks_of() {
    let half_periods: Vec<i32> = (0..40)
        .map(|unit| if unit < 20 { 100 } else { -125 })
        .collect();
    let bench = bench(&half_periods, MOTOR);
    let summary = bench.json(&["run", "s.toml", "--out", "o"]);
    let plain = bench.json(&["run", "s.toml", "--no-vcd", "--out", "p"]);
    assert_eq!(summary["step_rates"], plain["step_rates"]);

    let names = ["step_x", "dir_x", "plant.x.position", "plant.x.ahead"];
    let names = names.map(|name| format!("pulse_interpolator.{name}"));
    let ticks = words(
        &bench.read("o/s.vcd"),
        &names.each_ref().map(String::as_str),
    );
    // In a tick the motor is where the ticks before have left it: under the driver's position of the
    // last.
    let (mut position, mut high, mut most) = (0, 0, 0);
    for tick in &ticks {
        let [step, down, motor, ahead] = tick[..] else {
            panic!("{tick:?}");
        };
        // Both are cut to 1/256.
        let off = 256 * position - motor - ahead;
        assert!(off.abs() <= 1, "{tick:?} {position}");
        most = most.max(ahead.abs());
        if step > high {
            position += 1 - 2 * down;
        }
        high = step;
    }
    assert_eq!(ticks.len() as i64, whole(&summary, "/ticks"));
    let off = number(&summary, "/step_rates/x/motor/off_full_steps");
    near(most as f64 / 256.0, off, 1.0 / 128.0);
    assert_eq!(position, whole(&summary, "/axes/x/end_position"));
    let save = bench.read("o/s.gtkw");
    assert!(save.contains("plant.x.position"), "{save}");
}

#[test]
fn without_motors_there_are_rates_alone() {
    let summary = bench(&[50; 4], "").json(&["run", "s.toml", "--no-vcd"]);
    assert_eq!(summary["step_rates"]["x"]["motor"], json!(null));
    near(
        number(&summary, "/step_rates/x/largest_per_s"),
        1000.0,
        1e-9,
    );
}

#[test]
#[ignore = "takes long"]
fn a_drawing_can_have_motors_too() {
    let motor = "motor={holding_torque_nm=1,inertia_kg_m2=5e-5,damping_nm_s=5e-3,microsteps=4}";
    let run = ["run", "waves/bracket.toml", "--no-vcd", "--set", motor];
    let summary = Bench::new().json(&run);
    for axis in ["x", "y"] {
        let motor = &summary["step_rates"][axis]["motor"];
        assert_eq!(motor["lost_steps"], 0, "{axis}");
    }
    // In full steps it is shaken until it slips.
    let full = [&run[..], &["--set", "motor.microsteps=1"]].concat();
    let text = complaints(&Bench::new(), &full);
    for axis in ["x", "y"] {
        assert!(
            text.contains(&format!("{axis}: the motor loses ")),
            "{text}"
        );
    }
}

#[test]
fn bad_motors_are_refused() {
    for (set, refusal) in [
        (
            "holding_torque_nm=0",
            "motor.holding_torque_nm: is 0; allowed: 0.000000001 to 1000000000",
        ),
        (
            "inertia_kg_m2=nan",
            "motor.inertia_kg_m2: is NaN; allowed: ",
        ),
        (
            "damping_nm_s=-1",
            "motor.damping_nm_s: is -1; allowed: 0 to 1000000000",
        ),
        (
            "friction_nm=-1",
            "motor.friction_nm: is -1; allowed: 0 to 1000000000",
        ),
        (
            "full_steps_per_rev=3",
            "motor.full_steps_per_rev: is 3; allowed: 4 to 10000",
        ),
        (
            "inertia_kg_m2=1e-9",
            "motor.inertia_kg_m2: is 0.000000001; allowed: more, or less torque and damping",
        ),
        ("microsteps=0", "motor.microsteps: is 0; allowed: 1 to 1024"),
        (
            "rotor=1",
            "motor.rotor: unknown key; allowed: one of `holding_torque_nm`",
        ),
    ] {
        let bench = bench(&[50; 4], MOTOR);
        let set = format!("motor.{set}");
        bench.refuse_with(&["run", "s.toml", "--set", &set, "--out", "new"], |text| {
            assert!(text.contains(&format!("--set: {refusal}")), "{set}: {text}");
        });
    }
    let bench = bench(
        &[50; 4],
        "[motor]\nholding_torque_nm = 1\ninertia_kg_m2 = 0\n",
    );
    bench.refuse_with(&["run", "s.toml"], |text| {
        assert!(
            text.contains("s.toml:8: motor.inertia_kg_m2: is 0; allowed: "),
            "{text}"
        );
    });
}
