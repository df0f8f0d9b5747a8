//! `run` of the lead-angle compensator: its positionings, or a position log, with waves, summary
//! and picture.

mod job;
mod log;
mod picture;
mod summary;
mod systems;
mod text;

pub use job::Job;

use super::files::Files;
use super::run::{Arguments, Progress, clock, no_such_tick, not_selected, options, verilog};
use super::{Failure, print, print_json};
use motion_rtl::kernel::Without;
use motion_rtl::lead_angle::LeadSource;
use motion_rtl::lead_angle::job::{
    Conventional, JobError, Played, Positioner, RamLead, ShiftLead, play, positioner,
};
use motion_rtl::lead_angle::settings::{History, Settings};
use motion_rtl::trace::atomic::AtomicFile;
use motion_rtl::trace::{Options, StimulusFile, Vcd, gtkw};
use std::io;
use std::ops::Range;
use std::path::Path;
use summary::Summary;
use systems::{System, systems};

/// CKs that the save file's window shows.
const CKS_SHOWN: u64 = 400;

/// Runs a job.
pub fn run(arguments: &Arguments, job: &Job) -> Result<(), Failure> {
    let options = options(arguments, job.loaded.scenario.vcd_ticks())?;
    if let Some(log) = &job.log {
        return log::run(arguments, job, log, &options);
    }
    let all = systems(&job.settings);
    let mut files = None;
    let mut played = Vec::new();
    for system in all {
        let run = match system.own {
            true => {
                let (run, own) = simulate(arguments, job, &options)?;
                files = Some(own);
                run
            }
            false => alone(&system)?,
        };
        played.push((system, run));
    }
    let own = played.iter().find(|(system, _)| system.own);
    let (Some((_, own)), Some(mut files)) = (own, files) else {
        return Err(Failure::Check("no system of the settings' own".into()));
    };
    if options.ticks.start >= own.ticks {
        return Err(no_such_tick(&options, own.ticks));
    }
    files.write("svg", &picture::draw(job, &played))?;
    let mut summary = Summary::new(job, &played);
    if !arguments.no_vcd {
        let Range { start, end } = options.ticks;
        summary.vcd_window = Some([start, end.min(summary.ticks).max(start)]);
    }
    summary.files = files.commit()?;
    match arguments.json {
        true => print_json(&summary)?,
        false => print(&summary.text(arguments.segments))?,
    }
    if summary.complaints.is_empty() {
        return Ok(());
    }
    Err(Failure::Check(summary.complaints.join("\n")))
}

fn refuse(error: JobError) -> Failure {
    match error {
        JobError::Run(error) => Failure::Run(error),
        // What the settings let through, a body takes.
        JobError::Parameter(error) => Failure::Check(error.to_string()),
    }
}

/// Plays a system without waves.
fn alone(system: &System) -> Result<Played, Failure> {
    let settings = &system.settings;
    let played = match system.conventional {
        true => play(&positioner::<Conventional>(settings), settings, ()),
        // The RAM gives the same in every tick.
        false => play(&positioner::<ShiftLead>(settings), settings, ()),
    };
    played.map_err(refuse)
}

/// Plays the settings' own system with its waves.
fn simulate(
    arguments: &Arguments,
    job: &Job,
    options: &Options,
) -> Result<(Played, Files), Failure> {
    match job.settings.history {
        History::ShiftRegister => on(
            positioner::<ShiftLead>(&job.settings),
            arguments,
            job,
            options,
        ),
        History::Ram => on(
            positioner::<RamLead>(&job.settings),
            arguments,
            job,
            options,
        ),
    }
}

/// The files of a run while it goes on.
struct Traces<P: LeadSource<11, 24, 16>> {
    files: Files,
    vcd: Option<Vcd<Positioner<P>, AtomicFile>>,
    stimulus: Option<Without<StimulusFile<motion_rtl::lead_angle::Compensator<P>, AtomicFile>>>,
}

impl<P: LeadSource<11, 24, 16> + 'static> Traces<P> {
    fn begin(
        circuit: &Positioner<P>,
        arguments: &Arguments,
        job: &Job,
        options: &Options,
        ticks: u64,
    ) -> Result<(Self, motion_rtl::trace::Clock), Failure> {
        let clock = clock(arguments, &job.loaded, ticks, options)?;
        let directory = arguments.out.as_deref().unwrap_or(Path::new("waves"));
        let mut files = Files::begin(directory, &job.stem)?;
        let vcd = match arguments.no_vcd {
            true => None,
            false => {
                let dump = Vcd::new(files.create("vcd")?, circuit, clock, options);
                Some(dump.map_err(|error| not_selected(&error))?)
            }
        };
        let stimulus = match arguments.verilog {
            true => Some(Without(verilog(&circuit.circuit, &mut files)?)),
            false => None,
        };
        let traces = Traces {
            files,
            vcd,
            stimulus,
        };
        Ok((traces, clock))
    }

    /// Closes what was written, with a save file whose window begins a little before `action`.
    fn finish(
        mut self,
        circuit: &Positioner<P>,
        clock: motion_rtl::trace::Clock,
        job: &Job,
        options: &Options,
        [action, ticks]: [u64; 2],
    ) -> Result<Files, Failure> {
        if let Some(Without(stimulus)) = self.stimulus {
            self.files.push(stimulus.finish()?);
        }
        if let Some(vcd) = self.vcd {
            let shown = CKS_SHOWN * u64::from(job.settings.ck_ticks);
            let Range { start, end } = options.ticks;
            let first = match action < end {
                true => action.saturating_sub(shown / 2).max(start),
                false => start,
            };
            let focus = first..(first + shown).min(ticks.max(first + 1));
            let save = gtkw::save_file(circuit, clock, options, &job.stem, focus);
            self.files.push(vcd.finish()?);
            self.files.write("gtkw", &save.map_err(io::Error::from)?)?;
        }
        Ok(self.files)
    }
}

fn on<P: LeadSource<11, 24, 16> + 'static>(
    circuit: Positioner<P>,
    arguments: &Arguments,
    job: &Job,
    options: &Options,
) -> Result<(Played, Files), Failure> {
    let settings: &Settings = &job.settings;
    let ticks = job.ticks_at_least();
    let (mut traces, clock) = Traces::begin(&circuit, arguments, job, options, ticks)?;
    let mut progress = Progress::new(ticks);
    // Two calls, so that a run without waves is compiled without a trace of them.
    let played = match traces.vcd.is_some() || traces.stimulus.is_some() {
        true => {
            let files = (traces.vcd.as_mut(), traces.stimulus.as_mut());
            play(&circuit, settings, (files, &mut progress))
        }
        false => play(&circuit, settings, &mut progress),
    };
    let played = played.map_err(refuse)?;
    drop(progress);
    let first = played.positionings.first();
    let action = first.map_or(0, |positioning| positioning.fired);
    let files = traces.finish(&circuit, clock, job, options, [action, played.ticks])?;
    Ok((played, files))
}
