//! The arc generator: difference engine, rotation, memory and the whole against programs.

mod blend;
mod conventional;
mod engine;
mod example;
mod memory;
mod program;
mod rotation;
mod whole;

use motion_rtl::check::Random;

/// A random number below `end`.
fn below(random: &mut Random, end: u64) -> u64 {
    random.word() % end
}
