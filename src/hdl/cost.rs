//! What a circuit costs, counted in its netlist.

use super::Model;
use crate::engine::{Op, passes};

/// Arithmetic and storage of a circuit, without what nothing reads.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Cost {
    /// Adders, subtractors and comparators by size; not those for equality, which have no carry.
    pub adders: u64,
    /// The bits of all their operands.
    pub adder_bits: u64,
    /// Bits of flip-flops.
    pub register_bits: u64,
    /// Bits of memories.
    pub memory_bits: u64,
}

impl Model {
    /// What it costs.
    pub fn cost(&self) -> Cost {
        let flat = self.flat();
        let mut seen = vec![false; flat.leaves.len()];
        for leaf in self.ports_out() {
            seen[leaf] = true;
        }
        let lean = passes::all(flat, &seen);
        let mut cost = Cost::default();
        for node in &lean.nodes {
            if let Op::Add(a, _) | Op::Subtract(a, _) | Op::Below(a, _) | Op::BelowSigned(a, _) =
                node.op
            {
                cost.adders += 1;
                cost.adder_bits += u64::from(lean.nodes[a as usize].width);
            }
        }
        for register in &lean.registers {
            cost.register_bits += u64::from(register.width);
        }
        for memory in &lean.memories {
            cost.memory_bits += u64::from(memory.width) * memory.contents.len() as u64;
        }
        cost
    }
}
