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
//! let top = Verilog::new(&EnableCounter { width: 24 })?.top();
//! assert_eq!(top.name, "enable_counter.v");
//! assert!(top.text.contains("wire [23:0] next = count + 24'd1;"));
//! # Ok::<(), motion_rtl::engine::EngineError>(())
//! ```

mod connections;
mod conversion;
mod dpi;
mod expression;
mod formal;
mod header;
mod instances;
mod memories;
mod module;
mod rules;
mod statements;
mod testbench;
mod text;
mod unused;

use crate::engine::EngineError;
use crate::netlist::{Design, Module, Value};
use crate::printed::Modules;
pub use crate::printed::SourceFile;
use crate::sim::Described;
use crate::trace::Clock;
pub use connections::{Connection, Connections, Part};
pub use dpi::{Binding, DpiChecker};
use std::fmt::Write as _;

/// A circuit as Verilog-2001.
#[derive(Debug, Clone, PartialEq)]
pub struct Verilog {
    design: Design,
}

/// Returns the file of a module.
fn source(modules: &Modules<'_>, module: &Module) -> SourceFile {
    SourceFile {
        name: format!("{}.v", module.name),
        text: modules.print_in_verilog(module),
    }
}

impl Verilog {
    /// Prepares the modules of a circuit and of those inside it for printing.
    ///
    /// # Errors
    /// All errors of the circuit.
    pub fn new(circuit: &impl Described) -> Result<Self, EngineError> {
        let design = circuit.described()?.design().clone();
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

    /// Returns the file of the circuit's own module.
    ///
    /// ```
    /// use motion_rtl::circuits::pulse_interpolator::{UnitLaw, Variant};
    /// use motion_rtl::verilog::Verilog;
    ///
    /// let verilog = Verilog::new(&UnitLaw { width: 8, variant: Variant::Safe })?;
    /// let top = verilog.top();
    /// assert!(top.text.contains("module unit_law"));
    /// assert_ne!(verilog.sources()[0], top);
    /// assert_eq!(verilog.sources().last(), Some(&top));
    /// # Ok::<(), motion_rtl::engine::EngineError>(())
    /// ```
    pub fn top(&self) -> SourceFile {
        let modules = self.modules();
        let top = self.design.modules.last();
        top.map_or_else(SourceFile::default, |module| source(&modules, module))
    }

    /// Returns the files: a module each, the circuit itself last, then the contents of memories for
    /// `$readmemh`.
    pub fn sources(&self) -> Vec<SourceFile> {
        let modules = self.modules();
        let sources = self.design.modules.iter();
        let sources = sources.map(|module| source(&modules, module));
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

    /// Returns the assertions in the circuit's own module for formal tools: the names of its
    /// [properties](crate::hdl::Circuit::properties).
    pub fn assertions(&self) -> Vec<&'static str> {
        let Some(top) = self.design.modules.last() else {
            return Vec::new();
        };
        let printed = top.printed(&self.design.modules).into_iter();
        let asserted = printed.filter(|printed| printed.claim.is_proved());
        asserted.map(|printed| printed.name).collect()
    }

    /// A testbench with the time scale of waves with this clock. Applies the
    /// [`StimulusFile`](crate::trace::StimulusFile) `<circuit>.stimulus`, holds the ports out against
    /// the [`OutputFile`](crate::trace::OutputFile) `<circuit>.expected`, and dumps every signal to
    /// `<circuit>_tb.vcd`.
    pub fn testbench(&self, clock: Clock) -> Option<SourceFile> {
        let top = self.design.modules.last()?;
        Some(testbench::testbench(&self.modules(), top, clock))
    }
}
