//! Every circuit's Verilog against the model, in simulators and in synthesis.

mod golden_model;
mod plotter;
mod scenario;
mod simulators;
mod tools;
mod trajectory;
mod turntable;
mod weld;
mod yosys;
mod zoo;
