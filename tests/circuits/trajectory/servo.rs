//! The servo's arithmetic against its equations, tick by tick, at full width and at the edges of
//! small words.

use motion_rtl::circuits::trajectory_controller::model_state::ModelGains;
use motion_rtl::circuits::trajectory_controller::servo::In;
use motion_rtl::circuits::trajectory_controller::servo_arithmetic::{ServoGains, ServoWidths};
use motion_rtl::circuits::trajectory_controller::{Rounding, Servo, Widths};
use motion_rtl::hdl::Value;
use motion_rtl::sim::Simulator;
use motion_rtl::trace::LastTicks;
use proptest::prelude::*;

/// State of the equations from step to step.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
struct Loop {
    /// p and v of the model.
    model: [i128; 2],
    previous: i128,
    integral: i128,
    torque: i128,
    saturated: bool,
}

#[derive(Debug, Clone, Copy)]
struct Settings {
    model: [u64; 2],
    position: u64,
    speed: u64,
    integral: u64,
    inertia: u64,
    limit: u64,
}

/// `value`·`gain` / 2^bits towards zero.
fn scaled(value: i128, gain: u64, bits: usize) -> i128 {
    value.signum() * ((value.abs() * i128::from(gain)) >> bits)
}

impl Loop {
    /// A step to a target with the motor at `feedback` counts.
    fn step(self, target: i128, feedback: i128, settings: &Settings, widths: &ServoWidths) -> Loop {
        let one = 1i128 << (widths.model_gain - 1);
        let [p, v] = self.model;
        let [k1, k2] = settings.model.map(i128::from);
        let exact = k2 * (k1 * (target - p) - v * one);
        let a = exact.signum() * ((exact.abs() + one * one / 2) / (one * one));
        // The model's move in this step is its velocity before it.
        let (position, moved) = (p + v, v);
        let guard = widths.position - widths.count;
        let bits = widths.gain - 1;
        let error = position - (feedback << guard);
        let speed_error =
            moved + scaled(error, settings.position, bits) - ((feedback - self.previous) << guard);
        // Torques with 4 bits behind the point; a gain of 1 is 2^21 words of 24 bits.
        let torque = |value: i128, gain| scaled(value << 6, gain, bits);
        let most = i128::from(settings.limit);
        let grown = self.integral + torque(speed_error, settings.integral);
        let held = grown.clamp(-most << 4, most << 4);
        let whole = torque(speed_error, settings.speed) + held + torque(a, settings.inertia);
        let wanted = (whole + 8).div_euclid(16);
        let winds = (wanted > most && speed_error >= 0) || (wanted < -most && speed_error < 0);
        Loop {
            model: [position, v + a],
            previous: feedback,
            integral: if winds { self.integral } else { held },
            torque: wanted.clamp(-most, most),
            saturated: wanted.abs() > most,
        }
    }
}

const FULL: ServoWidths = Widths::FULL.servo();
/// Two guard bits, gains of 6.
const SMALL: ServoWidths = ServoWidths {
    count: 6,
    position: 8,
    model_gain: 6,
    gain: 6,
    torque: 6,
};

fn servo(widths: ServoWidths) -> Servo {
    let rounding = Rounding::Nearest;
    Servo { widths, rounding }
}

fn ports(
    target: i128,
    settings: &Settings,
    [step, preset]: [bool; 2],
    [a, b]: [bool; 2],
) -> In<Value> {
    In {
        step,
        preset,
        target: target as i64,
        a,
        b,
        home: false,
        model_gains: ModelGains {
            gain_1: settings.model[0],
            gain_2: settings.model[1],
        },
        gains: ServoGains {
            position_gain: settings.position,
            speed_gain: settings.speed,
            integral_gain: settings.integral,
            inertia: settings.inertia,
            limit: settings.limit,
        },
    }
}

/// Channels of an encoder at a count.
fn channels(count: i128) -> [bool; 2] {
    let quarter = count.rem_euclid(4);
    [quarter == 1 || quarter == 2, quarter >= 2]
}

/// Inputs of a period: move of the motor, and the target.
type Period = (i128, i128);

/// Position of the motor as the servo knows it.
fn position(simulator: &mut Simulator<Servo>) -> i128 {
    simulator.see(|s| s.p.detector.q.position).into()
}

/// The torque, and whether it is limited.
fn output(simulator: &mut Simulator<Servo>) -> (i128, bool) {
    let torque = simulator.see(|s| s.w.torque).into();
    (torque, simulator.see(|s| s.w.saturated))
}

/// Runs periods on a circuit and on the equations; nothing changes before its tick.
fn against_equations(widths: ServoWidths, settings: &Settings, periods: &[Period]) -> Loop {
    let circuit = servo(widths);
    let mut simulator = LastTicks::simulator(&circuit).unwrap();
    let mut expected = Loop::default();
    let mut count = 0i128;
    // The counter's synchronizers fill.
    for _ in 0..4 {
        let i = ports(0, settings, [false; 2], channels(0));
        simulator.step_with(&i, |_| ()).unwrap();
    }
    for &(moves, target) in periods {
        for _ in 0..moves.abs() {
            count += moves.signum();
            for _ in 0..2 {
                let i = ports(target, settings, [false; 2], channels(count));
                simulator.step_with(&i, |_| ()).unwrap();
            }
        }
        for _ in 0..6 {
            let i = ports(target, settings, [false; 2], channels(count));
            simulator.step_with(&i, |_| ()).unwrap();
        }
        let feedback = position(&mut simulator);
        assert_eq!(feedback.abs(), count.abs());
        let before = output(&mut simulator);
        expected = expected.step(target, feedback, settings, &widths);
        let latency = circuit.latency();
        for tick in 1..=latency {
            let i = ports(target, settings, [tick == 1, false], channels(count));
            simulator.step_with(&i, |_| ()).unwrap();
            let fresh = simulator.see(|s| s.w.fresh);
            assert_eq!(fresh, tick == latency, "tick {tick}");
            if tick < latency {
                assert_eq!(output(&mut simulator), before, "tick {tick}");
            }
        }
        let due = (expected.torque, expected.saturated);
        assert_eq!(output(&mut simulator), due);
    }
    expected
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(600))]

    #[test]
    fn every_torque_is_that_of_the_equations(
        periods in prop::collection::vec((-20..=20i128, -(1i128 << 26)..1i128 << 26), 1..8),
        gains in prop::array::uniform4(0..1u64 << 24),
        shifts in prop::array::uniform4(0..20u32),
        limit in 0..32_768u64,
    ) {
        let gain = |index: usize| gains[index] >> shifts[index];
        let settings = Settings {
            model: [3277, 16_384],
            position: gain(0),
            speed: gain(1),
            integral: gain(2),
            inertia: gain(3),
            limit,
        };
        against_equations(FULL, &settings, &periods);
    }

    /// Targets and gains up to their ends: no sum leaves its word.
    #[test]
    fn no_sum_of_small_words_overflows(
        periods in prop::collection::vec((-6..=6i128, -60..=60i128), 1..20),
        position in 0..64u64,
        gains in prop::array::uniform3(0..64u64),
        limit in 0..32u64,
    ) {
        let [speed, integral, inertia] = gains;
        let settings = Settings { model: [8, 32], position, speed, integral, inertia, limit };
        // The motor stays within its counts.
        let mut at = 0i128;
        let periods: Vec<Period> = periods.into_iter().map(|(moves, target)| {
            let to = (at + moves).clamp(-30, 30);
            let moves = to - at;
            at = to;
            (moves, target)
        }).collect();
        against_equations(SMALL, &settings, &periods);
    }
}

/// A motor that cannot follow for long does not wind the integral up: once the error turns, the
/// torque leaves its limit in the same period.
#[test]
fn the_integral_does_not_wind_up() {
    let settings = Settings {
        model: [16_384, 32_768],
        position: 1 << 22,
        speed: 1 << 12,
        integral: 1 << 12,
        inertia: 0,
        limit: 1000,
    };
    let blocked: Vec<Period> = (0..60).map(|_| (0, 10_000_000)).collect();
    let state = against_equations(FULL, &settings, &blocked);
    assert_eq!((state.torque, state.saturated), (1000, true));
    assert!(state.integral <= 16_000, "{state:?}");
    let mut released = blocked;
    released.extend((0..12).map(|_| (0, -10_000_000)));
    let state = against_equations(FULL, &settings, &released);
    assert_eq!((state.torque, state.saturated), (-1000, true));
}

/// A preset gives a step up in every tick of it and begins the loops anew.
#[test]
fn preset_begins_anew_in_every_tick() {
    let settings = Settings {
        model: [16_384, 32_768],
        position: 1 << 22,
        speed: 1 << 18,
        integral: 1 << 16,
        inertia: 1 << 18,
        limit: 30_000,
    };
    let circuit = servo(FULL);
    let latency = circuit.latency();
    for given_up in 1..=latency + 2 {
        let mut simulator = LastTicks::simulator(&circuit).unwrap();
        // A first step whole, so that there is something to forget.
        for tick in 0..=latency {
            let i = ports(900_000, &settings, [tick == 0, false], [false; 2]);
            simulator.step_with(&i, |_| ()).unwrap();
        }
        // The motor has moved since.
        for count in 1..=3 {
            for _ in 0..4 {
                let i = ports(900_000, &settings, [false; 2], channels(count));
                simulator.step_with(&i, |_| ()).unwrap();
            }
        }
        let feedback = position(&mut simulator);
        assert_eq!(feedback.abs(), 3);
        for tick in 0..=given_up {
            let i = ports(
                70_000,
                &settings,
                [tick == 0, tick == given_up],
                channels(3),
            );
            simulator.step_with(&i, |_| ()).unwrap();
        }
        assert_eq!(simulator.see(|s| s.p.model.w.position), 70_000);
        assert_eq!(output(&mut simulator), (0, false));
        // The preset itself is a step of the loops on the model that it has put there.
        let start = Loop {
            model: [70_000, 0],
            previous: feedback,
            ..Loop::default()
        };
        for _ in 0..2 * latency {
            let i = ports(70_000, &settings, [false; 2], channels(3));
            simulator.step_with(&i, |_| ()).unwrap();
        }
        let expected = start.step(70_000, feedback, &settings, &FULL);
        assert!(!expected.saturated);
        let due = (expected.torque, expected.saturated);
        assert_eq!(output(&mut simulator), due, "given up in tick {given_up}");
    }
}
