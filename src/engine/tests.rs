//! The engine as its users drive it: ticks, resets, words that do not fit.

#[cfg(feature = "jit")]
use super::flat::Flat;
use super::flat::mask;
use super::random::{Case, Plain, cases};
use super::{Engine, Program, Watch};
use proptest::prelude::*;
use std::sync::Arc;

/// Compares the engine with every node in every tick, with resets at some edges.
fn with_resets(case: &Case, resets: &[bool]) -> Result<(), TestCaseError> {
    let flat = Arc::new(case.flat.clone());
    let program = Arc::new(Program::planned(&flat, Watch::All, &[]));
    let mut engine = Engine::new(program);
    let mut plain = Plain::new(&case.flat);
    let mut resets = resets.iter().cycle();
    for hold in &case.stimulus {
        for &(port, word) in &hold.changes {
            prop_assert!(engine.input(port, word).is_ok());
            plain.inputs[port] = word;
        }
        for _ in 0..=hold.ticks {
            engine.settle();
            plain.settle();
            for leaf in 0..flat.leaves.len() {
                prop_assert_eq!(engine.leaf(leaf), Some(plain.leaf(leaf)), "leaf {}", leaf);
            }
            match resets.next() {
                Some(true) => {
                    engine.reset();
                    plain.reset();
                }
                _ => {
                    engine.edge();
                    plain.edge();
                }
            }
        }
    }
    Ok(())
}

proptest! {
    #[test]
    fn a_reset_is_an_edge_behind_which_registers_are_as_at_power_on(
        case in cases(true),
        resets in prop::collection::vec(prop::bool::weighted(0.3), 1..20),
    ) {
        with_resets(&case, &resets)?;
    }

    #[test]
    fn a_clone_goes_on_whichever_of_two_was_compiled_first(case in cases(true)) {
        with_clones(&case)?;
    }

    #[test]
    fn a_word_wider_than_its_port_is_refused_and_nothing_is_set(
        case in cases(true),
        word: u64,
        all: bool,
    ) {
        let flat = Arc::new(case.flat.clone());
        let mut engine = Engine::new(Arc::new(Program::planned(&flat, Watch::All, &[])));
        let widths = &case.flat.inputs;
        for (port, &width) in widths.iter().enumerate() {
            let fits = word & !mask(width) == 0;
            let before: Vec<_> = (0..widths.len()).map(|port| engine.port(port)).collect();
            let taken = match all {
                true => {
                    let mut words: Vec<u64> = before.iter().flatten().copied().collect();
                    words[port] = word;
                    engine.inputs(&words)
                }
                false => engine.input(port, word),
            };
            prop_assert_eq!(taken.is_ok(), fits);
            for (other, &was) in before.iter().enumerate() {
                let expected = if other == port && fits { Some(word) } else { was };
                prop_assert_eq!(engine.port(other), expected);
            }
        }
    }
}

/// Compiles two clones after different runs, so that they inline different blocks; the second one and,
/// later, a clone of it do what every node does.
fn with_clones(case: &Case) -> Result<(), TestCaseError> {
    let flat = Arc::new(case.flat.clone());
    let program = Arc::new(Program::planned(&flat, Watch::All, &[]));
    let mut first = Engine::new(program);
    let mut engine = first.clone();
    let mut plain = Plain::new(&case.flat);
    let third = case.stimulus.len() / 3;
    for (number, hold) in case.stimulus.iter().enumerate() {
        if number == third {
            first.compile();
            engine.compile();
        }
        if number == 2 * third {
            engine = engine.clone();
        }
        for &(port, word) in &hold.changes {
            prop_assert!(engine.input(port, word).is_ok());
            plain.inputs[port] = word;
        }
        for _ in 0..=hold.ticks {
            first.settle();
            first.edge();
            engine.settle();
            plain.settle();
            for leaf in 0..flat.leaves.len() {
                prop_assert_eq!(engine.leaf(leaf), Some(plain.leaf(leaf)), "leaf {}", leaf);
            }
            engine.edge();
            plain.edge();
        }
    }
    Ok(())
}

#[test]
#[cfg(feature = "jit")]
fn a_clone_takes_over_code_that_another_compiles() {
    let flat = Arc::new(Flat {
        inputs: vec![4],
        ..Flat::default()
    });
    let program = Arc::new(Program::planned(&flat, Watch::All, &[]));
    let mut first = Engine::new(program);
    let mut second = first.clone();
    let mut interpreted = first.clone();
    interpreted.interpret();
    assert!(first.compile());
    for engine in [&mut second, &mut interpreted] {
        for _ in 0..256 {
            engine.settle();
            engine.edge();
        }
    }
    assert!(first.is_compiled() && second.is_compiled());
    assert!(!interpreted.is_compiled());
}
