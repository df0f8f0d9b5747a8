//! `run` of the lead-angle compensator: its positionings, or a position log, with waves, summary
//! and picture.

mod job;
mod log;
mod picture;
mod summary;
mod systems;
mod text;

pub use job::Job;

use super::Failure;
use super::files::Files;
use super::report::conclude;
use super::run::{Arguments, Progress, options};
use super::traces::{Focus, Traces};
use motion_rtl::jobs::lead_angle::job::{
    Conventional, JobLead, Played, RamLead, ShiftLead, play, positioner,
};
use motion_rtl::jobs::lead_angle::settings::{History, Settings};
use motion_rtl::kernel::Without;
use motion_rtl::trace::Options;
use summary::Summary;
use systems::{NONE, System, TUNED, systems, tuned};

/// CKs that the save file's window shows.
const CKS_SHOWN: u64 = 400;

/// What the save file shows on top.
const OVERVIEW: [&str; 14] = [
    "ck",
    "position",
    "predicted",
    "target",
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

/// Runs a job.
pub fn run(arguments: &Arguments, job: &Job) -> Result<(), Failure> {
    let options = options(arguments, job.loaded.scenario.vcd_ticks())?;
    if let Some(log) = &job.log {
        return log::run(arguments, job, log, &options);
    }
    let (own, mut files) = match job.settings.history {
        History::ShiftRegister => simulate::<ShiftLead>(arguments, job, &options),
        History::Ram => simulate::<RamLead>(arguments, job, &options),
    }?;
    let mut played: Vec<(System, Played)> = Vec::new();
    for mut system in systems(&job.settings) {
        if let (TUNED, Some(none)) = (system.name, summary::of(&played, NONE)) {
            system.settings.speed_leads_ms = tuned(&job.settings, none);
        }
        let run = match system.own {
            true => own.clone(),
            false => alone(&system)?,
        };
        played.push((system, run));
    }
    files.write("svg", &picture::draw(job, &played))?;
    let summary = Summary::new(job, &played);
    conclude(arguments, &options, files, summary)
}

/// Plays a system without waves.
fn alone(system: &System) -> Result<Played, Failure> {
    let settings = &system.settings;
    Ok(match system.conventional {
        true => play(&positioner::<Conventional>(settings), settings, ())?,
        // The RAM gives the same in every tick.
        false => play(&positioner::<ShiftLead>(settings), settings, ())?,
    })
}

/// Plays the settings' own system with its waves.
fn simulate<P: JobLead>(
    arguments: &Arguments,
    job: &Job,
    options: &Options,
) -> Result<(Played, Files), Failure> {
    let settings = &job.settings;
    let circuit = positioner::<P>(settings);
    let (ticks, scenario) = (job.ticks_at_least(), (&job.loaded, job.stem.as_str()));
    let printed = &circuit.circuit;
    let mut traces = Traces::begin((&circuit, printed), arguments, scenario, options, ticks)?;
    let mut progress = Progress::new(ticks);
    let stimulus = traces.stimulus.as_mut().map(Without);
    let files = (traces.waves.as_mut(), stimulus, traces.noted.as_mut());
    let played = play(&circuit, settings, (files, &mut progress))?;
    drop(progress);
    let first = played.positionings.first();
    let focus = focus(settings, first.map_or(0, |positioning| positioning.fired));
    let files = traces.finish(&circuit, &focus, played.ticks)?;
    Ok((played, files))
}

/// A window with that tick in its middle.
fn focus(settings: &Settings, action: u64) -> Focus {
    let shown = CKS_SHOWN * u64::from(settings.ck_ticks);
    Focus {
        action,
        before: shown / 2,
        shown,
        overview: &OVERVIEW,
    }
}
