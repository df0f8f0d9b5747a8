//! Jumps compared with single ticks.

use super::super::{Graph, Prediction};
use super::held;
use crate::engine::flat::{Flat, Id, Instance, Memory, Node, Op, Place, Port, Register, mask};
use crate::engine::interpreter::{self, Counts};
use crate::engine::layout::Spot;
use crate::engine::passes;
use crate::engine::plan::Plan;
use crate::engine::random::{Case, Hold, cases};
use proptest::collection::vec;
use proptest::prelude::*;

struct Run<'p> {
    plan: &'p Plan,
    slab: Vec<u64>,
    counts: Counts,
}

impl Run<'_> {
    fn settle(&mut self) {
        interpreter::settle(self.plan, &mut self.slab, &mut self.counts);
    }

    fn edge(&mut self) {
        interpreter::edge(self.plan, &mut self.slab, &mut self.counts);
    }

    /// Returns registers and memories; shift registers as they are read.
    fn state(&self) -> Vec<u64> {
        let registers = self.plan.registers.iter();
        let registers = registers.map(|register| self.slab[register.slot as usize]);
        let words = self.plan.memories.iter().flat_map(|memory| {
            (0..memory.words.into()).map(|word| interpreter::read(memory, &self.slab, word))
        });
        registers.chain(words).collect()
    }

    /// Returns all leaves and properties that the slab has.
    fn leaves(&self) -> Vec<u64> {
        let layout = &self.plan.layout;
        let spots = layout.leaves.iter().chain(&layout.properties);
        let words = spots.map(|spot| match *spot {
            Spot::Slot(slot) => self.slab[slot as usize],
            Spot::Constant(bits) => bits,
            Spot::Stage(memory, stage) => {
                let memory = &self.plan.memories[memory as usize];
                interpreter::read(memory, &self.slab, stage.into())
            }
            Spot::Gone => 0,
        });
        words.collect()
    }

    fn watched(&self) -> Vec<u64> {
        let watched = self.plan.layout.watched.iter();
        watched.map(|one| self.slab[one.slot as usize]).collect()
    }

    /// Returns the change marks.
    fn changed(&self) -> Vec<u64> {
        let layout = &self.plan.layout;
        self.slab[layout.changed as usize..][..layout.changed_words as usize].to_vec()
    }

    /// Returns the slab as compiled code leaves it: hot blocks have no bits.
    fn cooled(&self, hot: &[bool]) -> Vec<u64> {
        let mut slab = self.slab.clone();
        for (place, _) in hot.iter().enumerate().filter(|(_, hot)| **hot) {
            let bit = self.plan.bit(place);
            slab[self.plan.layout.dirty as usize + bit / 64] &= !(1 << (bit % 64));
        }
        slab
    }
}

/// Returns the number of ticks jumped over, and of all ticks.
fn run(case: &Case, short: &[u64], every: u64) -> Result<[u64; 2], TestCaseError> {
    let flat = passes::equal(&case.flat);
    let plan = Plan::of(&flat, &case.wanted);
    let hot: Vec<bool> = (0..plan.blocks.len())
        .map(|block| case.hot[block % case.hot.len()])
        .collect();
    let mut prediction = Prediction::new(&plan, Graph::new(&plan, &held(&plan)).into());
    // Recipes are recorded at once here.
    prediction.interval = 0;
    let start = || Run {
        plan: &plan,
        slab: plan.layout.power_on(),
        counts: vec![0; plan.blocks.len()],
    };
    let (mut plain, mut over) = (start(), start());
    let (mut gone, mut all) = (0, 0);
    let mut short = short.iter().cycle();
    for hold in &case.stimulus {
        for run in [&mut plain, &mut over] {
            for &(port, word) in &hold.changes {
                let slot = plan.layout.inputs[port];
                interpreter::put(&plan.layout, &mut run.slab, slot, word);
            }
        }
        let mut left = hold.ticks;
        while left > 0 {
            plain.settle();
            over.settle();
            prop_assert_eq!(plain.state(), over.state());
            prop_assert_eq!(plain.leaves(), over.leaves());
            let horizon = match all % every {
                0 => prediction.horizon(&plan, &hot, &over.cooled(&hot), left),
                _ => 0,
            };
            prop_assert!(horizon <= left);
            let ticks = short.next().map_or(horizon, |&short| horizon.min(short));
            if horizon == 0 || ticks == 0 {
                plain.edge();
                over.edge();
                (left, all) = (left - 1, all + 1);
                continue;
            }
            let before = plain.watched();
            for run in [&mut plain, &mut over] {
                let changed = plan.layout.changed as usize;
                run.slab[changed..][..plan.layout.changed_words as usize].fill(0);
            }
            for tick in 0..ticks {
                if tick > 0 {
                    plain.settle();
                    prop_assert_eq!(&before, &plain.watched(), "tick {} of {}", tick, horizon);
                }
                plain.edge();
            }
            prediction.jump(&plan, &mut over.slab, ticks);
            prop_assert_eq!(
                plain.state(),
                over.state(),
                "after {} of {}",
                ticks,
                horizon
            );
            let changed = over.changed();
            plain.settle();
            over.settle();
            prop_assert_eq!(plain.leaves(), over.leaves());
            // Registers that did not change are not marked.
            let told = changed
                .iter()
                .zip(plain.changed())
                .all(|(over, plain)| over & !plain == 0);
            prop_assert!(told);
            prop_assert_eq!(plain.changed(), over.changed());
            (left, all, gone) = (left - ticks, all + ticks, gone + ticks);
        }
    }
    Ok([gone, all])
}

/// Seed of a node of a counting circuit: kind, operands modulo the number of nodes, constant,
/// width.
type Seed = (u8, [u16; 3], u64, u32);

/// Circuits with counters, functions of them, and registers and memories that take those: much of
/// it changes linearly for some ticks.
fn counting() -> impl Strategy<Value = Case> {
    let step = prop_oneof![4 => Just(1u64), 4 => Just(u64::MAX), 2 => 0..6u64, 1 => any::<u64>()];
    let small = prop_oneof![0..40u64, any::<u64>()];
    let widths = prop_oneof![2 => Just(1u8), 4 => 3..9u8, 1 => Just(64u8)];
    let register = (widths, small.clone(), step, any::<[u16; 3]>(), 0..8u8);
    let seed = (0..22u8, any::<[u16; 3]>(), small.clone(), 0..3u32);
    let hold = (vec((any::<u16>(), small), 0..3), 0..60u64);
    let flat = (
        vec(register, 1..7),
        vec(seed, 3..30),
        vec(any::<[u16; 4]>(), 0..3),
        vec(any::<u16>(), 0..3),
    );
    let hot = prop_oneof![Just(vec![false]), vec(any::<bool>(), 5), Just(vec![true])];
    (flat, vec(hold, 1..6), hot).prop_map(|((registers, seeds, memories, leaves), holds, hot)| {
        let flat = count(&registers, &seeds, &memories, &leaves);
        let hold = |(changes, ticks): (Vec<(u16, u64)>, u64)| Hold {
            changes: changes
                .into_iter()
                .map(|(port, word)| {
                    let port = port as usize % flat.inputs.len();
                    (port, word & mask(flat.inputs[port]))
                })
                .collect(),
            ticks,
        };
        Case {
            wanted: vec![true; flat.leaves.len()],
            stimulus: holds.into_iter().map(hold).collect(),
            flat,
            hot,
        }
    })
}

type Counting = (u8, u64, u64, [u16; 3], u8);

fn count(registers: &[Counting], seeds: &[Seed], memories: &[[u16; 4]], leaves: &[u16]) -> Flat {
    let instances = (0..3).map(|number| Instance {
        path: vec![format!("i{number}")],
        circuit: "counting".to_owned(),
    });
    let mut flat = Flat {
        inputs: vec![1, 1, 6, 64],
        instances: instances.collect(),
        ..Flat::default()
    };
    fn node(flat: &mut Flat, op: Op, width: u8, instance: u32) -> Id {
        flat.nodes.push(Node {
            op,
            width,
            instance,
        });
        flat.nodes.len() as Id - 1
    }
    /// Returns any node, converted to `width` bits.
    fn wide(flat: &mut Flat, pick: u16, width: u8, instance: u32) -> Id {
        let id = u32::from(pick) % flat.nodes.len() as u32;
        let own = flat.node(id).width;
        match pick % 3 {
            _ if own == width => id,
            _ if own > width => node(
                flat,
                Op::Slice(id, (pick % 64) as u8 % (own - width + 1)),
                width,
                instance,
            ),
            0 => node(flat, Op::ExtendSigned(id), width, instance),
            _ => node(flat, Op::Extend(id), width, instance),
        }
    }
    /// Returns a node of one bit at or after this one, if there is one.
    fn bit(flat: &mut Flat, pick: u16, instance: u32) -> Id {
        let start = pick as usize % flat.nodes.len();
        let found = (start..flat.nodes.len()).find(|&id| flat.nodes[id].width == 1);
        found.map_or_else(|| wide(flat, pick, 1, instance), |id| id as Id)
    }
    for port in 0..flat.inputs.len() {
        let width = flat.inputs[port];
        node(&mut flat, Op::Input(port as u32), width, 0);
    }
    for (number, &(width, ..)) in registers.iter().enumerate() {
        node(&mut flat, Op::Register(number as u32), width, 0);
    }
    for (number, [words, width, ..]) in memories.iter().enumerate() {
        flat.memories.push(Memory {
            width: 1 + (width % 8) as u8,
            contents: (0..u64::from(1 + words % 9))
                .map(|word| word & number as u64 & mask(1 + (width % 8) as u8))
                .collect(),
            port: Port::Rom,
            instance: u32::from(words % 3),
        });
    }
    for &(kind, [first, second, third], bits, instance) in seeds {
        let flat = &mut flat;
        // Usually as wide as a register, and combined with a constant.
        let width = registers[second as usize % registers.len()].0;
        let a = wide(flat, first, width, instance);
        let b = match second % 3 {
            0 => wide(flat, third, width, instance),
            _ => node(flat, Op::Constant(bits & mask(width)), width, instance),
        };
        let by = (third % u16::from(width)) as u8;
        let (op, width) = match kind {
            0 => (Op::Add(a, b), width),
            1 => (Op::Subtract(a, b), width),
            2 => (Op::Multiply(a, b), width),
            3 => (Op::And(a, b), width),
            4 => (Op::Or(a, b), width),
            5 => (Op::Xor(a, b), width),
            6 => (Op::Not(a), width),
            7 => (Op::Negate(a), width),
            8..=10 => (Op::Equal(a, b), 1),
            11 | 12 => (Op::Below(a, b), 1),
            13 => (Op::Below(b, a), 1),
            14 => (Op::BelowSigned(a, b), 1),
            15 => (Op::Slice(a, by), width - by),
            16 => (Op::ShiftRight(a, by), width),
            17 => (Op::ShiftRightSigned(a, by), width),
            18 if width < 33 => (Op::Join(a, b), 2 * width),
            19 => (
                Op::And(bit(flat, first, instance), bit(flat, third, instance)),
                1,
            ),
            20 => (Op::Mux(bit(flat, third, instance), a, b), width),
            _ if memories.is_empty() => (Op::ShiftLeft(a, by), width),
            _ => {
                let memory = third as usize % memories.len();
                (Op::Read(memory as u32, a), flat.memories[memory].width)
            }
        };
        node(flat, op, width, instance);
    }
    for (number, &(width, power_on, step, [first, second, third], kind)) in
        registers.iter().enumerate()
    {
        let instance = number as u32 % 3;
        let flat = &mut flat;
        let own = flat.inputs.len() as u32 + number as u32;
        let by = match kind {
            0 => wide(flat, third, width, instance),
            _ => node(flat, Op::Constant(step & mask(width)), width, instance),
        };
        let sum = node(flat, Op::Add(own, by), width, instance);
        let load = wide(flat, first, width, instance);
        let (one, other) = (bit(flat, second, instance), bit(flat, third, instance));
        let next = match kind {
            0 | 1 => sum,
            2 => load,
            3 | 4 => node(flat, Op::Mux(one, load, sum), width, instance),
            5 => node(flat, Op::Mux(one, sum, own), width, instance),
            _ => {
                let next = node(flat, Op::Mux(other, sum, own), width, instance);
                node(flat, Op::Mux(one, load, next), width, instance)
            }
        };
        flat.registers.push(Register {
            width,
            power_on: power_on & mask(width),
            next,
            instance,
        });
    }
    for (number, &[kind, enable, address, data]) in memories.iter().enumerate() {
        let flat = &mut flat;
        let instance = flat.memories[number].instance;
        let enable = bit(flat, enable, instance);
        let address = wide(flat, address, 3, instance);
        let data = wide(flat, data, flat.memories[number].width, instance);
        flat.memories[number].port = match kind % 4 {
            0 => Port::Rom,
            1 => Port::Shift { enable, data },
            _ => Port::Ram {
                enable,
                address,
                data,
            },
        };
    }
    for &leaf in leaves {
        let leaf = bit(&mut flat, leaf, 0);
        flat.leaves.push(Place::Node(leaf));
    }
    flat
}

/// A block that writes an unchanged word is idle, until another block changes its address or its
/// word.
#[test]
fn a_write_that_moves_in_a_block_that_sleeps() {
    for (moves_address, ram) in [(true, true), (false, true), (false, false)] {
        let mut builder = super::Builder::new();
        builder.0.inputs = vec![1, 1];
        builder.0.instances.push(builder.0.instances[0].clone());
        let counts = builder.node(Op::Input(0), 1);
        let enable = builder.node(Op::Input(1), 1);
        let count = builder.register(3, 0);
        let one = builder.constant(1, 3);
        let sum = builder.node(Op::Add(count, one), 3);
        let next = builder.node(Op::Mux(counts, sum, count), 3);
        builder.next(count, next);
        let (address, data) = match moves_address {
            true => (count, one),
            false => (one, count),
        };
        let mut flat = builder.0;
        flat.memories.push(Memory {
            width: 3,
            contents: vec![0; 5],
            port: match ram {
                true => Port::Ram {
                    enable,
                    address,
                    data,
                },
                false => Port::Shift { enable, data },
            },
            instance: 1,
        });
        let hold = |port, ticks| Hold {
            changes: vec![(port, 1)],
            ticks,
        };
        let case = Case {
            wanted: Vec::new(),
            stimulus: vec![hold(1, 9), hold(0, 4)],
            flat,
            hot: vec![false],
        };
        let [gone, all] = run(&case, &[u64::MAX], 1).unwrap();
        // Idle while it does not count; a shift register keeps shifting.
        assert!(all == 13 && (gone >= 6 || !ram), "{gone} of {all}");
    }
}

/// Jumps of the greatest length, or shorter.
fn short() -> impl Strategy<Value = Vec<u64>> {
    prop_oneof![
        Just(vec![u64::MAX]),
        vec(prop_oneof![0..20u64, Just(u64::MAX)], 1..5)
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(3000))]

    #[test]
    fn circuits_at_random(case in cases(false), short in short()) {
        run(&case, &short, 1)?;
    }

    #[test]
    fn circuits_that_count(case in counting(), short in short(), every in 1..4u64) {
        run(&case, &short, every)?;
    }
}
