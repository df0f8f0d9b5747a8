//! Arguments of `run`.

use super::series::SeriesPath;
use super::source::Input;
use super::wave_format::Format;
use clap::{Args, value_parser};
use std::path::PathBuf;

/// Arguments of `run`.
#[derive(Debug, Clone, Default, Args)]
pub struct Arguments {
    #[command(flatten)]
    pub input: Input,
    /// Directory for the files; `waves` by default.
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Format of the waves.
    #[arg(long, value_enum, value_name = "FORMAT", default_value_t)]
    pub format: Format,
    /// Writes no waves and no save file.
    #[arg(long, conflicts_with_all = ["format", "only"])]
    pub no_vcd: bool,
    /// First tick in the waves and the series.
    #[arg(long, value_name = "TICK", allow_negative_numbers = true)]
    pub from: Option<u64>,
    /// First tick after the window of the waves and the series.
    #[arg(long, value_name = "TICK", allow_negative_numbers = true)]
    pub to: Option<u64>,
    /// Scope or signal to put into the waves, such as `pulse_interpolator.x`; all by default. Can be
    /// repeated.
    #[arg(long, value_name = "SCOPE")]
    pub only: Vec<String>,
    /// Also writes the circuit as Verilog, with a testbench and the inputs of the run as its stimulus.
    #[arg(long)]
    pub verilog: bool,
    /// Also writes how the circuit was run: what `plan` shows, and how often each block ran.
    #[arg(long)]
    pub plan: bool,
    /// Writes commanded and actual positions and their differences, one row per sampling period, to
    /// a .csv file or, for NumPy, a .npy file.
    #[arg(long, value_name = "FILE", conflicts_with = "waves_of")]
    pub series: Option<SeriesPath>,
    /// Writes a row of the series every TICKS ticks instead of every sampling period.
    #[arg(
        long,
        value_name = "TICKS",
        requires = "series",
        allow_negative_numbers = true,
        value_parser = value_parser!(u64).range(1..)
    )]
    pub series_every: Option<u64>,
    /// Also runs the systems with which the circuit is compared, as `--set beside=true` does.
    #[arg(long)]
    pub beside: bool,
    /// Runs only this system of the summary, and writes its waves to STEM_NAME.vcd; `list` shows the
    /// names.
    #[arg(long, value_name = "NAME", conflicts_with_all = ["no_vcd", "beside", "segments"])]
    pub waves_of: Option<String>,
    /// Prints every segment, arc, positioning or signal, not only some of them. The pulse
    /// interpolator has none.
    #[arg(long)]
    pub segments: bool,
    /// Also writes the names of states for Surfer, to .surfer/mappings beside the waves.
    #[arg(long, conflicts_with = "no_vcd")]
    pub surfer: bool,
    /// Also writes a page that shows the run in a browser: path, errors and waves. Writes the waves
    /// as FST and the series STEM.csv for it.
    #[arg(long, value_name = "FILE", conflicts_with_all = ["format", "no_vcd", "waves_of"])]
    pub html: Option<PathBuf>,
    /// Shows the waves in GTKWave, or in Surfer if GTKWave is not installed.
    #[arg(long, conflicts_with = "no_vcd")]
    pub open: bool,
    /// Prints the summary as JSON.
    #[arg(long)]
    pub json: bool,
}
