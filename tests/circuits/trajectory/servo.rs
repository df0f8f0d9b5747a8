//! The servo's arithmetic against its equations, tick by tick, at full width and at the edges of
//! small words.

use motion_rtl::kernel::Simulator;
use motion_rtl::logic::Sim;
use motion_rtl::trajectory_controller::servo::{In, Reg};
use motion_rtl::trajectory_controller::{Rounding, Servo};
use proptest::prelude::*;

/// What the equations know from step to step.
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

/// Bits of counts, of points, of the model's gains and of the loops'.
#[derive(Debug, Clone, Copy)]
struct Widths {
    counts: u32,
    points: u32,
    model: u32,
    gain: u32,
}

/// `value`·`gain` / 2^bits towards zero.
fn scaled(value: i128, gain: u64, bits: u32) -> i128 {
    value.signum() * ((value.abs() * i128::from(gain)) >> bits)
}

impl Loop {
    /// A step to a target with the motor at `feedback` counts.
    fn step(self, target: i128, feedback: i128, settings: &Settings, widths: Widths) -> Loop {
        let one = 1i128 << (widths.model - 1);
        let [p, v] = self.model;
        let [k1, k2] = settings.model.map(i128::from);
        let exact = k2 * (k1 * (target - p) - v * one);
        let a = exact.signum() * ((exact.abs() + one * one / 2) / (one * one));
        // What the model moved in this step is its velocity before it.
        let (position, moved) = (p + v, v);
        let guard = widths.points - widths.counts;
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

type Full = Servo<31, 47, 16, 64, 24, 58, 16>;
/// Two guard bits, gains of 6.
type Small = Servo<6, 8, 6, 15, 6, 19, 6>;

fn ports<const P: usize, const K: usize, const G: usize, const T: usize>(
    target: i128,
    settings: &Settings,
    [step, preset]: [bool; 2],
    [a, b]: [bool; 2],
) -> In<Sim, P, K, G, T> {
    In {
        step: step.into(),
        preset: preset.into(),
        target: (target as i64).into(),
        a: a.into(),
        b: b.into(),
        home: false.into(),
        gain_1: settings.model[0].into(),
        gain_2: settings.model[1].into(),
        position_gain: settings.position.into(),
        speed_gain: settings.speed.into(),
        integral_gain: settings.integral.into(),
        inertia: settings.inertia.into(),
        limit: settings.limit.into(),
    }
}

/// Channels of an encoder at a count.
fn channels(count: i128) -> [bool; 2] {
    let quarter = count.rem_euclid(4);
    [quarter == 1 || quarter == 2, quarter >= 2]
}

/// What is told in a period: how far the motor moves, and the target.
type Period = (i128, i128);

/// Runs periods on a circuit and on the equations; nothing changes before its tick.
macro_rules! against_equations {
    ($circuit:ty, $registers:ty, $settings:expr, $periods:expr, $widths:expr) => {{
        let circuit = <$circuit>::new(Rounding::Nearest);
        let settings: &Settings = $settings;
        let mut simulator = Simulator::new(&circuit).unwrap();
        let mut expected = Loop::default();
        let mut count = 0i128;
        let output = |q: &$registers| {
            let q = &q.arithmetic;
            (i128::from(q.torque.get()), q.saturated.get())
        };
        // The counter's synchronizers fill.
        for _ in 0..4 {
            let i = ports(0, settings, [false; 2], channels(0));
            simulator = simulator.step(i, |_| ()).0;
        }
        for &(moves, target) in $periods {
            for _ in 0..i128::abs(moves) {
                count += moves.signum();
                for _ in 0..2 {
                    let i = ports(target, settings, [false; 2], channels(count));
                    simulator = simulator.step(i, |_| ()).0;
                }
            }
            for _ in 0..6 {
                let i = ports(target, settings, [false; 2], channels(count));
                simulator = simulator.step(i, |_| ()).0;
            }
            let feedback = i128::from(simulator.registers().detector.position.get());
            assert_eq!(feedback.abs(), count.abs());
            let before = output(&simulator.registers());
            let next = expected.step(target, feedback, settings, $widths);
            for tick in 1..=<$circuit>::LATENCY {
                let i = ports(target, settings, [tick == 1, false], channels(count));
                simulator = simulator.step(i, |_| ()).0;
                let q = simulator.registers();
                assert_eq!(
                    q.arithmetic.fresh.get(),
                    tick == <$circuit>::LATENCY,
                    "tick {tick}"
                );
                if tick < <$circuit>::LATENCY {
                    assert_eq!(output(&q), before, "tick {tick}");
                }
            }
            expected = next;
            assert_eq!(
                output(&simulator.registers()),
                (expected.torque, expected.saturated)
            );
        }
        expected
    }};
}

const FULL: Widths = Widths {
    counts: 31,
    points: 47,
    model: 16,
    gain: 24,
};
const SMALL: Widths = Widths {
    counts: 6,
    points: 8,
    model: 6,
    gain: 6,
};

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
        against_equations!(Full, Reg<Sim, 31, 47, 16, 64, 24, 58, 16>, &settings, &periods, FULL);
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
        against_equations!(Small, Reg<Sim, 6, 8, 6, 15, 6, 19, 6>, &settings, &periods, SMALL);
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
    let state = against_equations!(
        Full,
        Reg<Sim, 31, 47, 16, 64, 24, 58, 16>,
        &settings,
        &blocked,
        FULL
    );
    assert_eq!((state.torque, state.saturated), (1000, true));
    assert!(state.integral <= 16_000, "{state:?}");
    let mut released = blocked;
    released.extend((0..12).map(|_| (0, -10_000_000)));
    let state = against_equations!(
        Full,
        Reg<Sim, 31, 47, 16, 64, 24, 58, 16>,
        &settings,
        &released,
        FULL
    );
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
    let circuit = Full::new(Rounding::Nearest);
    for given_up in 1..=Full::LATENCY + 2 {
        let mut simulator = Simulator::new(&circuit).unwrap();
        // A first step whole, so that there is something to forget.
        for tick in 0..=Full::LATENCY {
            let i = ports(900_000, &settings, [tick == 0, false], [false; 2]);
            simulator = simulator.step(i, |_| ()).0;
        }
        // The motor has moved since.
        for count in 1..=3 {
            for _ in 0..4 {
                let i = ports(900_000, &settings, [false; 2], channels(count));
                simulator = simulator.step(i, |_| ()).0;
            }
        }
        let feedback = i128::from(simulator.registers().detector.position.get());
        assert_eq!(feedback.abs(), 3);
        for tick in 0..=given_up {
            let i = ports(
                70_000,
                &settings,
                [tick == 0, tick == given_up],
                channels(3),
            );
            simulator = simulator.step(i, |_| ()).0;
        }
        let q = simulator.registers();
        assert_eq!(q.model.integrators.position.get(), 70_000);
        assert_eq!(
            (q.arithmetic.torque.get(), q.arithmetic.saturated.get()),
            (0, false)
        );
        // The preset itself is a step of the loops on the model that it has put there.
        let start = Loop {
            model: [70_000, 0],
            previous: feedback,
            ..Loop::default()
        };
        for _ in 0..2 * Full::LATENCY {
            let i = ports(70_000, &settings, [false; 2], channels(3));
            simulator = simulator.step(i, |_| ()).0;
        }
        let expected = start.step(70_000, feedback, &settings, FULL);
        assert!(!expected.saturated);
        let q = simulator.registers();
        let seen = (
            i128::from(q.arithmetic.torque.get()),
            q.arithmetic.saturated.get(),
        );
        assert_eq!(
            seen,
            (expected.torque, expected.saturated),
            "given up in tick {given_up}"
        );
    }
}
