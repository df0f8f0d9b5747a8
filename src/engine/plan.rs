//! How a netlist is run: in which blocks, in which order, and where everything stands.

use super::flat::{Flat, Id, Op, Place, Port};
use super::layout::{Change, Layout, Slot, Spot, Watched};
use std::collections::{BTreeMap, BTreeSet, HashMap, HashSet};

/// A netlist that is planned.
///
/// Its nodes are in blocks: the nodes of an instance that can be computed one after the other once
/// the blocks before are settled. Blocks that settle nets come first, then those that make the edge.
/// A block runs where something that it reads has changed since it last ran.
#[derive(Debug, Clone)]
pub struct Plan {
    /// The blocks in the order in which they run.
    pub blocks: Vec<Block>,
    /// How many of them settle; the others make the edge.
    pub settling: usize,
    /// Registers, by their number in the netlist.
    pub registers: Vec<PlannedRegister>,
    /// Memories, by their number in the netlist.
    pub memories: Vec<PlannedMemory>,
    /// Where everything stands.
    pub layout: Layout,
    /// The paths of the instances.
    pub instances: Vec<String>,
}

/// A part of an instance that runs at once.
#[derive(Debug, Clone, Default)]
pub struct Block {
    /// The instance.
    pub instance: u32,
    /// Its place among the levels.
    pub level: u32,
    /// What it computes, in order.
    pub steps: Vec<Step>,
    /// What of it stands where others read it: from, to.
    pub outputs: Vec<(Slot, Slot)>,
    /// The registers that it makes, and from what.
    pub registers: Vec<(u32, Slot)>,
    /// The memories that it writes.
    pub writes: Vec<Write>,
    /// Whether one of its registers is made in its shadow.
    pub commits: bool,
    /// What it reads.
    pub reads: Vec<Slot>,
}

/// A node of a block.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Step {
    /// What it computes.
    pub code: Code,
    /// Width of the result.
    pub width: u8,
    /// Width of the first operand.
    pub from: u8,
    /// Bits of a shift, the lowest of a slice, the width of the lower part of a joined word.
    pub by: u8,
    /// Where the result stands.
    pub to: Slot,
    /// The operands; for a read the address and the memory.
    pub a: Slot,
    /// The second one.
    pub b: Slot,
    /// The third one.
    pub c: Slot,
}

/// What a step computes: see [`Op`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[allow(missing_docs, reason = "they are those of the netlist")]
pub enum Code {
    Not,
    Negate,
    Add,
    Subtract,
    Multiply,
    And,
    Or,
    Xor,
    Equal,
    Below,
    BelowSigned,
    Mux,
    ShiftLeft,
    ShiftRight,
    ShiftRightSigned,
    Slice,
    Extend,
    ExtendSigned,
    Join,
    Read,
}

/// A write to a memory at the edge.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Write {
    /// The memory.
    pub memory: u32,
    /// Where this is high.
    pub enable: Slot,
    /// The word.
    pub data: Slot,
    /// The address; none of a shift register.
    pub address: Option<Slot>,
}

/// A flip-flop of a plan.
#[derive(Debug, Clone, Copy)]
pub struct PlannedRegister {
    /// Where it stands.
    pub slot: Slot,
    /// Where it is made, if a later block still reads what it holds.
    pub shadow: Option<Slot>,
    /// Its width.
    pub width: u8,
}

/// A memory of a plan.
#[derive(Debug, Clone)]
pub struct PlannedMemory {
    /// Its first word.
    pub first: Slot,
    /// How many there are.
    pub words: u32,
    /// Where the first stage of a shift register is, counted from the first word.
    pub head: Option<Slot>,
    /// How often it was written or shifted.
    pub mark: Slot,
    /// Where it was written last.
    pub written: Slot,
    /// The blocks that read it.
    pub readers: Vec<u32>,
    /// Width of a word.
    pub width: u8,
}

/// Whether a node is computed again by whoever reads it.
fn is_cheap(op: Op) -> bool {
    matches!(
        op,
        Op::Not(_)
            | Op::Negate(_)
            | Op::ShiftLeft(..)
            | Op::ShiftRight(..)
            | Op::Slice(..)
            | Op::Extend(_)
            | Op::ExtendSigned(_)
    )
}

fn is_leaf(op: Op) -> bool {
    matches!(op, Op::Constant(_) | Op::Input(_) | Op::Register(_))
}

impl Plan {
    /// Plans a netlist that keeps the leaves which are `wanted`, and behind them the properties.
    pub fn of(flat: &Flat, wanted: &[bool]) -> Plan {
        let mut watched = vec![false; flat.nodes.len()];
        for (index, place) in flat.leaves.iter().enumerate() {
            if let (Place::Node(id), true) = (*place, wants(wanted, index)) {
                watched[id as usize] = true;
            }
        }
        for (index, &id) in flat.properties.iter().enumerate() {
            watched[id as usize] |= wants(wanted, flat.leaves.len() + index);
        }
        let levels = Levels::of(flat, &watched);
        let reads = edge_reads(flat, &levels);
        let order = order(flat, &levels, &reads);
        Planning::new(flat, &levels, &order, wanted).plan(&reads)
    }

    /// The number of a block's bit.
    pub fn bit(&self, block: usize) -> usize {
        bit(block, self.settling)
    }
}

fn bit(block: usize, settling: usize) -> usize {
    match block.checked_sub(settling) {
        None => block,
        Some(edge) => settling.next_multiple_of(64) + edge,
    }
}

fn wants(wanted: &[bool], index: usize) -> bool {
    wanted.get(index).copied().unwrap_or(false)
}

/// In which level each node is computed.
struct Levels {
    /// Whether a node stands for itself: others are leaves or computed where they are read.
    own: Vec<bool>,
    level: Vec<u32>,
    /// The level of the edge.
    end: u32,
}

impl Levels {
    fn of(flat: &Flat, watched: &[bool]) -> Levels {
        let count = flat.nodes.len();
        let own: Vec<bool> = flat
            .nodes
            .iter()
            .zip(watched)
            .map(|(node, watched)| !is_leaf(node.op) && (*watched || !is_cheap(node.op)))
            .collect();
        let instance = |id: Id| flat.nodes[id as usize].instance;
        // The earliest level.
        let mut early = vec![0u32; count];
        let mut end = 0;
        let mut stack = Vec::new();
        for id in 0..count as Id {
            if !own[id as usize] {
                continue;
            }
            let mut level = 0;
            through(
                flat,
                &own,
                flat.node(id).op.operands(),
                &mut stack,
                |other| {
                    let crossing = u32::from(instance(other) != instance(id));
                    level = level.max(early[other as usize] + crossing);
                },
            );
            early[id as usize] = level;
            end = end.max(level);
        }
        let end = end + 1;
        // As late as possible; what is watched is settled before the edge.
        let mut level: Vec<u32> = watched
            .iter()
            .map(|&watched| end - u32::from(watched))
            .collect();
        let roots = flat
            .registers
            .iter()
            .map(|register| (register.next, register.instance));
        let writes = flat
            .memories
            .iter()
            .flat_map(|memory| memory.port.operands().map(|id| (id, memory.instance)));
        for (root, owner) in roots.chain(writes) {
            through(flat, &own, std::iter::once(root), &mut stack, |other| {
                let at = end - u32::from(instance(other) != owner);
                level[other as usize] = level[other as usize].min(at);
            });
        }
        for id in (0..count as Id).rev() {
            if !own[id as usize] {
                continue;
            }
            let here = &mut level[id as usize];
            // The edge that writes a memory reads it first, if both are of one block.
            if let Op::Read(memory, _) = flat.node(id).op
                && flat.memories[memory as usize].instance != instance(id)
            {
                *here = (*here).min(end - 1);
            }
            let here = *here;
            through(
                flat,
                &own,
                flat.node(id).op.operands(),
                &mut stack,
                |other| {
                    let crossing = u32::from(instance(other) != instance(id));
                    level[other as usize] = level[other as usize].min(here - crossing);
                },
            );
        }
        Levels { own, level, end }
    }
}

/// Calls `see` for the nodes that stand for themselves and that these are made of.
fn through(
    flat: &Flat,
    own: &[bool],
    from: impl Iterator<Item = Id>,
    stack: &mut Vec<Id>,
    mut see: impl FnMut(Id),
) {
    stack.extend(from);
    while let Some(id) = stack.pop() {
        let op = flat.node(id).op;
        if own[id as usize] {
            see(id);
        } else {
            stack.extend(op.operands());
        }
    }
}

/// The blocks in their order, each by level and instance.
fn order(flat: &Flat, levels: &Levels, reads: &EdgeReads) -> Vec<(u32, u32)> {
    let mut keys = BTreeSet::new();
    for (id, node) in flat.nodes.iter().enumerate() {
        if levels.own[id] {
            keys.insert((levels.level[id], node.instance));
        }
    }
    let written = flat
        .memories
        .iter()
        .filter(|memory| memory.port != Port::Rom);
    let owners = flat.registers.iter().map(|register| register.instance);
    for owner in owners.chain(written.map(|memory| memory.instance)) {
        keys.insert((levels.end, owner));
    }
    let (mut edges, mut order): (Vec<_>, Vec<_>) = keys
        .into_iter()
        .partition(|(level, _)| *level == levels.end);
    // Of the edges that one first of whose registers the fewest others still read.
    let mut read: HashMap<(u32, u32), usize> = HashMap::new();
    for (reader, registers) in reads {
        for register in registers {
            let writer = flat.registers[*register as usize].instance;
            *read.entry((*reader, writer)).or_default() += 1;
        }
    }
    while let Some(best) = (0..edges.len()).min_by_key(|&place| {
        let writer = edges[place].1;
        let others = edges.iter().filter(|(_, other)| *other != writer);
        let counts = others.filter_map(|(_, reader)| read.get(&(*reader, writer)));
        counts.sum::<usize>()
    }) {
        order.push(edges.remove(best));
    }
    order
}

struct Planning<'f> {
    flat: &'f Flat,
    levels: &'f Levels,
    order: &'f [(u32, u32)],
    wanted: &'f [bool],
    /// The block of each level and instance.
    place: HashMap<(u32, u32), usize>,
    settling: usize,
    layout: Layout,
    /// Where nodes stand that others read.
    nets: HashMap<Id, Slot>,
    constants: BTreeMap<u64, Slot>,
    registers: Vec<PlannedRegister>,
}

impl<'f> Planning<'f> {
    fn new(
        flat: &'f Flat,
        levels: &'f Levels,
        order: &'f [(u32, u32)],
        wanted: &'f [bool],
    ) -> Self {
        let settling = order
            .iter()
            .filter(|(level, _)| *level < levels.end)
            .count();
        let blocks = bit(order.len(), settling);
        let mut layout = Layout::new(blocks);
        layout.inputs = flat.inputs.iter().map(|_| layout.take(1)).collect();
        let registers = flat.registers.iter().map(|register| PlannedRegister {
            slot: layout.take(1),
            shadow: None,
            width: register.width,
        });
        let registers = registers.collect();
        Planning {
            flat,
            levels,
            order,
            wanted,
            place: order
                .iter()
                .enumerate()
                .map(|(place, key)| (*key, place))
                .collect(),
            settling,
            layout,
            nets: HashMap::new(),
            constants: BTreeMap::new(),
            registers,
        }
    }

    /// The block of a node that stands for itself.
    fn block_of(&self, id: Id) -> usize {
        let key = (self.levels.level[id as usize], self.flat.node(id).instance);
        self.place[&key]
    }

    fn plan(mut self, reads: &EdgeReads) -> Plan {
        let mut nodes: Vec<Vec<Id>> = vec![Vec::new(); self.order.len()];
        for id in 0..self.flat.nodes.len() as Id {
            if self.levels.own[id as usize] {
                nodes[self.block_of(id)].push(id);
            }
        }
        self.shadow(reads);
        self.store();
        let mut scratch = Vec::new();
        let mut blocks = Vec::new();
        for (place, nodes) in nodes.iter().enumerate() {
            blocks.push(self.block(place, nodes, &mut scratch));
        }
        self.finish(blocks)
    }

    /// Which registers are made in a shadow: those that a later edge reads.
    fn shadow(&mut self, reads: &EdgeReads) {
        for (owner, registers) in reads {
            let Some(&reader) = self.place.get(&(self.levels.end, *owner)) else {
                continue;
            };
            for &register in registers {
                let writer = self.flat.registers[register as usize].instance;
                let writer = self.place[&(self.levels.end, writer)];
                let planned = &mut self.registers[register as usize];
                if reader > writer && planned.shadow.is_none() {
                    planned.shadow = Some(self.layout.take(1));
                }
            }
        }
    }

    /// Gives nodes a place that others read, or that are wanted.
    fn store(&mut self) {
        let (flat, levels) = (self.flat, self.levels);
        let mut stored = BTreeSet::new();
        let mut stack = Vec::new();
        let mut see = |stored: &mut BTreeSet<Id>, from: Id, key: (u32, u32)| {
            through(flat, &levels.own, std::iter::once(from), &mut stack, |id| {
                if (levels.level[id as usize], flat.node(id).instance) != key {
                    stored.insert(id);
                }
            });
        };
        for id in 0..flat.nodes.len() as Id {
            if levels.own[id as usize] {
                let node = flat.node(id);
                let key = (levels.level[id as usize], node.instance);
                node.op
                    .operands()
                    .for_each(|from| see(&mut stored, from, key));
            }
        }
        for register in &flat.registers {
            see(&mut stored, register.next, (levels.end, register.instance));
        }
        for memory in &flat.memories {
            let key = (levels.end, memory.instance);
            memory
                .port
                .operands()
                .for_each(|from| see(&mut stored, from, key));
        }
        for (index, place) in flat.leaves.iter().enumerate() {
            if let (Place::Node(id), true) = (*place, wants(self.wanted, index))
                && levels.own[id as usize]
            {
                stored.insert(id);
            }
        }
        for (index, &id) in flat.properties.iter().enumerate() {
            if wants(self.wanted, flat.leaves.len() + index) && levels.own[id as usize] {
                stored.insert(id);
            }
        }
        for id in stored {
            let slot = self.layout.take(1);
            self.nets.insert(id, slot);
        }
    }

    fn constant(&mut self, bits: u64) -> Slot {
        let layout = &mut self.layout;
        *self.constants.entry(bits).or_insert_with(|| {
            let slot = layout.take(1);
            layout.initial.push((slot, bits));
            layout.constants.push((slot, bits));
            slot
        })
    }

    fn block(&mut self, place: usize, nodes: &[Id], scratch: &mut Vec<Slot>) -> Block {
        let (level, instance) = self.order[place];
        let mut block = Block {
            instance,
            level,
            ..Block::default()
        };
        let mut making = Making {
            known: HashMap::new(),
            used: 0,
            scratch,
            reads: BTreeSet::new(),
        };
        for &id in nodes {
            let slot = self.make(id, place, &mut block, &mut making);
            if let Some(&to) = self.nets.get(&id) {
                block.outputs.push((slot, to));
            }
        }
        if level == self.levels.end {
            for number in 0..self.flat.registers.len() {
                let register = &self.flat.registers[number];
                if register.instance == instance {
                    let mut from = self.make(register.next, place, &mut block, &mut making);
                    if matches!(self.flat.node(register.next).op, Op::Register(_)) {
                        // A copy, since that register may be made before this one.
                        let to = making.scratch(&mut self.layout);
                        block.steps.push(Step {
                            code: Code::Extend,
                            width: register.width,
                            from: register.width,
                            by: 0,
                            to,
                            a: from,
                            b: 0,
                            c: 0,
                        });
                        from = to;
                    }
                    block.registers.push((number as u32, from));
                    block.commits |= self.registers[number].shadow.is_some();
                }
            }
            for number in 0..self.flat.memories.len() {
                let memory = &self.flat.memories[number];
                if memory.instance == instance && memory.port != Port::Rom {
                    let port = memory.port;
                    let mut of = |id| self.make(id, place, &mut block, &mut making);
                    let (enable, data, address) = match port {
                        Port::Rom => continue,
                        Port::Ram {
                            enable,
                            address,
                            data,
                        } => (of(enable), of(data), Some(of(address))),
                        Port::Shift { enable, data } => (of(enable), of(data), None),
                    };
                    block.writes.push(Write {
                        memory: number as u32,
                        enable,
                        data,
                        address,
                    });
                }
            }
        }
        block.reads = making.reads.into_iter().collect();
        block
    }

    /// Where a node stands for a block; steps that make it are added if it does not yet.
    fn make(&mut self, id: Id, place: usize, block: &mut Block, making: &mut Making<'_>) -> Slot {
        if let Some(&slot) = making.known.get(&id) {
            return slot;
        }
        let node = self.flat.node(id);
        let slot = match node.op {
            Op::Constant(bits) => self.constant(bits),
            Op::Input(input) => {
                let slot = self.layout.inputs[input as usize];
                making.reads.insert(slot);
                slot
            }
            Op::Register(register) => {
                let slot = self.registers[register as usize].slot;
                making.reads.insert(slot);
                slot
            }
            _ if self.levels.own[id as usize] && self.block_of(id) != place => {
                let slot = self.nets[&id];
                making.reads.insert(slot);
                slot
            }
            op => {
                let mut operands = [0; 3];
                let mut from = node.width;
                let mut by = 0;
                for (index, operand) in op.operands().enumerate() {
                    operands[index] = self.make(operand, place, block, making);
                    if index == 0 {
                        from = self.flat.node(operand).width;
                    } else {
                        by = self.flat.node(operand).width;
                    }
                }
                let [a, b, mut c] = operands;
                let code = match op {
                    Op::Not(_) => Code::Not,
                    Op::Negate(_) => Code::Negate,
                    Op::Add(..) => Code::Add,
                    Op::Subtract(..) => Code::Subtract,
                    Op::Multiply(..) => Code::Multiply,
                    Op::And(..) => Code::And,
                    Op::Or(..) => Code::Or,
                    Op::Xor(..) => Code::Xor,
                    Op::Equal(..) => Code::Equal,
                    Op::Below(..) => Code::Below,
                    Op::BelowSigned(..) => Code::BelowSigned,
                    Op::Mux(..) => Code::Mux,
                    Op::ShiftLeft(_, bits) => {
                        by = bits;
                        Code::ShiftLeft
                    }
                    Op::ShiftRight(_, bits) => {
                        by = bits;
                        Code::ShiftRight
                    }
                    Op::ShiftRightSigned(_, bits) => {
                        by = bits;
                        Code::ShiftRightSigned
                    }
                    Op::Slice(_, low) => {
                        by = low;
                        Code::Slice
                    }
                    Op::Extend(_) => Code::Extend,
                    Op::ExtendSigned(_) => Code::ExtendSigned,
                    Op::Join(..) => Code::Join,
                    Op::Read(memory, _) => {
                        c = memory;
                        Code::Read
                    }
                    Op::Constant(_) | Op::Input(_) | Op::Register(_) => Code::Extend,
                };
                let to = making.scratch(&mut self.layout);
                block.steps.push(Step {
                    code,
                    width: node.width,
                    from,
                    by,
                    to,
                    a,
                    b,
                    c,
                });
                to
            }
        };
        making.known.insert(id, slot);
        slot
    }

    fn finish(mut self, blocks: Vec<Block>) -> Plan {
        let mut memories = Vec::new();
        for memory in &self.flat.memories {
            let shifts = matches!(memory.port, Port::Shift { .. });
            let head = shifts.then(|| self.layout.take(1));
            let (mark, written) = (self.layout.take(1), self.layout.take(1));
            memories.push(PlannedMemory {
                first: self.layout.take(memory.contents.len() as u32),
                words: memory.contents.len() as u32,
                head,
                mark,
                written,
                readers: Vec::new(),
                width: memory.width,
            });
        }
        for (planned, memory) in memories.iter().zip(&self.flat.memories) {
            for (index, &word) in memory.contents.iter().enumerate() {
                if word != 0 {
                    self.layout
                        .initial
                        .push((planned.first + index as u32, word));
                }
            }
        }
        for (planned, register) in self.registers.iter().zip(&self.flat.registers) {
            self.layout.initial.push((planned.slot, register.power_on));
        }
        let mut readers: Vec<Vec<u32>> = vec![Vec::new(); self.layout.words as usize];
        for (place, block) in blocks.iter().enumerate() {
            for &slot in &block.reads {
                readers[slot as usize].push(bit(place, self.settling) as u32);
            }
            for step in &block.steps {
                if step.code == Code::Read {
                    let known = &mut memories[step.c as usize].readers;
                    let bit = bit(place, self.settling) as u32;
                    if known.last() != Some(&bit) {
                        known.push(bit);
                    }
                }
            }
        }
        self.layout.bits = (0..blocks.len())
            .map(|block| bit(block, self.settling) as u32)
            .collect();
        self.layout.readers = readers
            .into_iter()
            .map(|blocks| {
                let mut words: BTreeMap<Slot, u64> = BTreeMap::new();
                for bit in blocks {
                    *words.entry(self.layout.dirty + bit / 64).or_default() |= 1 << (bit % 64);
                }
                words.into_iter().collect()
            })
            .collect();
        self.spots(&memories);
        Plan {
            blocks,
            settling: self.settling,
            registers: self.registers,
            memories,
            instances: self
                .flat
                .instances
                .iter()
                .map(|instance| instance.path.join("."))
                .collect(),
            layout: self.layout,
        }
    }

    /// Where leaves and properties stand, and what tells that they have changed.
    fn spots(&mut self, memories: &[PlannedMemory]) {
        let mut watched: BTreeMap<Slot, Watched> = BTreeMap::new();
        let mut spots = Vec::new();
        for (index, place) in self.flat.leaves.iter().enumerate() {
            let wanted = wants(self.wanted, index);
            let spot = match *place {
                Place::Input(input) => Spot::Slot(self.layout.inputs[input as usize]),
                Place::Register(register) => Spot::Slot(self.registers[register as usize].slot),
                Place::Word(memory, word) => match memories[memory as usize].head {
                    Some(_) => Spot::Stage(memory, word),
                    None => Spot::Slot(memories[memory as usize].first + word),
                },
                Place::Node(_) if !wanted => Spot::Gone,
                Place::Node(id) => self.spot(id),
            };
            let (slot, memory) = match (*place, spot) {
                (Place::Word(memory, _), _) => (Some(memories[memory as usize].mark), Some(memory)),
                (_, Spot::Slot(slot)) => (Some(slot), None),
                _ => (None, None),
            };
            if let Some(slot) = slot.filter(|_| wanted) {
                let watched = watched.entry(slot).or_default();
                watched.memory = memory;
                watched.leaves.push(index as u32);
            }
            spots.push(spot);
        }
        let leaves = self.flat.leaves.len();
        let properties = self.flat.properties.iter().enumerate().map(|(index, &id)| {
            match wants(self.wanted, leaves + index) {
                true => self.spot(id),
                false => Spot::Gone,
            }
        });
        self.layout.properties = properties.collect();
        self.layout.leaves = spots;
        let words = watched.len().div_ceil(64) as u32;
        self.layout.changed = self.layout.take(words);
        self.layout.changed_words = words;
        let first = self.layout.changed;
        self.layout.changes = vec![None; self.layout.words as usize];
        for (index, (slot, watched)) in watched.into_iter().enumerate() {
            let index = index as u32;
            self.layout.changes[slot as usize] = Some(Change {
                word: first + index / 64,
                mask: 1 << (index % 64),
            });
            self.layout.watched.push(Watched { slot, ..watched });
        }
    }

    fn spot(&self, id: Id) -> Spot {
        match self.flat.node(id).op {
            Op::Constant(bits) => Spot::Constant(bits),
            Op::Input(input) => Spot::Slot(self.layout.inputs[input as usize]),
            Op::Register(register) => Spot::Slot(self.registers[register as usize].slot),
            _ => self
                .nets
                .get(&id)
                .map_or(Spot::Gone, |&slot| Spot::Slot(slot)),
        }
    }
}

/// A block under way.
struct Making<'s> {
    known: HashMap<Id, Slot>,
    /// Places for what nobody else reads, which all blocks use.
    used: usize,
    scratch: &'s mut Vec<Slot>,
    reads: BTreeSet<Slot>,
}

impl Making<'_> {
    fn scratch(&mut self, layout: &mut Layout) -> Slot {
        if self.used == self.scratch.len() {
            self.scratch.push(layout.take(1));
        }
        self.used += 1;
        self.scratch[self.used - 1]
    }
}

/// The registers that the edge of each instance reads.
type EdgeReads = BTreeMap<u32, BTreeSet<u32>>;

fn edge_reads(flat: &Flat, levels: &Levels) -> EdgeReads {
    let mut reads = EdgeReads::new();
    let mut seen = HashSet::new();
    let mut see = |owner: u32, from: Id| {
        let registers = reads.entry(owner).or_default();
        let mut stack = vec![from];
        while let Some(id) = stack.pop() {
            if !seen.insert((owner, id)) {
                continue;
            }
            let node = flat.node(id);
            let settled = levels.own[id as usize]
                && (levels.level[id as usize] < levels.end || node.instance != owner);
            match node.op {
                Op::Register(register) => {
                    registers.insert(register);
                }
                _ if settled => {}
                op => stack.extend(op.operands()),
            }
        }
    };
    for register in &flat.registers {
        see(register.instance, register.next);
    }
    for memory in &flat.memories {
        for id in memory.port.operands() {
            see(memory.instance, id);
        }
    }
    reads
}
