//! Every circuit's Verilog and VHDL against the model, in simulators and in synthesis.

mod dpi;
mod equal;
mod ghdl;
mod golden_model;
mod plotter;
mod scenario;
mod simulators;
mod testbench;
mod tools;
mod trajectory;
mod turntable;
mod vhdl;
mod vhpi;
mod weld;
mod yosys;
mod zoo;
