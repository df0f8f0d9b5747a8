//! `run` of the arc generator: its path, waves, summary and picture.

mod arm;
mod beside;
mod figures;
mod job;
mod mechanism;
mod operations;
mod picture;
mod products;
mod rows;
mod summary;
mod text;
mod verdict;
mod view;
mod waves;

pub use job::Job;
pub use waves::systems;

use super::Failure;
use super::files::Files;
use super::progress::{self, Work};
use super::report::conclude;
use super::run::{Arguments, in_waves, options};
use super::traces::{Focus, Traces};
use beside::Beside;
use figures::{Figures, UnderWay};
use motion_rtl::circuits::arc_generator::ArcGenerator;
use motion_rtl::hdl::{Observer, RunError};
use motion_rtl::jobs::arc_generator::conventional::Conventional as Method;
use motion_rtl::jobs::arc_generator::job::{Command, Played, arc_generator, play_each};
use motion_rtl::trace::Options;
use picture::draw;
use summary::Summary;

/// About how long a sample takes.
const SAMPLE_S: f64 = 1e-6;

/// Samples that the save file's window shows, with the change into the rotation in its middle.
const SAMPLES_SHOWN: u64 = 12;

/// Signals at the top of the save file.
const OVERVIEW: [&str; 23] = [
    "sampled",
    "kind",
    "sequencer.state",
    "memory.word",
    "engine_x.nearest",
    "engine_y.nearest",
    "engine_z.nearest",
    "blend_point.share.nearest",
    "blend_point.weight.pass",
    "blend_point.weight.bits",
    "blend_point.row_x.sum",
    "blend_point.row_y.sum",
    "blend_point.row_z.sum",
    "rotation.control.bit_index",
    "rotation.row_x.sum",
    "rotation.row_y.sum",
    "rotation.row_z.sum",
    "x",
    "y",
    "z",
    "arm.base",
    "arm.shoulder",
    "arm.elbow",
];

pub fn run(arguments: &Arguments, job: &Job) -> Result<(), Failure> {
    let options = options(arguments, job.loaded.scenario.vcd_ticks())?;
    let ((played, mut figures), mut files) = simulate(arguments, job, &options)?;
    progress::stage("the arcs by the conventional method");
    if job.loaded.scenario.beside() {
        figures.beside = Beside::run(job, Method::new, figures.blended.as_ref())?;
        figures.even = Beside::run(job, Method::even, None)?;
    }
    progress::stage("summary and picture");
    files.write("svg", &draw(job, &figures))?;
    let summary = Summary::new(job, &played, &figures)?;
    conclude(arguments, &options, files, summary)
}

/// Plays the path with its waves.
fn simulate(
    arguments: &Arguments,
    job: &Job,
    options: &Options,
) -> Result<((Played, Figures), Files), Failure> {
    let circuit = arc_generator(&job.settings);
    let (ticks, scenario) = (job.ticks_at_least(), (&job.loaded, job.stem.as_str()));
    let shown = waves::shown(&circuit, job.arm.is_some())?;
    let traces = Traces::begin((&shown, &circuit), arguments, scenario, options, ticks)?;
    let in_waves = in_waves(arguments, options, ticks);
    let subject = job
        .drawing
        .as_ref()
        .map_or(&job.stem, |drawing| &drawing.file);
    progress::run(
        subject,
        Work {
            ticks,
            runs: 1,
            seconds: job.prepared.samples() as f64 * SAMPLE_S,
            in_waves,
        },
    );
    traces.play(
        &shown,
        |observer| {
            let mut under_way = UnderWay::new(job);
            let each = &mut |command| under_way.take(command);
            let played = play(job, &circuit, observer, each)?;
            Ok((played, under_way.finish()))
        },
        |(played, figures)| {
            let change = figures.change.unwrap_or(0);
            (window(job, change, &OVERVIEW), played.ticks)
        },
    )
}

fn play(
    job: &Job,
    circuit: &ArcGenerator,
    observer: &mut dyn Observer<ArcGenerator>,
    each: &mut dyn FnMut(Command),
) -> Result<Played, RunError> {
    let (records, sample_ticks) = (&job.records, job.sample_ticks);
    play_each(circuit, records, sample_ticks, job.hand(), observer, each)
}

/// A window around a tick, of as many samples as are shown.
fn window(job: &Job, action: u64, overview: &'static [&'static str]) -> Focus {
    let shown = SAMPLES_SHOWN * u64::from(job.sample_ticks);
    Focus {
        action,
        before: shown / 2,
        shown,
        overview,
    }
}
