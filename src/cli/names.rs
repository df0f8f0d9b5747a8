//! Names of a user's design: its clock, its reset, and a map of the others.

use clap::Args;
use std::path::{Path, PathBuf};

/// Names of a design.
#[derive(Debug, Args)]
pub struct Names {
    /// Names that differ and signals to leave out, in TOML, as in `compare`.
    #[arg(long, value_name = "FILE", requires = "design")]
    map: Option<PathBuf>,
    /// Clock of your design; clk by default.
    #[arg(long, value_name = "NAME", requires = "design")]
    clock: Option<String>,
    /// Synchronous reset of your design: NAME, !NAME if it is active low, or none; rst by default.
    #[arg(long, value_name = "NAME", requires = "design")]
    reset: Option<String>,
}

impl Names {
    /// Value of `--reset` for a design without a reset.
    pub const NONE: &str = "none";

    pub fn map(&self) -> Option<&Path> {
        self.map.as_deref()
    }

    pub fn clock(&self) -> Option<&str> {
        self.clock.as_deref()
    }

    pub fn reset(&self) -> Option<&str> {
        self.reset.as_deref()
    }
}
