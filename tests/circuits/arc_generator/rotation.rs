//! The rotation stage against products of wide numbers.

use super::program::{rotated, wrap};
use motion_rtl::arc_generator::rotation::{In, Reg};
use motion_rtl::arc_generator::{Rotation, Rounding};
use motion_rtl::kernel::Simulator;
use motion_rtl::logic::Sim;
use proptest::prelude::*;

const IDLE: fn() -> Wires = Wires::default;

/// Ports in as numbers.
#[derive(Default)]
struct Wires {
    load: Option<(u64, i128)>,
    step: bool,
    halt: bool,
}

impl Wires {
    fn ports<const D: usize>(&self) -> In<Sim, D> {
        let (word, data) = self.load.unwrap_or_default();
        In {
            load: self.load.is_some().into(),
            word: word.into(),
            data: (data as u64).into(),
            step: self.step.into(),
            halt: self.halt.into(),
        }
    }
}

type Bench<'c, const P: usize, const C: usize, const S: usize, const D: usize> =
    Simulator<Rotation<P, C, S, D>>;

fn tick<'c, const P: usize, const C: usize, const S: usize, const D: usize>(
    simulator: Bench<'c, P, C, S, D>,
    wires: &Wires,
) -> Bench<'c, P, C, S, D> {
    simulator.step(wires.ports(), |_| ()).0
}

fn load<'c, const P: usize, const C: usize, const S: usize, const D: usize>(
    simulator: Bench<'c, P, C, S, D>,
    word: u64,
    data: i128,
) -> Bench<'c, P, C, S, D> {
    let load = Some((word, data));
    tick(simulator, &Wires { load, ..IDLE() })
}

fn vector<const P: usize, const C: usize, const S: usize>(q: &Reg<Sim, P, C, S>) -> [i128; 3] {
    [&q.row_x, &q.row_y, &q.row_z].map(|row| row.offset.get().into())
}

/// A step, with every tick of it looked at: nothing changes before its end.
fn step<'c, const P: usize, const C: usize, const S: usize, const D: usize>(
    mut simulator: Bench<'c, P, C, S, D>,
) -> (Bench<'c, P, C, S, D>, [i128; 3]) {
    let before = vector(&simulator.registers());
    let latency = Rotation::<P, C, S, D>::LATENCY;
    for ticks in 1..=latency {
        let step = ticks == 1;
        simulator = tick(simulator, &Wires { step, ..IDLE() });
        let q = simulator.registers();
        assert_eq!(
            q.control.done.get(),
            ticks == latency,
            "after {ticks} ticks"
        );
        if ticks < latency {
            assert_eq!(vector(&q), before, "after {ticks} ticks");
        }
    }
    let after = vector(&simulator.registers());
    (simulator, after)
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
        let circuit = Rotation::<P, C, 6, 4>::new(rounding);
        let mut simulator = Simulator::new(&circuit).unwrap();
        // Three rows at a time: every triple of coefficients comes in some row.
        for first in (0..4096i128).step_by(3) {
            let triple = |index: i128| [0, 4, 8].map(|low| wrap(index >> low, C));
            let matrix = [0, 1, 2].map(|row| triple((first + row) % 4096));
            for (word, data) in coefficients(&matrix) {
                simulator = load(simulator, word, data);
            }
            // Every vector comes with every 8th matrix.
            for index in (first / 3 % 8..512).step_by(8) {
                let from = [0, 3, 6].map(|low| wrap(index >> low, P));
                for (word, data) in (2..).zip(from) {
                    simulator = load(simulator, word, data);
                }
                let (after, to) = step(simulator);
                simulator = after;
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
    let circuit = Rotation::<8, 8, 11, 8>::new(Rounding::Nearest);
    let mut simulator = Simulator::new(&circuit).unwrap();
    let matrix = [[40, -20, 7], [3, 64, -9], [-31, 5, 50]];
    for (word, data) in coefficients(&matrix).chain([(2, 100), (3, -60), (4, 33)]) {
        simulator = load(simulator, word, data);
    }
    for word in (0..32).filter(|word| !(2..5).contains(word) && (*word < 8 || word % 8 > 2)) {
        simulator = load(simulator, word, 85);
    }
    let expected = rotated(&matrix, [100, -60, 33], 6, true);
    // A second start in the middle of a step is not taken.
    for ticks in 1..=Rotation::<8, 8, 11, 8>::LATENCY {
        let step = ticks == 1 || ticks == 5;
        simulator = tick(simulator, &Wires { step, ..IDLE() });
    }
    assert_eq!(vector(&simulator.registers()), expected);
    // After a halt nothing comes, and the next step is right.
    for ticks in 1..=30 {
        let (step, halt) = (ticks == 1, ticks == 6);
        let load = None;
        simulator = tick(simulator, &Wires { load, step, halt });
        assert_eq!(
            vector(&simulator.registers()),
            expected,
            "after {ticks} ticks"
        );
        assert!(!simulator.registers().control.done.get());
    }
    let (_, after) = step(simulator);
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
        let circuit = Rotation::<40, 42, 43, 42>::new(rounding);
        let mut simulator = Simulator::new(&circuit).unwrap();
        for (word, data) in coefficients(&matrix).chain((2..).zip(from)) {
            simulator = load(simulator, word, data);
        }
        let (simulator, first) = step(simulator);
        prop_assert_eq!(first, rotated(&matrix, from, 40, nearest).map(|word| wrap(word, 40)));
        let (_, second) = step(simulator);
        prop_assert_eq!(second, rotated(&matrix, first, 40, nearest).map(|word| wrap(word, 40)));
    }
}
