//! `run` on a position log: where signals would have been given, and how good the predictions were.

mod picture;
mod text;

use super::{Job, focus, series_of};
use crate::cli::Failure;
use crate::cli::progress::{self, Work};
use crate::cli::report::{Outcome, conclude};
use crate::cli::setup::Setup;
use crate::cli::simulate::{Stage, with_waves};
use crate::cli::traces::End;
use crate::cli::waves_of::{Ending, System};
use motion_rtl::circuits::lead_angle::Compensator;
use motion_rtl::hdl::Circuit;
use motion_rtl::input::position_log::{PositionLog, UnitFrom};
use motion_rtl::jobs::lead_angle::job::positioner;
use motion_rtl::jobs::lead_angle::replay::{Predictions, Replayed, Signal, replay, settings_for};
use motion_rtl::jobs::lead_angle::settings::Settings;
use motion_rtl::plant::waves::Body;
use motion_rtl::sim::{Elaborated, Observer, RunError};
use serde::Serialize;
use std::collections::BTreeMap;

/// The summary of a log.
#[derive(Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Summary {
    /// Fields that all summaries share.
    #[serde(flatten)]
    outcome: Outcome,
    /// Column of the log that has the times.
    time_column: String,
    /// Unit of the times.
    time_unit: String,
    /// Origin of the unit.
    time_unit_from: &'static str,
    /// Column of the log that has the counts.
    counts_column: String,
    /// The counts' column was asked for, or is called so.
    #[serde(skip)]
    counts_named: bool,
    /// Samples of the log.
    samples: usize,
    /// CK in ticks.
    ck_ticks: u32,
    /// Errors of the predictions.
    #[serde(flatten)]
    predictions: Predictions,
    /// Every signal.
    signals: Vec<Signal>,
}

/// Ticks that a log takes.
fn ticks(log: &PositionLog, clock_hz: u64) -> u64 {
    ((log.seconds() * clock_hz as f64) as u64).saturating_add(1)
}

/// Replays a log with its waves.
pub fn run(setup: &Setup<'_>, job: &Job, log: &PositionLog) -> Result<(), Failure> {
    let settings = settings_for(log, &job.settings);
    let ticks = ticks(log, settings.clock_hz);
    setup.check_window(ticks)?;
    let circuit = positioner(&settings);
    let stage = Stage {
        circuit: &circuit,
        model: &Elaborated::with_beside(&circuit, &Body).map_err(RunError::from)?,
        subject: &log.file,
        work: Work {
            ticks,
            runs: 1,
            seconds: ticks as f64 * super::TICK_S,
        },
        series: setup.series(|| series_of(&settings)),
    };
    let (replayed, mut files) = with_waves(setup, stage, |observer| {
        let replayed = replay(&circuit, &settings, log, observer)?;
        let end = end(&settings, &replayed);
        Ok((replayed, end))
    })?;
    progress::stage("summary and picture");
    files.write("svg", &picture::draw(job, log, &settings, &replayed))?;
    let summary = summary(log, &settings, &replayed);
    conclude(setup, files, summary)
}

/// The end of a run; its window has the first signal in its middle.
fn end(settings: &Settings, replayed: &Replayed) -> End {
    let first = replayed.signals.first();
    End {
        ticks: replayed.ticks,
        focus: focus(settings, first.map_or(0, |signal| signal.tick)),
    }
}

/// The circuit with the log, as a system.
pub fn system<'a>(job: &'a Job, log: &'a PositionLog) -> System<'a> {
    let settings = settings_for(log, &job.settings);
    let ticks = ticks(log, settings.clock_hz);
    System::new(Compensator::NAME, ticks, move || {
        let circuit = positioner(&settings);
        let model = Elaborated::with_beside(&circuit, &Body).map_err(RunError::from)?;
        let run = move |circuit: &Compensator, observer: &mut dyn Observer<Compensator>| {
            let replayed = replay(circuit, &settings, log, observer)?;
            Ok(Ending {
                end: end(&settings, &replayed),
                position: BTreeMap::new(),
                unit: "counts",
            })
        };
        Ok((circuit, model, run))
    })
}

fn summary(log: &PositionLog, settings: &Settings, replayed: &Replayed) -> Summary {
    let lost = "the encoder was too fast for the detector".to_owned();
    Summary {
        outcome: Outcome {
            complaints: replayed.lost.then_some(lost).into_iter().collect(),
            ..Outcome::new("lead_angle", &log.file, settings.clock_hz, replayed.ticks)
        },
        time_column: log.time.name.clone(),
        time_unit: log.unit.to_string(),
        time_unit_from: match log.unit.from {
            UnitFrom::Given => "log_time_unit_ms",
            UnitFrom::Header => "header",
            UnitFrom::Step => "median step",
        },
        counts_column: log.counts.name.clone(),
        counts_named: log.counts.named,
        samples: log.samples.len(),
        ck_ticks: settings.ck_ticks,
        predictions: replayed.predictions,
        signals: replayed.signals.clone(),
    }
}
