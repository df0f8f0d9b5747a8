//! Every circuit's Verilog against the model, in simulators and in synthesis.
#![cfg(feature = "cosim")]

mod simulators;
mod tools;
mod zoo;
