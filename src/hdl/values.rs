//! Signals of circuits as numbers.

use super::{Circuit, Kept, Value};
use std::fmt;

/// All signals of a circuit inside another, as numbers.
pub struct Values<C: Circuit> {
    /// Input ports.
    pub i: C::In<Value>,
    /// Registers.
    pub q: C::Reg<Value>,
    /// Nets.
    pub w: C::Net<Value>,
    /// Circuits inside.
    pub p: C::Parts<Value>,
}

/// All registers of a circuit, as numbers.
pub struct Registers<C: Circuit> {
    /// Registers of the circuit itself.
    pub q: C::Reg<Value>,
    /// Registers of the circuits inside.
    pub p: C::Parts<Kept>,
}

impl<C: Circuit> fmt::Debug for Values<C> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct(C::NAME).finish_non_exhaustive()
    }
}

impl<C: Circuit> fmt::Debug for Registers<C> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct(C::NAME).finish_non_exhaustive()
    }
}
