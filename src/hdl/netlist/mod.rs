//! Netlist of a circuit: modules of nodes.

mod module;
mod modules;
mod node;

pub(crate) use module::Register;
pub use module::{
    Assertion, Child, Design, Memory, Module, Parameter, Port, Setting, Signal, Value,
};
pub(crate) use modules::{enter, live};
pub use node::{Id, Node, Operator};
