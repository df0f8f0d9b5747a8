//! Execution plan of a netlist: its blocks, their order, and the memory layout.

mod blocks;
mod levels;
mod places;
mod planning;

use super::flat::{Flat, Place};
use super::layout::{Layout, Slot};
use levels::Levels;
use planning::Planning;

/// Planned netlist.
///
/// Nodes are grouped into blocks: nodes of one instance that can be computed in sequence once the
/// blocks before are settled. Blocks that settle nets come first, then those that make the edge. A
/// block runs if something that it reads has changed since its last run.
#[derive(Debug, Clone)]
pub struct Plan {
    /// Blocks in execution order.
    pub blocks: Vec<Block>,
    /// Number of blocks that settle; the others make the edge.
    pub settling: usize,
    /// Registers, by their number in the netlist.
    pub registers: Vec<PlannedRegister>,
    /// Memories, by their number in the netlist.
    pub memories: Vec<PlannedMemory>,
    /// Memory layout.
    pub layout: Layout,
    /// Instance paths.
    pub instances: Vec<String>,
}

/// Nodes of an instance that run together.
#[derive(Debug, Clone, Default)]
pub struct Block {
    /// Index of the instance.
    pub instance: u32,
    /// Operations, in order.
    pub steps: Vec<Step>,
    /// Results that other blocks read: from, to.
    pub outputs: Vec<(Slot, Slot)>,
    /// Registers that the block makes: index, and slot of the new value.
    pub registers: Vec<(u32, Slot)>,
    /// Memory writes.
    pub writes: Vec<Write>,
    /// True if one of its registers is made in a shadow.
    pub commits: bool,
    /// Slots that the block reads.
    pub reads: Vec<Slot>,
}

/// Operation of a block.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Step {
    /// Operation code.
    pub code: Code,
    /// Width of the result in bits.
    pub width: u8,
    /// Width of the first operand in bits.
    pub from: u8,
    /// Distance of a shift, lowest bit of a slice, or width of the lower part of a concatenation.
    pub by: u8,
    /// Slot of the result.
    pub to: Slot,
    /// First operand; for a read, the address.
    pub a: Slot,
    /// Second operand; unused by a read.
    pub b: Slot,
    /// Third operand; for a read, the memory.
    pub c: Slot,
}

/// Operation code of a step: see [`Op`](super::flat::Op).
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

/// Write to a memory at the edge.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Write {
    /// Index of the memory.
    pub memory: u32,
    /// Write enable.
    pub enable: Slot,
    /// Word to write.
    pub data: Slot,
    /// Address; `None` for a shift register.
    pub address: Option<Slot>,
}

/// Flip-flop of a plan.
#[derive(Debug, Clone, Copy)]
pub struct PlannedRegister {
    /// Slot of the register.
    pub slot: Slot,
    /// Slot of the new value, if a later block still reads the old one.
    pub shadow: Option<Slot>,
    /// Width in bits.
    pub width: u8,
}

/// Memory of a plan.
#[derive(Debug, Clone)]
pub struct PlannedMemory {
    /// First word.
    pub first: Slot,
    /// Number of words.
    pub words: u32,
    /// Slot with the position of a shift register's first stage, counted from the first word.
    pub head: Option<Slot>,
    /// Slot with the number of writes or shifts.
    pub mark: Slot,
    /// Slot with the address of the last write.
    pub written: Slot,
    /// Blocks that read the memory.
    pub readers: Vec<u32>,
    /// Width of a word in bits; only compiled code needs it.
    #[cfg_attr(not(feature = "jit"), allow(dead_code))]
    pub width: u8,
}

impl Block {
    /// Returns the cost of running the block, in steps: its own, and those of finding it.
    pub fn cost(&self) -> u64 {
        self.steps.len() as u64 + 8
    }
}

impl Plan {
    /// Plans a netlist; keeps the leaves that are `wanted` and, after them, the properties.
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
        let reads = levels::edge_reads(flat, &levels);
        let order = levels::order(flat, &levels, &reads);
        Planning::new(flat, &levels, &order, wanted).plan(&reads)
    }

    /// Returns the number of a block's bit.
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
