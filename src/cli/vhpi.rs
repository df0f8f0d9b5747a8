//! `vhdl --vhpi`: a checker that puts the model beside a design in GHDL.

use super::bench::UNUSED;
use super::chosen::Chosen;
use super::export::Export;
use super::files::Files;
use super::{Failure, print};
use clap::Args;
use motion_rtl::vhdl::{LibraryPath, VhpiChecker};
use std::path::Path;

/// Arguments of a checker.
#[derive(Debug, Args)]
pub struct Vhpi {
    /// Writes a VHDL checker in place of the circuit: it compares your design with the model at
    /// every clock edge, in GHDL.
    #[arg(long, conflicts_with_all = UNUSED)]
    vhpi: bool,
    /// Shared library of bindings/c, as GHDL opens it: a path, or a name that is sought in
    /// LD_LIBRARY_PATH.
    #[arg(
        long,
        value_name = "FILE",
        requires = "vhpi",
        default_value = "libmotion_rtl.so"
    )]
    library: LibraryPath,
}

impl Vhpi {
    /// True if a checker is to be written.
    pub fn is_asked(&self) -> bool {
        self.vhpi
    }
}

/// Writes the checker of a circuit.
pub fn checker(chosen: &Chosen, vhpi: &Vhpi, out: &Path) -> Result<(), Failure> {
    let (model, settings) = chosen.running()?;
    let circuit = model.name();
    let checker = VhpiChecker::new(&model, &settings, vhpi.library.clone());
    let mut files = Files::begin(out, circuit)?;
    files.export(Export::checker(
        &format!("{circuit}_checker_vhdl"),
        Vec::from(checker.sources()),
        format!("vhdl {chosen} --vhpi"),
    ))?;
    let paths = files.commit()?;
    print(
        &paths
            .iter()
            .map(|path| format!("{path}\n"))
            .collect::<String>(),
    )
}
