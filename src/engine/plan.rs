//! How a netlist is run: in which blocks, in which order, and where everything stands.

mod blocks;
mod levels;
mod places;
mod planning;

use super::flat::{Flat, Place};
use super::layout::{Layout, Slot};
use levels::Levels;
use planning::Planning;

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

/// What a step computes: see [`Op`](super::flat::Op).
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
    /// Width of a word, which compiled code asks for.
    #[cfg_attr(not(feature = "jit"), expect(dead_code))]
    pub width: u8,
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
        let reads = levels::edge_reads(flat, &levels);
        let order = levels::order(flat, &levels, &reads);
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
