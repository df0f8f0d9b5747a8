//! The reference model against its equations, and what the note says of gains and words.

use motion_rtl::kernel::{Circuit, Simulator};
use motion_rtl::logic::Sim;
use motion_rtl::trajectory_controller::reference_model::{In, Reg};
use motion_rtl::trajectory_controller::{ReferenceModel, Rounding};
use proptest::prelude::*;

type Bench<'c, const P: usize, const K: usize, const Q: usize> = Simulator<ReferenceModel<P, K, Q>>;

/// p, v and a.
type State = [i128; 3];

fn state<const P: usize, const K: usize, const Q: usize>(q: &Reg<Sim, P, K, Q>) -> State {
    let q = &q.integrators;
    [q.position, q.velocity, q.acceleration].map(|word| word.get().into())
}

fn ports<const P: usize, const K: usize>(
    target: i128,
    gains: [u64; 2],
    [step, preset]: [bool; 2],
) -> In<Sim, P, K> {
    In {
        step: step.into(),
        preset: preset.into(),
        target: (target as i64).into(),
        gain_1: gains[0].into(),
        gain_2: gains[1].into(),
    }
}

/// A step, with every tick of it looked at.
fn step<'c, const P: usize, const K: usize, const Q: usize>(
    mut simulator: Bench<'c, P, K, Q>,
    target: i128,
    gains: [u64; 2],
) -> (Bench<'c, P, K, Q>, State) {
    let before = state(&simulator.registers());
    let latency = ReferenceModel::<P, K, Q>::LATENCY;
    for ticks in 1..=latency {
        let i = ports(target, gains, [ticks == 1, false]);
        simulator = simulator.step(i, |_| ()).0;
        let q = simulator.registers();
        assert_eq!(
            q.integrators.fresh.get(),
            ticks == latency,
            "after {ticks} ticks"
        );
        assert!(
            ticks == latency || state(&q) == before,
            "after {ticks} ticks"
        );
    }
    let after = state(&simulator.registers());
    (simulator, after)
}

/// The same by the equations: gains are `gains` / 2^(K − 1).
fn model(
    [p, v, _]: State,
    target: i128,
    gains: [u64; 2],
    bits: usize,
    rounding: Rounding,
) -> State {
    let unit = 1i128 << (bits - 1);
    let [first, second] = gains.map(i128::from);
    let exact = second * (first * (target - p) - v * unit);
    let square = unit * unit;
    let half = if rounding == Rounding::Nearest {
        square / 2
    } else {
        0
    };
    // The first product has its whole fraction, so there is one rounding.
    let amount = (exact.abs() + half) / square;
    let a = exact.signum() * amount;
    [p + v, v + a, a]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn every_step_is_that_of_the_equations(
        targets in prop::collection::vec(-(1i128 << 36)..1i128 << 36, 1..12),
        gains in prop::array::uniform2(0..1u64 << 16),
        nearest in any::<bool>(),
    ) {
        let rounding = if nearest { Rounding::Nearest } else { Rounding::Floor };
        let circuit = ReferenceModel::<40, 16, 57>::new(rounding);
        let mut simulator = Simulator::new(&circuit).unwrap();
        let mut expected = [0; 3];
        for &target in &targets {
            expected = model(expected, target, gains, 16, rounding);
            // Any gain is right as long as the numbers fit: an unstable pair is left in time.
            if expected.iter().any(|word| word.abs() >= 1 << 38) {
                break;
            }
            let (after, seen) = step(simulator, target, gains);
            simulator = after;
            prop_assert_eq!(seen, expected);
        }
    }
}

const P: usize = 12;
const K: usize = 7;
const Q: usize = 20;

/// The gain 2^−`a`.
fn power(a: u32) -> u64 {
    1 << (K as u32 - 1 - a)
}

/// Positions on the way to `target` from rest at 0, until nothing changes any more.
fn run(target: i128, gains: [u64; 2], rounding: Rounding) -> Vec<i128> {
    let circuit = ReferenceModel::<P, K, Q>::new(rounding);
    let mut simulator = Simulator::new(&circuit).unwrap();
    let mut positions = vec![0];
    let mut before = [0; 3];
    loop {
        let (after, seen) = step(simulator, target, gains);
        simulator = after;
        positions.push(seen[0]);
        if seen == before {
            return positions;
        }
        assert!(positions.len() < 4000, "{target}, {gains:?}: no end");
        before = seen;
    }
}

/// Gain pairs whose response is monotone: K2 >= 4·K1 and K2 <= 2, by their exponents.
fn monotone() -> impl Iterator<Item = [u32; 2]> {
    (2..5).flat_map(|a| (0..=a - 2).map(move |b| [a, b]))
}

/// What is left at the end in units of a count of 2^`fraction`, a half upwards.
fn counts(position: i128, fraction: u32) -> i128 {
    (2 * position + (1 << fraction)) >> (fraction + 1)
}

#[test]
fn the_target_is_reached_with_as_many_fraction_bits_as_the_gains_have() {
    for [a, b] in monotone() {
        for (rounding, fraction) in [(Rounding::Nearest, a + b), (Rounding::Floor, a + b + 1)] {
            for target in -12..=12i128 {
                let positions = run(target << fraction, [power(a), power(b)], rounding);
                let end = *positions.last().expect("positions");
                let seen = counts(end, fraction);
                assert_eq!(seen, target, "2^-{a}, 2^-{b}, {rounding:?}: {end}");
            }
        }
    }
}

/// Whether some target is missed with so many bits of fraction.
fn misses([a, b]: [u32; 2], rounding: Rounding, fraction: u32) -> bool {
    (-12..=12i128).any(|target| {
        let positions = run(target << fraction, [power(a), power(b)], rounding);
        counts(*positions.last().expect("positions"), fraction) != target
    })
}

#[test]
fn with_a_bit_less_a_target_is_missed() {
    let missed = |rounding, less: u32| -> Vec<[u32; 2]> {
        let pairs = monotone().filter(|&[a, b]| misses([a, b], rounding, a + b - less));
        pairs.collect()
    };
    // The other pairs happen to come to rest near enough.
    assert_eq!(
        missed(Rounding::Nearest, 1),
        [[2, 0], [3, 0], [4, 0], [4, 2]]
    );
    assert_eq!(missed(Rounding::Floor, 0), [[3, 1], [4, 1], [4, 2]]);
}

/// Every state of a model of 4 bits that some way leads to, with every target and every pair of
/// gains of 3 bits: the products fit whatever they are of, and each step is that of the equations,
/// modulo the word of positions.
#[test]
fn no_product_overflows_in_any_state() {
    type Small = ReferenceModel<4, 3, 8>;
    let circuit = Small::new(Rounding::Nearest);
    let wrap = |word: i128| (word + 8).rem_euclid(16) - 8;
    let after = |q: &Reg<Sim, 4, 3, 8>, target: i128, gains: [u64; 2]| {
        let mut q = q.clone();
        for tick in 0..Small::LATENCY {
            let i = ports(target, gains, [tick == 0, false]);
            let w = circuit.comb(&q, &i);
            q = circuit.next(q, &w, &i);
        }
        q
    };
    let mut found = std::collections::HashSet::from([[0, 0]]);
    let mut open = vec![circuit.power_on()];
    while let Some(q) = open.pop() {
        let [p, v, _] = state(&q);
        for target in -8..8i128 {
            for first in 0..8 {
                for second in 0..8 {
                    let gains = [first, second];
                    let next = after(&q, target, gains);
                    // The distance is a word of positions too.
                    let near = p + wrap(target - p);
                    let exact = model([p, v, 0], near, gains, 3, Rounding::Nearest);
                    let seen = state(&next);
                    assert_eq!(seen, exact.map(wrap), "{p}, {v} to {target}, {gains:?}");
                    if found.insert([seen[0], seen[1]]) {
                        open.push(next);
                    }
                }
            }
        }
    }
    assert_eq!(found.len(), 256);
}

/// Words of a gain of 1 and of a guard unit where counts have 4 of their bits, for all pairs.
const ONE: u64 = 1 << 4;
const FRACTION: u32 = 4;

/// All stable positions that the model goes through at the end of its way to a target.
fn ends(target: i128, gains: [u64; 2]) -> Vec<i128> {
    let circuit = ReferenceModel::<14, 5, 20>::new(Rounding::Nearest);
    let mut simulator = Simulator::new(&circuit).unwrap();
    let mut states: Vec<State> = Vec::new();
    loop {
        let (after, seen) = step(simulator, target, gains);
        simulator = after;
        if let Some(begin) = states.iter().position(|state| state[..2] == seen[..2]) {
            return states[begin..].iter().map(|state| state[0]).collect();
        }
        states.push(seen);
    }
}

/// Pairs of all words of 5 bits with a product of a guard unit at least: in the stated regions every
/// target is reached to the count, however long one waits; and beyond them one is missed by a
/// response that never ends.
#[test]
fn targets_are_reached_by_all_pairs_of_gains() {
    let reached = |gains: [u64; 2]| {
        (-6..=6i128).all(|target| {
            let ends = ends(target << FRACTION, gains);
            ends.iter().all(|&end| counts(end, FRACTION) == target)
        })
    };
    let mut pairs = 0;
    for first in 1..ONE {
        for second in 2 * first..2 * ONE {
            if first * second >= (ONE * ONE) >> FRACTION {
                pairs += 1;
                assert!(reached([first, second]), "{first}, {second}");
            }
        }
    }
    assert_eq!(pairs, 222);
    // A product below a guard unit, and a response that is hardly damped.
    assert!(!reached([1, 7]));
    assert!(!reached([12, 2]));
}

#[test]
fn the_response_is_monotone_and_mirrored() {
    for [a, b] in monotone() {
        for target in 0..=300i128 {
            let gains = [power(a), power(b)];
            let up = run(target, gains, Rounding::Nearest);
            assert!(up.is_sorted(), "2^-{a}, 2^-{b} to {target}: {up:?}");
            let down = run(-target, gains, Rounding::Nearest);
            let mirrored: Vec<_> = down.iter().map(|position| -position).collect();
            assert_eq!(up, mirrored);
        }
    }
}

#[test]
fn preset_gives_up_a_step_in_every_tick_of_it() {
    let circuit = ReferenceModel::<P, K, Q>::default();
    for given_up in 1..=ReferenceModel::<P, K, Q>::LATENCY + 2 {
        let mut simulator = Simulator::new(&circuit).unwrap();
        for tick in 0..=given_up {
            let i = ports(500, [33, 50], [tick == 0, tick == given_up]);
            simulator = simulator.step(i, |_| ()).0;
        }
        assert_eq!(state(&simulator.registers()), [500, 0, 0]);
        // And the next step is right, at once.
        let (_, seen) = step(simulator, -200, [33, 50]);
        let expected = model([500, 0, 0], -200, [33, 50], K, Rounding::Nearest);
        assert_eq!(seen, expected, "given up in tick {given_up}");
    }
}
