//! `vhdl`: a circuit as VHDL, with a testbench if one is asked for, or a checker by VHPIDIRECT.

use super::Failure;
use super::bench::{Bench, unprinted, write};
use super::export::Printed;
use super::vhpi::{self, Vhpi};
use clap::Args;

/// Arguments of `vhdl`.
#[derive(Debug, Args)]
pub struct Arguments {
    #[command(flatten)]
    bench: Bench,
    #[command(flatten)]
    vhpi: Vhpi,
}

/// Writes the circuit and, if requested, its testbench.
pub fn vhdl(arguments: &Arguments) -> Result<(), Failure> {
    let Arguments { bench, vhpi } = arguments;
    if vhpi.is_asked() {
        return vhpi::checker(&bench.chosen, vhpi, &bench.out);
    }
    let circuit = bench.chosen.model()?;
    let vhdl = circuit.vhdl().map_err(|error| unprinted(&error))?;
    write(bench, &*circuit, Printed::Vhdl(&vhdl), "vhdl")
}
