//! `run`: a job on its circuit, with waves, save file and picture.

use super::Failure;
use super::job::Job;
use super::progress;
use super::source::{Input, Source};
use super::traces::Format;
use super::viewer::Viewer;
use clap::Args;
use motion_rtl::scenario::Loaded;
use motion_rtl::trace::{Clock, Options};
use std::path::PathBuf;

/// The key that `--beside` sets.
const BESIDE: &str = "beside=true";

/// Arguments of `run`.
#[derive(Debug, Default, Args)]
pub struct Arguments {
    #[command(flatten)]
    input: Input,
    /// Directory for the files.
    #[arg(long, value_name = "DIR")]
    pub(super) out: Option<PathBuf>,
    /// The format of the waves.
    #[arg(long, value_enum, value_name = "FORMAT", default_value_t)]
    pub(super) format: Format,
    /// Writes no waves and no save file.
    #[arg(long, conflicts_with_all = ["format", "from", "to", "only"])]
    pub(super) no_vcd: bool,
    /// First tick in the waves.
    #[arg(long, value_name = "TICK", allow_negative_numbers = true)]
    pub(super) from: Option<u64>,
    /// End of the window, exclusive.
    #[arg(long, value_name = "TICK", allow_negative_numbers = true)]
    pub(super) to: Option<u64>,
    /// A scope or signal in the waves, as `pulse_interpolator.x`; repeated for more. Without it all.
    #[arg(long, value_name = "SCOPE")]
    pub(super) only: Vec<String>,
    /// Writes the circuit as Verilog too, with a testbench and the run's inputs as its stimulus.
    #[arg(long)]
    pub(super) verilog: bool,
    /// Writes how the circuit was run, as `plan` shows it, with how often each block ran.
    #[arg(long)]
    pub(super) plan: bool,
    /// Plays what the circuit is compared with too, as `--set beside=true` does.
    #[arg(long)]
    beside: bool,
    /// Writes the waves of this system of the summary, to STEM_NAME.vcd, and plays it alone; `list`
    /// has the names.
    #[arg(long, value_name = "NAME", conflicts_with_all = ["no_vcd", "beside", "segments"])]
    pub(super) waves_of: Option<String>,
    /// Prints every segment, arc, positioning or signal, not the worst or the last alone (not of
    /// the pulse interpolator).
    #[arg(long)]
    pub(super) segments: bool,
    /// Shows the waves in GTKWave, or in Surfer where that is not there.
    #[arg(long, conflicts_with = "no_vcd")]
    pub(super) open: bool,
    /// Prints the summary as JSON.
    #[arg(long)]
    pub(super) json: bool,
}

pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    progress::begin();
    let done = play(arguments);
    progress::end();
    done
}

fn play(arguments: &Arguments) -> Result<(), Failure> {
    // Before the run, which may be long.
    arguments.open.then(Viewer::find).transpose()?;
    let mut input = arguments.input.clone();
    input
        .sets
        .extend(arguments.beside.then(|| BESIDE.to_owned()));
    let mut source = Source::read(&input)?;
    source.compares |= arguments.waves_of.is_some();
    Job::prepare(source)?.run(arguments)
}

/// The window and the signals that are asked for.
pub(super) fn options(arguments: &Arguments, most: u64) -> Result<Options, Failure> {
    let from = arguments.from.unwrap_or(0);
    let to = arguments.to.unwrap_or_else(|| from.saturating_add(most));
    if from >= to {
        return Err(Failure::Argument {
            field: "--from, --to",
            problem: format!("no tick from {from} to {to}"),
            allowed: "--from below --to".into(),
        });
    }
    let only = (!arguments.only.is_empty()).then(|| arguments.only.clone());
    Ok(Options {
        ticks: from..to,
        only,
    })
}

/// Returns how many of a run's `ticks` are in the waves.
pub(super) fn in_waves(arguments: &Arguments, options: &Options, ticks: u64) -> u64 {
    match arguments.no_vcd {
        true => 0,
        false => options
            .ticks
            .end
            .min(ticks)
            .saturating_sub(options.ticks.start),
    }
}

/// The clock of the waves, in which the last tick must have a time; ticks that do not fit their
/// counter are given as its largest number.
pub(super) fn clock(
    arguments: &Arguments,
    loaded: &Loaded,
    ticks: u64,
    options: &Options,
) -> Result<Clock, Failure> {
    let refuse = |problem: String, allowed: String| loaded.fault("clock_hz", problem, allowed);
    let hz = loaded.scenario.clock_hz();
    let clock = Clock::from_hz(hz).map_err(|error| {
        let allowed = format!("1 to {} Hz", Clock::MAX_HZ);
        refuse(error.to_string(), allowed)
    })?;
    if ticks == u64::MAX {
        let allowed = "a run of fewer ticks: a slower clock, or faster motions".to_owned();
        return Err(refuse(
            format!("is {hz}: the run takes 2^64 ticks or more"),
            allowed,
        )
        .into());
    }
    let last = options.ticks.end.min(ticks);
    if clock.rise(last).is_none() && !arguments.no_vcd {
        let (problem, allowed) = (
            format!("is {hz}: tick {last} is 2^64 fs or more after tick 0"),
            "a clock whose period is not rounded to 1 fs, an earlier --to, or --no-vcd",
        );
        return Err(refuse(problem, allowed.into()).into());
    }
    Ok(clock)
}
