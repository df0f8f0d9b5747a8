//! `run`: a job on the circuit, with waves, save file and picture.

use super::files::Files;
use super::job::{Input, Job, Source};
use super::picture::{Following, draw};
use super::summary::Summary;
use super::{Failure, print, print_json};
use super::{lead_angle, linear};
use clap::Args;
use indicatif::{ProgressBar, ProgressFinish, ProgressStyle};
use motion_rtl::input::scenario::{Loaded, Scenario};
use motion_rtl::kernel::{Circuit, Observer, RunError, Sample};
use motion_rtl::pulse_interpolator::job::{Played, group, play};
use motion_rtl::trace::atomic::AtomicFile;
use motion_rtl::trace::{Clock, LayoutError, Options, StimulusFile, Vcd, gtkw};
use motion_rtl::verilog::Verilog;
use std::io::{self, Write as _};
use std::ops::{ControlFlow, Range};
use std::path::{Path, PathBuf};

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
    /// Writes no VCD and no save file.
    #[arg(long, conflicts_with_all = ["from", "to", "only"])]
    pub(super) no_vcd: bool,
    /// First tick in the VCD.
    #[arg(long, value_name = "TICK")]
    pub(super) from: Option<u64>,
    /// First tick that is no more in the VCD.
    #[arg(long, value_name = "TICK")]
    pub(super) to: Option<u64>,
    /// A scope or signal in the VCD, as `pulse_interpolator.x`; repeated for more. Without it all.
    #[arg(long, value_name = "SCOPE")]
    pub(super) only: Vec<String>,
    /// Writes the circuit as Verilog too, with a testbench and the run's inputs as its stimulus.
    #[arg(long)]
    pub(super) verilog: bool,
    /// Prints every segment, positioning or signal, not the worst or the last alone (not of the
    /// pulse interpolator).
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
        Scenario::ArcGenerator(_) => {
            let problem = "the arc generator cannot be run yet".to_owned();
            let allowed = "another circuit".to_owned();
            Err(source.loaded.fault("circuit", problem, allowed).into())
        }
    }
}

/// Runs a job on the pulse interpolator.
fn pulse(arguments: &Arguments, job: Job) -> Result<(), Failure> {
    if arguments.segments {
        return Err(Failure::Argument {
            field: "--segments",
            problem: "the pulse interpolator has no segments".into(),
            allowed: "a scenario of the linear interpolator or the lead-angle compensator".into(),
        });
    }
    let options = options(arguments, job.vcd_ticks)?;
    let (played, mut files) = match job.table.axes() {
        1 => simulate::<1>(arguments, &job, &options),
        2 => simulate::<2>(arguments, &job, &options),
        _ => simulate::<3>(arguments, &job, &options),
    }?;
    if options.ticks.start >= played.ticks {
        return Err(no_such_tick(&options, played.ticks));
    }
    let following =
        Following::new(&job, &played).map_err(|error| Failure::Check(error.to_string()))?;
    let mut summary = Summary::new(&job, &played, &following.largest);
    files.write("svg", &draw(&job, &played, &following))?;
    if !arguments.no_vcd {
        let Range { start, end } = options.ticks;
        summary.vcd_window = Some([start, end.min(played.ticks).max(start)]);
    }
    summary.files = files.commit()?;
    match arguments.json {
        true => print_json(&summary)?,
        false => print(&summary.text())?,
    }
    if summary.exact {
        return Ok(());
    }
    Err(Failure::Check(summary.complaints.join("\n")))
}

/// The run is over before the window begins.
pub(super) fn no_such_tick(options: &Options, ticks: u64) -> Failure {
    Failure::Argument {
        field: "--from",
        problem: format!("is {}", options.ticks.start),
        allowed: format!("0 to {}, the last tick of the run", ticks.saturating_sub(1)),
    }
}

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
    let clock = clock(arguments, &job.loaded, job.table.total_ticks(), options)?;
    let directory = arguments.out.as_deref().unwrap_or(Path::new("waves"));
    let mut files = Files::begin(directory, &job.stem)?;
    let mut vcd = match arguments.no_vcd {
        true => None,
        false => {
            let dump = Vcd::new(files.create("vcd")?, &group, clock, options);
            Some(dump.map_err(|error| not_selected(&error))?)
        }
    };
    let mut stimulus = match arguments.verilog {
        true => Some(verilog(&group, &mut files)?),
        false => None,
    };
    let mut progress = Progress::new(job.table.total_ticks());
    // Two calls, so that a run without waves is compiled without a trace of them.
    let played = match vcd.is_some() || stimulus.is_some() {
        true => {
            let files = (vcd.as_mut(), stimulus.as_mut());
            play(&group, &job.table, (files, &mut progress))
        }
        false => play(&group, &job.table, &mut progress),
    }?;
    drop(progress);
    if let Some(stimulus) = stimulus {
        files.push(stimulus.finish()?);
    }
    if let Some(vcd) = vcd {
        let units = u64::from(job.table.patterns().first().map_or(1, |first| first.period));
        let Range { start, end } = options.ticks;
        let action = played.first_step.unwrap_or(played.begun);
        // A unit time before the first step, where that is in the dump.
        let first = match action < end {
            true => action.saturating_sub(units).max(start),
            false => start,
        };
        let focus = first..(first + UNITS_SHOWN * units).min(played.ticks.max(first + 1));
        let save = gtkw::save_file(&group, clock, options, &job.stem, focus);
        files.push(vcd.finish()?);
        files.write("gtkw", &save.map_err(io::Error::from)?)?;
    }
    Ok((played, files))
}

/// The circuit's Verilog and its testbench; returns what writes the stimulus.
pub(super) fn verilog<C: Circuit>(
    circuit: &C,
    files: &mut Files,
) -> Result<StimulusFile<C, AtomicFile>, Failure> {
    // Every circuit of the crate is printed by a test, so only a new one can fail here.
    let verilog = Verilog::of(circuit).map_err(|error| Failure::Check(error.to_string()))?;
    for source in verilog.sources().iter().chain(&verilog.testbench()) {
        let mut file = files.create_as(&source.name)?;
        file.write_all(source.text.as_bytes())?;
        files.push(file);
    }
    let stimulus = files.create_as(&format!("{}.stimulus", C::NAME))?;
    Ok(StimulusFile::new(stimulus))
}

/// The clock of the waves, in which the last tick must have a time.
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

pub(super) fn not_selected(error: &LayoutError) -> Failure {
    let (problem, allowed) = match error {
        LayoutError::Unknown { wanted, scopes } => (
            format!("there is no {wanted}"),
            format!("a signal, or a scope: {}", scopes.join(", ")),
        ),
        other => (other.to_string(), "other signals".into()),
    };
    Failure::Argument {
        field: "--only",
        problem,
        allowed,
    }
}

/// A bar on standard error, where that is a terminal.
pub(super) struct Progress {
    bar: ProgressBar,
}

impl Progress {
    pub(super) fn new(ticks: u64) -> Self {
        let bar = ProgressBar::new(ticks).with_finish(ProgressFinish::AndClear);
        let style =
            ProgressStyle::with_template("{bar:40} {percent:>3} %  {human_pos} ticks  {eta}");
        if let Ok(style) = style {
            bar.set_style(style);
        }
        Progress { bar }
    }
}

impl<C: Circuit> Observer<C> for Progress {
    #[inline]
    fn sample(&mut self, now: &Sample<'_, C>) -> Result<ControlFlow<()>, RunError> {
        if now.tick.is_multiple_of(PROGRESS) {
            self.bar.set_position(now.tick);
        }
        Ok(ControlFlow::Continue(()))
    }
}
