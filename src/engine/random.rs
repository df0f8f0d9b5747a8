//! Random circuits, for tests that compare one way to run a circuit with another.

use super::flat::{Flat, Id, Instance, Memory, Node, Op, Place, Port, Register, mask};
use super::value;
use proptest::collection::vec;
use proptest::prelude::*;

/// Parts of which tests build netlists.
pub(crate) mod parts {
    pub(crate) use super::super::flat::{Flat, Memory, Node, Op, Place, Port, Register};
}

/// Circuit with a stimulus.
#[derive(Debug, Clone)]
pub(crate) struct Case {
    pub flat: Flat,
    /// Wanted leaves and, after them, properties.
    pub wanted: Vec<bool>,
    /// Hot blocks, as many as there may be.
    pub hot: Vec<bool>,
    pub stimulus: Vec<Hold>,
}

/// New words of the input ports, and the number of ticks that they are held.
#[derive(Debug, Clone)]
pub(crate) struct Hold {
    pub changes: Vec<(usize, u64)>,
    pub ticks: u64,
}

/// Random numbers from which a node is made, taken modulo the number of choices.
#[derive(Debug, Clone)]
struct Seed {
    kind: u8,
    width: u8,
    by: u8,
    picks: [u16; 3],
    bits: u64,
    instance: u32,
}

/// Number of instances.
const INSTANCES: u32 = 4;

fn width() -> impl Strategy<Value = u8> {
    prop_oneof![
        3 => Just(1u8),
        3 => 2..=9u8,
        2 => prop::sample::select(vec![8u8, 16, 31, 32, 33, 63, 64]),
        2 => 1..=64u8,
    ]
}

/// Words that are often small, or all ones.
fn bits() -> impl Strategy<Value = u64> {
    prop_oneof![
        0..4u64,
        any::<u64>(),
        Just(u64::MAX),
        (0..64u32).prop_map(|bit| 1 << bit)
    ]
}

fn seed(kinds: u8) -> impl Strategy<Value = Seed> {
    let picks = any::<[u16; 3]>();
    (0..kinds, width(), 0..70u8, picks, bits(), 0..INSTANCES).prop_map(
        |(kind, width, by, picks, bits, instance)| Seed {
            kind,
            width,
            by,
            picks,
            bits,
            instance,
        },
    )
}

/// Any circuit with any stimulus; with `all`, all leaves are wanted.
pub(crate) fn cases(all: bool) -> impl Strategy<Value = Case> {
    let flat = (
        vec(width(), 1..5),
        vec(seed(1), 0..8),
        vec(seed(4), 0..4),
        vec(seed(22), 1..60),
        vec(seed(3), 1..12),
        vec(any::<u16>(), 0..3),
    );
    let flat = flat.prop_map(|(inputs, registers, memories, nodes, leaves, properties)| {
        Builder::new(inputs).flat(&registers, &memories, &nodes, &leaves, &properties)
    });
    let change = (any::<u16>(), bits());
    let hold = (vec(change, 0..3), 0..6u64);
    let wanted = vec(prop::bool::weighted(if all { 1.0 } else { 0.3 }), 64);
    let hot = prop_oneof![Just(0.0), Just(0.5), Just(1.0),];
    let hot = hot.prop_flat_map(|share| vec(prop::bool::weighted(share), 96));
    (flat, wanted, hot, vec(hold, 1..8)).prop_map(|(flat, wanted, hot, holds)| {
        let stimulus = holds.into_iter().map(|(changes, ticks)| {
            let changes = changes.into_iter().map(|(port, bits)| {
                let port = usize::from(port) % flat.inputs.len();
                (port, bits & mask(flat.inputs[port]))
            });
            let changes = changes.collect();
            Hold { changes, ticks }
        });
        Case {
            stimulus: stimulus.collect(),
            flat,
            wanted,
            hot,
        }
    })
}

struct Builder {
    flat: Flat,
    instance: u32,
}

impl Builder {
    fn new(inputs: Vec<u8>) -> Self {
        let instances = (0..INSTANCES).map(|number| Instance {
            path: (0..number).map(|depth| format!("i{depth}")).collect(),
            circuit: "random".to_owned(),
        });
        let instances = instances.collect();
        let mut builder = Builder {
            flat: Flat {
                inputs,
                instances,
                ..Flat::default()
            },
            instance: 0,
        };
        for port in 0..builder.flat.inputs.len() {
            builder.node(Op::Input(port as u32), builder.flat.inputs[port]);
        }
        builder
    }

    fn node(&mut self, op: Op, width: u8) -> Id {
        let instance = self.instance;
        self.flat.nodes.push(Node {
            op,
            width,
            instance,
        });
        self.flat.nodes.len() as Id - 1
    }

    fn width(&self, id: Id) -> u8 {
        self.flat.node(id).width
    }

    /// Returns any node so far.
    fn any(&self, pick: u16) -> Id {
        u32::from(pick) % self.flat.nodes.len() as u32
    }

    /// Returns any node so far, converted to `width` bits.
    fn wide(&mut self, pick: u16, width: u8) -> Id {
        let id = self.any(pick);
        match self.width(id) {
            own if own == width => id,
            own if own > width => {
                let low = (pick % 64) as u8 % (own - width + 1);
                self.node(Op::Slice(id, low), width)
            }
            _ if pick.is_multiple_of(2) => self.node(Op::Extend(id), width),
            _ => self.node(Op::ExtendSigned(id), width),
        }
    }

    fn flat(
        mut self,
        registers: &[Seed],
        memories: &[Seed],
        nodes: &[Seed],
        leaves: &[Seed],
        properties: &[u16],
    ) -> Flat {
        for (number, seed) in registers.iter().enumerate() {
            self.node(Op::Register(number as u32), seed.width);
        }
        for seed in memories {
            let words = 1 + u64::from(seed.by) % 17;
            let word = |index: u64| seed.bits.wrapping_mul(index + 1) & mask(seed.width);
            self.flat.memories.push(Memory {
                width: seed.width,
                contents: (0..words).map(word).collect(),
                port: Port::Rom,
                instance: seed.instance,
            });
        }
        for seed in nodes {
            self.instance = seed.instance;
            self.compute(seed);
        }
        for seed in registers {
            self.instance = seed.instance;
            let next = self.wide(seed.picks[0], seed.width);
            self.flat.registers.push(Register {
                width: seed.width,
                power_on: seed.bits & mask(seed.width),
                next,
                instance: seed.instance,
            });
        }
        for (number, seed) in memories.iter().enumerate() {
            self.instance = seed.instance;
            let [enable, address, data] = seed.picks;
            let enable = self.wide(enable, 1);
            let address = self.wide(address, 1 + seed.by % 6);
            let data = self.wide(data, seed.width);
            self.flat.memories[number].port = match seed.kind {
                0 => Port::Rom,
                1 => Port::Ram {
                    enable,
                    address,
                    data,
                },
                _ => Port::Shift { enable, data },
            };
        }
        for seed in leaves {
            let leaf = self.leaf(seed);
            self.flat.leaves.push(leaf);
        }
        self.instance = 0;
        for &pick in properties {
            let property = self.wide(pick, 1);
            self.flat.properties.push(property);
        }
        self.flat
    }

    fn leaf(&self, seed: &Seed) -> Place {
        let [pick, other, _] = seed.picks.map(usize::from);
        let flat = &self.flat;
        match seed.kind {
            0 if !flat.registers.is_empty() => {
                Place::Register((pick % flat.registers.len()) as u32)
            }
            1 if !flat.memories.is_empty() => {
                let memory = pick % flat.memories.len();
                let words = flat.memories[memory].contents.len();
                Place::Word(memory as u32, (other % words) as u32)
            }
            _ => Place::Node(self.any(pick as u16)),
        }
    }

    fn compute(&mut self, seed: &Seed) {
        let (width, by) = (seed.width, seed.by);
        let [first, second, third] = seed.picks;
        let a = self.any(first);
        let own = self.width(a);
        let op = match seed.kind {
            0 => Op::Constant(seed.bits & mask(width)),
            1 => Op::Not(self.wide(first, width)),
            2 => Op::Negate(self.wide(first, width)),
            3 => Op::Add(self.wide(first, width), self.wide(second, width)),
            4 => Op::Subtract(self.wide(first, width), self.wide(second, width)),
            5 => Op::Multiply(self.wide(first, width), self.wide(second, width)),
            6 => Op::And(self.wide(first, width), self.wide(second, width)),
            7 => Op::Or(self.wide(first, width), self.wide(second, width)),
            8 => Op::Xor(self.wide(first, width), self.wide(second, width)),
            9..=11 => {
                let b = self.wide(second, own);
                let op = match seed.kind {
                    9 => Op::Equal(a, b),
                    10 => Op::Below(a, b),
                    _ => Op::BelowSigned(a, b),
                };
                self.node(op, 1);
                return;
            }
            12 | 13 => {
                let choose = self.wide(third, 1);
                Op::Mux(choose, self.wide(first, width), self.wide(second, width))
            }
            14 => Op::ShiftLeft(self.wide(first, width), by),
            15 => Op::ShiftRight(self.wide(first, width), by),
            16 => Op::ShiftRightSigned(self.wide(first, width), by),
            17 => {
                let low = by % own;
                self.node(Op::Slice(a, low), 1 + width % (own - low));
                return;
            }
            18 => {
                self.node(Op::Extend(a), own.max(width));
                return;
            }
            19 => {
                self.node(Op::ExtendSigned(a), own.max(width));
                return;
            }
            20 => {
                let (high, low) = (1 + width % 32, 1 + by % 32);
                let op = Op::Join(self.wide(first, high), self.wide(second, low));
                self.node(op, high + low);
                return;
            }
            _ if self.flat.memories.is_empty() => Op::Constant(seed.bits & mask(width)),
            _ => {
                let memory = usize::from(second) % self.flat.memories.len();
                let op = Op::Read(memory as u32, self.wide(first, 1 + by % 6));
                self.node(op, self.flat.memories[memory].width);
                return;
            }
        };
        self.node(op, width);
    }
}

/// Reference evaluation: every node in every tick.
pub(crate) struct Plain<'f> {
    flat: &'f Flat,
    pub inputs: Vec<u64>,
    pub registers: Vec<u64>,
    pub memories: Vec<Vec<u64>>,
    nodes: Vec<u64>,
}

impl<'f> Plain<'f> {
    pub fn new(flat: &'f Flat) -> Self {
        let memories = flat.memories.iter();
        Plain {
            flat,
            inputs: vec![0; flat.inputs.len()],
            registers: flat.registers.iter().map(|one| one.power_on).collect(),
            memories: memories.map(|memory| memory.contents.clone()).collect(),
            nodes: vec![0; flat.nodes.len()],
        }
    }

    pub fn settle(&mut self) {
        for (id, node) in self.flat.nodes.iter().enumerate() {
            self.nodes[id] = match node.op {
                Op::Input(port) => self.inputs[port as usize],
                Op::Register(register) => self.registers[register as usize],
                Op::Read(memory, address) => {
                    let address = self.nodes[address as usize] as usize;
                    let word = self.memories[memory as usize].get(address);
                    word.copied().unwrap_or(0)
                }
                _ => value::of(*node, |id| {
                    (self.nodes[id as usize], self.flat.node(id).width)
                }),
            };
        }
    }

    pub fn edge(&mut self) {
        let node = |id: Id| self.nodes[id as usize];
        let registers = self.flat.registers.iter();
        self.registers = registers.map(|register| node(register.next)).collect();
        for (words, memory) in self.memories.iter_mut().zip(&self.flat.memories) {
            match memory.port {
                Port::Ram {
                    enable,
                    address,
                    data,
                } if node(enable) == 1 => {
                    if let Some(word) = words.get_mut(node(address) as usize) {
                        *word = node(data);
                    }
                }
                Port::Shift { enable, data } if node(enable) == 1 => {
                    words.rotate_right(1);
                    words[0] = node(data);
                }
                _ => {}
            }
        }
    }

    pub fn reset(&mut self) {
        self.edge();
        let registers = self.flat.registers.iter();
        self.registers = registers.map(|register| register.power_on).collect();
    }

    /// Returns a leaf or, after the leaves, a property.
    pub fn leaf(&self, index: usize) -> u64 {
        let leaves = &self.flat.leaves;
        match leaves.get(index) {
            Some(Place::Input(port)) => self.inputs[*port as usize],
            Some(Place::Register(register)) => self.registers[*register as usize],
            Some(Place::Node(id)) => self.nodes[*id as usize],
            Some(Place::Word(memory, word)) => self.memories[*memory as usize][*word as usize],
            None => self.nodes[self.flat.properties[index - leaves.len()] as usize],
        }
    }
}
