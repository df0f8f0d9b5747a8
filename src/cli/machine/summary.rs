//! Summary of the run.

use super::Job;
use super::rows::{self, LiftRow, PieceRow};
use super::verdict::{complaints, steppers_cut_off};
use crate::cli::report::Outcome;
use crate::cli::times::rounded;
use motion_rtl::jobs::machine::Settings;
use motion_rtl::jobs::machine::job::Played;
use motion_rtl::jobs::machine::measure::{Ends, Measured};
use serde::Serialize;

/// The summary of a run.
#[derive(Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Summary {
    /// Fields that all summaries share.
    #[serde(flatten)]
    pub outcome: Outcome,
    /// Settings of the run, by the keys of `keys machine --json-schema`.
    #[cfg_attr(
        feature = "schema",
        schemars(with = "crate::cli::schema::Settings<Settings>")
    )]
    pub settings: Settings,
    /// True if both machines came to rest at the job's end, on the nearest step and count.
    pub exact: bool,
    /// Pulses of the steppers, either way.
    pub pulses: [u64; 2],
    /// Unit times whose steps no half-period gives.
    pub unattainable_units: usize,
    /// Duration of the run by machine and activity.
    pub times: TimesRow,
    /// The job's end and the machines' end positions.
    #[serde(flatten)]
    pub ends: Ends,
    /// Every piece of the path.
    pub pieces: Vec<PieceRow>,
    /// Every step of the pen lift.
    pub lifts: Vec<LiftRow>,
}

/// Duration of the run by machine and activity, in seconds.
#[derive(Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct TimesRow {
    /// Time of the steppers, which do not stop between pieces.
    pub steppers_s: f64,
    /// True if a fault of the servos ended the run before the steppers finished.
    pub steppers_cut_off: bool,
    /// True if the servos came to rest at the end of each move and of the job.
    pub servos_settled: bool,
    /// Time of the servos, which stop at the end of each piece.
    pub servos_s: f64,
    /// Part of the servos' time in motion.
    pub moving_s: f64,
    /// Part of the servos' time until they rest in position.
    pub settling_s: f64,
    /// Part of the servos' time waiting for the pen and for records.
    pub waiting_s: f64,
}

impl Summary {
    /// The summary of a job that was played.
    pub fn new(job: &Job, played: &Played, measured: &Measured) -> Self {
        let settings = &job.settings;
        let seconds = |ticks: u64| ticks as f64 / settings.clock_hz as f64;
        let (times, ends) = (&measured.times, &measured.ends);
        let complaints = complaints(job, played, ends);
        Summary {
            exact: complaints.is_empty(),
            outcome: Outcome {
                complaints,
                warnings: warnings(job),
                ..Outcome::new(
                    "machine",
                    &job.drawing.file,
                    settings.clock_hz,
                    played.ticks,
                )
            },
            settings: settings.clone(),
            pulses: played.pulses,
            unattainable_units: job.program.report.unattainable_units,
            times: TimesRow {
                steppers_s: seconds(times.steppers),
                steppers_cut_off: steppers_cut_off(job, played),
                servos_settled: played.settled,
                servos_s: seconds(times.servos),
                moving_s: seconds(times.moving),
                settling_s: seconds(times.settling),
                waiting_s: seconds(times.servos.saturating_sub(times.moving + times.settling)),
            },
            ends: *ends,
            pieces: rows::pieces(job, measured),
            lifts: rows::lifts(job, played),
        }
    }
}

/// Returns the warnings: anything skipped, assumed or rounded.
fn warnings(job: &Job) -> Vec<String> {
    let [lines, arcs] = job.settings.ramps();
    let ramps = [
        rounded(&lines, "scan", " on lines"),
        rounded(&arcs, "pair of Ts", " on arcs"),
    ];
    let own = job.drawing.warnings.iter().map(ToString::to_string);
    own.chain(ramps.into_iter().flatten()).collect()
}
