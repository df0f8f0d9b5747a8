//! Results compared with a visit of all states of narrow random netlists.

use crate::check::induct::prover::{Basis, Found, Task, prove};
use crate::engine::random::parts::{Flat, Op, Place, Port};
use crate::engine::random::{Plain, cases};
use proptest::prelude::*;
use std::collections::{HashSet, VecDeque};
use std::time::Duration;

/// Greatest number of bits of the state, and of the inputs.
const STATE: usize = 9;
const INPUTS: usize = 5;

/// Returns a netlist with little state and few inputs: others are constant.
fn narrow(mut flat: Flat) -> Flat {
    let mut left = STATE;
    let mut room = |bits: usize| {
        let fits = bits <= left;
        left -= if fits { bits } else { 0 };
        fits
    };
    let registers = flat.registers.iter();
    let kept: Vec<bool> = registers.map(|one| room(one.width.into())).collect();
    for memory in &mut flat.memories {
        if !room(memory.contents.len() * usize::from(memory.width)) {
            memory.port = Port::Rom;
        }
    }
    let mut bits = 0;
    let ports: Vec<bool> = (flat.inputs.iter())
        .map(|&width| {
            bits += usize::from(width);
            bits <= INPUTS
        })
        .collect();
    for node in &mut flat.nodes {
        node.op = match node.op {
            Op::Input(port) if !ports[port as usize] => Op::Constant(1),
            Op::Register(register) if !kept[register as usize] => {
                Op::Constant(flat.registers[register as usize].power_on)
            }
            op => op,
        };
    }
    flat
}

/// Words of the registers and memories.
type State = (Vec<u64>, Vec<Vec<u64>>);

/// Returns the number of edges to a violation of each property, where inputs keep the givens.
fn visit(flat: &Flat, properties: &[usize], givens: &[usize]) -> Vec<Option<usize>> {
    let free: Vec<bool> = (0..flat.inputs.len() as u32)
        .map(|port| flat.nodes.iter().any(|node| node.op == Op::Input(port)))
        .collect();
    let widths = flat.inputs.iter().zip(&free);
    let bits: u32 = widths
        .filter(|(_, free)| **free)
        .map(|(width, _)| u32::from(*width))
        .sum();
    let mut found = vec![None; properties.len()];
    let mut plain = Plain::new(flat);
    let first: State = (plain.registers.clone(), plain.memories.clone());
    let mut seen = HashSet::from([first.clone()]);
    let mut open = VecDeque::from([(0, first)]);
    while let Some((edges, state)) = open.pop_front() {
        for case in 0..1u64 << bits {
            (plain.registers, plain.memories) = state.clone();
            let mut rest = case;
            for (port, width) in flat.inputs.iter().enumerate() {
                let taken = if free[port] { *width } else { 0 };
                plain.inputs[port] = rest & ((1 << taken) - 1);
                rest >>= taken;
            }
            plain.settle();
            let holds = |property: usize| plain.leaf(flat.leaves.len() + property) == 1;
            if !givens.iter().all(|&given| holds(given)) {
                continue;
            }
            for (found, &property) in found.iter_mut().zip(properties) {
                if found.is_none() && !holds(property) {
                    *found = Some(edges);
                }
            }
            plain.edge();
            let next = (plain.registers.clone(), plain.memories.clone());
            if seen.insert(next.clone()) {
                open.push_back((edges + 1, next));
            }
        }
    }
    found
}

/// True if the inputs keep the givens and violate the property in the last tick.
fn violates(flat: &Flat, inputs: &[Vec<u64>], property: usize, givens: &[usize]) -> bool {
    let mut plain = Plain::new(flat);
    let mut held = true;
    for ports in inputs {
        plain.inputs.clone_from(ports);
        plain.settle();
        let holds = |property: usize| plain.leaf(flat.leaves.len() + property) == 1;
        if !givens.iter().all(|&given| holds(given)) {
            return false;
        }
        held = holds(property);
        plain.edge();
    }
    !held
}

/// Compares the results for a netlist of some properties, the last of which may be a given. Returns
/// the number of proofs on each basis, and of violations that only reads of any word allow.
fn compare(mut flat: Flat, given: bool, memory_bits: usize) -> Result<[usize; 4], TestCaseError> {
    flat.leaves
        .retain(|place| !matches!(place, Place::Word(..)));
    let count = flat.properties.len();
    let (properties, givens): (Vec<usize>, Vec<usize>) =
        (0..count).partition(|index| !given || *index + 1 < count);
    let task = Task {
        flat: &flat,
        properties: properties.clone(),
        lemmas: Vec::new(),
        givens: givens.clone(),
        memory_bits,
        limit: Duration::from_secs(10),
    };
    let results = prove(&task);
    prop_assert_eq!(&results.refused, &Vec::<usize>::new());
    let expected = visit(&flat, &properties, &givens);
    let mut kinds = [0; 4];
    for (index, (found, _)) in results.found.iter().enumerate() {
        let kind = match (found, expected[index]) {
            (Found::Proved(grounds), None) => match grounds.basis {
                Basis::EveryState => 0,
                Basis::Induction(_) => 1,
                Basis::Search(_) => 2,
            },
            (Found::Violated(inputs), Some(edges))
                if violates(&flat, inputs, properties[index], &givens) =>
            {
                prop_assert!(inputs.len() > edges, "shorter than the shortest");
                continue;
            }
            (Found::Violated(_), _) if results.is_abstract => 3,
            (found, expected) => {
                let reason = format!("property {index}: {found:?}, expected {expected:?}");
                return Err(TestCaseError::fail(reason));
            }
        };
        kinds[kind] += 1;
    }
    Ok(kinds)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 160, ..ProptestConfig::default() })]

    #[test]
    fn results_are_those_of_a_visit_of_all_states(
        case in cases(true),
        given in any::<bool>(),
        expanded in any::<bool>(),
        picks in prop::collection::vec(any::<u16>(), 4),
    ) {
        let mut flat = narrow(case.flat);
        // Any single bits of the netlist.
        let single: Vec<u32> = (0..flat.nodes.len() as u32)
            .filter(|id| flat.node(*id).width == 1)
            .collect();
        if single.is_empty() {
            return Ok(());
        }
        let picked = picks.iter().map(|pick| single[usize::from(*pick) % single.len()]);
        flat.properties = picked.collect();
        compare(flat, given, if expanded { 64 } else { 0 })?;
    }
}

/// Returns a netlist of a counter with a step and a wrap, a gate of its enable and a memory of its
/// last words, from some numbers; its properties bound the counter.
fn counter(seed: u64) -> Flat {
    use crate::engine::random::parts::{Memory, Node, Register};
    let mut flat = Flat {
        inputs: vec![1, 2],
        ..Flat::default()
    };
    let mut node = |op, width| {
        flat.nodes.push(Node {
            op,
            width,
            instance: 0,
        });
        flat.nodes.len() as u32 - 1
    };
    let pick = |low: u32, most: u64| seed >> low & most;
    let (go, word) = (node(Op::Input(0), 1), node(Op::Input(1), 2));
    let (count, gate) = (node(Op::Register(0), 4), node(Op::Register(1), 1));
    let by = node(Op::Constant(1 + pick(0, 1)), 4);
    let end = node(Op::Constant(pick(1, 15)), 4);
    let start = node(Op::Constant(pick(5, 15) & 7), 4);
    let sum = node(Op::Add(count, by), 4);
    let at_end = node(
        if pick(9, 1) == 1 {
            Op::Equal(count, end)
        } else {
            Op::Below(end, count)
        },
        1,
    );
    let next = node(Op::Mux(at_end, start, sum), 4);
    let enabled = node(
        if pick(10, 1) == 1 {
            Op::And(go, gate)
        } else {
            Op::Or(go, gate)
        },
        1,
    );
    let next = node(Op::Mux(enabled, next, count), 4);
    let address = node(Op::Extend(word), 2);
    let read = node(Op::Read(0, address), 1);
    let low = node(Op::Slice(count, pick(11, 3) as u8), 1);
    let bound = node(Op::Constant(pick(13, 15)), 4);
    let below = node(Op::Below(count, bound), 1);
    let other = node(Op::Equal(next, bound), 1);
    let other = node(Op::Not(other), 1);
    let same = node(Op::Xor(read, low), 1);
    let same = node(Op::Not(same), 1);
    let first = node(Op::Constant(0), 2);
    let first = node(Op::Read(0, first), 1);
    let all = node(Op::Equal(read, first), 1);
    let not = node(Op::Not(gate), 1);
    flat.registers = [(4, pick(5, 15) & 7, next), (1, pick(17, 1), not)]
        .map(|(width, power_on, next)| Register {
            width,
            power_on,
            next,
            instance: 0,
        })
        .to_vec();
    let port = match pick(18, 1) {
        1 => Port::Ram {
            enable: enabled,
            address,
            data: low,
        },
        _ => Port::Shift {
            enable: enabled,
            data: low,
        },
    };
    flat.memories = vec![Memory {
        width: 1,
        contents: vec![pick(19, 1); 3],
        port,
        instance: 0,
    }];
    flat.properties = vec![below, other, same, all, not];
    flat
}

#[test]
fn results_of_counters_are_those_of_a_visit_of_all_states() {
    let mut all = [0; 4];
    for seed in 0..400u64 {
        let seed = (seed + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 20;
        let (given, expanded) = (seed >> 43 & 1 == 1, seed >> 42 & 1 == 1);
        let kinds = compare(counter(seed), given, if expanded { 64 } else { 0 });
        let kinds = kinds.unwrap_or_else(|error| panic!("{seed:#x}: {error}"));
        for (all, kind) in all.iter_mut().zip(kinds) {
            *all += kind;
        }
    }
    // Every way to a proof was taken.
    assert!(all[1..].iter().all(|count| *count > 5), "{all:?}");
}
