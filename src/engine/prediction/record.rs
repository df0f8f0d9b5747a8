//! Recording of an attempt as a [`Recipe`].

use super::graph::{From, Node, bits};
use super::notes::{Notes, Traced, What, number};
use super::pair::Line;
use super::recipe::{Recipe, Sum};
use super::tree::Item;
use super::walk::Pairs;
use crate::engine::flat::mask;
use crate::engine::plan::Code;
use rustc_hash::FxHashMap;

/// Evaluates nodes as [`Pairs`] does, and records them.
pub(super) struct Recorder<'r, 'w> {
    pairs: &'r mut Pairs<'w>,
    notes: Notes<'r>,
    known: FxHashMap<u32, Traced>,
}

impl<'r, 'w> Recorder<'r, 'w> {
    pub fn new(pairs: &'r mut Pairs<'w>, reloaded: &'r [bool]) -> Self {
        Recorder {
            notes: Notes::new(pairs.slab, reloaded),
            pairs,
            known: FxHashMap::default(),
        }
    }

    /// Records these edge blocks and watched nets; `None` if that is not possible.
    pub fn record(
        mut self,
        edges: &[u64],
        watched_nets: impl Iterator<Item = u32>,
    ) -> Option<Recipe> {
        for edge in bits(edges) {
            self.edge(edge)?;
        }
        for net in watched_nets {
            let made = self.pairs.graph.nets[net as usize].made;
            self.trace(made)?.line.is_still().then_some(())?;
        }
        let mut recipe = self.notes.recipe();
        recipe.edges = edges.to_vec();
        Some(recipe)
    }

    fn edge(&mut self, edge: usize) -> Option<()> {
        let graph = self.pairs.graph;
        let mut place = graph.starts[edge] as usize;
        loop {
            match graph.items[place] {
                Item::Choose { on, low } => {
                    let on = self.trace(on)?;
                    if !self.notes.is_high(on)? {
                        place = low as usize;
                        continue;
                    }
                }
                Item::Goto { to } => {
                    place = to as usize;
                    continue;
                }
                Item::Register { register, next } => self.register(register, next)?,
                Item::Write { enable } => {
                    let enable = self.trace(enable)?;
                    (!self.notes.is_high(enable)?).then_some(())?;
                }
                Item::End => return Some(()),
            }
            place += 1;
        }
    }

    /// Records that a register continues along its line.
    fn register(&mut self, register: u32, next: From) -> Option<()> {
        let planned = self.pairs.plan.registers[register as usize];
        let (slot, width) = (planned.slot, planned.width);
        let next = self.trace(next)?;
        let now = self.trace(From::Register(slot))?;
        if now.line.is_still() {
            if next.what == What::Slot(slot) {
                return Some(());
            }
            return self.notes.equal(next, now, width).map(|_| ());
        }
        let slope = now.line.slope;
        let (word, now) = (self.notes.word(next), self.notes.word(now));
        let sum = Sum {
            word: now,
            plus: slope,
        };
        if self.notes.sums.get(&word) == Some(&(sum, width)) {
            return Some(());
        }
        let step = self
            .notes
            .make(Code::Subtract, [width, width, 0], word, now);
        self.notes.same(step, slope, width);
        Some(())
    }

    fn trace(&mut self, from: From) -> Option<Traced> {
        let pairs = &self.pairs;
        let slot = match from {
            From::Register(slot) => slot,
            From::Port(slot) => slot,
            From::Number(slot) => {
                return Some(number(pairs.slab[slot as usize]));
            }
            From::Net(net) if pairs.touches(net) => {
                return self.trace(pairs.graph.nets[net as usize].made);
            }
            From::Net(net) => pairs.graph.nets[net as usize].slot,
            From::Node(node) => {
                if let Some(&traced) = self.known.get(&node) {
                    return Some(traced);
                }
                let traced = self.node(node)?;
                self.known.insert(node, traced);
                return Some(traced);
            }
        };
        let line = self.pairs.at(from, slot);
        let what = match line.is_still() {
            true => What::Slot(slot),
            false => What::Word(self.notes.load(slot)),
        };
        Some(Traced { line, what })
    }

    fn node(&mut self, number: u32) -> Option<Traced> {
        let node = self.pairs.graph.nodes[number as usize];
        let traced = self.compute(&node)?;
        // A bit is requested more often than it changes.
        let is_word = matches!(traced.what, What::Word(_));
        match node.width == 1 && is_word && traced.line.is_still() {
            true => self.notes.pin(traced),
            false => Some(traced),
        }
    }

    fn compute(&mut self, node: &Node) -> Option<Traced> {
        let Node {
            code,
            width,
            from,
            by,
            ..
        } = *node;
        match code {
            Code::And => return self.both(node, 0),
            Code::Or => return self.both(node, mask(width)),
            _ => {}
        }
        let a = self.trace(node.a)?;
        match code {
            Code::Mux => {
                let chosen = if self.notes.is_high(a)? {
                    node.b
                } else {
                    node.c
                };
                return self.trace(chosen);
            }
            Code::Read => return self.read(node, a),
            _ => {}
        }
        let a = self.notes.take(a);
        match code {
            Code::Not | Code::Negate | Code::ShiftLeft => {
                let line = match code {
                    Code::Not => a.line.not(width),
                    Code::Negate => a.line.negate(width),
                    _ => a.line.shift_left(by, width),
                };
                return Some(self.notes.result(line, code, [width, from, by], a, a));
            }
            Code::ShiftRight | Code::Slice if by >= from => {
                return Some(
                    self.notes
                        .result(Line::still(0), code, [width, from, by], a, a),
                );
            }
            Code::ShiftRight | Code::Slice => {
                let high = self.notes.high(a, by, from);
                return Some(self.notes.extend(high, from - by, width, false));
            }
            Code::ShiftRightSigned => {
                let by = by.min(from - 1);
                let high = self.notes.high(a, by, from);
                return Some(self.notes.extend(high, from - by, width, true));
            }
            Code::Extend => return Some(self.notes.extend(a, from, width, false)),
            Code::ExtendSigned => return Some(self.notes.extend(a, from, width, true)),
            _ => {}
        }
        let b = self.trace(node.b)?;
        let b = self.notes.take(b);
        match code {
            Code::Add => Some(self.notes.add(a, b, width)),
            Code::Subtract => {
                let line = a.line.subtract(b.line, width);
                let sum = self.notes.result(line, code, [width, width, 0], a, b);
                if let (What::Word(to), What::Word(word), What::Number) = (sum.what, a.what, b.what)
                {
                    self.notes
                        .known_sum(to, word, b.line.value.wrapping_neg(), width);
                }
                Some(sum)
            }
            Code::Multiply => {
                let (a, b) = self.notes.one_number(a, b)?;
                let line = a.line.multiply(b.line, width, &mut 0);
                Some(self.notes.result(line, code, [width, width, 0], a, b))
            }
            Code::Xor => {
                let (a, b) = self.notes.one_number(a, b)?;
                let line = a.line.xor(b.line, width, &mut 0);
                (line.is_still() == (a.line.is_still() && b.line.is_still())).then_some(())?;
                Some(self.notes.result(line, code, [width, width, 0], a, b))
            }
            Code::Equal => self.notes.equal(a, b, from),
            Code::Below => self.notes.below(a, b, from, 0),
            Code::BelowSigned => self.notes.below(a, b, from, 1 << (from - 1)),
            Code::Join => {
                let low = self.notes.extend(b, by, width, false);
                let line = a.line.join(b.line, by, width, &mut 0);
                Some(self.notes.result(line, code, [width, from, by], a, low))
            }
            _ => None,
        }
    }

    /// Records a read of a memory whose address is constant.
    fn read(&mut self, node: &Node, address: Traced) -> Option<Traced> {
        let address = self.notes.pin(address)?.line.value;
        let memory = &self.pairs.plan.memories[node.memory as usize];
        if address >= u64::from(memory.words) {
            return Some(number(0));
        }
        let mut place = address as u32;
        if let Some(head) = memory.head {
            self.notes.guard(head);
            place = (place + self.pairs.slab[head as usize] as u32) % memory.words;
        }
        let slot = memory.first + place;
        let line = Line::still(self.pairs.slab[slot as usize]);
        let what = What::Slot(slot);
        Some(Traced { line, what })
    }

    /// Records an `and` or `or`, for which one operand may decide.
    fn both(&mut self, node: &Node, end: u64) -> Option<Traced> {
        let [one, other] = [node.a, node.b].map(|from| self.pairs.ended(from));
        let ends = |line: Line| line == Line::still(end);
        let alone = match (ends(one.0), ends(other.0)) {
            (true, true) if one.1 >= other.1 => Some(node.a),
            (true, false) => Some(node.a),
            (_, true) => Some(node.b),
            (false, false) => None,
        };
        if let Some(from) = alone {
            let traced = self.trace(from)?;
            return self.notes.pin(traced);
        }
        let (a, b) = (self.trace(node.a)?, self.trace(node.b)?);
        let (a, b) = (self.notes.take(a), self.notes.take(b));
        let width = node.width;
        if node.code == Code::And {
            return self.notes.and(a, b, width);
        }
        let (a, b) = (self.notes.not(a, width), self.notes.not(b, width));
        let neither = self.notes.and(a, b, width)?;
        Some(self.notes.not(neither, width))
    }
}
