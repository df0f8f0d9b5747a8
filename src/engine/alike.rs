//! Comparison of compiled code with the interpreter, and circuits for it.

use super::flat::{Flat, Instance, Memory, Node, Op, Place, Port, Register, mask};
use super::interpreter::{self, Counts};
use super::plan::Plan;
use super::random::{Case, Hold};
use proptest::collection::vec;
use proptest::prelude::*;

/// Compiled code of a plan.
pub trait Compiled {
    fn settle(&mut self, slab: &mut [u64]);
    fn edge(&mut self, slab: &mut [u64]);
    /// Makes up to `ticks` ticks, up to one in which something watched changes; returns their
    /// number.
    fn advance(&mut self, slab: &mut [u64], ticks: u64) -> u64;
}

/// Returns masks of the bits that both backends must leave equal: all but the words of steps and
/// the bits of hot blocks.
pub fn common(plan: &Plan, hot: &[bool]) -> Vec<u64> {
    let mut masks = vec![u64::MAX; plan.layout.words as usize];
    for (place, block) in plan.blocks.iter().enumerate() {
        for step in &block.steps {
            masks[step.to as usize] = 0;
        }
        if hot[place] {
            let bit = plan.bit(place);
            masks[plan.layout.dirty as usize + bit / 64] &= !(1 << (bit % 64));
        }
    }
    masks
}

pub fn same(masks: &[u64], one: &[u64], other: &[u64]) -> Result<(), TestCaseError> {
    for (slot, ((mask, one), other)) in masks.iter().zip(one).zip(other).enumerate() {
        prop_assert_eq!(one & mask, other & mask, "slot {}", slot);
    }
    Ok(())
}

pub fn put(plan: &Plan, slab: &mut [u64], changes: &[(usize, u64)]) {
    for &(port, word) in changes {
        interpreter::put(&plan.layout, slab, plan.layout.inputs[port], word);
    }
}

/// Clears the change marks, as an observer does.
pub fn seen(plan: &Plan, slab: &mut [u64]) {
    let layout = &plan.layout;
    slab[layout.event as usize] = 0;
    slab[layout.changed as usize..][..layout.changed_words as usize].fill(0);
}

/// Compares compiled code with the interpreter, phase by phase.
pub fn compiled<C: Compiled>(
    case: &Case,
    compile: impl FnOnce(&Plan) -> C,
) -> Result<(), TestCaseError> {
    let plan = Plan::of(&case.flat, &case.wanted);
    let mut code = compile(&plan);
    let masks = common(&plan, &case.hot);
    let mut counts = Counts::from(vec![0; plan.blocks.len()]);
    let mut reference = plan.layout.power_on();
    let mut slab = reference.clone();
    for hold in &case.stimulus {
        put(&plan, &mut reference, &hold.changes);
        put(&plan, &mut slab, &hold.changes);
        interpreter::settle(&plan, &mut reference, &mut counts);
        code.settle(&mut slab);
        same(&masks, &reference, &slab)?;
        for _ in 0..hold.ticks {
            seen(&plan, &mut reference);
            seen(&plan, &mut slab);
            interpreter::edge(&plan, &mut reference, &mut counts);
            code.edge(&mut slab);
            same(&masks, &reference, &slab)?;
            interpreter::settle(&plan, &mut reference, &mut counts);
            code.settle(&mut slab);
            same(&masks, &reference, &slab)?;
        }
    }
    Ok(())
}

/// Compares compiled code with the interpreter where it makes many ticks at a time.
pub fn advanced<C: Compiled>(
    case: &Case,
    compile: impl FnOnce(&Plan) -> C,
) -> Result<(), TestCaseError> {
    let plan = Plan::of(&case.flat, &case.wanted);
    let mut code = compile(&plan);
    let masks = common(&plan, &case.hot);
    let mut counts = Counts::from(vec![0; plan.blocks.len()]);
    let mut reference = plan.layout.power_on();
    let mut slab = reference.clone();
    for hold in &case.stimulus {
        put(&plan, &mut reference, &hold.changes);
        put(&plan, &mut slab, &hold.changes);
        interpreter::settle(&plan, &mut reference, &mut counts);
        code.settle(&mut slab);
        let mut left = hold.ticks * 3;
        while left > 0 {
            seen(&plan, &mut reference);
            seen(&plan, &mut slab);
            let mut ticks = 0;
            while ticks < left && reference[plan.layout.event as usize] == 0 {
                interpreter::edge(&plan, &mut reference, &mut counts);
                interpreter::settle(&plan, &mut reference, &mut counts);
                ticks += 1;
            }
            prop_assert_eq!(code.advance(&mut slab, left), ticks);
            same(&masks, &reference, &slab)?;
            left -= ticks;
        }
    }
    Ok(())
}

/// Adds a node to the outermost circuit; returns its index.
pub fn add(nodes: &mut Vec<Node>, op: Op, width: u8) -> u32 {
    nodes.push(Node {
        op,
        width,
        instance: 0,
    });
    nodes.len() as u32 - 1
}

/// Returns a circuit of registers that choose among words, a memory that some of them read, and a
/// register of another block. The seeds of a register are a tree of choices.
fn chooser(width: u8, seeds: &[Vec<u8>]) -> Flat {
    let mut flat = Flat {
        inputs: vec![1, 1, 1, width],
        instances: [vec![], vec!["far".to_owned()]]
            .map(|path| Instance {
                path,
                circuit: "chooser".to_owned(),
            })
            .to_vec(),
        ..Flat::default()
    };
    let mut add = |op, width| add(&mut flat.nodes, op, width);
    let ports = [0, 1, 2].map(|port| add(Op::Input(port), 1));
    let inverted = ports.map(|port| add(Op::Not(port), 1));
    let mut ons = [ports, inverted].concat();
    ons.push(add(Op::Constant(1), 1));
    let one = add(Op::Constant(1), width);
    let mut words = vec![add(Op::Input(3), width)];
    words.extend((0..=seeds.len()).map(|register| add(Op::Register(register as u32), width)));
    let far = words[words.len() - 1];
    words.push(add(Op::Add(words[1], one), width));
    words.push(add(Op::Add(words[1], words[2]), width));
    words.push(add(Op::Read(0, words[2]), width));
    ons.push(add(Op::Slice(words[1], 0), 1));
    ons.push(add(Op::Below(words[2], words[1]), 1));
    let of = |list: &[u32], seed: u8| list[usize::from(seed) % list.len()];
    for seeds in seeds {
        // From the leaves to the root.
        let mut level: Vec<u32> = seeds[..8].iter().map(|&seed| of(&words, seed)).collect();
        for depth in [8, 12, 14] {
            let sides = level.chunks(2).zip(&seeds[depth..]);
            let choices = sides.map(|(sides, &seed)| match seed % 4 {
                0 => sides[0],
                _ => add(Op::Mux(of(&ons, seed / 4), sides[0], sides[1]), width),
            });
            level = choices.collect();
        }
        flat.registers.push(Register {
            width,
            power_on: 0,
            next: level[0],
            instance: 0,
        });
    }
    flat.nodes.push(Node {
        op: Op::Mux(ports[1], words[1], far),
        width,
        instance: 1,
    });
    flat.registers.push(Register {
        width,
        power_on: 1,
        next: flat.nodes.len() as u32 - 1,
        instance: 1,
    });
    flat.memories.push(Memory {
        width,
        contents: vec![0; 4],
        port: Port::Ram {
            enable: ons[0],
            address: words[1],
            data: words[words.len() - 1],
        },
        instance: 0,
    });
    let registers = (0..=seeds.len()).map(|register| Place::Register(register as u32));
    flat.leaves = registers
        .chain((0..4).map(|word| Place::Word(0, word)))
        .collect();
    flat
}

pub fn choosers() -> impl Strategy<Value = Case> {
    let seeds = vec(vec(any::<u8>(), 15), 2..6);
    let hold = (vec((0..4usize, any::<u64>()), 0..4), 0..4u64);
    (1..6u8, seeds, vec(hold, 8), any::<[bool; 8]>()).prop_map(|(width, seeds, holds, hot)| {
        let flat = chooser(width, &seeds);
        let held = holds.into_iter().map(|(changes, ticks)| {
            let fit = |(port, word): (usize, u64)| (port, word & mask(flat.inputs[port]));
            let changes = changes.into_iter().map(fit).collect();
            Hold { changes, ticks }
        });
        Case {
            stimulus: held.collect(),
            wanted: vec![true; flat.leaves.len()],
            hot: hot.to_vec(),
            flat,
        }
    })
}

/// Returns a circuit of `count` registers that each take a mixture of others, all watched.
fn registers(count: u32) -> Flat {
    let node = |op, width| Node {
        op,
        width,
        instance: 0,
    };
    let mut flat = Flat {
        inputs: vec![16],
        instances: vec![Instance {
            path: Vec::new(),
            circuit: "wide".to_owned(),
        }],
        ..Flat::default()
    };
    flat.nodes.push(node(Op::Input(0), 16));
    flat.nodes
        .extend((0..count).map(|number| node(Op::Register(number), 16)));
    let held = |number: u32| 1 + number % count;
    for number in 0..count {
        let sum = flat.nodes.len() as u32;
        let mixed = [
            node(Op::Add(held(number), held(number * 7 + 1)), 16),
            node(Op::Xor(sum, held(number + count / 2)), 16),
            node(Op::Below(sum, 0), 1),
            node(Op::Mux(sum + 2, sum + 1, held(number + 1)), 16),
        ];
        flat.nodes.extend(mixed);
        flat.registers.push(Register {
            width: 16,
            power_on: u64::from(number),
            next: sum + 3,
            instance: 0,
        });
    }
    flat.leaves = (0..count).map(Place::Register).collect();
    flat
}

pub fn wide(count: u32) -> Plan {
    Plan::of(&registers(count), &vec![true; count as usize])
}
