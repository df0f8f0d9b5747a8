//! Circuits as Verilog-2001: one module per circuit, a file each, and a file for what stands in
//! a memory at power-on.
//!
//! Signals have the names that they have in the waves. `clk` and a synchronous `rst`, which
//! returns every register to its power-on value and leaves memories as they are, are added to
//! what is clocked.
//!
//! ```
//! use motion_rtl::{circuits::blocks::EnableCounter, verilog::Verilog};
//!
//! let sources = Verilog::of(&EnableCounter { width: 24 })?.sources();
//! assert_eq!(sources[0].name, "enable_counter.v");
//! assert!(sources[0].text.contains("wire [23:0] next = count + 24'd1;"));
//! # Ok::<(), motion_rtl::verilog::VerilogError>(())
//! ```

mod connections;
mod conversion;
mod design;
mod expression;
mod formal;
mod header;
mod instances;
mod keywords;
mod memories;
mod module;
mod names;
mod statements;
mod testbench;
mod text;
mod unused;

use crate::engine::EngineError;
use crate::hdl::netlist::{Design, Value};
use crate::hdl::{Described, Model};
pub use connections::{Connection, Connections, Part};
use design::Modules;
use std::collections::HashSet;
use std::fmt::Write as _;

/// A circuit as Verilog-2001.
#[derive(Debug, Clone, PartialEq)]
pub struct Verilog {
    design: Design,
}

/// A file of a design.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SourceFile {
    /// Its name.
    pub name: String,
    /// Its text.
    pub text: String,
}

/// Why a circuit cannot be had as Verilog.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum VerilogError {
    /// It is no netlist.
    #[error(transparent)]
    Engine(EngineError),
    /// A name that has another meaning.
    #[error("{module}: {name} is a word of Verilog or kept for the clock and the reset")]
    Reserved {
        /// The circuit.
        module: String,
        /// The name.
        name: String,
    },
    /// A name that is used twice.
    #[error("{module}: {name} is declared twice")]
    Twice {
        /// The circuit.
        module: String,
        /// The name.
        name: String,
    },
}

impl Verilog {
    /// The modules of a circuit and of those inside it.
    ///
    /// # Errors
    /// The circuit is no netlist, or has names that Verilog does not take.
    pub fn of(circuit: &impl Described) -> Result<Self, VerilogError> {
        Self::of_model(circuit.described())
    }

    /// Those of a circuit that was elaborated, if it could be.
    pub(crate) fn of_model(model: Result<Model, EngineError>) -> Result<Self, VerilogError> {
        let design = model.map_err(VerilogError::Engine)?.design().clone();
        check_names(&design)?;
        Ok(Verilog { design })
    }

    /// The netlist that is printed.
    pub fn design(&self) -> &Design {
        &self.design
    }

    fn modules(&self) -> Modules<'_> {
        Modules {
            modules: &self.design.modules,
            settings: &self.design.settings,
        }
    }

    /// The files: a module each, the circuit itself last, then the contents of memories for
    /// `$readmemh`.
    pub fn sources(&self) -> Vec<SourceFile> {
        let modules = self.modules();
        let sources = self.design.modules.iter().map(|module| SourceFile {
            name: format!("{}.v", module.name),
            text: modules.print(module),
        });
        let contents = self.design.settings.iter().filter_map(|setting| {
            let Value::Words(words) = &setting.value else {
                return None;
            };
            let digits = setting.width.div_ceil(4);
            let mut text = String::new();
            for word in words {
                // Writing to a string does not fail.
                let _ = writeln!(text, "{word:0digits$x}");
            }
            let name = format!("{}.hex", setting.path.join("_"));
            Some(SourceFile { name, text })
        });
        sources.chain(contents).collect()
    }

    /// What the circuit's own module asserts for formal tools: the names of its
    /// [properties](crate::hdl::Circuit::properties).
    pub fn assertions(&self) -> Vec<&'static str> {
        let top = self.design.modules.last();
        let assertions = top.map(|module| module.assertions.iter());
        assertions
            .into_iter()
            .flatten()
            .map(|assertion| assertion.name)
            .collect()
    }

    /// A testbench that applies a stimulus of [`StimulusFile`](crate::trace::StimulusFile), which
    /// it expects as `<circuit>.stimulus`, and dumps every signal to `<circuit>_tb.vcd`.
    pub fn testbench(&self) -> Option<SourceFile> {
        let top = self.design.modules.last()?;
        Some(testbench::testbench(&self.modules(), top))
    }
}

/// Finds names that Verilog does not take.
fn check_names(design: &Design) -> Result<(), VerilogError> {
    for module in &design.modules {
        let own = module
            .signals
            .iter()
            .filter(|signal| signal.owner.is_none());
        let memories = module.memories.iter().filter(|memory| !memory.inner);
        let names = own
            .map(|signal| &signal.name)
            .chain(memories.map(|memory| &memory.name))
            .chain(module.instances.iter().map(|child| &child.name));
        let mut seen = HashSet::new();
        for name in names.chain([&module.name]) {
            let module = module.name.clone();
            let name = name.clone();
            if keywords::is_reserved(&name) {
                return Err(VerilogError::Reserved { module, name });
            }
            if !seen.insert(name.clone()) {
                return Err(VerilogError::Twice { module, name });
            }
        }
    }
    Ok(())
}
