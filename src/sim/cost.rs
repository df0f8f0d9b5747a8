//! Size of a circuit, counted in its netlist.

use super::Elaborated;
use crate::engine::{Op, passes};

/// Arithmetic and storage of a circuit, without dead nodes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Cost {
    /// Number of adders, subtractors and `<` comparators. Comparators for equality do not count:
    /// they have no carry.
    pub adders: u64,
    /// Sum of all their operand widths in bits.
    pub adder_bits: u64,
    /// Number of flip-flops in bits.
    pub register_bits: u64,
    /// Number of memory bits.
    pub memory_bits: u64,
}

impl Elaborated {
    /// Counts arithmetic and storage of the circuit.
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
