use super::Invariants;
use crate::hdl::{Circuit, Value};

/// Circuit with its specification: properties that must hold for any input.
pub trait Specified: Circuit {
    /// Returns the properties that must hold on every transition; by default the circuit's
    /// [own](Circuit::properties).
    fn invariants(&self) -> Invariants<'_, Self> {
        Invariants::of(self)
    }

    /// True if a proof applies this input; by default every input.
    fn applies(&self, _: &Self::In<Value>) -> bool {
        true
    }
}
