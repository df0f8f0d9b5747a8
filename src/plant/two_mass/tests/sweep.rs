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
    // Friction and stiction meet the torques below in one value now and then.
    let dry = || prop_oneof![2 => option(3.0), 1 => Just(1.0)];
    let rubs = (dry(), dry(), dry(), dry());
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
                    motor_stiction_nm: rubs.2,
                    load_stiction_nm: rubs.3,
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
    /// Nothing gives energy but the amplifier; dry friction takes what it must.
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
                prop_assert!(left >= -1e-10 * scale - 1e-15, "{left} of {scale}");
                for body in [0, 1] {
                    if axis.grips[body] == Grip::Stuck {
                        prop_assert_eq!(axis.state[2 + body], 0.0);
                    }
                }
            }
        }
    }

    /// Ticks that divide a millisecond come to the same.
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
                prop_assert!(off < 1e-6 * scale, "{row}: {:?} {:?}", coarse.state, fine.state);
            }
        }
    }
}
