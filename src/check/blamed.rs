//! Signals that invariants name as at fault, checked against those of the circuit.

use super::counterexample::is_named;
use crate::nearest::{meant, nearest};
use crate::sim::Elaborated;
use std::cell::{Cell, RefCell};

/// Name in an invariant that belongs to no signal of the circuit.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{circuit}: the invariant `{invariant}` names `{signal}`, but there is no such signal{}", meant(.near.as_deref()))]
pub struct UnknownSignal {
    /// Name of the circuit.
    pub circuit: String,
    /// Name of the invariant.
    pub invariant: String,
    /// Name that belongs to no signal.
    pub signal: String,
    /// Nearest name of a signal.
    pub near: Option<String>,
}

/// Returns the errors of all `named` signals, each with its invariant, that the circuit does not
/// have.
pub(super) fn unknown(model: &Elaborated, named: Vec<(String, String)>) -> Vec<UnknownSignal> {
    if named.is_empty() {
        return Vec::new();
    }
    let leaves = model.outline().leaves.iter();
    let paths: Vec<_> = leaves.map(|leaf| leaf.path()).collect();
    let mut wrong = Vec::new();
    for (invariant, signal) in named {
        if paths.iter().any(|path| is_named(&signal, path)) {
            continue;
        }
        let below = |path| below(model.name(), path);
        let whole = paths.iter().map(|path| below(path));
        let last = whole.clone().filter_map(|path| path.rsplit('.').next());
        let near = nearest(&signal, whole.chain(last)).map(str::to_owned);
        let circuit = model.name().to_owned();
        wrong.push(UnknownSignal {
            circuit,
            invariant,
            signal,
            near,
        });
    }
    wrong
}

/// Returns the path without the scope of the outermost circuit.
pub(super) fn below<'p>(circuit: &str, path: &'p str) -> &'p str {
    let below = path.strip_prefix(circuit);
    below
        .and_then(|path| path.strip_prefix('.'))
        .unwrap_or(path)
}

thread_local! {
    static LISTENING: Cell<bool> = const { Cell::new(false) };
    static NAMES: RefCell<Vec<String>> = const { RefCell::new(Vec::new()) };
}

/// Notes the signals of an invariant, if [`during`] listens.
#[inline]
pub(super) fn note(signals: &[&str]) {
    if LISTENING.get() {
        NAMES.with_borrow_mut(|names| names.extend(signals.iter().map(|&name| name.to_owned())));
    }
}

/// Returns the signals that invariants name in `work`.
pub(super) fn during(work: impl FnOnce()) -> Vec<String> {
    /// Stops listening, also if an invariant panics.
    struct Listening;
    impl Drop for Listening {
        fn drop(&mut self) {
            LISTENING.set(false);
        }
    }
    NAMES.take();
    LISTENING.set(true);
    let listening = Listening;
    work();
    drop(listening);
    NAMES.take()
}
