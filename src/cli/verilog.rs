//! `verilog`: a circuit as Verilog, with a testbench if one is asked for, or a checker by DPI.

use super::Failure;
use super::bench::{Bench, unprinted, write};
use super::dpi::{self, Dpi};
use super::export::Printed;
use clap::Args;

/// Arguments of `verilog`.
#[derive(Debug, Args)]
pub struct Arguments {
    #[command(flatten)]
    bench: Bench,
    #[command(flatten)]
    dpi: Dpi,
}

/// Writes the circuit and, if requested, its testbench.
pub fn verilog(arguments: &Arguments) -> Result<(), Failure> {
    let Arguments { bench, dpi } = arguments;
    if dpi.is_asked() {
        return dpi::checker(&bench.chosen, dpi, &bench.names, &bench.out);
    }
    let circuit = bench.chosen.model()?;
    let verilog = circuit.verilog().map_err(|error| unprinted(&error))?;
    write(bench, &*circuit, Printed::Verilog(&verilog), "verilog")
}
