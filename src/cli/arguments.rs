//! Arguments of `run`.

use super::series::SeriesPath;
use super::source::Input;
use super::wave_format::Format;
use clap::{Args, value_parser};
use std::path::PathBuf;

/// Arguments of `run`.
#[derive(Debug, Default, Args)]
pub struct Arguments {
    #[command(flatten)]
    pub input: Input,
    /// Directory for the files.
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// The format of the waves.
    #[arg(long, value_enum, value_name = "FORMAT", default_value_t)]
    pub format: Format,
    /// Writes no waves and no save file.
    #[arg(long, conflicts_with_all = ["format", "only"])]
    pub no_vcd: bool,
    /// First tick in the waves and the series.
    #[arg(long, value_name = "TICK", allow_negative_numbers = true)]
    pub from: Option<u64>,
    /// End of the window, exclusive.
    #[arg(long, value_name = "TICK", allow_negative_numbers = true)]
    pub to: Option<u64>,
    /// A scope or signal in the waves, as `pulse_interpolator.x`; repeated for more. Without it all.
    #[arg(long, value_name = "SCOPE")]
    pub only: Vec<String>,
    /// Writes the circuit as Verilog too, with a testbench and the run's inputs as its stimulus.
    #[arg(long)]
    pub verilog: bool,
    /// Writes how the circuit was run, as `plan` shows it, with how often each block ran.
    #[arg(long)]
    pub plan: bool,
    /// Writes commanded and actual positions and their difference, one row per sampling period, to
    /// a .csv file or, for NumPy, a .npy file.
    #[arg(long, value_name = "FILE", conflicts_with = "waves_of")]
    pub series: Option<SeriesPath>,
    /// Writes a row of the series every TICKS ticks instead.
    #[arg(
        long,
        value_name = "TICKS",
        requires = "series",
        allow_negative_numbers = true,
        value_parser = value_parser!(u64).range(1..)
    )]
    pub series_every: Option<u64>,
    /// Plays what the circuit is compared with too, as `--set beside=true` does.
    #[arg(long)]
    pub beside: bool,
    /// Writes the waves of this system of the summary, to STEM_NAME.vcd, and plays it alone; `list`
    /// has the names.
    #[arg(long, value_name = "NAME", conflicts_with_all = ["no_vcd", "beside", "segments"])]
    pub waves_of: Option<String>,
    /// Prints every segment, arc, positioning or signal, not the worst or the last alone (not of
    /// the pulse interpolator).
    #[arg(long)]
    pub segments: bool,
    /// Shows the waves in GTKWave, or in Surfer where that is not there.
    #[arg(long, conflicts_with = "no_vcd")]
    pub open: bool,
    /// Prints the summary as JSON.
    #[arg(long)]
    pub json: bool,
}
