//! Plant compared with the closed forms of its equations.

use super::*;
use crate::settings::CLOCK_RANGE_HZ;

const TICK_S: f64 = 5e-6;
const FULL: i64 = 32_767;

fn servo(parameters: &ServoParameters) -> ServoAxis {
    ServoAxis::new(parameters, TICK_S).expect("they are in range")
}

#[test]
fn the_default_motor_has_a_hundred_thousand_counts_a_second() {
    let rated = ServoParameters::default().rated_counts_per_s();
    assert_eq!(rated.round(), 100_000.0);
}

#[test]
fn a_step_of_the_reference_is_followed_with_the_time_constant() {
    for velocity_loop_s in [0.002, 0.02] {
        let parameters = ServoParameters {
            velocity_loop_s,
            max_torque_nm: 1e6,
            ..ServoParameters::default()
        };
        let (mut axis, rated) = (servo(&parameters), parameters.rated_counts_per_s());
        for tick in 1..=20_000 {
            axis.step(FULL / 2, FULL);
            let time = f64::from(tick) * TICK_S;
            let target = rated * (FULL / 2) as f64 / FULL as f64;
            let rest = (-time / velocity_loop_s).exp();
            let speed = target * (1.0 - rest);
            assert!((axis.speed_counts_per_s() - speed).abs() < 1e-6, "{time}");
            let position = target * (time - velocity_loop_s * (1.0 - rest));
            // According to the note: (tick / time constant)² / 12 of the lag.
            let error = (TICK_S / velocity_loop_s).powi(2) / 12.0 * target * velocity_loop_s;
            let off = (axis.position_counts() - position).abs();
            assert!(off < error + 1e-6, "{time}: {off}");
        }
    }
}

#[test]
fn the_torque_is_limited_both_ways() {
    let parameters = ServoParameters::default();
    let limit = parameters.max_torque_nm / parameters.inertia_kg_m2 * parameters.counts_per_rad();
    for sign in [1, -1] {
        let mut axis = servo(&parameters);
        for tick in 1..=500 {
            axis.step(sign * FULL, FULL);
            assert_eq!(axis.torque_nm(), sign as f64 * parameters.max_torque_nm);
            let speed = sign as f64 * limit * f64::from(tick) * TICK_S;
            assert!((axis.speed_counts_per_s() / speed - 1.0).abs() < 1e-9);
            let position = 0.5 * speed * f64::from(tick) * TICK_S;
            assert!((axis.position_counts() / position - 1.0).abs() < 1e-9);
        }
    }
}

#[test]
fn friction_holds_at_rest_and_stops_in_time() {
    let parameters = ServoParameters {
        friction_nm: 0.5,
        ..ServoParameters::default()
    };
    for sign in [1.0, -1.0] {
        let mut motor = Motor::new(&parameters);
        for torque in [0.0, 0.2, -0.4, 0.5, -0.5] {
            motor.step(torque * sign, 1.0);
            assert_eq!(motor.speed_rad_per_s(), 0.0);
            assert_eq!(motor.position_counts(), 0.0);
        }
        // 0.7 N·m above friction for 10 ms, then nothing: stops within the following second.
        motor.step(1.2 * sign, 0.01);
        let (torque, inertia) = (0.7, parameters.inertia_kg_m2);
        let speed = torque / inertia * 0.01;
        assert!((motor.speed_rad_per_s() - sign * speed).abs() < 1e-9);
        motor.step(0.0, 1.0);
        assert_eq!(motor.speed_rad_per_s(), 0.0);
        let angle = 0.5 * speed * 0.01 + 0.5 * speed * speed * inertia / 0.5;
        let counts = sign * angle * parameters.counts_per_rad();
        assert!((motor.position_counts() - counts).abs() < 1e-6);
        // Braked by more than friction it reverses.
        motor.step(1.2 * sign, 0.01);
        motor.step(-0.6 * sign, 1.0);
        let stop = speed * inertia / 1.1;
        let back = 0.1 / inertia * (1.0 - stop);
        assert!((motor.speed_rad_per_s() + sign * back).abs() < 1e-6);
    }
}

#[test]
fn friction_takes_its_share_of_the_speed() {
    let parameters = ServoParameters {
        friction_nm: 0.4,
        ..ServoParameters::default()
    };
    let mut axis = servo(&parameters);
    for _ in 0..40_000 {
        axis.step(FULL / 2, FULL);
    }
    // The driver has no integral action: a speed difference provides the friction's torque.
    let lag = 0.4 * parameters.velocity_loop_s / parameters.inertia_kg_m2;
    let speed = parameters.rated_speed_rad_per_s * (FULL / 2) as f64 / FULL as f64 - lag;
    let seen = axis.speed_counts_per_s() / parameters.counts_per_rad();
    assert!((seen / speed - 1.0).abs() < 1e-3, "{seen}, not {speed}");
}

#[test]
fn the_encoder_turns_through_its_quarters() {
    let up = [(false, false), (true, false), (true, true), (false, true)];
    for count in -9i32..9 {
        for part in [-0.49, 0.0, 0.49] {
            let channels = Encoder::default().channels(f64::from(count) + part);
            assert_eq!(channels, up[count.rem_euclid(4) as usize], "{count} {part}");
        }
    }
    // At the countable speed no tick moves by more than a quarter.
    let step = Encoder::default().countable_counts_per_s(TICK_S) * TICK_S;
    for tick in 0..1000 {
        let at = |tick: i32| Encoder::default().channels(0.3 + f64::from(tick) * step);
        let ((a, b), (c, d)) = (at(tick), at(tick + 1));
        assert!((a != c) != (b != d));
    }
}

#[test]
fn what_is_out_of_range_is_named() {
    let good = ServoParameters::default();
    assert_eq!(good.validate(), Ok(()));
    type Choose = fn(&mut ServoParameters) -> &mut f64;
    let faults: [(&str, Choose); 6] = [
        ("velocity_loop_s", |p| &mut p.velocity_loop_s),
        ("inertia_kg_m2", |p| &mut p.inertia_kg_m2),
        ("max_torque_nm", |p| &mut p.max_torque_nm),
        ("friction_nm", |p| &mut p.friction_nm),
        ("rated_speed_rad_per_s", |p| &mut p.rated_speed_rad_per_s),
        ("counts_per_rev", |p| &mut p.counts_per_rev),
    ];
    for (field, of) in faults {
        for value in [-1.0, f64::NAN, f64::INFINITY] {
            let mut bad = good;
            *of(&mut bad) = value;
            let error = bad.validate().expect_err(field);
            assert_eq!(error.field, field);
            assert!(error.to_string().contains(" to 1000000000"), "{error}");
            assert!(ServoAxis::new(&bad, TICK_S).is_err());
        }
    }
    let shortest_s = 1.0 / *CLOCK_RANGE_HZ.end() as f64;
    assert!(ServoAxis::new(&good, shortest_s).is_ok());
    let error = ServoAxis::new(&good, 0.0).expect_err("no tick");
    assert_eq!(
        error.to_string(),
        "tick_s: is 0; allowed: 0.0000000001 to 1000000000"
    );
}

#[test]
fn parameters_are_read_by_name() {
    let text = "
        velocity_loop_s = 0.01
        inertia_kg_m2 = 0.002
        max_torque_nm = 10
        friction_nm = 0.1
        rated_speed_rad_per_s = 200
        counts_per_rev = 4000
    ";
    let parameters: ServoParameters = toml::from_str(text).expect("they are complete");
    assert_eq!(parameters.velocity_loop_s, 0.01);
    assert_eq!(parameters.counts_per_rev, 4000.0);
    assert!(toml::from_str::<ServoParameters>("friction_nm = 0.1").is_err());
}

#[test]
fn the_waves_show_the_two_masses_of_each_axis() {
    let parameters = TwoMassParameters {
        counts_per_rev: 10_000.0,
        load_stiction_nm: 1.0,
        ..TwoMassParameters::default()
    };
    fn machine<const AXES: usize>(parameters: &TwoMassParameters) -> [TwoMassAxis; AXES] {
        std::array::from_fn(|axis| {
            let mut plant = TwoMassAxis::new(parameters, 1e-4).expect("they are in range");
            for _ in 0..50 {
                plant.step([8_000, -8_000, 0][axis]);
            }
            plant
        })
    }
    let axes = machine::<3>(&parameters);
    let shown = waves::MachineSignals::of(&axes);
    let [x, y, z] = &shown.axes[..] else {
        panic!("three axes");
    };
    let off = |seen: i64, wanted: f64| (seen as f64 - wanted).abs() <= 1.0;
    for (signals, axis) in shown.axes.iter().zip(&axes) {
        assert!(off(signals.position, 256.0 * axis.position_counts()));
        assert!(off(signals.speed, axis.speed_counts_per_s()));
        let load = 256.0 * axis.load_position_counts();
        assert!(off(signals.load_position, load));
        assert!(off(signals.twist, 1e6 * axis.twist_rad()));
        assert!(off(signals.torque, 1e3 * axis.torque_nm()));
    }
    assert!(x.position > x.load_position && x.load_position > 256);
    assert!(x.twist > 1000 && x.speed > 1000);
    assert_eq!(x.torque, 2441);
    assert_eq!(x.position, -y.position);
    assert_eq!((z.position, z.torque), (0, 0));
    let two = waves::MachineSignals::of(&machine::<2>(&parameters));
    assert_eq!(two.axes[1].load_position, y.load_position);
}
