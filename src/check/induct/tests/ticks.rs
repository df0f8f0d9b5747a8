//! Unrolled ticks compared with the evaluation of the nodes.

use crate::check::induct::frames::{Cone, Frames, Start};
use crate::engine::Place;
use crate::engine::random::{Plain, cases};
use crate::engine::sliced::gates::{Gate, Gates, Wire};
use proptest::prelude::*;

/// Returns the level of each gate, where `input` gives those of the inputs.
fn levels(gates: &Gates, input: &dyn Fn(u32) -> bool) -> Vec<bool> {
    let mut levels: Vec<bool> = Vec::new();
    for gate in &gates.gates {
        let of = |wire: Wire| levels[wire.gate()] != wire.is_inverse();
        let level = match *gate {
            Gate::Low => false,
            Gate::Input(bit) => input(bit),
            Gate::And(a, b) => of(a) && of(b),
            Gate::Xor(a, b) => of(a) != of(b),
            Gate::Mux(a, b, c) => of(if of(a) { b } else { c }),
        };
        levels.push(level);
    }
    levels
}

fn number(levels: &[bool], word: &[Wire]) -> u64 {
    let bits = word.iter().enumerate();
    bits.fold(0, |number, (bit, wire)| {
        number | u64::from(levels[wire.gate()] != wire.is_inverse()) << bit
    })
}

/// Returns the bit of a case for each wire of a word of inputs.
fn bits<'w>(gates: &'w Gates, word: &'w [Wire]) -> impl Iterator<Item = u32> + 'w {
    word.iter().map(|wire| match gates.gates[wire.gate()] {
        Gate::Input(bit) => bit,
        gate => panic!("{gate:?} is no input"),
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 96, ..ProptestConfig::default() })]

    #[test]
    fn unrolled_ticks_do_what_the_nodes_say(
        case in cases(true),
        words in prop::collection::vec(any::<u64>(), 6),
        powered in any::<bool>(),
    ) {
        let flat = case.flat;
        let start = if powered { Start::PowerOn } else { Start::Any };
        let cone = Cone::of(&flat, &flat.properties, 1 << 17);
        prop_assert!(!cone.is_abstract(&flat));
        let mut frames = Frames::new(&flat, &cone, start);
        frames.tick(words.len() - 1).expect("few gates");
        // What the inputs of the gates are.
        let mut given = std::collections::HashMap::new();
        if start == Start::Any {
            let plain = Plain::new(&flat);
            let state = frames.state(0).expect("few gates").clone();
            for (place, bit, wire) in Frames::bits(&state) {
                let word = match place {
                    Place::Register(register) => plain.registers[register as usize],
                    Place::Word(memory, word) => plain.memories[memory as usize][word as usize],
                    Place::Input(_) | Place::Node(_) => unreachable!("no state"),
                };
                for input in bits(&frames.gates, &[wire]) {
                    given.insert(input, word >> bit & 1 == 1);
                }
            }
        }
        let of = |word: u64, port: usize| word.rotate_left((port * 7) as u32);
        for (tick, word) in words.iter().enumerate() {
            let (frame, gates) = frames.tick(tick).expect("few gates");
            for (port, wires) in frame.ports.iter().enumerate() {
                for (bit, input) in bits(gates, wires).enumerate() {
                    let before = given.insert(input, of(*word, port) >> bit & 1 == 1);
                    prop_assert_eq!(before, None, "two ticks share an input");
                }
            }
        }
        let levels = levels(&frames.gates, &|bit| given[&bit]);
        let mut plain = Plain::new(&flat);
        for (tick, word) in words.iter().enumerate() {
            for port in 0..flat.inputs.len() {
                plain.inputs[port] = of(*word, port) & u64::MAX >> (64 - flat.inputs[port]);
            }
            plain.settle();
            let (frame, _) = frames.tick(tick).expect("few gates");
            for (index, wire) in frame.properties.iter().enumerate() {
                let expected = plain.leaf(flat.leaves.len() + index);
                prop_assert_eq!(number(&levels, &[*wire]), expected, "tick {}", tick);
            }
            plain.edge();
            let places = |tick| {
                let state = frames.state(tick).expect("few gates");
                let bits = Frames::bits(state).into_iter();
                bits.map(|(place, bit, _)| (place, bit)).collect::<Vec<_>>()
            };
            let [first, after] = [0, tick + 1].map(places);
            prop_assert_eq!(first, after, "every tick has the same bits of state");
            let state = frames.state(tick + 1).expect("few gates");
            for (index, word) in state.registers.iter().enumerate() {
                let expected = plain.registers[index];
                prop_assert!(word.is_empty() || number(&levels, word) == expected);
            }
            for (index, words) in state.memories.iter().enumerate() {
                for (address, word) in words.iter().flatten().enumerate() {
                    prop_assert_eq!(number(&levels, word), plain.memories[index][address]);
                }
            }
        }
    }
}
