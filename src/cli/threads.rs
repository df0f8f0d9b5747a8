//! Threads that may not be had.

use super::Failure;
use rayon::ThreadPoolBuilder;
use std::io;
use std::panic::resume_unwind;
use std::thread::{Builder, Scope, ScopedJoinHandle, available_parallelism};

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
    let pool = match cfg!(target_family = "wasm") {
        // There are no threads but this one.
        true => ThreadPoolBuilder::new().num_threads(1).use_current_thread(),
        false => ThreadPoolBuilder::new().num_threads(threads),
    };
    pool.build_global()
        .map_err(|error| none(&io::Error::other(error.to_string())))
}

/// Work beside this thread.
pub enum Beside<'scope, T> {
    /// In a thread of its own.
    Thread(ScopedJoinHandle<'scope, T>),
    /// Done already, where there are no threads.
    Done(T),
}

/// Starts a thread beside this one.
pub fn beside<'scope, T: Send + 'scope>(
    scope: &'scope Scope<'scope, '_>,
    work: impl FnOnce() -> T + Send + 'scope,
) -> Result<Beside<'scope, T>, Failure> {
    if cfg!(target_family = "wasm") {
        return Ok(Beside::Done(work()));
    }
    let started = Builder::new().spawn_scoped(scope, work);
    started.map(Beside::Thread).map_err(|error| none(&error))
}

/// Joins a thread and returns its result; a panic of the thread continues here.
pub fn joined<T>(other: Beside<'_, T>) -> T {
    match other {
        Beside::Thread(thread) => thread.join().unwrap_or_else(|panic| resume_unwind(panic)),
        Beside::Done(result) => result,
    }
}

/// Returns the error for a thread that could not be started.
fn none(error: &io::Error) -> Failure {
    Failure::Argument {
        field: "threads",
        problem: format!("one could not be started: {error}"),
        allowed: "higher limits on processes and memory; RAYON_NUM_THREADS=1 needs the fewest"
            .into(),
    }
}
