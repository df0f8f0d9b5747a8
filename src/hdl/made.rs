//! What is made of a circuit's records for who runs it. [`records!`](super::records) writes a method
//! of the circuit for each, so that it is compiled with the circuit, and not again in every crate
//! that runs it.

use super::elaborate;
use super::netlist::Setting;
use super::record::{Record, Source};
use super::view::{self, Shapes, Value};
use super::{Circuit, More, Registers, Role, Signals};

/// Makes the module of a circuit, with ports in that it does not look at; returns its number and its
/// settings.
pub fn module<C: Circuit>(circuit: &C, path: String, more: More<'_>) -> (usize, Vec<Setting>) {
    elaborate::module(circuit, path, more)
}

/// Walks over the ports in of a circuit, over all its registers, or over all its nets.
pub fn shapes<C: Circuit>(circuit: &C, role: Role, source: &mut dyn Source) {
    match role {
        Role::Input => {
            C::In::<Shapes>::make(circuit, view::role(role), source);
        }
        Role::Register => view::registers(circuit, source),
        Role::Net => view::nets(circuit, source),
    }
}

/// Makes the places of all signals.
pub fn places<C: Circuit>(circuit: &C, source: &mut dyn Source) -> Signals<C> {
    let i = C::In::make(circuit, view::role(Role::Input), source);
    let (q, p, w) = view::inner(circuit, source);
    Signals { i, q, w, p }
}

/// Makes the ports in as numbers.
pub fn inputs<C: Circuit>(circuit: &C, source: &mut dyn Source) -> C::In<Value> {
    C::In::make(circuit, view::role(Role::Input), source)
}

/// Makes a circuit's own registers as numbers.
pub fn registers<C: Circuit>(circuit: &C, source: &mut dyn Source) -> C::Reg<Value> {
    C::Reg::make(circuit, view::role(Role::Register), source)
}

/// Makes a circuit's own nets as numbers.
pub fn nets<C: Circuit>(circuit: &C, source: &mut dyn Source) -> C::Net<Value> {
    C::Net::make(circuit, view::role(Role::Net), source)
}

/// Makes the circuits inside as numbers; `source` has the circuit's own registers before them.
pub fn parts<C: Circuit>(circuit: &C, source: &mut dyn Source) -> C::Parts<Value> {
    C::Reg::<Shapes>::make(circuit, view::role(Role::Register), source);
    C::Parts::make(circuit, view::role(Role::Net), source)
}

/// Makes all registers as numbers.
pub fn kept<C: Circuit>(circuit: &C, source: &mut dyn Source) -> Registers<C> {
    let q = C::Reg::make(circuit, view::role(Role::Register), source);
    let p = C::Parts::make(circuit, view::role(Role::Register), source);
    Registers { q, p }
}
