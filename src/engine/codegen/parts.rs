//! Long blocks, which are compiled in parts.

use crate::engine::layout::Slot;
use crate::engine::plan::{Block, Code};
use rustc_hash::{FxHashMap, FxHashSet};

/// True if a block is compiled in more than one part.
pub fn is_long(block: &Block, part: usize) -> bool {
    let ends = block.outputs.len() + block.registers.len() + block.writes.len();
    block.steps.len() + ends > part
}

/// Returns the slots whose words other parts of the block read.
pub fn kept(block: &Block, size: usize) -> FxHashSet<Slot> {
    let mut kept = FxHashSet::default();
    if !is_long(block, size) {
        return kept;
    }
    let mut made = FxHashMap::default();
    for (number, step) in block.steps.iter().enumerate() {
        let third = (step.code == Code::Mux).then_some(step.c);
        for slot in [step.a, step.b].into_iter().chain(third) {
            if made.get(&slot).is_some_and(|&part| part != number / size) {
                kept.insert(slot);
            }
        }
        made.insert(step.to, number / size);
    }
    let outputs = block.outputs.iter().map(|&(from, _)| from);
    let registers = block.registers.iter().map(|&(_, from)| from);
    let writes = block.writes.iter();
    let writes =
        writes.flat_map(|write| [write.enable, write.data].into_iter().chain(write.address));
    kept.extend(
        outputs
            .chain(registers)
            .chain(writes)
            .filter(|slot| made.contains_key(slot)),
    );
    kept
}
