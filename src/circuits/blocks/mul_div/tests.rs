//! The multiplier-divider against integer arithmetic, in all architectures.

use super::{Architecture, In, MulDiv};
use crate::prelude::*;
use crate::sim::Sample;
use crate::trace::LastTicks;
use proptest::prelude::*;

const ALL: [Architecture; 3] = [
    Architecture::Radix2,
    Architecture::Radix4,
    Architecture::Combinational,
];

const IDLE: In<Value> = In {
    start: false,
    product_only: false,
    multiplicand: 0,
    multiplier: 0,
    addend: 0,
    divisor: 0,
};

/// Output ports in a tick.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Out {
    busy: bool,
    done: bool,
    quotient: u64,
    remainder: u64,
}

fn seen(now: &Sample<'_, MulDiv>) -> Out {
    Out {
        busy: now.w.busy,
        done: now.q.done,
        quotient: now.q.quotient,
        remainder: now.q.remainder,
    }
}

/// Returns quotient and remainder of the inputs; `None` if the sum is too large for a word, or the
/// divisor.
fn expected(circuit: &MulDiv, i: &In<Value>) -> Option<(u64, u64)> {
    let word = circuit.word;
    let product = u128::from(i.multiplicand) * u128::from(i.multiplier);
    let sum = product + u128::from(i.addend);
    let largest = (1u128 << word) - 1;
    if sum > largest || i.divisor >> (word - 1) != 0 {
        return None;
    }
    let divisor = u128::from(i.divisor);
    Some(match (i.product_only, divisor) {
        (true, _) => (sum as u64, 0),
        // The lower bits of the dividend: those of a word of the same width.
        (_, 0) => (largest as u64, sum as u64),
        _ => ((sum / divisor) as u64, (sum % divisor) as u64),
    })
}

/// Ticks from `start` to `done`.
fn latency(circuit: &MulDiv, i: &In<Value>) -> u64 {
    match i.product_only {
        true => circuit.product_latency(),
        false => circuit.latency(),
    }
}

/// Starts a calculation in idle, and returns its result when it is done, in time.
fn calculate(simulator: &mut Simulator<MulDiv>, i: &In<Value>) -> (u64, u64) {
    let latency = latency(simulator.circuit(), i);
    let first = simulator.step_with(i, seen).unwrap();
    assert!(!first.busy, "{i:?}: {first:?}");
    for tick in 1..latency {
        let out = simulator.step_with(&IDLE, seen).unwrap();
        assert!(out.busy && !out.done, "{i:?}, tick {tick}: {out:?}");
    }
    let out = simulator.now(seen);
    assert!(!out.busy && out.done, "{i:?}: {out:?}");
    (out.quotient, out.remainder)
}

/// Every input at small widths, even and odd ones.
#[test]
fn every_calculation_of_few_bits_is_integer_arithmetic() {
    for architecture in ALL {
        for (multiplier, word) in [(1, 1), (1, 2), (2, 2), (2, 3), (3, 4), (5, 3)] {
            let circuit = MulDiv {
                multiplier,
                word,
                architecture,
            };
            let mut simulator = LastTicks::simulator(&circuit).unwrap();
            let mut count = 0;
            let words = 1 << word;
            let operands = (0..words).flat_map(|multiplicand| {
                (0..1 << multiplier).map(move |multiplier| (multiplicand, multiplier))
            });
            let others = (0..words).flat_map(|addend| (0..words).map(move |by| (addend, by)));
            for ((multiplicand, multiplier), (addend, divisor)) in
                operands.flat_map(|one| others.clone().map(move |other| (one, other)))
            {
                for product_only in [false, true] {
                    let i = In {
                        start: true,
                        product_only,
                        multiplicand,
                        multiplier,
                        addend,
                        divisor,
                    };
                    if let Some(expected) = expected(&circuit, &i) {
                        let result = calculate(&mut simulator, &i);
                        assert_eq!(result, expected, "{circuit:?}, {i:?}");
                        count += 1;
                    }
                }
            }
            assert!(count > 1, "{circuit:?}: {count}");
        }
    }
}

#[test]
fn latencies_are_those_of_the_architectures() {
    let of = |architecture, multiplier, word| {
        let circuit = MulDiv {
            multiplier,
            word,
            architecture,
        };
        (circuit.latency(), circuit.product_latency())
    };
    assert_eq!(of(Architecture::Radix2, 25, 58), (84, 26));
    assert_eq!(of(Architecture::Radix4, 25, 58), (43, 14));
    assert_eq!(of(Architecture::Radix4, 24, 57), (42, 13));
    assert_eq!(of(Architecture::Combinational, 25, 58), (1, 1));
    assert_eq!(MulDiv::new(25, 58).latency(), 84);
    assert_eq!(Architecture::default(), MulDiv::new(1, 1).architecture);
}

/// Returns inputs that keep the assumptions, from any numbers.
fn given(circuit: &MulDiv, [multiplicand, multiplier, addend, divisor]: [u64; 4]) -> In<Value> {
    let word = circuit.word;
    let cut = |value: u64, bits: usize| value & (u64::MAX >> (64 - bits));
    let multiplier = cut(multiplier, circuit.multiplier);
    let largest = cut(u64::MAX, word);
    let most = largest / multiplier.max(1);
    let multiplicand = match most {
        u64::MAX => multiplicand,
        most => multiplicand % (most + 1),
    };
    let room = largest - multiplicand * multiplier;
    let addend = match room {
        u64::MAX => addend,
        room => addend % (room + 1),
    };
    In {
        start: true,
        product_only: false,
        multiplicand,
        multiplier,
        addend,
        divisor: if word == 1 { 0 } else { cut(divisor, word - 1) },
    }
}

/// Numbers of all lengths, 0 and all ones among them.
fn numbers() -> impl Strategy<Value = [u64; 4]> {
    let number = (any::<u64>(), 0..=64u32, any::<bool>()).prop_map(|(number, by, ones)| {
        let number = if ones { u64::MAX } else { number };
        number.checked_shr(by).unwrap_or(0)
    });
    prop::array::uniform4(number)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(40))]

    /// The full widths of the catalogue, others up to 64 bits, and odd ones.
    #[test]
    fn all_architectures_have_the_results_of_integer_arithmetic(
        widths in prop::sample::select(vec![(25, 58), (32, 64), (64, 64), (12, 35), (1, 24), (7, 63)]),
        calculations in prop::collection::vec((numbers(), any::<bool>()), 1..20),
    ) {
        let (multiplier, word) = widths;
        for architecture in ALL {
            let circuit = MulDiv { multiplier, word, architecture };
            let mut simulator = LastTicks::simulator(&circuit).unwrap();
            for &(numbers, product_only) in &calculations {
                let i = In { product_only, ..given(&circuit, numbers) };
                let expected = expected(&circuit, &i).expect("it keeps the assumptions");
                // Each starts in the tick in which the one before is done.
                assert_eq!(calculate(&mut simulator, &i), expected, "{circuit:?}, {i:?}");
            }
        }
    }

    /// Starts and resets at any time: only a start in idle counts, the results stay until the next,
    /// and a reset ends a calculation.
    #[test]
    fn starts_while_busy_are_ignored_and_a_reset_ends_a_calculation(
        ticks in prop::collection::vec(
            (numbers(), prop::bool::weighted(0.3), any::<bool>(), prop::bool::weighted(0.02)),
            1..200,
        ),
    ) {
        for architecture in ALL {
            let circuit = MulDiv { multiplier: 5, word: 9, architecture };
            let mut simulator = LastTicks::simulator(&circuit).unwrap();
            // Ticks until the calculation is done, and its result; then the result that stays.
            let (mut running, mut stays) = (None, Some((0, 0)));
            let mut done = false;
            for &(numbers, start, product_only, rst) in &ticks {
                let i = In { start, product_only, ..given(&circuit, numbers) };
                let out = simulator.step_with_reset(rst, &i, seen).unwrap();
                assert_eq!((out.busy, out.done), (running.is_some(), done), "{circuit:?}: {out:?}");
                if let Some(stays) = stays {
                    assert_eq!((out.quotient, out.remainder), stays, "{circuit:?}");
                }
                done = false;
                if running.is_none() && start {
                    stays = None;
                    running = Some((latency(&circuit, &i), expected(&circuit, &i)));
                }
                if let Some((left, result)) = &mut running {
                    *left -= 1;
                    if *left == 0 {
                        (stays, done, running) = (*result, true, None);
                    }
                }
                if rst {
                    (running, stays, done) = (None, Some((0, 0)), false);
                }
            }
        }
    }
}

#[test]
fn all_architectures_are_proved() {
    for architecture in ALL {
        for (multiplier, word) in [(1, 1), (2, 2), (2, 3)] {
            let circuit = MulDiv {
                multiplier,
                word,
                architecture,
            };
            let all = circuit.invariants();
            let inputs = |i: &In<Value>| circuit.applies(i);
            let outcome = reach(&circuit, &all).inputs(inputs).run();
            let outcome = outcome.expect("narrow enough");
            assert!(
                matches!(outcome, Outcome::Proof(_)),
                "{circuit:?}: {outcome}"
            );
        }
    }
}
