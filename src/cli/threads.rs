//! Threads that may not be had.

use super::Failure;
use rayon::ThreadPoolBuilder;
use std::io;
use std::thread::available_parallelism;

/// Threads a processor at most: more only take memory.
const MOST: usize = 4;

/// Starts the threads of proofs, sweeps and readers of waves: `RAYON_NUM_THREADS`, or one for each
/// processor.
pub fn start() -> Result<(), Failure> {
    let processors = available_parallelism().map_or(1, usize::from);
    let asked = std::env::var("RAYON_NUM_THREADS").ok();
    let asked = asked
        .and_then(|text| text.trim().parse().ok())
        .filter(|&number| number > 0);
    let threads = asked.unwrap_or(processors).min(MOST * processors);
    let pool = ThreadPoolBuilder::new().num_threads(threads);
    pool.build_global()
        .map_err(|error| none(&io::Error::other(error.to_string())))
}

/// That a thread could not be started.
pub fn none(error: &io::Error) -> Failure {
    Failure::Argument {
        field: "threads",
        problem: format!("one could not be started: {error}"),
        allowed: "higher limits on processes and memory; RAYON_NUM_THREADS=1 needs the fewest"
            .into(),
    }
}
