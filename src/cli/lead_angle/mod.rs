//! `run` of the lead-angle compensator: its positionings, or a position log, with waves, summary
//! and picture.

mod job;
pub mod log;
mod picture;
mod summary;
mod systems;
mod text;
pub mod waves;

pub use job::Job;
pub use summary::Summary;

use super::arguments::Arguments;
use super::progress::{self, Part, Work};
use super::report::conclude;
use super::setup::Setup;
use super::simulate::{Stage, with_waves};
use super::traces::{End, Focus};
use super::{Failure, series, threads};
use motion_rtl::jobs::lead_angle::job::{Played, play, positioner};
use motion_rtl::jobs::lead_angle::settings::{History, LeadBy, Settings};
use motion_rtl::plant::waves::Body;
use motion_rtl::sim::{Elaborated, RunError};
use motion_rtl::trace::{Position, SeriesLayout};
use rayon::prelude::*;
use systems::{NONE, System, systems};

/// About how long a tick takes, with the body.
const TICK_S: f64 = 50e-9;

/// CKs that the save file's window shows.
const CKS_SHOWN: u64 = 400;

/// Signals at the top of the save file.
const OVERVIEW: [&str; 15] = [
    "ck",
    "position",
    "predicted",
    "target",
    "comparator.difference",
    "lead_source.lead_time",
    "lead_source.history.tap",
    "lead_source.history.ratio",
    "placement.lead",
    "drive",
    "fire",
    "brake",
    "complete",
    "error",
    "learned_time",
];

/// Signals at the top of the save file if the lead follows the speed.
const OVERVIEW_BY_SPEED: [&str; 12] = [
    "ck",
    "position",
    "predicted",
    "target",
    "comparator.difference",
    "lead_source.speed",
    "placement.lead",
    "drive",
    "fire",
    "brake",
    "complete",
    "error",
];

/// Runs a job.
pub fn run(arguments: &Arguments, job: &Job) -> Result<(), Failure> {
    let setup = Setup::new(arguments, &job.loaded, &job.stem)?;
    if let Some(log) = &job.log {
        return log::run(&setup, job, log);
    }
    threads::start()?;
    let mut systems = systems(&job.settings);
    let (ticks, runs) = (job.ticks_at_least(), systems.len() as u64);
    let shown = systems.iter().find(|system| system.own);
    let settings = shown.map_or(&job.settings, |system| &system.settings);
    let circuit = positioner(settings);
    let stage = Stage {
        circuit: &circuit,
        model: &Elaborated::with_beside(&circuit, &Body).map_err(RunError::from)?,
        subject: &job.stem,
        work: Work {
            ticks,
            runs,
            seconds: ticks as f64 * runs as f64 * TICK_S,
        },
        series: setup.series(|| series_of(settings)),
    };
    let (own, mut files) = with_waves(&setup, stage, |observer| {
        let played = play(&circuit, settings, observer)?;
        let end = end(settings, &played);
        Ok((played, end))
    })?;
    if !job.loaded.scenario.beside() {
        systems.retain(|system| system.own);
    }
    let none = systems.iter().find(|system| system.name == NONE);
    let none = none.map(alone).transpose()?.unwrap_or_default();
    systems.iter_mut().for_each(|system| system.set_up(&none));
    let played = systems.into_par_iter().map(|system| {
        let played = match system.name {
            NONE => none.clone(),
            _ if system.own => own.clone(),
            _ => alone(&system)?,
        };
        Ok((system, played))
    });
    let played = played.collect::<Result<Vec<_>, Failure>>()?;
    progress::stage("summary and picture");
    files.write("svg", &picture::draw(job, &played))?;
    let summary = Summary::new(job, &played);
    conclude(&setup, files, summary)
}

/// Plays a system without waves.
fn alone(system: &System) -> Result<Played, Failure> {
    let settings = &Settings {
        // The RAM gives the same in every tick.
        history: History::ShiftRegister,
        ..system.settings.clone()
    };
    Ok(play(&positioner(settings), settings, &mut Part::default())?)
}

/// The end of a run; its window has the first signal in its middle.
fn end(settings: &Settings, played: &Played) -> End {
    let first = played.positionings.first();
    End {
        ticks: played.ticks,
        focus: focus(settings, first.map_or(0, |positioning| positioning.fired)),
    }
}

/// A window with that tick in its middle.
fn focus(settings: &Settings, action: u64) -> Focus {
    let shown = CKS_SHOWN * u64::from(settings.ck_ticks);
    Focus {
        action,
        before: shown / 2,
        shown,
        overview: match settings.lead {
            LeadBy::Time => &OVERVIEW,
            LeadBy::Speed | LeadBy::Table => &OVERVIEW_BY_SPEED,
        },
    }
}

/// The time series: target and body at each CK. The target's word counts turns over.
fn series_of(settings: &Settings) -> SeriesLayout<'static> {
    let target = Position::Nearest {
        path: "target".to_owned(),
    };
    let rows = series::at("ck", settings.ck_ticks.into());
    let body = series::axis("body", "counts", target, series::plant("position"));
    series::layout(rows, [body])
}
