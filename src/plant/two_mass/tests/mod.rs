//! Two-mass axis compared with closed forms and with small Runge-Kutta steps.

mod dry;
mod flanks;
mod linear;
mod small_steps;
mod sweep;

use super::*;

/// Ticks of 0.1 µs to 1 ms.
const TICKS_S: [f64; 5] = [1e-7, 1e-6, 1e-5, 1e-4, 1e-3];

/// Round numbers: 120 Hz, no friction.
const PARAMETERS: TwoMassParameters = TwoMassParameters {
    max_torque_nm: 20.0,
    motor_inertia_kg_m2: 1e-3,
    load_inertia_kg_m2: 3e-3,
    stiffness_nm_per_rad: 430.0,
    counts_per_rev: 10_000.0,
    mm_per_rev: 5.0,
    damping_nm_s_per_rad: 0.0,
    backlash_rad: 0.0,
    motor_viscous_nm_s_per_rad: 0.0,
    load_viscous_nm_s_per_rad: 0.0,
    motor_friction_nm: 0.0,
    load_friction_nm: 0.0,
    motor_stiction_nm: 0.0,
    load_stiction_nm: 0.0,
};

fn axis(parameters: &TwoMassParameters, tick_s: f64) -> TwoMassAxis {
    TwoMassAxis::new(parameters, tick_s).expect("they are in range")
}

fn ticks(seconds: f64, tick_s: f64) -> usize {
    (seconds / tick_s).round() as usize
}

/// Runs for a time under a torque.
fn run(axis: &mut TwoMassAxis, torque_nm: f64, seconds: f64) {
    for _ in 0..ticks(seconds, axis.tick_s) {
        axis.drive(torque_nm);
    }
}

#[track_caller]
fn near(seen: f64, wanted: f64, within: f64) {
    assert!((seen - wanted).abs() <= within, "{seen}, not {wanted}");
}

#[test]
fn torque_words_and_positions_have_their_units() {
    let mut axis = axis(&PARAMETERS, 1e-4);
    for (word, torque) in [
        (0, 0.0),
        (32_767, 20.0),
        (-32_767, -20.0),
        (-32_768, -20.0),
        (i64::MAX, 20.0),
        (16_384, 20.0 * 16_384.0 / 32_767.0),
    ] {
        assert_eq!(axis.step(word), axis.channels());
        near(axis.torque_nm(), torque, 1e-12);
    }
    let turn = std::f64::consts::TAU;
    axis.state = [2.0 * turn, 3.0 * turn, turn, -turn];
    near(axis.position_counts(), 20_000.0, 1e-9);
    near(axis.load_position_counts(), 30_000.0, 1e-9);
    near(axis.load_position_mm(), 15.0, 1e-9);
    near(axis.speed_counts_per_s(), 10_000.0, 1e-9);
    near(axis.load_speed_counts_per_s(), -10_000.0, 1e-9);
    near(axis.twist_rad(), -turn, 1e-12);
    near(axis.shaft_torque_nm(), -430.0 * turn, 1e-9);
    assert_eq!(axis.countable_counts_per_s(), 1.0 / 1e-4);
    // The encoder is on the motor.
    axis.state[0] = turn * 2.0 / 10_000.0;
    assert_eq!(axis.channels(), (true, true));
}

#[test]
fn what_is_out_of_range_is_named() {
    type Choose = fn(&mut TwoMassParameters) -> &mut f64;
    let faults: [(&str, Choose); 14] = [
        ("max_torque_nm", |p| &mut p.max_torque_nm),
        ("motor_inertia_kg_m2", |p| &mut p.motor_inertia_kg_m2),
        ("load_inertia_kg_m2", |p| &mut p.load_inertia_kg_m2),
        ("stiffness_nm_per_rad", |p| &mut p.stiffness_nm_per_rad),
        ("counts_per_rev", |p| &mut p.counts_per_rev),
        ("mm_per_rev", |p| &mut p.mm_per_rev),
        ("damping_nm_s_per_rad", |p| &mut p.damping_nm_s_per_rad),
        ("backlash_rad", |p| &mut p.backlash_rad),
        ("motor_viscous_nm_s_per_rad", |p| {
            &mut p.motor_viscous_nm_s_per_rad
        }),
        ("load_viscous_nm_s_per_rad", |p| {
            &mut p.load_viscous_nm_s_per_rad
        }),
        ("motor_friction_nm", |p| &mut p.motor_friction_nm),
        ("load_friction_nm", |p| &mut p.load_friction_nm),
        ("motor_stiction_nm", |p| &mut p.motor_stiction_nm),
        ("load_stiction_nm", |p| &mut p.load_stiction_nm),
    ];
    for (index, (field, of)) in faults.into_iter().enumerate() {
        for value in [-1.0, f64::NAN, f64::INFINITY] {
            let mut bad = PARAMETERS;
            *of(&mut bad) = value;
            assert_eq!(bad.ranges().expect_err(field).field, field);
            assert!(TwoMassAxis::new(&bad, 1e-5).is_err());
        }
        let mut zero = PARAMETERS;
        *of(&mut zero) = 0.0;
        assert_eq!(zero.ranges().is_ok(), index >= 6, "{field}");
    }
    assert!(TwoMassAxis::new(&PARAMETERS, 0.0).is_err());
    // 757.2 rad/s: a tick may be at most 10,000 rad long.
    let error = TwoMassAxis::new(&PARAMETERS, 14.0).expect_err("too long");
    assert_eq!(error.field, "tick_s");
    near(PARAMETERS.longest_tick_s(), 13.206, 1e-3);
}

#[test]
fn what_is_not_given_is_not_there() {
    let needed = "
        max_torque_nm = 20
        motor_inertia_kg_m2 = 1e-3
        load_inertia_kg_m2 = 3e-3
        stiffness_nm_per_rad = 430
        counts_per_rev = 10000
        mm_per_rev = 5
    ";
    let parameters: TwoMassParameters = toml::from_str(needed).expect("they are complete");
    assert_eq!(parameters, PARAMETERS);
    assert!(toml::from_str::<TwoMassParameters>("mm_per_rev = 5").is_err());
    assert!(toml::from_str::<TwoMassParameters>(&format!("{needed} play = 1")).is_err());
}
