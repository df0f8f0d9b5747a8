//! Everything needed to write and test a circuit.

pub use crate::check::{Fault, Invariants, Outcome, Specified, prove, reach, require};
pub use crate::hdl::Record as _;
pub use crate::hdl::{
    Bit, Circuit, Cut, Edge, I, Image, Moment, Nothing, Open, Part, Property, Ram, Seen, Settled,
    Shift, U, Value, View, Wire, Words, Written, choice, log2, records, settle_each, signals, zero,
};
pub use crate::sim::Simulator;
