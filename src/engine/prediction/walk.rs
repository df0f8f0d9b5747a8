//! Evaluation of edge blocks: first the words that registers take, then their lines.

use super::NODE;
use super::graph::{From, Graph, Node, has};
use super::pair::Line;
use super::recipe::of;
use super::tree::Item;
use crate::engine::flat::mask;
use crate::engine::interpreter::read;
use crate::engine::layout::Slot;
use crate::engine::plan::{Code, Plan, PlannedRegister};

/// Cached value of a node, valid for one walk.
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

/// Register that moves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Moving {
    pub register: u32,
    pub slot: Slot,
    pub width: u8,
    /// Change per tick, modulo 2^width.
    pub slope: u64,
}

/// End of an attempt; the register that stopped it, if one did.
pub(super) struct Stop(pub Option<u32>);

/// Evaluation of words; nets are settled.
pub(super) struct Words<'w> {
    pub plan: &'w Plan,
    pub graph: &'w Graph,
    pub slab: &'w [u64],
    pub known: &'w mut [Known<u64>],
    pub stamp: u64,
    pub work: &'w mut u64,
}

impl Words<'_> {
    /// Collects the registers that an edge block moves.
    pub fn edge(&mut self, edge: usize, moving: &mut Vec<Moving>) -> Result<(), Stop> {
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
                    let PlannedRegister { slot, width, .. } =
                        self.plan.registers[register as usize];
                    let now = self.slab[slot as usize];
                    let word = self.word(next);
                    if word != now {
                        if self.ends(register, next) {
                            return Err(Stop(Some(register)));
                        }
                        let slope = word.wrapping_sub(now) & mask(width);
                        moving.push(Moving {
                            register,
                            slot,
                            width,
                            slope,
                        });
                    }
                }
                Item::Write { enable } => {
                    if self.word(enable) != 0 {
                        return Err(Stop(None));
                    }
                }
                Item::End => return Ok(()),
            }
            place += 1;
        }
    }

    /// True if a move of this register always ends the prediction.
    pub fn ends(&self, register: u32, next: From) -> bool {
        // A bit that toggles is rarely on a line that anything follows, and a loaded word stays
        // constant.
        let is_loaded = matches!(next, From::Number(_) | From::Port(_));
        let register = register as usize;
        self.plan.registers[register].width == 1 || is_loaded || self.graph.held[register]
    }

    pub fn word(&mut self, from: From) -> u64 {
        match from {
            From::Register(slot) | From::Port(slot) | From::Number(slot) => {
                self.slab[slot as usize]
            }
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
        *self.work += NODE;
        let a = self.word(node.a);
        let b = match node.code {
            Code::Mux if a == 0 => return self.word(node.c) & mask(node.width),
            Code::Mux => return self.word(node.b) & mask(node.width),
            Code::Read => {
                let memory = &self.plan.memories[node.memory as usize];
                return read(memory, self.slab, a) & mask(node.width);
            }
            Code::And if a == 0 => return 0,
            Code::Or if a == mask(node.width) => return a,
            _ if node.b == node.a => a,
            _ => self.word(node.b),
        };
        of(node.code, [node.width, node.from, node.by], a, b)
    }
}

/// Evaluation of lines; nets that move are computed from their nodes.
pub(super) struct Pairs<'w> {
    pub plan: &'w Plan,
    pub graph: &'w Graph,
    pub slab: &'w [u64],
    pub known: &'w mut [Known<(Line, u64)>],
    pub stamp: u64,
    /// Slopes by slot.
    pub slopes: &'w [u64],
    /// Nets and blocks that move: see [`Graph::touches`].
    pub touched: &'w [u64],
    pub work: &'w mut u64,
    /// Number of ticks in which all lines evaluated since it was set are exact.
    pub until: u64,
    /// True if lines of nodes with a single reader are cached too.
    pub all: bool,
}

impl Pairs<'_> {
    /// Follows the registers of a block while they stay on their lines.
    pub fn edge(&mut self, edge: usize) -> Result<(), Stop> {
        let graph = self.graph;
        let mut place = graph.starts[edge] as usize;
        loop {
            match graph.items[place] {
                Item::Choose { on, low } => {
                    if !self.holds(on) {
                        place = low as usize;
                        continue;
                    }
                }
                Item::Goto { to } => {
                    place = to as usize;
                    continue;
                }
                Item::Register { register, next } => {
                    let slot = self.plan.registers[register as usize].slot;
                    if self.line(next).slope != self.slopes[slot as usize] || self.until <= 1 {
                        return Err(Stop(Some(register)));
                    }
                }
                // The enable may be high in a block that is idle: the word is written already.
                Item::Write { enable } => {
                    if self.holds(enable) {
                        return Err(Stop(None));
                    }
                }
                Item::End => return Ok(()),
            }
            if self.until <= 1 {
                return Err(Stop(None));
            }
            place += 1;
        }
    }

    /// Follows a net while it is constant.
    pub fn net(&mut self, net: u32) -> Result<(), Stop> {
        let line = self.line(self.graph.nets[net as usize].made);
        match line.is_still() && self.until > 1 {
            true => Ok(()),
            false => Err(Stop(None)),
        }
    }

    /// True if something that moves drives a net.
    pub fn touches(&self, net: u32) -> bool {
        has(self.touched, net as usize)
    }

    /// Returns the line of a slot.
    pub fn at(&self, from: From, slot: Slot) -> Line {
        Line {
            value: self.slab[slot as usize],
            slope: match from {
                From::Register(_) => self.slopes[slot as usize],
                _ => 0,
            },
        }
    }

    /// Returns a line, and the number of ticks in which it is exact.
    pub fn ended(&mut self, from: From) -> (Line, u64) {
        let before = std::mem::replace(&mut self.until, u64::MAX);
        let line = self.line(from);
        (line, std::mem::replace(&mut self.until, before))
    }

    /// Returns a condition, and limits the horizon to the ticks in which it is constant.
    fn holds(&mut self, on: From) -> bool {
        let line = self.line(on);
        if !line.is_still() {
            self.until = 1;
        }
        line.value != 0
    }

    pub fn line(&mut self, from: From) -> Line {
        match from {
            From::Register(slot) => Line {
                value: self.slab[slot as usize],
                slope: self.slopes[slot as usize],
            },
            From::Port(slot) | From::Number(slot) => Line::still(self.slab[slot as usize]),
            From::Net(number) => {
                let net = self.graph.nets[number as usize];
                if self.touches(number) {
                    self.line(net.made)
                } else {
                    Line::still(self.slab[net.slot as usize])
                }
            }
            From::Node(number) => {
                let node = &self.graph.nodes[number as usize];
                if !node.shared && !self.all {
                    return self.make(node);
                }
                let known = self.known[number as usize];
                if known.stamp == self.stamp {
                    self.until = self.until.min(known.what.1);
                    return known.what.0;
                }
                let before = std::mem::replace(&mut self.until, u64::MAX);
                let line = self.make(node);
                self.known[number as usize] = Known {
                    stamp: self.stamp,
                    what: (line, self.until),
                };
                self.until = self.until.min(before);
                line
            }
        }
    }

    fn make(&mut self, node: &Node) -> Line {
        *self.work += NODE;
        let (width, from, by) = (node.width, node.from, node.by);
        match node.code {
            Code::And => return self.both(node.a, node.b, 0, width),
            Code::Or => return self.both(node.a, node.b, mask(width), width),
            _ => {}
        }
        let a = self.line(node.a);
        let until = &mut self.until;
        match node.code {
            Code::Not => a.not(width),
            Code::Negate => a.negate(width),
            Code::ShiftLeft => a.shift_left(by, width),
            Code::ShiftRight | Code::Slice => a.slice(by, from, width, until),
            Code::ShiftRightSigned => a.shift_right_signed(by, from, width, until),
            Code::Extend => a.extend(from, width, until),
            Code::ExtendSigned => a.extend_signed(from, width, until),
            Code::Mux => {
                if !a.is_still() {
                    *until = 1;
                }
                let chosen = if a.value == 0 { node.c } else { node.b };
                self.line(chosen).low(width)
            }
            Code::Read => {
                if !a.is_still() {
                    *until = 1;
                }
                let memory = &self.plan.memories[node.memory as usize];
                Line::still(read(memory, self.slab, a.value) & mask(width))
            }
            _ => {
                let b = self.line(node.b);
                let until = &mut self.until;
                match node.code {
                    Code::Add => a.add(b, width),
                    Code::Subtract => a.subtract(b, width),
                    Code::Multiply => a.multiply(b, width, until),
                    Code::Xor => a.xor(b, width, until),
                    Code::Equal => a.equal(b, from, until),
                    Code::Below => a.below(b, from, until),
                    Code::BelowSigned => a.below_signed(b, from, until),
                    Code::Join => a.join(b, by, width, until),
                    _ => unreachable!("all others are above"),
                }
            }
        }
    }

    /// Returns an `and`, which zero decides, or an `or`, which all ones decide.
    fn both(&mut self, a: From, b: From, end: u64, width: u8) -> Line {
        let end = Line::still(end);
        let before = std::mem::replace(&mut self.until, u64::MAX);
        let a = self.line(a);
        let first = std::mem::replace(&mut self.until, u64::MAX);
        if a == end && first == u64::MAX {
            // Decided for good, whatever the other one is.
            self.until = before;
            return a;
        }
        let b = self.line(b);
        let second = self.until;
        let line = match (a == end, b == end) {
            (true, true) => {
                self.until = first.max(second);
                end
            }
            (true, false) => {
                self.until = first;
                end
            }
            (false, true) => end,
            _ => {
                self.until = first.min(second);
                match end.value {
                    0 => a.and(b, width, &mut self.until),
                    _ => a.or(b, width, &mut self.until),
                }
            }
        };
        self.until = self.until.min(before);
        line
    }
}
