//! Signals shown in the waves beside a circuit.

use super::{Needs, Observer, RunError, Sample};
use crate::hdl::{Circuit, Record, View};
use crate::netlist::{Field, Role};
use std::ops::ControlFlow;

/// Signals that are shown in the waves beside a circuit without being part of it, such as the
/// motion of a motor.
#[diagnostic::on_unimplemented(
    message = "`{Self}` does not stand beside a circuit",
    note = "implement `Beside` with the scope of its signals and a record from `signals!`"
)]
pub trait Beside: Clone + Send + Sync + 'static {
    /// Scope of the signals in the waves.
    const SCOPE: &'static str;
    /// Record of the signals.
    type Signals<V: View>: Record<Self, V>;
}

/// Returns the field that describes the scope of the signals beside a circuit.
pub(super) const fn scope<B: Beside>() -> Field {
    Field {
        role: Some(Role::Input),
        ..Field::named(B::SCOPE)
    }
}

/// Observer of a circuit that hides the signals beside it from the inner observer.
#[derive(Debug)]
pub struct Without<O>(pub O);

impl<C: Circuit, O: Observer<C>> Observer<C> for Without<O> {
    fn next_look(&self, tick: u64) -> u64 {
        self.0.next_look(tick)
    }

    fn looks(&self, tick: u64) -> bool {
        self.0.looks(tick)
    }

    fn needs(&self) -> Needs {
        let needs = self.0.needs();
        // The leaves of a model without signals beside it have other numbers.
        match needs.leaves.is_empty() {
            true => needs,
            false => Needs::ALL,
        }
    }

    fn next_whole(&self, tick: u64) -> u64 {
        match self.0.needs().leaves.is_empty() {
            true => self.0.next_whole(tick),
            false => tick,
        }
    }

    fn sample(&mut self, now: &Sample<'_, C>) -> Result<ControlFlow<()>, RunError> {
        self.0.sample(&now.alone())
    }
}
