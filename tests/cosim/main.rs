//! Every circuit's Verilog against the model, in simulators and in synthesis.

mod golden_model;
mod plotter;
#[path = "../scaled/mod.rs"]
mod scaled;
mod scenario;
mod simulators;
mod tools;
mod trajectory;
mod turntable;
mod weld;
mod yosys;
mod zoo;
