//! Levels: which nodes are stored, in which level each is computed, and the order of blocks.

use crate::engine::flat::{Flat, Id, Op, Port};
use rustc_hash::{FxHashMap, FxHashSet};
use std::collections::{BTreeMap, BTreeSet};

/// True if each reader computes the node again.
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

/// Level in which each node is computed.
pub(super) struct Levels {
    /// True if a node is stored: others are leaves, or are computed where they are read.
    pub own: Vec<bool>,
    pub level: Vec<u32>,
    /// Level of the edge.
    pub end: u32,
}

impl Levels {
    pub fn of(flat: &Flat, watched: &[bool]) -> Levels {
        let count = flat.nodes.len();
        let own: Vec<bool> = flat
            .nodes
            .iter()
            .zip(watched)
            .map(|(node, watched)| !is_leaf(node.op) && (*watched || !is_cheap(node.op)))
            .collect();
        let instance = |id: Id| flat.nodes[id as usize].instance;
        let crossing = |id: Id, other: Id| u32::from(instance(other) != instance(id));
        // Earliest level.
        let mut early = vec![0u32; count];
        let mut end = 0;
        let mut stack = Vec::new();
        for id in 0..count as Id {
            if !own[id as usize] {
                continue;
            }
            let mut level = 0;
            let operands = flat.node(id).op.operands();
            through(flat, &own, operands, &mut stack, |other| {
                level = level.max(early[other as usize] + crossing(id, other));
            });
            early[id as usize] = level;
            end = end.max(level);
        }
        let end = end + 1;
        // Latest possible level; watched nodes are settled before the edge.
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
            // An edge that writes a memory reads it first, if both are in one block.
            if let Op::Read(memory, _) = flat.node(id).op
                && flat.memories[memory as usize].instance != instance(id)
            {
                *here = (*here).min(end - 1);
            }
            let here = *here;
            let operands = flat.node(id).op.operands();
            through(flat, &own, operands, &mut stack, |other| {
                level[other as usize] = level[other as usize].min(here - crossing(id, other));
            });
        }
        Levels { own, level, end }
    }
}

/// Calls `see` for the stored nodes on which these depend.
pub(super) fn through(
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

/// Returns the blocks in their order, each as level and instance.
pub(super) fn order(flat: &Flat, levels: &Levels, reads: &EdgeReads) -> Vec<(u32, u32)> {
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
    // Among the edges, the one comes first whose registers the fewest others still read.
    let mut read: BTreeMap<(u32, u32), usize> = BTreeMap::new();
    for (reader, registers) in reads {
        for register in registers {
            let writer = flat.registers[*register as usize].instance;
            *read.entry((*reader, writer)).or_default() += 1;
        }
    }
    let writers: BTreeSet<u32> = edges.iter().map(|(_, writer)| *writer).collect();
    read.retain(|(reader, writer), _| reader != writer && writers.contains(reader));
    let mut waits: FxHashMap<u32, usize> = FxHashMap::default();
    for ((_, writer), count) in &read {
        *waits.entry(*writer).or_default() += count;
    }
    while let Some(best) = (0..edges.len()).min_by_key(|&place| waits.get(&edges[place].1)) {
        let edge = edges.remove(best);
        for ((_, writer), count) in read.range((edge.1, 0)..=(edge.1, u32::MAX)) {
            waits.entry(*writer).and_modify(|waits| *waits -= count);
        }
        order.push(edge);
    }
    order
}

/// Registers that the edge of each instance reads.
pub(super) type EdgeReads = BTreeMap<u32, BTreeSet<u32>>;

pub(super) fn edge_reads(flat: &Flat, levels: &Levels) -> EdgeReads {
    let mut reads = EdgeReads::new();
    let mut seen = FxHashSet::default();
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
