//! Conversions of a circuit's records for the code that runs it. [`records!`](super::records)
//! writes a method of the circuit for each, so that they are compiled once, with the circuit, and
//! not again in every crate that runs it.

pub use super::elaborate::module;
use super::record::{Record, Source};
use super::view::{self, Shapes, Value};
use super::{Circuit, Registers, Signals};
use crate::netlist::Role;

/// Walks over the input ports of a circuit, over all its registers, or over all its nets.
pub fn shapes<C: Circuit>(circuit: &C, role: Role, source: &mut dyn Source) {
    match role {
        Role::Input => {
            C::In::<Shapes>::make(circuit, view::role(role), source);
        }
        Role::Register => view::registers(circuit, source),
        Role::Net => view::nets(circuit, source),
    }
}

/// Returns the places of all signals.
pub fn places<C: Circuit>(circuit: &C, source: &mut dyn Source) -> Signals<C> {
    let i = C::In::make(circuit, view::role(Role::Input), source);
    let (q, p, w) = view::inner(circuit, source);
    Signals { i, q, w, p }
}

/// Returns the input ports as numbers.
pub fn inputs<C: Circuit>(circuit: &C, source: &mut dyn Source) -> C::In<Value> {
    C::In::make(circuit, view::role(Role::Input), source)
}

/// Returns a circuit's own registers as numbers.
pub fn registers<C: Circuit>(circuit: &C, source: &mut dyn Source) -> C::Reg<Value> {
    C::Reg::make(circuit, view::role(Role::Register), source)
}

/// Returns a circuit's own nets as numbers.
pub fn nets<C: Circuit>(circuit: &C, source: &mut dyn Source) -> C::Net<Value> {
    C::Net::make(circuit, view::role(Role::Net), source)
}

/// Returns the circuits inside as numbers; in `source` the circuit's own registers come before
/// them.
pub fn parts<C: Circuit>(circuit: &C, source: &mut dyn Source) -> C::Parts<Value> {
    C::Reg::<Shapes>::make(circuit, view::role(Role::Register), source);
    C::Parts::make(circuit, view::role(Role::Net), source)
}

/// Returns all registers as numbers.
pub fn kept<C: Circuit>(circuit: &C, source: &mut dyn Source) -> Registers<C> {
    let q = C::Reg::make(circuit, view::role(Role::Register), source);
    let p = C::Parts::make(circuit, view::role(Role::Register), source);
    Registers { q, p }
}

/// Writes those methods of a circuit that are compiled with it.
#[macro_export]
#[doc(hidden)]
macro_rules! hdl_made {
    () => {
        $crate::hdl_made! {
            make_module module(
                path: ::std::string::String,
                more: $crate::hdl::More<'_>,
            ) -> (usize, ::std::vec::Vec<$crate::netlist::Setting>);
            make_shapes shapes(role: $crate::netlist::Role, source: &mut dyn $crate::hdl::Source) -> ();
            make_places places(source: &mut dyn $crate::hdl::Source) -> $crate::hdl::Signals<Self>;
            make_inputs inputs(
                source: &mut dyn $crate::hdl::Source,
            ) -> Self::In<$crate::hdl::Value>;
            make_registers registers(
                source: &mut dyn $crate::hdl::Source,
            ) -> Self::Reg<$crate::hdl::Value>;
            make_nets nets(source: &mut dyn $crate::hdl::Source) -> Self::Net<$crate::hdl::Value>;
            make_parts parts(
                source: &mut dyn $crate::hdl::Source,
            ) -> Self::Parts<$crate::hdl::Value>;
            make_kept kept(source: &mut dyn $crate::hdl::Source) -> $crate::hdl::Registers<Self>;
        }
    };
    ($( $name:ident $made:ident($($given:ident: $kind:ty),* $(,)?) -> $makes:ty; )+) => {
        $(
            #[inline(never)]
            fn $name(&self, $($given: $kind),*) -> $makes {
                $crate::hdl::made::$made(self, $($given),*)
            }
        )+
    };
}
