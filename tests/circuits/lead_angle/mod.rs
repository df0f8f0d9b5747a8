//! The lead-angle compensator: history, prediction, comparison and learning against programs.

mod absolute;
mod comparing;
mod history;
mod learning;
mod phase;
mod prediction;
mod resolver;
mod table;
mod unwrapper;
mod variants;
mod whole;

use motion_rtl::check::Random;

/// A random number below `end`.
fn below(random: &mut Random, end: u64) -> u64 {
    random.word() % end
}
