//! Circuits as VHDL-2008: one entity per circuit, a file each.
//!
//! Signals have the names that they have in the waves, as far as VHDL takes them. `clk` and a
//! synchronous `rst`, which returns every register to its power-on value and leaves memories as
//! they are, are added to what is clocked. A bit is a `std_logic`; a word, even one of one bit, is
//! an `unsigned` or `signed`.
//!
//! ```
//! use motion_rtl::{circuits::blocks::EnableCounter, vhdl::Vhdl};
//!
//! let top = Vhdl::new(&EnableCounter { width: 24 })?.top();
//! assert_eq!(top.name, "enable_counter.vhd");
//! assert!(top.text.contains("next_s <= count + 1;"));
//! # Ok::<(), motion_rtl::engine::EngineError>(())
//! ```

mod constant;
mod conversion;
mod entity;
mod expression;
mod map;
mod memories;
mod rules;
mod scope;
mod statements;
mod testbench;
mod text;
mod units;
mod vhpi;
mod words;

use crate::engine::EngineError;
use crate::netlist::Design;
use crate::printed::SourceFile;
use crate::sim::{Described, Elaborated};
use crate::trace::Clock;
use units::{Unit, Units};
pub use vhpi::{LibraryPath, LibraryPathError, VhpiChecker};

/// A circuit as VHDL-2008.
#[derive(Debug, Clone)]
pub struct Vhdl {
    circuit: Elaborated,
}

impl Vhdl {
    /// Prepares the modules of a circuit and of those inside it for printing.
    ///
    /// # Errors
    /// All errors of the circuit.
    pub fn new(circuit: &impl Described) -> Result<Self, EngineError> {
        let circuit = circuit.described()?;
        Ok(Vhdl { circuit })
    }

    /// The netlist that is printed.
    pub fn design(&self) -> &Design {
        self.circuit.design()
    }

    /// Returns the file of the circuit's own entity.
    pub fn top(&self) -> SourceFile {
        let units = Units::of(self.design());
        let top = units.units.last();
        top.map_or_else(SourceFile::default, |unit| source(&units, unit))
    }

    /// Returns the files in the order in which they are analysed: an entity each, the circuit
    /// itself last. Memories have their contents in their declarations.
    pub fn sources(&self) -> Vec<SourceFile> {
        let units = Units::of(self.design());
        units
            .units
            .iter()
            .map(|unit| source(&units, unit))
            .collect()
    }

    /// Returns a testbench with the period of a clock. It applies the
    /// [`StimulusFile`](crate::trace::StimulusFile) `<circuit>.stimulus`, and compares the output
    /// ports with the [`OutputFile`](crate::trace::OutputFile) `<circuit>.expected`.
    pub fn testbench(&self, clock: Clock) -> Option<SourceFile> {
        Units::of(self.design()).testbench(clock)
    }

    /// Returns the names that differ from those in the waves, as a
    /// [map](crate::compare::Map) for a comparison with the dump of the testbench.
    pub fn names(&self) -> SourceFile {
        Units::of(self.design()).map(&self.circuit)
    }
}

/// Returns the file of an entity.
fn source(units: &Units<'_>, unit: &Unit) -> SourceFile {
    SourceFile {
        name: format!("{}.vhd", unit.name),
        text: units.print(unit),
    }
}
