//! Every circuit's Verilog against the model, in simulators and in synthesis.
#![cfg(feature = "cosim")]

mod scenario;
mod golden_model;
mod simulators;
mod tools;
mod yosys;
