//! The rotation stage against products of wide numbers.

use super::program::{rotated, wrap};
use motion_rtl::circuits::arc_generator::rotation::In;
use motion_rtl::circuits::arc_generator::{Rotation, Rounding, Widths};
use motion_rtl::circuits::blocks::RecordWord;
use motion_rtl::hdl::{Cut, Value};
use motion_rtl::sim::Simulator;
use motion_rtl::trace::LastTicks;
use proptest::prelude::*;

/// Ports in with a word that is loaded.
fn word((word, data): (u64, u64)) -> In<Value> {
    let record = RecordWord {
        load: true,
        word,
        data,
    };
    In { record, ..idle() }
}

fn idle() -> In<Value> {
    let record = RecordWord {
        load: false,
        word: 0,
        data: 0,
    };
    In {
        record,
        step: false,
        halt: false,
    }
}

/// A rotation for points, coefficients and words of records of these widths.
fn simulator(
    (point, coefficient, data): (usize, usize, usize),
    rounding: Rounding,
) -> Simulator<Rotation> {
    let widths = Widths {
        point,
        coefficient,
        data,
        ..Widths::FULL
    };
    LastTicks::simulator(&Rotation { widths, rounding }).unwrap()
}

fn load(simulator: &mut Simulator<Rotation>, words: impl IntoIterator<Item = (u64, i128)>) {
    let width = simulator.signals().i.record.data.width();
    for (number, data) in words {
        let loaded = (number, (data as u64).cut(width));
        simulator.step_with(&word(loaded), |_| ()).unwrap();
    }
}

fn vector(simulator: &mut Simulator<Rotation>) -> [i128; 3] {
    let at = simulator.signals();
    let at = [at.w.x, at.w.y, at.w.z];
    at.map(|word| simulator.get(word).into())
}

/// A step, with every tick of it looked at: nothing changes before its end.
fn step(simulator: &mut Simulator<Rotation>) -> [i128; 3] {
    let before = vector(simulator);
    let latency = simulator.circuit().latency();
    for ticks in 1..=latency {
        let step = ticks == 1;
        simulator.step_with(&In { step, ..idle() }, |_| ()).unwrap();
        let done = simulator.see(|s| s.w.done);
        assert_eq!(done, ticks == latency, "after {ticks} ticks");
        if ticks < latency {
            assert_eq!(vector(simulator), before, "after {ticks} ticks");
        }
    }
    vector(simulator)
}

fn coefficients(matrix: &[[i128; 3]; 3]) -> impl Iterator<Item = (u64, i128)> {
    let rows = matrix.iter().zip([8, 16, 24]);
    rows.flat_map(|(row, first)| (first..).zip(row.iter().copied()))
}

#[test]
fn every_small_product_is_right_under_both_roundings() {
    const P: usize = 3;
    const C: usize = 4;
    for rounding in [Rounding::Nearest, Rounding::Floor] {
        let mut simulator = simulator((P, C, 4), rounding);
        // Three rows at a time: every triple of coefficients comes in some row.
        for first in (0..4096i128).step_by(3) {
            let triple = |index: i128| [0, 4, 8].map(|low| wrap(index >> low, C));
            let matrix = [0, 1, 2].map(|row| triple((first + row) % 4096));
            load(&mut simulator, coefficients(&matrix));
            // Every vector comes with every 8th matrix.
            for index in (first / 3 % 8..512).step_by(8) {
                let from = [0, 3, 6].map(|low| wrap(index >> low, P));
                load(&mut simulator, (2..).zip(from));
                let to = step(&mut simulator);
                let expected = rotated(&matrix, from, C - 2, rounding == Rounding::Nearest);
                assert_eq!(
                    to,
                    expected.map(|word| wrap(word, P)),
                    "{matrix:?} times {from:?}"
                );
            }
        }
    }
}

#[test]
fn words_of_other_blocks_and_steps_under_way_change_nothing() {
    let mut simulator = simulator((8, 8, 8), Rounding::Nearest);
    let matrix = [[40, -20, 7], [3, 64, -9], [-31, 5, 50]];
    let vector_words = [(2, 100), (3, -60), (4, 33)];
    load(&mut simulator, coefficients(&matrix).chain(vector_words));
    let others = (0..32).filter(|word| !(2..5).contains(word) && (*word < 8 || word % 8 > 2));
    load(&mut simulator, others.map(|word| (word, 85)));
    let expected = rotated(&matrix, [100, -60, 33], 6, true);
    // A second start in the middle of a step is not taken.
    for ticks in 1..=simulator.circuit().latency() {
        let step = ticks == 1 || ticks == 5;
        simulator.step_with(&In { step, ..idle() }, |_| ()).unwrap();
    }
    assert_eq!(vector(&mut simulator), expected);
    // After a halt nothing comes, and the next step is right.
    for ticks in 1..=30 {
        let (step, halt) = (ticks == 1, ticks == 6);
        let i = In {
            step,
            halt,
            ..idle()
        };
        simulator.step_with(&i, |_| ()).unwrap();
        assert_eq!(vector(&mut simulator), expected, "after {ticks} ticks");
        assert!(!simulator.see(|s| s.w.done));
    }
    let after = step(&mut simulator);
    assert_eq!(after, rotated(&matrix, expected, 6, true));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn every_product_of_full_width_is_right(
        matrix in prop::array::uniform3(prop::array::uniform3(-(1i128 << 40)..=1i128 << 40)),
        from in prop::array::uniform3(-(1i128 << 37)..1i128 << 37),
        nearest in any::<bool>(),
    ) {
        let rounding = if nearest { Rounding::Nearest } else { Rounding::Floor };
        let mut simulator = simulator((40, 42, 42), rounding);
        load(&mut simulator, coefficients(&matrix).chain((2..).zip(from)));
        let first = step(&mut simulator);
        assert_eq!(first, rotated(&matrix, from, 40, nearest).map(|word| wrap(word, 40)));
        let second = step(&mut simulator);
        assert_eq!(second, rotated(&matrix, first, 40, nearest).map(|word| wrap(word, 40)));
    }
}
