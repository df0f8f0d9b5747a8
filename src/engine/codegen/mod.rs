//! Parts of code generation that the compilers to machine code and to WebAssembly share.

mod parts;
mod runs;

use super::plan::{Code, Plan};
pub use parts::{is_long, kept};
pub use runs::{GROUP, cold, is_hot, runs, words};

/// True if every index in a plan is in range. Slots are checked where they are used.
pub fn is_whole(plan: &Plan) -> bool {
    let registers = plan.registers.len();
    let memories = plan.memories.len();
    let bits = plan.layout.block_words as usize * 64;
    let blocks = plan.blocks.iter().enumerate().all(|(place, block)| {
        let reads = block.steps.iter().filter(|step| step.code == Code::Read);
        plan.bit(place) < bits
            && block
                .registers
                .iter()
                .all(|&(register, _)| (register as usize) < registers)
            && block
                .writes
                .iter()
                .all(|write| (write.memory as usize) < memories)
            && reads.clone().all(|step| (step.c as usize) < memories)
            && block.steps.iter().all(|step| {
                let widths = [step.width, step.from];
                widths.iter().all(|width| (1..=64).contains(width))
            })
    });
    blocks && plan.settling <= plan.blocks.len()
}
