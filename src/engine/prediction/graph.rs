//! Dependency graph of a plan, so that only nodes that matter are examined.

use super::tree::{Item, Root, tree};
use crate::engine::layout::Slot;
use crate::engine::plan::{Block, Code, Plan, Step};
use rustc_hash::FxHashMap;

/// Source of a value.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(super) enum From {
    /// Register.
    Register(Slot),
    /// Input port.
    Port(Slot),
    /// Constant.
    Number(Slot),
    /// Net: its index.
    Net(u32),
    /// Node: its index.
    Node(u32),
}

/// Node of the graph.
#[derive(Debug, Clone, Copy)]
pub(super) struct Node {
    pub code: Code,
    pub width: u8,
    pub from: u8,
    pub by: u8,
    /// True if several nodes read it.
    pub shared: bool,
    pub a: From,
    pub b: From,
    pub c: From,
    pub memory: u32,
}

/// Net of the plan.
#[derive(Debug, Clone, Copy)]
pub(super) struct Net {
    pub slot: Slot,
    pub made: From,
}

/// Dependency graph of a plan.
#[derive(Debug, Clone, Default)]
pub struct Graph {
    pub(super) nodes: Vec<Node>,
    pub(super) nets: Vec<Net>,
    /// First item of each edge block.
    pub(super) starts: Vec<u32>,
    pub(super) items: Vec<Item>,
    /// By edge block: itself, and the blocks whose registers it reads.
    pub(super) suppliers: Vec<Vec<u64>>,
    /// Nets that must not change.
    pub(super) watched_nets: Vec<u32>,
    /// Per register `stride` words: a bit for each net that it moves, from `edge_word` on for each
    /// edge block, from `watched_word` on for each net in `watched_nets`.
    pub(super) touches: Vec<u64>,
    pub(super) stride: usize,
    pub(super) edge_word: usize,
    pub(super) watched_word: usize,
    /// By register: true if it must not change.
    pub(super) held: Vec<bool>,
    /// By register: source of its next value.
    pub(super) nexts: Vec<From>,
    /// By register: true if its next value depends on no other register and on no net.
    pub(super) alone: Vec<bool>,
    /// One above the last slot of a register.
    pub(super) slots: usize,
}

/// Set of registers, one bit each.
type Set = Vec<u64>;

pub(super) fn has(set: &[u64], bit: usize) -> bool {
    set.get(bit / 64)
        .is_some_and(|word| word >> (bit % 64) & 1 != 0)
}

pub(super) fn insert(set: &mut [u64], bit: usize) {
    set[bit / 64] |= 1 << (bit % 64);
}

/// Returns the indices of the set bits.
pub(super) fn bits(set: &[u64]) -> impl Iterator<Item = usize> + '_ {
    set.iter().enumerate().flat_map(|(word, &bits)| {
        let mut bits = bits;
        std::iter::from_fn(move || {
            let bit = bits.trailing_zeros() as usize;
            (bits != 0).then(|| {
                bits &= bits - 1;
                word * 64 + bit
            })
        })
    })
}

pub(super) fn unite(set: &mut [u64], other: &[u64]) {
    set.iter_mut().zip(other).for_each(|(to, from)| *to |= from);
}

impl Graph {
    /// Creates the graph; `held` gives by slot the nets and registers that must not change.
    pub fn new(plan: &Plan, held: &[bool]) -> Graph {
        let mut builder = Builder::new(plan);
        let mut trees = Vec::new();
        let mut edges = Vec::new();
        for (place, block) in plan.blocks.iter().enumerate() {
            let known = builder.block(block);
            if place < plan.settling {
                for &(from, to) in &block.outputs {
                    builder.net(known[&from], to);
                }
                continue;
            }
            let mut roots = Vec::new();
            let mut set = vec![0; builder.words];
            for &(number, slot) in &block.registers {
                let register = plan.registers[number as usize];
                let next = builder.at(slot, &known);
                let next = builder.fit(next, register.width);
                builder.graph.nexts[number as usize] = next;
                let mut takes = builder.set(next);
                insert(&mut takes, number as usize);
                unite(&mut set, &takes);
                let registers = takes.iter().map(|word| word.count_ones()).sum::<u32>();
                builder.graph.alone[number as usize] = registers == 1 && !builder.crosses(next);
                roots.push(Root::Register {
                    register: number,
                    next,
                });
            }
            for write in &block.writes {
                let enable = builder.at(write.enable, &known);
                unite(&mut set, &builder.set(enable));
                // A block that has written its word is idle until the word or the address changes.
                for moved in [Some(write.data), write.address].into_iter().flatten() {
                    let moved = builder.at(moved, &known);
                    unite(&mut set, &builder.set(moved));
                }
                roots.push(Root::Write { enable });
            }
            edges.push(set);
            trees.push(roots);
        }
        builder.finish(&trees, &edges, held)
    }
}

struct Builder<'p> {
    plan: &'p Plan,
    graph: Graph,
    /// Number of words of a set.
    words: usize,
    /// Registers on which each node, and each net, depends.
    nodes: Vec<Set>,
    nets: Vec<Set>,
    registers: FxHashMap<Slot, u32>,
    numbers: FxHashMap<Slot, u32>,
}

impl<'p> Builder<'p> {
    fn new(plan: &'p Plan) -> Self {
        let registers = plan.registers.iter().enumerate();
        Builder {
            plan,
            graph: Graph {
                nexts: vec![From::Number(0); plan.registers.len()],
                alone: vec![false; plan.registers.len()],
                ..Graph::default()
            },
            words: plan.registers.len().div_ceil(64),
            nodes: Vec::new(),
            nets: Vec::new(),
            registers: registers
                .map(|(number, register)| (register.slot, number as u32))
                .collect(),
            numbers: FxHashMap::default(),
        }
    }

    fn at(&self, slot: Slot, known: &FxHashMap<Slot, From>) -> From {
        if let Some(&from) = known.get(&slot) {
            from
        } else if let Some(&net) = self.numbers.get(&slot) {
            From::Net(net)
        } else if self.registers.contains_key(&slot) {
            From::Register(slot)
        } else if self.plan.layout.inputs.contains(&slot) {
            From::Port(slot)
        } else {
            From::Number(slot)
        }
    }

    fn set(&self, from: From) -> Set {
        match from {
            From::Port(_) | From::Number(_) => vec![0; self.words],
            From::Register(slot) => {
                let mut set = vec![0; self.words];
                insert(&mut set, self.registers[&slot] as usize);
                set
            }
            From::Net(net) => self.nets[net as usize].clone(),
            From::Node(node) => self.nodes[node as usize].clone(),
        }
    }

    /// Returns the width of a source, if it can move.
    fn width(&self, from: From) -> Option<u8> {
        match from {
            From::Port(_) | From::Number(_) => None,
            From::Register(slot) => Some(self.plan.registers[self.registers[&slot] as usize].width),
            From::Net(net) => self.width(self.graph.nets[net as usize].made),
            From::Node(node) => Some(self.graph.nodes[node as usize].width),
        }
    }

    /// True if it depends on a net.
    fn crosses(&self, from: From) -> bool {
        match from {
            From::Net(_) => true,
            From::Node(node) => {
                let Node { a, b, c, .. } = self.graph.nodes[node as usize];
                let others = [b, c].into_iter().filter(|&other| other != a);
                std::iter::once(a)
                    .chain(others)
                    .any(|from| self.crosses(from))
            }
            _ => false,
        }
    }

    /// Extends or cuts a source to `width` bits.
    fn fit(&mut self, from: From, width: u8) -> From {
        match self.width(from) {
            Some(known) if known != width => {
                let node = Node {
                    code: Code::Extend,
                    width,
                    from: known,
                    by: 0,
                    shared: false,
                    a: from,
                    b: from,
                    c: from,
                    memory: 0,
                };
                let set = self.set(from);
                self.node(node, set)
            }
            _ => from,
        }
    }

    fn node(&mut self, node: Node, set: Set) -> From {
        self.graph.nodes.push(node);
        self.nodes.push(set);
        From::Node(self.graph.nodes.len() as u32 - 1)
    }

    fn net(&mut self, made: From, slot: Slot) {
        let number = self.graph.nets.len() as u32;
        self.graph.nets.push(Net { slot, made });
        self.nets.push(self.set(made));
        self.numbers.insert(slot, number);
    }

    /// Returns the nodes of a block, by their slots while it runs.
    fn block(&mut self, block: &Block) -> FxHashMap<Slot, From> {
        let mut known = FxHashMap::default();
        for step in &block.steps {
            let from = self.step(step, &known);
            known.insert(step.to, from);
        }
        known
    }

    fn step(&mut self, step: &Step, known: &FxHashMap<Slot, From>) -> From {
        let Step { code, width, .. } = *step;
        let a = self.at(step.a, known);
        if code == Code::Extend && self.width(a) == Some(width) {
            return a;
        }
        let mut node = Node {
            code,
            width,
            from: step.from,
            by: step.by,
            shared: false,
            a,
            b: a,
            c: a,
            memory: 0,
        };
        match code {
            Code::Not | Code::Negate | Code::ShiftLeft => node.a = self.fit(a, width),
            Code::Add | Code::Subtract | Code::Multiply | Code::And | Code::Or | Code::Xor => {
                node.a = self.fit(a, width);
                node.b = self.at(step.b, known);
                node.b = self.fit(node.b, width);
            }
            Code::Equal | Code::Below | Code::BelowSigned => {
                // Equality and unsigned order need no more bits than exist; two's complement order
                // needs the sign.
                let b = self.at(step.b, known);
                let wide = match code {
                    Code::BelowSigned => step.from,
                    _ => step.from.max(step.by),
                };
                node.from = wide;
                node.a = self.fit(a, wide);
                node.b = self.fit(b, wide);
            }
            Code::Mux => {
                node.b = self.at(step.b, known);
                node.b = self.fit(node.b, width);
                node.c = self.at(step.c, known);
                node.c = self.fit(node.c, width);
            }
            Code::Join => node.b = self.at(step.b, known),
            Code::Read => node.memory = step.c,
            Code::ShiftRight
            | Code::ShiftRightSigned
            | Code::Slice
            | Code::Extend
            | Code::ExtendSigned => {}
        }
        if code == Code::Join {
            node.a = self.fit(a, width);
        }
        let mut set = self.set(node.a);
        unite(&mut set, &self.set(node.b));
        unite(&mut set, &self.set(node.c));
        self.node(node, set)
    }

    fn finish(mut self, trees: &[Vec<Root>], edges: &[Set], held: &[bool]) -> Graph {
        for roots in trees {
            self.graph.starts.push(self.graph.items.len() as u32);
            tree(self.plan, &self.graph.nodes, roots, &mut self.graph.items);
        }
        self.watched_nets(held);
        self.share();
        let graph = &mut self.graph;
        graph.edge_word = graph.nets.len().div_ceil(64);
        graph.watched_word = graph.edge_word + edges.len().div_ceil(64);
        graph.stride = graph.watched_word + graph.watched_nets.len().div_ceil(64);
        graph.touches = vec![0; graph.stride * self.plan.registers.len()];
        let owners = self.plan.blocks[self.plan.settling..].iter().enumerate();
        for set in edges {
            let mut suppliers = vec![0; edges.len().div_ceil(64)];
            for (edge, block) in owners.clone() {
                let mut registers = block.registers.iter();
                if registers.any(|&(register, _)| has(set, register as usize)) {
                    insert(&mut suppliers, edge);
                }
            }
            graph.suppliers.push(suppliers);
        }
        for (edge, suppliers) in graph.suppliers.iter_mut().enumerate() {
            insert(suppliers, edge);
        }
        let watched_nets = graph
            .watched_nets
            .iter()
            .map(|watched| &self.nets[*watched as usize]);
        for (word, sets) in [
            (0, self.nets.iter().collect::<Vec<_>>()),
            (graph.edge_word, edges.iter().collect()),
            (graph.watched_word, watched_nets.collect()),
        ] {
            for (bit, set) in sets.into_iter().enumerate() {
                for register in 0..self.plan.registers.len() {
                    if has(set, register) {
                        let start = register * graph.stride + word;
                        insert(&mut graph.touches[start..], bit);
                    }
                }
            }
        }
        let last = self.registers.keys().max();
        graph.slots = last.map_or(0, |&slot| slot as usize + 1);
        self.graph
    }

    /// Collects the nets and registers that must not change.
    fn watched_nets(&mut self, held: &[bool]) {
        let held = |slot: Slot| held.get(slot as usize).copied().unwrap_or(false);
        let registers = self.plan.registers.iter();
        self.graph.held = registers.map(|register| held(register.slot)).collect();
        for (number, net) in self.graph.nets.iter().enumerate() {
            if held(net.slot) {
                self.graph.watched_nets.push(number as u32);
            }
        }
    }

    /// Finds the nodes that several read.
    fn share(&mut self) {
        let mut uses = vec![0u32; self.graph.nodes.len()];
        let mut take = |from: From| {
            if let From::Node(node) = from {
                uses[node as usize] += 1;
            }
        };
        for node in &self.graph.nodes {
            take(node.a);
            match node.code {
                Code::Mux => {
                    take(node.b);
                    take(node.c);
                }
                _ if node.b != node.a => take(node.b),
                _ => {}
            }
        }
        for net in &self.graph.nets {
            // Each reader of the net evaluates it.
            take(net.made);
            take(net.made);
        }
        for item in &self.graph.items {
            match *item {
                Item::Choose { on, .. } => take(on),
                Item::Register { next, .. } => take(next),
                Item::Write { enable } => take(enable),
                Item::Goto { .. } | Item::End => {}
            }
        }
        for (node, uses) in self.graph.nodes.iter_mut().zip(uses) {
            node.shared = uses > 1;
        }
    }
}
