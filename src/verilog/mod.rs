//! Circuits as Verilog-2001: one module per circuit, a file each, and a file for what stands in
//! a memory at power-on.

mod expression;
mod module;
mod names;
mod statements;

use crate::kernel::Circuit;
use crate::logic::netlist::{Design, NetlistError, Value, elaborate};
use module::Modules;
use std::fmt::Write as _;

/// A file of a design.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SourceFile {
    /// Its name.
    pub name: String,
    /// Its text.
    pub text: String,
}

/// The files of a circuit: its own module last among those ending in `.v`.
///
/// # Errors
/// What cannot be printed; see [`NetlistError`].
pub fn print<C: Circuit>(circuit: &C) -> Result<Vec<SourceFile>, Vec<NetlistError>> {
    elaborate(circuit).map(|design| files(&design))
}

fn files(design: &Design) -> Vec<SourceFile> {
    let modules = Modules {
        modules: &design.modules,
        settings: &design.settings,
    };
    let sources = design.modules.iter().map(|module| SourceFile {
        name: format!("{}.v", module.name),
        text: modules.print(module),
    });
    let contents = design.settings.iter().filter_map(|setting| {
        let Value::Words(words) = &setting.value else {
            return None;
        };
        let digits = setting.width.div_ceil(4);
        let mut text = String::new();
        for word in words {
            let _ = writeln!(text, "{word:0digits$x}");
        }
        let name = format!("{}.hex", setting.path.join("_"));
        Some(SourceFile { name, text })
    });
    sources.chain(contents).collect()
}
