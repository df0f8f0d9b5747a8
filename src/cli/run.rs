//! `run`: a job on the circuit, with waves, save file and picture.

use super::files::Files;
use super::job::{Input, Job, Source};
use super::picture::{Following, draw};
use super::report::conclude;
use super::summary::Summary;
use super::traces::{Focus, Format, Traces};
use super::{Failure, arc, lead_angle, linear, machine, trajectory};
use clap::Args;
use indicatif::{ProgressBar, ProgressFinish, ProgressStyle};
use motion_rtl::input::scenario::{Loaded, Scenario};
use motion_rtl::kernel::{Circuit, Observer, RunError, Sample};
use motion_rtl::pulse_interpolator::job::{Played, fast_forward, group, play};
use motion_rtl::trace::{Clock, Options};
use std::ops::ControlFlow;
use std::path::PathBuf;

/// Ticks between two looks at the progress bar.
const PROGRESS: u64 = 1 << 18;
/// Unit times that the save file's window shows.
const UNITS_SHOWN: u64 = 6;

/// What to run, and what to write.
#[derive(Debug, Default, Args)]
pub struct Arguments {
    #[command(flatten)]
    input: Input,
    /// Where the files go.
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
    /// First tick that is no more in the waves.
    #[arg(long, value_name = "TICK", allow_negative_numbers = true)]
    pub(super) to: Option<u64>,
    /// A scope or signal in the waves, as `pulse_interpolator.x`; repeated for more. Without it all.
    #[arg(long, value_name = "SCOPE")]
    pub(super) only: Vec<String>,
    /// Writes the circuit as Verilog too, with a testbench and the run's inputs as its stimulus.
    #[arg(long)]
    pub(super) verilog: bool,
    /// Prints every segment, arc, positioning or signal, not the worst or the last alone (not of
    /// the pulse interpolator).
    #[arg(long)]
    pub(super) segments: bool,
    /// Prints the summary as JSON.
    #[arg(long)]
    pub(super) json: bool,
}

/// Runs a job.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let source = Source::read(&arguments.input)?;
    match &source.loaded.scenario {
        Scenario::PulseInterpolator(_) => pulse(arguments, Job::prepare(source)?),
        Scenario::LinearInterpolator(scenario) => {
            let settings = scenario.settings();
            linear::run(arguments, &linear::Job::prepare(source, settings)?)
        }
        Scenario::LeadAngle(scenario) => {
            let (settings, columns) = (scenario.settings(), scenario.columns());
            lead_angle::run(
                arguments,
                &lead_angle::Job::prepare(source, settings, &columns)?,
            )
        }
        Scenario::ArcGenerator(scenario) => {
            let scenario = scenario.clone();
            arc::run(arguments, &arc::Job::prepare(source, &scenario)?)
        }
        Scenario::TrajectoryController(scenario) => {
            let scenario = scenario.clone();
            trajectory::run(arguments, &trajectory::Job::prepare(source, &scenario)?)
        }
        Scenario::Machine(scenario) => {
            let settings = scenario.settings();
            machine::run(arguments, &machine::Job::prepare(source, settings)?)
        }
    }
}

/// Runs a job on the pulse interpolator.
fn pulse(arguments: &Arguments, job: Job) -> Result<(), Failure> {
    if arguments.segments {
        return Err(Failure::Argument {
            field: "--segments",
            problem: "the pulse interpolator has no segments".into(),
            allowed: "a scenario of another circuit".into(),
        });
    }
    let options = options(arguments, job.vcd_ticks)?;
    let (played, mut files) = match job.table.axes() {
        1 => simulate::<1>(arguments, &job, &options),
        2 => simulate::<2>(arguments, &job, &options),
        _ => simulate::<3>(arguments, &job, &options),
    }?;
    let following =
        Following::new(&job, &played).map_err(|error| Failure::Check(error.to_string()))?;
    let summary = Summary::new(&job, &played, &following.largest);
    files.write("svg", &draw(&job, &played, &following))?;
    conclude(arguments, &options, files, summary)
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

fn simulate<const AXES: usize>(
    arguments: &Arguments,
    job: &Job,
    options: &Options,
) -> Result<(Played, Files), Failure> {
    let group = group::<AXES>(&job.table, job.variant);
    let ticks = job.table.total_ticks();
    let scenario = (&job.loaded, job.stem.as_str());
    let mut traces = Traces::begin((&group, &group), arguments, scenario, options, ticks)?;
    let mut progress = Progress::new(ticks);
    // Two calls, so that a run without waves is compiled without a trace of them.
    let played = match traces.is_empty() {
        false => {
            let files = (traces.waves.as_mut(), traces.stimulus.as_mut());
            play(&group, &job.table, (files, &mut progress))
        }
        true => fast_forward(&group, &job.table, &mut progress),
    }?;
    drop(progress);
    let unit = u64::from(job.table.patterns().first().map_or(1, |first| first.period));
    let focus = Focus {
        action: played.first_step.unwrap_or(played.begun),
        before: unit,
        shown: UNITS_SHOWN * unit,
        overview: &[],
    };
    let files = traces.finish(&group, &focus, played.ticks)?;
    Ok((played, files))
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

/// A bar on standard error, where that is a terminal.
pub(super) struct Progress {
    bar: ProgressBar,
    /// The tick at which it is looked at again.
    due: u64,
}

impl Progress {
    pub(super) fn new(ticks: u64) -> Self {
        let bar = ProgressBar::new(ticks).with_finish(ProgressFinish::AndClear);
        let style =
            ProgressStyle::with_template("{bar:40} {percent:>3} %  {human_pos} ticks  {eta}");
        if let Ok(style) = style {
            bar.set_style(style);
        }
        Progress { bar, due: 0 }
    }
}

impl<C: Circuit> Observer<C> for Progress {
    #[inline]
    fn sample(&mut self, now: &Sample<'_, C>) -> Result<ControlFlow<()>, RunError> {
        if now.tick >= self.due {
            self.bar.set_position(now.tick);
            self.due = now.tick + PROGRESS;
        }
        Ok(ControlFlow::Continue(()))
    }
}
