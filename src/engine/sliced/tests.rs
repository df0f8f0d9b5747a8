//! Bit-sliced cases compared with the evaluation of the nodes, case by case.

use super::{LANES, Run, Sliced, Tick, Ticks, Turned, transpose};
use crate::engine::flat::{Flat, Id, Node, Op, Place, Port, mask};
use crate::engine::random::{Plain, cases};
use crate::engine::value;
use proptest::prelude::*;

/// Returns the netlist without registers, with at most 63 bits of input ports, and with constant
/// memories: one tick of an unrolled run.
fn combinational(mut flat: Flat) -> Flat {
    let mut bits = 0;
    let kept = flat.inputs.iter().take_while(|&&width| {
        bits += usize::from(width);
        bits < 64
    });
    let kept = kept.count();
    for node in &mut flat.nodes {
        node.op = match node.op {
            Op::Register(register) => Op::Constant(flat.registers[register as usize].power_on),
            Op::Input(port) if port as usize >= kept => {
                Op::Constant(0x5a5a_1234_0ff0_9876 & mask(node.width))
            }
            op => op,
        };
    }
    flat.inputs.truncate(kept);
    flat.registers.clear();
    flat.properties.clear();
    for memory in &mut flat.memories {
        memory.port = Port::Rom;
    }
    flat
}

/// Returns every node of a case whose input ports are packed.
fn plain(flat: &Flat, case: u64) -> Vec<u64> {
    let mut low = 0;
    let ports = flat.inputs.iter().map(|&width| {
        low += u32::from(width);
        case >> (low - u32::from(width)) & mask(width)
    });
    let ports: Vec<u64> = ports.collect();
    let mut words: Vec<u64> = Vec::new();
    for node in &flat.nodes {
        let word = match node.op {
            Op::Input(port) => ports[port as usize],
            Op::Read(memory, address) => {
                let contents = &flat.memories[memory as usize].contents;
                let word = contents.get(words[address as usize] as usize);
                word.copied().unwrap_or(0)
            }
            _ => value::of(*node, |id| (words[id as usize], flat.node(id).width)),
        };
        words.push(word);
    }
    words
}

/// Compares the values of some nodes in all cases of the group that contains case `first`.
fn check(flat: &Flat, seen: &[Id], first: u64, batch_bits: u32) {
    let places = seen.iter().map(|&id| Place::Node(id));
    let flat = Flat {
        leaves: places.collect(),
        parts: [0; 2],
        ..flat.clone()
    };
    let bits: u32 = seen.iter().map(|&id| u32::from(flat.node(id).width)).sum();
    let sliced = Sliced::of(&flat, batch_bits).expect("no registers");
    assert_eq!(sliced.batch_bits(), batch_bits);
    let mut run = Run::new(&sliced);
    let group = (LANES as u64) << batch_bits;
    let first = first / group * group;
    // Results of an earlier group must not matter.
    for batch in 0..(1 << batch_bits) / 2 + 1 {
        run.run(!first / 2 / group * group, batch);
    }
    for batch in 0..1 << batch_bits {
        run.run(first, batch);
        let packed = (0..LANES / 64).flat_map(|word| run.seen(word));
        for (lane, packed) in packed.enumerate() {
            let case = first + batch + ((lane as u64) << batch_bits);
            let words = plain(&flat, case);
            let mut low = 0;
            let mut expected = 0;
            for &id in seen {
                expected |= words[id as usize] << low;
                low += u32::from(flat.node(id).width);
            }
            assert_eq!(packed, expected, "case {case} of nodes {seen:?}");
            assert_eq!(run.case(bits as usize, lane), expected, "case {case}");
            let bit = |word: u64| word >> (lane % 64) & 1;
            let last = run.bits(bits as usize - 1, lane / 64).map(bit);
            assert!(last.eq([expected >> (bits - 1) & 1]), "case {case}");
        }
    }
}

/// Returns the last nodes of a netlist in groups of at most 64 bits.
fn groups(flat: &Flat) -> Vec<Vec<Id>> {
    let (mut groups, mut bits) = (vec![Vec::new()], 0);
    for id in (0..flat.nodes.len() as Id).rev().take(24) {
        bits += usize::from(flat.node(id).width);
        if bits > 64 {
            groups.push(Vec::new());
            bits = flat.node(id).width.into();
        }
        groups.last_mut().expect("there is one").push(id);
    }
    groups
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, ..ProptestConfig::default() })]

    #[test]
    fn random_netlists_do_what_the_nodes_say(
        case in cases(true),
        first in any::<u64>(),
        batch_bits in 0u32..3,
    ) {
        let flat = combinational(case.flat);
        for group in groups(&flat) {
            check(&flat, &group, first / 2, batch_bits);
        }
    }
}

/// Returns the netlist with at most 64 bits of state and 64 bits of input ports: other registers
/// and ports are constant, other memories are not written.
fn narrow(mut flat: Flat) -> Flat {
    let (mut left, mut kept) = (64, Vec::new());
    let mut room = |bits: usize| {
        let fits = bits <= left;
        left -= if fits { bits } else { 0 };
        fits
    };
    let registers: Vec<bool> = flat
        .registers
        .iter()
        .map(|one| room(one.width.into()))
        .collect();
    for (number, _) in registers.iter().enumerate().filter(|(_, kept)| **kept) {
        kept.push(Place::Register(number as u32));
    }
    for (number, memory) in flat.memories.iter_mut().enumerate() {
        let words = memory.contents.len();
        if memory.port == Port::Rom || !room(words * usize::from(memory.width)) {
            memory.port = Port::Rom;
        } else {
            kept.extend((0..words as u32).map(|word| Place::Word(number as u32, word)));
        }
    }
    let mut bits = 0;
    let ports = flat.inputs.iter().take_while(|&&width| {
        bits += usize::from(width);
        bits <= 64
    });
    let ports = ports.count();
    flat.inputs.truncate(ports);
    for node in &mut flat.nodes {
        node.op = match node.op {
            Op::Input(port) if port as usize >= ports => Op::Constant(1),
            Op::Register(register) if !registers[register as usize] => {
                Op::Constant(flat.registers[register as usize].power_on)
            }
            op => op,
        };
    }
    flat.leaves = (0..ports as u32).map(Place::Input).chain(kept).collect();
    flat.parts = [ports, flat.leaves.len()];
    flat
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 128, ..ProptestConfig::default() })]

    /// Compares a tick as gates with the nodes, on states and inputs of a random run.
    #[test]
    fn a_tick_of_random_netlists_is_that_of_their_nodes(
        case in cases(true),
        words in prop::collection::vec(any::<u64>(), 1..600),
    ) {
        let flat = narrow(case.flat);
        let leaves = flat.leaves.clone();
        let held = flat.parts[0]..flat.parts[1];
        let width = |leaf: usize| match leaves[leaf] {
            Place::Input(port) => flat.inputs[port as usize],
            Place::Register(register) => flat.registers[register as usize].width,
            Place::Word(memory, _) => flat.memories[memory as usize].width,
            Place::Node(id) => flat.node(id).width,
        };
        let packed = |leaves: std::ops::Range<usize>, word: &dyn Fn(usize) -> u64| {
            let mut low = 0u32;
            leaves.fold(0, |packed, leaf| {
                low += u32::from(width(leaf));
                packed | word(leaf) << (low - u32::from(width(leaf)))
            })
        };
        let mut plain = Plain::new(&flat);
        let (mut before, mut inputs) = (Vec::new(), Vec::new());
        let (mut expected, mut holds) = (Vec::new(), Vec::new());
        for (number, word) in words.iter().take(LANES).enumerate() {
            for (port, &width) in flat.inputs.iter().enumerate() {
                plain.inputs[port] = word.rotate_left((port * 7) as u32) & mask(width);
            }
            plain.settle();
            before.push(packed(held.clone(), &|leaf| plain.leaf(leaf)));
            inputs.push(packed(0..flat.parts[0], &|leaf| plain.leaf(leaf)));
            let properties = 0..flat.properties.len();
            holds.push(properties.clone().all(|one| plain.leaf(leaves.len() + one) == 1));
            plain.edge();
            expected.push(packed(held.clone(), &|leaf| plain.leaf(leaf)));
            if number % 50 == 49 {
                plain = Plain::new(&flat);
            }
        }
        let properties: Vec<usize> = (0..flat.properties.len()).collect();
        let tick = Tick::of(&flat, &properties, &[]).expect("narrow enough");
        let mut ticks = Ticks::new(&tick);
        for _ in 0..2 {
            let words = before.chunks(64).zip(inputs.chunks(64)).enumerate();
            for (word, (states, inputs)) in words {
                ticks.states(word, &Turned::of(states.iter().copied()));
                ticks.inputs(word, &Turned::of(inputs.iter().copied()));
            }
            ticks.run();
            for (word, expected) in expected.chunks(64).enumerate() {
                prop_assert_eq!(&ticks.after(word)[..expected.len()], expected);
                let there = u64::MAX >> (64 - expected.len());
                let mut different: Vec<u64> = Vec::new();
                ticks.each_after(word, there, |state| {
                    if !different.contains(&state) {
                        different.push(state);
                    }
                });
                let mut firsts = Vec::new();
                for (lane, state) in expected.iter().enumerate() {
                    if !firsts.contains(state) {
                        firsts.push(*state);
                        prop_assert_eq!(ticks.leading(word, there, *state), Some(lane));
                    }
                }
                prop_assert_eq!(different, firsts);
                for (lane, held) in holds[word * 64..].iter().take(64).enumerate() {
                    prop_assert_eq!(ticks.holds(word) >> lane & 1 == 1, *held);
                }
            }
            // Another order, and fewer cases: results of an earlier run must not matter.
            for list in [&mut before, &mut inputs, &mut expected] {
                list.reverse();
                list.truncate(list.len().div_ceil(2));
            }
            holds.reverse();
            holds.truncate(before.len());
        }
    }
}

/// Returns every operation on words of `width` bits.
fn operations(width: u8) -> Flat {
    let mut flat = Flat {
        inputs: vec![width, width, 1],
        ..Flat::default()
    };
    let mut node = |op, width| {
        flat.nodes.push(Node {
            op,
            width,
            instance: 0,
        });
    };
    node(Op::Input(0), width);
    node(Op::Input(1), width);
    node(Op::Input(2), 1);
    node(Op::Constant(0x2d & mask(width)), width);
    for (a, b) in [(0, 1), (0, 3), (3, 1), (0, 0)] {
        for op in [
            Op::Add(a, b),
            Op::Subtract(a, b),
            Op::Multiply(a, b),
            Op::And(a, b),
            Op::Or(a, b),
            Op::Xor(a, b),
            Op::Mux(2, a, b),
        ] {
            node(op, width);
        }
        for op in [Op::Equal(a, b), Op::Below(a, b), Op::BelowSigned(a, b)] {
            node(op, 1);
        }
        node(Op::Join(a, b), 2 * width);
    }
    node(Op::Not(0), width);
    node(Op::Negate(0), width);
    for by in [0, 1, width - 1, width, 64] {
        node(Op::ShiftLeft(0, by), width);
        node(Op::ShiftRight(0, by), width);
        node(Op::ShiftRightSigned(0, by), width);
    }
    node(Op::Slice(0, width - 1), 1);
    node(Op::Slice(0, width / 2), width - width / 2);
    node(Op::Extend(0), 2 * width);
    node(Op::ExtendSigned(0), 2 * width);
    flat
}

#[test]
fn every_operation_at_every_narrow_width() {
    for width in 1..=16 {
        let flat = operations(width);
        for id in 0..flat.nodes.len() as Id {
            // All cases of narrow words, some of wide ones.
            let all = (1u64 << (2 * width + 1)).div_ceil(LANES as u64);
            let step = all.div_ceil(8);
            for block in (0..all).step_by(step as usize) {
                check(&flat, &[id], block * LANES as u64, 0);
            }
        }
    }
}

#[test]
fn turned_over_twice_is_as_before() {
    let word = |k: u64| (k + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    let words: [u64; 64] = std::array::from_fn(|k| word(k as u64));
    let mut turned = words;
    transpose(&mut turned);
    for (i, &word) in words.iter().enumerate() {
        for (k, &column) in turned.iter().enumerate() {
            assert_eq!(word >> k & 1, column >> i & 1);
        }
    }
    transpose(&mut turned);
    assert_eq!(turned, words);
}
