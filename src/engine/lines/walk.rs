//! Goes through what edge blocks do: once for the words that registers take, once for their lines.

use super::graph::{From, Graph, Node, has};
use super::pair::Line;
use super::tree::Item;
use crate::engine::flat::mask;
use crate::engine::interpreter::read;
use crate::engine::plan::{Code, Plan};
use crate::engine::value::signed;

/// What is known of a node since a walk.
#[derive(Debug, Clone, Copy)]
pub(super) struct Known<T> {
    stamp: u64,
    what: T,
}

impl<T> Known<T> {
    pub fn nothing(what: T) -> Self {
        Known { stamp: 0, what }
    }
}

/// A register that moves.
#[derive(Debug, Clone, Copy)]
pub(super) struct Moving {
    pub register: u32,
    pub slope: u64,
}

/// It cannot go on so.
pub(super) struct Ends;

/// Words: nets are settled.
pub(super) struct Words<'w> {
    pub plan: &'w Plan,
    pub graph: &'w Graph,
    pub slab: &'w [u64],
    pub known: &'w mut [Known<u64>],
    pub stamp: u64,
}

impl Words<'_> {
    /// Notes what moves at the edge of a block.
    pub fn edge(&mut self, edge: usize, moving: &mut Vec<Moving>) -> Result<(), Ends> {
        let graph = self.graph;
        let mut place = graph.starts[edge] as usize;
        loop {
            match graph.items[place] {
                Item::Choose { on, low } if self.word(on) == 0 => {
                    place = low as usize;
                    continue;
                }
                Item::Goto { to } => {
                    place = to as usize;
                    continue;
                }
                Item::Choose { .. } => {}
                Item::Register { register, next } => {
                    let planned = plan_of(self.plan, register);
                    let now = self.slab[planned.0 as usize];
                    let next = self.word(next);
                    if next != now {
                        // A bit that turns over is hardly ever on a line that anything follows.
                        if planned.1 == 1 || graph.held[register as usize] {
                            return Err(Ends);
                        }
                        let slope = next.wrapping_sub(now) & mask(planned.1);
                        moving.push(Moving { register, slope });
                    }
                }
                Item::Write { enable } => {
                    if self.word(enable) != 0 {
                        return Err(Ends);
                    }
                }
                Item::End => return Ok(()),
            }
            place += 1;
        }
    }

    fn word(&mut self, from: From) -> u64 {
        match from {
            From::Register(slot) | From::Fixed(slot) => self.slab[slot as usize],
            From::Net(net) => self.slab[self.graph.nets[net as usize].slot as usize],
            From::Node(number) => {
                let node = &self.graph.nodes[number as usize];
                if !node.shared {
                    return self.make(node);
                }
                let known = self.known[number as usize];
                if known.stamp == self.stamp {
                    return known.what;
                }
                let what = self.make(node);
                self.known[number as usize] = Known {
                    stamp: self.stamp,
                    what,
                };
                what
            }
        }
    }

    fn make(&mut self, node: &Node) -> u64 {
        let a = self.word(node.a);
        let value = match node.code {
            Code::Not => !a,
            Code::Negate => a.wrapping_neg(),
            Code::Add => a.wrapping_add(self.word(node.b)),
            Code::Subtract => a.wrapping_sub(self.word(node.b)),
            Code::Multiply => a.wrapping_mul(self.word(node.b)),
            Code::And if a == 0 => 0,
            Code::And => a & self.word(node.b),
            Code::Or if a == mask(node.width) => a,
            Code::Or => a | self.word(node.b),
            Code::Xor => a ^ self.word(node.b),
            Code::Equal => (a == self.word(node.b)).into(),
            Code::Below => (a < self.word(node.b)).into(),
            Code::BelowSigned => {
                (signed(a, node.from) < signed(self.word(node.b), node.from)).into()
            }
            Code::Mux if a == 0 => self.word(node.c),
            Code::Mux => self.word(node.b),
            Code::ShiftLeft => a.checked_shl(node.by.into()).unwrap_or(0),
            Code::ShiftRight | Code::Slice => a.checked_shr(node.by.into()).unwrap_or(0),
            Code::ShiftRightSigned => (signed(a, node.from) >> node.by.min(63)) as u64,
            Code::Extend => a,
            Code::ExtendSigned => signed(a, node.from) as u64,
            Code::Join => a.checked_shl(node.by.into()).unwrap_or(0) | self.word(node.b),
            Code::Read => read(&self.plan.memories[node.memory as usize], self.slab, a),
        };
        value & mask(node.width)
    }
}

/// Slot and width of a register.
fn plan_of(plan: &Plan, register: u32) -> (u32, u8) {
    let planned = &plan.registers[register as usize];
    (planned.slot, planned.width)
}

/// Lines: nets are what their nodes make where something moves them.
pub(super) struct Pairs<'w> {
    pub plan: &'w Plan,
    pub graph: &'w Graph,
    pub slab: &'w [u64],
    pub known: &'w mut [Known<Line>],
    pub stamp: u64,
    /// By slot.
    pub slopes: &'w [u64],
    /// What moves: see [`Graph::touches`].
    pub touched: &'w [u64],
}

impl Pairs<'_> {
    /// For how many ticks the registers of a block stay on their lines.
    pub fn edge(&mut self, edge: usize) -> u64 {
        let graph = self.graph;
        let mut place = graph.starts[edge] as usize;
        let mut until = u64::MAX;
        loop {
            match graph.items[place] {
                Item::Choose { on, low } => {
                    let line = self.line(on);
                    until = until.min(holds(line));
                    if line.value == 0 {
                        place = low as usize;
                        if until <= 1 {
                            return until;
                        }
                        continue;
                    }
                }
                Item::Goto { to } => {
                    place = to as usize;
                    continue;
                }
                Item::Register { register, next } => {
                    let slot = plan_of(self.plan, register).0;
                    let line = self.line(next);
                    if line.slope != self.slopes[slot as usize] {
                        return 1;
                    }
                    until = until.min(line.until);
                }
                Item::Write { enable } => {
                    let line = self.line(enable);
                    // It may be high in a block that has nothing to do: the word is written already.
                    if line.value != 0 {
                        return 0;
                    }
                    until = until.min(holds(line));
                }
                Item::End => return until,
            }
            if until <= 1 {
                return until;
            }
            place += 1;
        }
    }

    /// For how many ticks a watched net stays as it is.
    pub fn net(&mut self, net: u32) -> u64 {
        let line = self.line(self.graph.nets[net as usize].made);
        if line.is_still() { line.until } else { 1 }
    }

    fn line(&mut self, from: From) -> Line {
        match from {
            From::Register(slot) => Line {
                slope: self.slopes[slot as usize],
                ..Line::still(self.slab[slot as usize])
            },
            From::Fixed(slot) => Line::still(self.slab[slot as usize]),
            From::Net(number) => {
                let net = self.graph.nets[number as usize];
                if has(self.touched, number as usize) {
                    self.line(net.made)
                } else {
                    Line::still(self.slab[net.slot as usize])
                }
            }
            From::Node(number) => {
                let node = &self.graph.nodes[number as usize];
                if !node.shared {
                    return self.make(node);
                }
                let known = self.known[number as usize];
                if known.stamp == self.stamp {
                    return known.what;
                }
                let what = self.make(node);
                self.known[number as usize] = Known {
                    stamp: self.stamp,
                    what,
                };
                what
            }
        }
    }

    fn make(&mut self, node: &Node) -> Line {
        let a = self.line(node.a);
        let (width, from, by) = (node.width, node.from, node.by);
        match node.code {
            Code::Not => a.not(width),
            Code::Negate => a.negate(width),
            Code::Add => a.add(self.line(node.b), width),
            Code::Subtract => a.subtract(self.line(node.b), width),
            Code::Multiply => a.multiply(self.line(node.b), width),
            // What is zero for good asks for nothing else.
            Code::And if a == Line::still(0) => a,
            Code::And => a.and(self.line(node.b), width),
            Code::Or if a == Line::still(mask(width)) => a,
            Code::Or => a.or(self.line(node.b), width),
            Code::Xor => a.xor(self.line(node.b), width),
            Code::Equal => a.equal(self.line(node.b), from),
            Code::Below => a.below(self.line(node.b), from),
            Code::BelowSigned => a.below_signed(self.line(node.b), from),
            Code::Mux => {
                let chosen = self.line(if a.value == 0 { node.c } else { node.b });
                Line {
                    until: chosen.until.min(holds(a)),
                    ..chosen.low(width)
                }
            }
            Code::ShiftLeft => a.shift_left(by, width),
            Code::ShiftRight | Code::Slice => a.slice(by, from, width),
            Code::ShiftRightSigned => a.shift_right_signed(by, from, width),
            Code::Extend => a.extend(from, width),
            Code::ExtendSigned => a.extend_signed(from, width),
            Code::Join => a.join(self.line(node.b), by, width),
            Code::Read => {
                let memory = &self.plan.memories[node.memory as usize];
                Line {
                    until: if a.is_still() { a.until } else { 1 },
                    ..Line::still(read(memory, self.slab, a.value) & mask(width))
                }
            }
        }
    }
}

/// For how many ticks a condition stays low, or stays high.
fn holds(line: Line) -> u64 {
    if line.is_still() { line.until } else { 1 }
}
