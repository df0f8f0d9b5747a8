//! Conversion of panics into errors, without output: the waveform reader panics on some malformed
//! files.

use std::cell::Cell;
use std::panic::{self, AssertUnwindSafe};
use std::sync::Once;

thread_local! {
    static QUIET: Cell<bool> = const { Cell::new(false) };
}

static HOOK: Once = Once::new();

/// Returns the result of `f`; `None` if it panicked. Values that `f` modified must not be used
/// after that.
pub(super) fn catch<T>(f: impl FnOnce() -> T) -> Option<T> {
    // One hook for all threads: the output of other threads is unaffected.
    HOOK.call_once(|| {
        let loud = panic::take_hook();
        panic::set_hook(Box::new(move |info| {
            if !QUIET.get() {
                loud(info);
            }
        }));
    });
    let before = QUIET.replace(true);
    let done = panic::catch_unwind(AssertUnwindSafe(f));
    QUIET.set(before);
    done.ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panic_is_none() {
        assert_eq!(catch(|| 3), Some(3));
        assert_eq!(catch(|| -> u8 { panic!("not shown") }), None);
        assert!(!QUIET.get());
    }
}
