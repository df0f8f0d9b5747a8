//! Files that are read and written: waves and their comparison, drawings and programs, Verilog.

mod compare;
mod fuzz;
mod input;
mod verilog;
mod vhdl;
mod waves;
