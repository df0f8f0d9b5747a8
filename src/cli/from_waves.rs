//! `--from-waves`: the inputs that a design had in a simulation.

use super::Failure;
use super::names::Names;
use clap::Args;
use motion_rtl::compare::{DumpInputs, Map, Reset, Settings, inputs};
use motion_rtl::sim::Elaborated;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

/// Waves of a simulation, and the ticks that are taken of them.
#[derive(Debug, Args)]
pub struct FromWaves {
    /// Also writes the files of --testbench, with the inputs that your design had in a simulation:
    /// a VCD, FST or GHW.
    #[arg(
        long,
        value_name = "DUMP",
        groups = ["bench", "design"],
        conflicts_with_all = ["testbench", "stimulus"]
    )]
    from_waves: Option<PathBuf>,
    /// Scope of DUMP that corresponds to the circuit, by its path or path end. By default the scope
    /// with the most signals of the circuit, or none if the map names scopes.
    #[arg(long, value_name = "PATH", requires = "from_waves")]
    scope: Option<String>,
    /// Pairs names that differ only in case, if no name matches exactly.
    #[arg(long, requires = "from_waves")]
    ignore_case: bool,
    /// Ticks to skip at the beginning of DUMP; the circuit is at power-on in the next one.
    #[arg(
        long,
        value_name = "TICKS",
        requires = "from_waves",
        allow_negative_numbers = true,
        default_value_t = 0,
        value_parser = clap::value_parser!(i64).range(0..)
    )]
    skip: i64,
    /// Count of ticks to take; all by default.
    #[arg(
        long,
        value_name = "COUNT",
        requires = "from_waves",
        allow_negative_numbers = true,
        value_parser = clap::value_parser!(u64).range(2..)
    )]
    ticks: Option<u64>,
}

impl FromWaves {
    /// Returns the file, if there is one.
    pub fn path(&self) -> Option<&Path> {
        self.from_waves.as_deref()
    }

    /// Reads the inputs.
    pub fn read(
        &self,
        path: &Path,
        names: &Names,
        model: &Elaborated,
    ) -> Result<DumpInputs, Failure> {
        let map = match names.map() {
            Some(path) => Map::read(path)?,
            None => Map::default(),
        };
        let settings = Settings {
            other_clock: names.clock().map(str::to_owned),
            scope: self.scope.clone(),
            ignore_case: self.ignore_case,
            map,
            skip: self.skip,
            ticks: 0..self.ticks.unwrap_or(u64::MAX),
            ..Settings::default()
        };
        let reset = match names.reset() {
            None => Reset::Found,
            Some(Names::NONE) => Reset::None,
            Some(name) => Reset::Named(name.to_owned()),
        };
        Ok(inputs(model, path, &settings, &reset)?)
    }

    /// Formats where the inputs come from, and the command that compares the waves of the design
    /// with the golden ones.
    pub fn text(&self, path: &Path, names: &Names, taken: &DumpInputs, golden: &Path) -> String {
        let scope = match taken.scope.as_deref() {
            None => String::new(),
            Some("") => " from the file's own scope,".to_owned(),
            Some(scope) => format!(" from {scope},"),
        };
        let reset = match &taken.reset {
            Some(reset) => format!("reset by {reset}"),
            None => "no reset".to_owned(),
        };
        let mut text = format!("inputs{scope} by the clock {}, {reset}\n", taken.clock);
        let mut compare = format!("motion-rtl compare {} {}", golden.display(), path.display());
        // Writing to a string does not fail.
        if let Some(map) = names.map() {
            let _ = write!(compare, " --map {}", map.display());
        }
        if let Some(clock) = names.clock() {
            let _ = write!(compare, " --other-clock {clock}");
        }
        if let Some(scope) = &self.scope {
            let _ = write!(compare, " --scope {scope}");
        }
        if self.ignore_case {
            compare += " --ignore-case";
        }
        if self.skip > 0 {
            let _ = write!(compare, " --skip {}", self.skip);
        }
        if let Some(ticks) = self.ticks {
            let _ = write!(compare, " --ticks {ticks}");
        }
        let _ = writeln!(
            text,
            "to compare your waves with the golden ones: {compare}"
        );
        text
    }
}
