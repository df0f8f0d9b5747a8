//! Every circuit's Verilog against the model, in simulators and in synthesis.
#![cfg(feature = "cosim")]

mod scenario;
mod simulators;
mod tools;
mod yosys;
