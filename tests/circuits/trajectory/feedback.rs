//! Error feedback against whole numbers: every case where words are narrow, random ones at full width.

use motion_rtl::circuits::trajectory_controller::error_feedback::{FeedbackGains, In};
use motion_rtl::circuits::trajectory_controller::widths::FeedbackWidths;
use motion_rtl::circuits::trajectory_controller::{ErrorFeedback, Widths};
use motion_rtl::hdl::{Value, zero};
use motion_rtl::sim::Simulator;
use motion_rtl::trace::LastTicks;
use proptest::prelude::*;
use proptest::test_runner::{Config, TestRunner};

/// `bits` of a number, signed.
fn cut(number: i128, bits: usize) -> i128 {
    let above = 128 - bits as u32;
    number << above >> above
}

/// N·(e − s·t) + T·s·t, each product rounded down; words wrap.
pub fn expected(circuit: &ErrorFeedback, i: &In<Value>) -> Vec<i128> {
    let FeedbackWidths {
        count,
        position,
        gain,
    } = circuit.widths;
    let guard = position - count;
    let axes = 0..circuit.axes;
    let error = axes.clone().map(|k| {
        let off = i128::from(i.command[k]) - (i128::from(i.position[k]) << guard);
        cut(off, position)
    });
    let error: Vec<i128> = error.collect();
    let way = |k: usize| cut(i128::from(i.path[k] - i.behind[k]), (guard + 3) / 2 * 2);
    let along: i128 = axes.clone().map(|k| error[k] * way(k)).sum();
    let along = cut(along >> guard, position + 2);
    let [n, t] = [i.gains.normal_gain, i.gains.tangential_gain].map(i128::from);
    let of_axis = |k: usize| {
        let tangential = cut((along * way(k)) >> guard, position + 2);
        let normal = cut(error[k] - tangential, position + 2);
        (n * normal + t * tangential) >> (gain / 2)
    };
    axes.map(of_axis).collect()
}

/// Feeds back once, tick by tick; a start on the way is not taken, and what is given is not held.
fn hold(simulator: &mut Simulator<ErrorFeedback>, circuit: &ErrorFeedback, i: &In<Value>) {
    let idle = In {
        gains: i.gains.clone(),
        ..zero(circuit)
    };
    simulator.step_with(i, |_| ()).unwrap();
    for tick in 1..circuit.latency() {
        let start = tick == circuit.latency() / 2;
        let given = In {
            start,
            ..idle.clone()
        };
        let done = simulator.step_with(&given, |now| now.q.done).unwrap();
        assert!(!done, "tick {tick}");
    }
    let (done, busy, sum) = simulator
        .step_with(&idle, |now| (now.q.done, now.w.busy, now.q.sum.clone()))
        .unwrap();
    assert!(done && !busy);
    let sum: Vec<i128> = sum.into_iter().map(i128::from).collect();
    assert_eq!(sum, expected(circuit, i), "{i:?}");
}

/// Two axes cannot be visited whole: all of one, at an odd and an even number of guard bits and of
/// bits of a gain.
#[test]
fn every_case_of_an_axis() {
    for (count, position, gain) in [(2, 3, 3), (1, 3, 2)] {
        let widths = FeedbackWidths {
            count,
            position,
            gain,
        };
        let circuit = ErrorFeedback { widths, axes: 1 };
        let mut simulator = LastTicks::simulator(&circuit).unwrap();
        simulator.compile();
        let signed = |bits: usize| -(1i64 << (bits - 1))..1 << (bits - 1);
        for command in signed(position) {
            for way in signed(position) {
                for at in signed(count) {
                    for gains in 0..1u64 << (2 * gain) {
                        let i = In {
                            start: true,
                            command: vec![command],
                            path: vec![way],
                            behind: vec![0],
                            position: vec![at],
                            gains: FeedbackGains {
                                tangential_gain: gains >> gain,
                                normal_gain: gains & ((1 << gain) - 1),
                            },
                        };
                        hold(&mut simulator, &circuit, &i);
                    }
                }
            }
        }
    }
}

#[test]
fn random_errors_and_directions_of_two_to_four_axes() {
    for axes in [2, 3, 4] {
        let widths = Widths::FULL.feedback();
        let circuit = ErrorFeedback { widths, axes };
        assert_eq!(circuit.latency(), 27);
        let mut compiled = Simulator::new(&circuit).unwrap();
        compiled.compile();
        let each = |most: i64| proptest::collection::vec(-most..=most, axes);
        // From errors of a guard unit to all that there is.
        let near = (0..46u32).prop_flat_map(move |bits| each(1i64 << bits));
        let gain = || (0..=16u32).prop_flat_map(|bits| 0..1u64 << bits);
        let cases = (
            near,
            each(1 << 29),
            each(1 << 45),
            each(1 << 16),
            gain(),
            gain(),
        );
        let config = Config {
            cases: 2000,
            ..Config::default()
        };
        let held = TestRunner::new(config).run(&cases, |(near, position, path, way, t, n)| {
            let near = near.iter().zip(&position);
            let word = |number: i64| number << 17 >> 17;
            let i = In {
                start: true,
                command: near.map(|(near, at)| word(near + (at << 16))).collect(),
                behind: path.iter().zip(way).map(|(to, way)| to - way).collect(),
                path,
                position,
                gains: FeedbackGains {
                    tangential_gain: t,
                    normal_gain: n,
                },
            };
            hold(&mut compiled.clone(), &circuit, &i);
            Ok(())
        });
        held.unwrap();
    }
}

/// With equal gains no direction is left but for the rounding; along the path and across it each gain
/// alone acts.
#[test]
fn each_gain_is_of_its_direction() {
    let widths = Widths::FULL.feedback();
    let circuit = ErrorFeedback { widths, axes: 2 };
    let mut simulator = LastTicks::simulator(&circuit).unwrap();
    let mut fed = |way: [i64; 2], error: [i64; 2], tangential_gain: u64, normal_gain: u64| {
        let i = In {
            start: true,
            command: error.to_vec(),
            path: way.to_vec(),
            gains: FeedbackGains {
                tangential_gain,
                normal_gain,
            },
            ..zero(&circuit)
        };
        hold(&mut simulator, &circuit, &i);
        simulator.registers().q.sum
    };
    let near = |seen: Vec<i64>, exact: [f64; 2], off: f64| {
        for (seen, exact) in seen.into_iter().zip(exact) {
            assert!((seen as f64 - exact).abs() <= off, "{seen}, not {exact}");
        }
    };
    // 3, 4, 5: along (3, 4)/5 there are 3·0.6 + 1·0.8 = 2.6 of (3, 1) mm, across it 1.8·(0.8, −0.6).
    let mm = 65_536_000;
    let (way, error) = ([39_322, 52_429], [3 * mm, mm]);
    let [tangential, normal] = [[1.56, 2.08], [1.44, -1.08]];
    let units = |of: [f64; 2], gain: f64| of.map(|part| part * gain * mm as f64);
    // A direction is right to half a guard unit of a count, 2^−17 of an error of 3 mm.
    near(fed(way, error, 512, 0), units(tangential, 2.0), 8e3);
    near(fed(way, error, 0, 768), units(normal, 3.0), 12e3);
    near(fed(way, error, 640, 640), units([3.0, 1.0], 2.5), 1.0);
    // Without a direction all of it is normal.
    near(fed([0, 0], error, 65_535, 256), units([3.0, 1.0], 1.0), 1.0);
}
