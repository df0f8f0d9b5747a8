//! Plants and torques of all kinds.

use super::linear::energy;
use super::*;
use proptest::prelude::*;

/// 0 in a third of the cases.
fn option(greatest: f64) -> impl Strategy<Value = f64> {
    prop_oneof![1 => Just(0.0), 2 => (0.0..1.0f64).prop_map(move |part| part * greatest)]
}

fn plants() -> impl Strategy<Value = TwoMassParameters> {
    let masses = (-5.0..-1.0f64, -5.0..-1.0f64, 0.0..5.0f64);
    // Values sometimes equal the torques below. Stiction without friction is excluded: without
    // damping a body would come back to rest where it broke loose, and stick or not depending on
    // rounding.
    let dry = || prop_oneof![2 => option(3.0), 1 => Just(1.0)];
    let rubs = (dry(), dry(), 0.5..3.0f64, 0.5..3.0f64);
    (
        masses,
        option(0.3),
        option(0.03),
        option(0.05),
        option(0.05),
        rubs,
    )
        .prop_map(
            |((motor, load, stiffness), damping, backlash, on_motor, on_load, rubs)| {
                TwoMassParameters {
                    motor_inertia_kg_m2: 10f64.powf(motor),
                    load_inertia_kg_m2: 10f64.powf(load),
                    stiffness_nm_per_rad: 10f64.powf(stiffness),
                    damping_nm_s_per_rad: damping,
                    backlash_rad: backlash,
                    motor_viscous_nm_s_per_rad: on_motor,
                    load_viscous_nm_s_per_rad: on_load,
                    motor_friction_nm: rubs.0,
                    load_friction_nm: rubs.1,
                    motor_stiction_nm: rubs.0 * rubs.2,
                    load_stiction_nm: rubs.1 * rubs.3,
                    ..PARAMETERS
                }
            },
        )
}

fn torques() -> impl Strategy<Value = Vec<f64>> {
    let torque = prop_oneof![2 => -4.0..4.0f64, 1 => Just(1.0), 1 => Just(-1.0), 1 => Just(0.0)];
    proptest::collection::vec(torque, 1..20)
}

proptest! {
    /// Only the amplifier supplies energy; dry friction dissipates what it must.
    #[test]
    fn no_energy_comes_from_nowhere(
        parameters in plants(),
        torques in torques(),
        tick_s in prop_oneof![Just(1e-6), Just(1e-5), Just(1e-4), Just(1e-3)],
    ) {
        let mut axis = axis(&parameters, tick_s);
        for torque in torques {
            for _ in 0..30 {
                let before = energy(&axis);
                let from = axis.state;
                axis.drive(torque);
                let way = [0, 1].map(|body| (axis.state[body] - from[body]).abs());
                let taken = parameters.motor_friction_nm * way[0]
                    + parameters.load_friction_nm * way[1];
                let left = before + torque * (axis.state[0] - from[0]) - taken - energy(&axis);
                let scale = before + energy(&axis) + taken;
                prop_assert!(left >= -1e-9 * scale - 1e-14, "{left} of {scale}");
                for body in [0, 1] {
                    if axis.grips[body] == Grip::Stuck {
                        prop_assert_eq!(axis.state[2 + body], 0.0);
                    }
                }
            }
        }
    }

    /// Ticks that divide a millisecond give the same result, except for a light motor that bounces
    /// between its flanks, which amplifies rounding.
    #[test]
    fn any_plant_moves_the_same_with_any_tick(parameters in plants(), torques in torques()) {
        let mut coarse = axis(&parameters, 1e-3);
        let mut fine = axis(&parameters, 1e-3 / 128.0);
        for torque in torques {
            coarse.drive(torque);
            for _ in 0..128 {
                fine.drive(torque);
            }
            let scale = coarse.state.iter().fold(1.0f64, |most, x| most.max(x.abs()));
            for row in 0..4 {
                let off = (coarse.state[row] - fine.state[row]).abs();
                prop_assert!(off < 1e-4 * scale, "{row}: {:?} {:?}", coarse.state, fine.state);
            }
        }
    }
}

/// A flank touches while the torque equals the stiction except for rounding: the shaft turns it
/// away from breaking loose.
#[test]
fn a_torque_that_is_the_stiction_to_the_bit_is_no_start() {
    let stiff = TwoMassParameters {
        motor_inertia_kg_m2: 1.4501547103768111e-5,
        load_inertia_kg_m2: 5.4918380004697615e-5,
        stiffness_nm_per_rad: 10357.041179092426,
        backlash_rad: 0.0018981312240972125,
        motor_friction_nm: 1.0,
        ..PARAMETERS
    };
    let soft = TwoMassParameters {
        motor_inertia_kg_m2: 0.0015888195642366283,
        load_inertia_kg_m2: 0.0025723945776604143,
        stiffness_nm_per_rad: 42.87856577691919,
        backlash_rad: 0.010219507281102004,
        motor_stiction_nm: 1.0,
        ..stiff
    };
    for (parameters, first) in [
        (stiff, [3.1949104035795464, -1.0]),
        (soft, [-1.5091453424424557, 3.6990841220219295]),
    ] {
        let mut coarse = axis(&parameters, 1e-3);
        let mut fine = axis(&parameters, 1e-3 / 128.0);
        for torque in first.into_iter().chain([-1.0; 400]) {
            run(&mut coarse, torque, 1e-3);
            run(&mut fine, torque, 1e-3);
            for row in 0..4 {
                near(coarse.state[row], fine.state[row], 1e-7);
            }
        }
    }
}
