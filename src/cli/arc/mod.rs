//! `run` of the arc generator: its path, waves, summary and picture.

mod arm;
mod beside;
mod blended;
mod costs;
mod figures;
mod job;
mod jolt;
mod mechanism;
mod operations;
mod picture;
mod products;
mod projection;
mod style;
mod summary;
mod text;
mod verdict;
mod view;
mod waves;

pub use job::Job;
pub use summary::Summary;
pub use waves::systems;

use super::arguments::Arguments;
use super::progress::{self, Work};
use super::report::conclude;
use super::setup::Setup;
use super::simulate::{Stage, with_waves};
use super::traces::{End, Focus};
use super::{Failure, series};
use beside::Beside;
use figures::UnderWay;
use motion_rtl::circuits::arc_generator::ArcGenerator;
use motion_rtl::input::COORDINATES;
use motion_rtl::jobs::arc_generator::conventional::Conventional as Method;
use motion_rtl::jobs::arc_generator::job::{Command, Played, arc_generator, play_each};
use motion_rtl::sim::{Observer, RunError};
use motion_rtl::trace::{Position, SeriesLayout, SeriesPlan};
use picture::draw;

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
    let setup = Setup::new(arguments, &job.loaded, &job.stem)?;
    let circuit = arc_generator(&job.settings);
    let subject = job.drawing.as_ref();
    let subject = subject.map_or(&job.stem, |drawing| &drawing.file);
    let stage = Stage {
        circuit: &circuit,
        model: &waves::shown(&circuit, job.arm.is_some())?,
        subject,
        work: Work {
            ticks: job.ticks_at_least(),
            runs: 1,
            seconds: job.prepared.samples() as f64 * SAMPLE_S,
        },
        series: setup.series(|| series_of(job)),
    };
    let ((played, mut figures), mut files) = with_waves(&setup, stage, |observer| {
        let mut under_way = UnderWay::new(job);
        let each = &mut |command| under_way.take(command);
        let played = play(job, &circuit, observer, each)?;
        let figures = under_way.finish();
        let end = End {
            ticks: played.ticks,
            focus: window(job, figures.change.unwrap_or(0), &OVERVIEW),
        };
        Ok(((played, figures), end))
    })?;
    progress::stage("the arcs by the conventional method");
    if job.loaded.scenario.beside() {
        figures.beside = Beside::run(job, Method::new, figures.blended.as_ref())?;
        figures.even = Beside::run(job, Method::even, None)?;
        figures.compare_arcs();
    }
    progress::stage("summary and picture");
    files.write("svg", &draw(job, &figures))?;
    let summary = Summary::new(job, &played, &figures)?;
    conclude(&setup, files, summary)
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

/// The time series: exact points and commands at each sample.
fn series_of(job: &Job) -> SeriesLayout<'_> {
    let strobe = "sampled";
    let per_mm = job.settings.counts_per_mm;
    let last = job.prepared.samples().saturating_sub(1);
    // Before the first sample there is neither a point nor a command.
    let exact = move |samples: u64| {
        if samples == 0 {
            return Vec::new();
        }
        let point = job.prepared.point((samples - 1).min(last));
        let point = point.unwrap_or([f64::NAN; COORDINATES]);
        point.map(|mm| mm * per_mm).to_vec()
    };
    let axis = |(axis, name)| {
        let exact = Position::Planned { plan: 0, axis };
        series::axis(name, "counts", exact, series::word(name))
    };
    let axes = waves::NAMES.into_iter().enumerate().map(axis);
    SeriesLayout {
        plans: vec![SeriesPlan {
            clock: strobe.to_owned(),
            at: Box::new(exact),
        }],
        ..series::layout(series::at(strobe, job.sample_ticks.into()), axes)
    }
}
