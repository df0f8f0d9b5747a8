//! Backlash.

use super::*;

const GAP: f64 = 0.02;
const PLAY: TwoMassParameters = TwoMassParameters {
    backlash_rad: GAP,
    ..PARAMETERS
};

#[test]
fn the_motor_crosses_the_gap_before_the_load_moves() {
    for tick_s in TICKS_S {
        for sign in [1.0, -1.0] {
            // Half of it from the middle.
            let mut axis = axis(&PLAY, tick_s);
            let touch = (2.0 * 0.5 * GAP / (2.0 / 1e-3)).sqrt();
            for tick in 1..=ticks(5e-3, tick_s) {
                axis.drive(sign * 2.0);
                let t = tick as f64 * tick_s;
                assert_eq!(axis.state[1] != 0.0, t > touch, "{t}");
                if t <= touch {
                    near(axis.state[0], sign * 1e3 * t * t, 1e-12);
                }
            }
            // All of it backwards from the flank; friction holds the load meanwhile.
            let rubbing = TwoMassParameters {
                load_friction_nm: 3.0,
                damping_nm_s_per_rad: 0.3,
                motor_friction_nm: 0.1,
                ..PLAY
            };
            let mut axis = super::axis(&rubbing, tick_s);
            run(&mut axis, sign * 0.4, 0.2);
            let [flank, load, ..] = axis.state;
            assert_eq!(load, 0.0);
            assert_eq!(axis.grips, [Grip::Stuck; 2]);
            assert!(sign * flank > 0.5 * GAP);
            run(&mut axis, -sign * 0.4, 0.2);
            assert_eq!(axis.state[1], 0.0);
            let way = sign * (flank - axis.state[0]);
            // The gap, plus the twist of the shaft by 0.3 to 0.4 N·m on each flank.
            assert!(way > GAP + 2.0 * 0.29 / 430.0 && way < GAP + 2.0 * 0.5 / 430.0);
            let turned = axis.state[0];
            run(&mut axis, -sign * 6.0, 0.01);
            assert!(sign * axis.state[1] < 0.0 && sign * (turned - axis.state[0]) > 0.0);
        }
    }
}

#[test]
fn momentum_is_kept_in_the_gap_and_in_a_blow() {
    for (tick_s, sign) in TICKS_S.into_iter().flat_map(|t| [(t, 1.0), (t, -1.0)]) {
        let mut axis = axis(&PLAY, tick_s);
        axis.state = [0.0, 0.0, sign * 4.0, sign];
        let momentum = sign * (4.0 * 1e-3 + 3e-3);
        let energy = linear::energy(&axis);
        // 3 rad/s against each other: half the gap takes 3.3 ms; an elastic impact half a period.
        let touch = 0.5 * GAP / 3.0;
        let apart = touch + std::f64::consts::PI / (430.0f64 / 1e-3 + 430.0 / 3e-3).sqrt();
        for tick in 1..=ticks(0.012, tick_s) {
            axis.drive(0.0);
            let t = tick as f64 * tick_s;
            let [_, _, motor, load] = axis.state;
            near(1e-3 * motor + 3e-3 * load, momentum, 1e-14);
            near(linear::energy(&axis), energy, 1e-13);
            if t <= touch {
                assert_eq!([motor, load], [sign * 4.0, sign]);
                assert_eq!(axis.shaft_torque_nm(), 0.0);
            }
            if t >= apart {
                // Common speed 1.75; relative speed reversed.
                near(motor, sign * -0.5, 1e-10);
                near(load, sign * 2.5, 1e-10);
                assert_eq!(axis.flank, Flank::Gap);
            }
        }
        // Across the gap to the other flank.
        let cross = GAP / 3.0;
        run(&mut axis, 0.0, apart + cross - 0.012 - 2e-4);
        assert_eq!(axis.shaft_torque_nm(), 0.0);
        run(&mut axis, 0.0, 3e-3);
        assert!(sign * axis.shaft_torque_nm() < 0.0);
    }
}

#[test]
fn a_flank_does_not_pull_and_damping_takes_from_a_blow() {
    let parameters = TwoMassParameters {
        damping_nm_s_per_rad: 0.2,
        ..PLAY
    };
    let mut axis = axis(&parameters, 1e-6);
    axis.state = [0.0, 0.0, 4.0, 0.0];
    let mut parted = 0;
    let mut before = linear::energy(&axis);
    for _ in 0..15_000 {
        axis.drive(0.0);
        assert!(axis.shaft_torque_nm() * axis.twist_rad() >= 0.0);
        let energy = linear::energy(&axis);
        match axis.flank {
            Flank::Gap => assert_eq!(axis.shaft_torque_nm(), 0.0),
            Flank::Touches(_) => assert!(energy <= before + 1e-15),
            // The shaft untwists without torque.
            Flank::Parted(side) => {
                parted += 1;
                assert!(side * axis.twist_rad() > 0.5 * GAP - 1e-12);
            }
        }
        before = energy;
        near(1e-3 * axis.state[2] + 3e-3 * axis.state[3], 4e-3, 1e-14);
    }
    assert!(parted > 0);
    let against = axis.state[2] - axis.state[3];
    assert!(against < -0.5 && against > -3.5, "{against}");
}
