//! Coulomb friction and stiction.

use super::*;
use std::f64::consts::PI;

#[test]
fn stiction_of_the_motor_holds_and_lets_go() {
    let parameters = TwoMassParameters {
        motor_friction_nm: 0.6,
        motor_stiction_nm: 1.0,
        ..PARAMETERS
    };
    for tick_s in TICKS_S {
        for sign in [1.0, -1.0] {
            let mut axis = axis(&parameters, tick_s);
            for torque in [0.0, 0.3, 1.0, -1.0, 0.99] {
                run(&mut axis, sign * torque, 3e-3);
                assert_eq!(axis.state, [0.0; 4]);
            }
            // Once it slides only Coulomb friction is left; both bodies and their shaft move as
            // under a torque of 0.4 N·m.
            let free = TwoMassParameters {
                motor_stiction_nm: 0.0,
                motor_friction_nm: 0.0,
                ..parameters
            };
            let mut other = super::axis(&free, tick_s);
            run(&mut axis, sign * 1.0001, 5e-3);
            run(&mut other, sign * 0.4001, 5e-3);
            for (seen, wanted) in axis.state.into_iter().zip(other.state) {
                near(seen, wanted, 1e-10);
            }
        }
    }
    // Less stiction than friction counts as friction.
    let parameters = TwoMassParameters {
        motor_stiction_nm: 0.1,
        ..parameters
    };
    let mut axis = axis(&parameters, 1e-5);
    run(&mut axis, 0.6, 0.01);
    assert_eq!(axis.state, [0.0; 4]);
    run(&mut axis, 0.601, 0.01);
    assert!(axis.state[0] > 0.0);
}

#[test]
fn stiction_of_the_load_holds_a_torque_from_outside() {
    let parameters = TwoMassParameters {
        load_friction_nm: 2.0,
        load_stiction_nm: 3.0,
        ..PARAMETERS
    };
    for tick_s in TICKS_S {
        for sign in [1.0, -1.0] {
            let mut axis = axis(&parameters, tick_s);
            for (torque, starts) in [(3.0, false), (-2.999, false), (3.001, true)] {
                axis.set_load_torque_nm(sign * torque);
                run(&mut axis, 0.0, 3e-3);
                assert_eq!(sign * axis.state[3] > 0.0, starts, "{torque}");
            }
            // Friction is part of the state: a restored plant continues as before.
            let (state, before) = (axis.state(), axis.state);
            run(&mut axis, 0.0, 2e-3);
            let after = axis.state;
            axis.set_load_torque_nm(0.0);
            axis.set_state(&state);
            assert_eq!(axis.state, before);
            run(&mut axis, 0.0, 2e-3);
            assert_eq!(axis.state, after);
        }
    }
}

#[test]
fn stiction_of_the_load_holds_until_the_shaft_has_wound_up() {
    let parameters = TwoMassParameters {
        load_friction_nm: 2.0,
        load_stiction_nm: 3.0,
        ..PARAMETERS
    };
    let omega = (430.0f64 / 1e-3).sqrt();
    for tick_s in TICKS_S {
        for sign in [1.0, -1.0] {
            // The motor oscillates against the held load, up to twice the torque.
            let mut held = axis(&parameters, tick_s);
            for tick in 1..=ticks(0.05, tick_s) {
                held.drive(sign * 1.499);
                let t = tick as f64 * tick_s;
                let twist = sign * 1.499 / 430.0 * (1.0 - (omega * t).cos());
                near(held.state[0], twist, 1e-11);
                assert_eq!((held.state[1], held.state[3]), (0.0, 0.0));
            }
            let mut loose = axis(&parameters, tick_s);
            let breaks = (1.0f64 - 3.0 / 2.5).acos() / omega;
            for tick in 1..=ticks(0.01, tick_s) {
                loose.drive(sign * 2.5);
                let t = tick as f64 * tick_s;
                assert_eq!(loose.state[3] != 0.0, t > breaks, "{t}");
            }
            assert!(sign * loose.state[3] > 0.0);
        }
    }
}

#[test]
fn a_swing_against_dry_friction_loses_as_much_each_time_and_then_stands() {
    // The load is held; the motor oscillates about it and reverses at x → −(x −
    // 2·friction/stiffness).
    let parameters = TwoMassParameters {
        motor_friction_nm: 0.43,
        load_stiction_nm: 1e6,
        ..PARAMETERS
    };
    let half = PI / (430.0f64 / 1e-3).sqrt();
    for tick_s in TICKS_S {
        let mut axis = axis(&parameters, tick_s);
        axis.state[0] = 0.0093;
        let mut last = axis.state[0];
        for _ in 0..=ticks(5.0 * half, tick_s) + 1 {
            axis.drive(0.0);
            last = axis.state[0].min(last);
        }
        // 9.3, −7.3, 5.3, −3.3, 1.3 and 0.7 mrad, where friction holds it: it could hold 1 mrad.
        near(axis.state[0], 0.0007, 1e-12);
        assert_eq!(axis.state[2], 0.0);
        if tick_s <= 1e-5 {
            near(last, -0.0073, 1e-8);
        }
        let stands = axis.state;
        for torque in [0.0, 0.1, -0.1, 0.7, 0.0] {
            run(&mut axis, torque, 0.01);
            assert_eq!(axis.state, stands);
        }
    }
}

#[test]
fn both_come_to_rest_and_stay_to_the_bit() {
    let parameters = TwoMassParameters {
        damping_nm_s_per_rad: 0.05,
        motor_friction_nm: 0.4,
        load_friction_nm: 0.8,
        load_stiction_nm: 1.1,
        ..PARAMETERS
    };
    for tick_s in TICKS_S {
        let mut axis = axis(&parameters, tick_s);
        run(&mut axis, 6.0, 0.01);
        let speeds = [axis.state[2], axis.state[3]];
        assert!(speeds.iter().all(|speed| *speed > 0.0));
        run(&mut axis, 0.0, 0.1);
        let rest = axis.state;
        assert_eq!([rest[2], rest[3]], [0.0; 2]);
        assert_eq!(axis.grips, [Grip::Stuck; 2]);
        let channels = axis.channels();
        run(&mut axis, 0.0, 0.02);
        assert_eq!(axis.state, rest);
        assert_eq!(axis.step(0), channels);
        // A wound-up shaft does not creep.
        run(&mut axis, 1.0, 0.1);
        let wound = axis.state;
        assert!(wound[0] > rest[0] && wound[1] == rest[1]);
        run(&mut axis, 1.0, 0.05);
        assert_eq!(axis.state, wound);
    }
}

#[test]
fn friction_takes_its_torque_times_the_way() {
    let parameters = TwoMassParameters {
        motor_friction_nm: 0.4,
        load_friction_nm: 0.8,
        ..PARAMETERS
    };
    for tick_s in TICKS_S {
        let mut axis = axis(&parameters, tick_s);
        // Both move forward all the time: the shaft does not brake the motor that hard.
        let (mut done, mut turned) = (0.0, false);
        for torque in [6.0, 3.0, 5.0, 4.0] {
            let from = axis.state[0];
            for _ in 0..ticks(0.01, tick_s) {
                axis.drive(torque);
                turned |= axis.state[2] <= 0.0 || axis.state[3] < 0.0;
            }
            done += torque * (axis.state[0] - from);
        }
        assert!(!turned);
        let taken = 0.4 * axis.state[0] + 0.8 * axis.state[1];
        near(linear::energy(&axis) + taken, done, 1e-9);
    }
}

#[test]
fn a_peak_above_stiction_is_seen_within_a_piece() {
    let parameters = TwoMassParameters {
        load_friction_nm: 2.0,
        load_stiction_nm: 3.0,
        ..PARAMETERS
    };
    let omega = (430.0f64 / 1e-3).sqrt();
    for tick_s in TICKS_S {
        // The shaft's torque is above stiction for this angle before and after its peak.
        for window in [0.1, 0.01, 1e-3, -1e-3f64] {
            let rise = window.signum() * (1.0 - window.cos());
            let mut axis = axis(&parameters, tick_s);
            for tick in 1..=ticks(5e-3, tick_s) {
                axis.drive(3.0 / (2.0 - rise));
                let breaks = window > 0.0 && tick as f64 * tick_s > (PI - window) / omega;
                assert_eq!(axis.state[1] != 0.0 || axis.state[3] != 0.0, breaks);
            }
        }
    }
}
