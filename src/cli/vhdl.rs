//! `vhdl`: a circuit as VHDL, with a testbench if one is asked for.

use super::Failure;
use super::bench::{Bench, unprinted, write};
use super::export::Printed;
use clap::Args;

/// Arguments of `vhdl`.
#[derive(Debug, Args)]
pub struct Arguments {
    #[command(flatten)]
    bench: Bench,
}

/// Writes the circuit and, if requested, its testbench.
pub fn vhdl(arguments: &Arguments) -> Result<(), Failure> {
    let bench = &arguments.bench;
    let circuit = bench.chosen.model()?;
    let vhdl = circuit.vhdl().map_err(|error| unprinted(&error))?;
    write(bench, &*circuit, Printed::Vhdl(&vhdl), "vhdl")
}
