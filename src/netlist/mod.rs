//! Netlist of a circuit: modules of nodes, the signals that they drive, and the mistakes that a
//! circuit can have.

mod mistake;
mod module;
mod modules;
mod node;
mod signal;

pub(crate) use mistake::debug_as_display;
pub use mistake::{Mistake, Site, Wrong};
pub(crate) use module::Register;
pub use module::{
    Assertion, Child, Claim, Design, Memory, Module, Parameter, Port, Setting, Signal, Value,
};
pub(crate) use modules::{enter, live};
pub use node::{Id, Node, Operator};
pub use signal::{BIT, Field, Format, Kind, Role, Shape, signed, unsigned};
