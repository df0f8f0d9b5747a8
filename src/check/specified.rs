use super::Invariants;
use crate::hdl::{Circuit, Registers, Value};

/// A circuit that says what must hold of it, whatever comes in.
pub trait Specified: Circuit {
    /// What must hold on every transition.
    fn invariants(&self) -> Invariants<'_, Self>;

    /// Whether a proof applies this input: unless overridden, all bits are free.
    fn applies(&self, _: &Self::In<Value>) -> bool {
        true
    }

    /// Whether a proof applies this input in this state: unless overridden, in every state. What
    /// the surroundings are relied on for stands in the circuit's comment.
    fn assumes(&self, _: &Registers<Self>, _: &Self::In<Value>) -> bool {
        true
    }
}
