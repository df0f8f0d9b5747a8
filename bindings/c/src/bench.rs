//! Models and snapshots behind handles.

use crate::codes::{MRTL_FULL, MRTL_PANIC, MRTL_WRONG_INDEX};
use crate::failure::Failure;
use crate::table::Table;
use motion_rtl::Model;
use motion_rtl::sim::{Handle, SignalInfo, Snapshot};
use std::panic::catch_unwind;

/// Handle of a model; always positive. Negative numbers are error codes.
#[allow(non_camel_case_types)]
pub type mrtl_model = i32;

/// Handle of a snapshot; always positive. Negative numbers are error codes.
#[allow(non_camel_case_types)]
pub type mrtl_snapshot = i32;

pub static MODELS: Table<Bench, 0> = Table::new();
pub static SNAPSHOTS: Table<Snapshot, { 1 << 30 }> = Table::new();

/// Model with what its caller asks of it.
pub struct Bench {
    pub model: Model,
    /// Descriptions of the signals, once they were asked for.
    signals: Option<Vec<SignalInfo>>,
    /// Text of the last error.
    pub error: String,
}

impl Bench {
    pub fn new(model: Model) -> Self {
        Bench {
            model,
            signals: None,
            error: String::new(),
        }
    }

    pub fn signals(&mut self) -> &[SignalInfo] {
        self.signals.get_or_insert_with(|| self.model.signals())
    }

    pub fn signal(&mut self, index: i32) -> Result<&SignalInfo, Failure> {
        let count = self.signals().len();
        let signals = self.signals();
        let signal = usize::try_from(index).ok().and_then(|at| signals.get(at));
        signal.ok_or_else(|| no_index(index, count))
    }

    #[inline]
    pub fn handle(&mut self, index: i32) -> Result<Handle, Failure> {
        match usize::try_from(index).ok().and_then(|at| self.model.at(at)) {
            Some(handle) => Ok(handle),
            None => Err(no_index(index, self.signals().len())),
        }
    }
}

#[cold]
fn no_index(index: i32, count: usize) -> Failure {
    let last = count.saturating_sub(1);
    let text = format!("no signal has the index {index}; allowed are 0 to {last}");
    Failure::new(MRTL_WRONG_INDEX, text)
}

/// Calls a function with a model and returns its result or the code of the error, whose text the
/// model keeps.
///
/// # Safety
/// Calls with one handle do not overlap in time.
#[inline]
pub unsafe fn on(model: mrtl_model, call: impl FnOnce(&mut Bench) -> Result<i32, Failure>) -> i32 {
    let kept = |bench: &mut Bench| match call(bench) {
        Ok(result) => result,
        Err(failure) => keep(bench, failure),
    };
    // SAFETY: this function's contract is that of the table.
    match unsafe { MODELS.with(model, kept) } {
        Ok(result) => result,
        Err(refusal) => refusal.code(),
    }
}

#[cold]
fn keep(bench: &mut Bench, failure: Failure) -> i32 {
    bench.error = failure.text;
    failure.code
}

/// Calls a function without a model; a panic becomes a code.
pub fn caught(call: impl FnOnce() -> i32 + std::panic::UnwindSafe) -> i32 {
    catch_unwind(call).unwrap_or_else(|payload| {
        // Its destructor could panic too.
        std::mem::forget(payload);
        MRTL_PANIC
    })
}

/// Returns the handle of a new value, or the failure of a full table.
pub fn given(handle: Option<i32>, what: &str) -> Result<i32, Failure> {
    let full = || Failure::new(MRTL_FULL, format!("there are too many {what} at once"));
    handle.ok_or_else(full)
}

// Each model may be called from any thread, one at a time.
const _: () = {
    const fn may_change_threads<T: Send>() {}
    may_change_threads::<Bench>();
    may_change_threads::<Snapshot>();
};
