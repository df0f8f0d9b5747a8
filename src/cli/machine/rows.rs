//! The figures of a run: of each piece of the path and of the pen lift.

use super::Job;
use motion_rtl::jobs::machine::job::Played;
use motion_rtl::jobs::machine::measure::{Farthest, Measured, PieceMeasured};
use motion_rtl::path::pieces::Course;
use serde::Serialize;
use std::ops::RangeInclusive;

/// A piece of the path by both machines.
#[derive(Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct PieceRow {
    /// Index of the piece.
    pub piece: usize,
    /// Line of the input it stands in.
    pub line: usize,
    /// Rapid move, line or arc.
    pub kind: &'static str,
    /// Length.
    pub length_mm: f64,
    /// Farthest point of the steppers; `None` if no unit time ended on the piece.
    pub steppers: Option<Farthest>,
    /// Time that the steppers took.
    pub steppers_s: f64,
    /// Largest distance of the servos' commands; `None` if the servos did not reach the piece.
    pub command_um: Option<f64>,
    /// Largest distance of the servos' models.
    pub model_um: Option<f64>,
    /// Largest distance of the motors.
    pub motor_um: Option<f64>,
    /// Farthest point of the loads.
    pub load: Option<Farthest>,
    /// Counts that the correction left the motors beside the piece's end.
    pub left_by_correction: Option<[i64; 2]>,
    /// Time that the servos took, until their motors were in position.
    pub servos_s: Option<f64>,
}

pub fn pieces(job: &Job, measured: &Measured) -> Vec<PieceRow> {
    let rows = measured.pieces.iter().filter_map(|one| row(job, one));
    rows.collect()
}

fn row(job: &Job, one: &PieceMeasured) -> Option<PieceRow> {
    let step = job.drawing.moves.get(one.piece)?;
    let piece = &job.program.pieces[one.piece];
    let from = match one.piece {
        0 => job.drawing.start,
        _ => job.program.pieces[one.piece - 1].to,
    };
    let seconds = |ticks: &RangeInclusive<u64>| {
        (ticks.end() - ticks.start()) as f64 / job.settings.clock_hz as f64
    };
    let servos = one.servos.as_ref();
    Some(PieceRow {
        piece: one.piece,
        line: step.line,
        kind: match (step.rapid, &piece.course) {
            (true, _) => "rapid",
            (false, Course::Line) => "line",
            (false, Course::Arc(_)) => "arc",
            (false, Course::Helix(_)) => "helix",
            (false, Course::Spline(_)) => "spline",
        },
        length_mm: piece.course.length(from, piece.to),
        steppers: one.steppers.farthest,
        steppers_s: seconds(&one.steppers.ticks),
        command_um: servos.map(|servos| servos.command_um),
        model_um: servos.map(|servos| servos.model_um),
        motor_um: servos.map(|servos| servos.motor_um),
        load: servos.map(|servos| servos.load),
        left_by_correction: servos.map(|servos| servos.left_by_correction),
        servos_s: servos.map(|servos| seconds(&servos.ticks)),
    })
}

/// A step of the pen lift.
#[derive(Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct LiftRow {
    /// The piece that it was for.
    pub piece: usize,
    /// Line of the input it stands in.
    pub line: usize,
    /// Down or up.
    pub pen: &'static str,
    /// Tick of the control signal.
    pub fired_tick: u64,
    /// Tick in which it stood.
    pub completed_tick: u64,
    /// Lead time that was applied.
    pub lead_ms: f64,
    /// Way past the target.
    pub error_counts: i64,
    /// Lead time that was learned from it.
    pub learned_ms: Option<f64>,
}

/// Every step of the pen lift.
pub fn lifts(job: &Job, played: &Played) -> Vec<LiftRow> {
    let ck_ms = 1e3 * f64::from(job.settings.ck_ticks) / job.settings.clock_hz as f64;
    let rows = played.liftings.iter().filter_map(|lifting| {
        let step = job.program.moves.get(lifting.index)?;
        Some(LiftRow {
            piece: step.piece,
            line: step.line,
            pen: if lifting.down { "down" } else { "up" },
            fired_tick: lifting.fired,
            completed_tick: lifting.completed,
            lead_ms: lifting.lead as f64 * ck_ms,
            error_counts: lifting.error,
            learned_ms: lifting.learned.map(|learned| learned as f64 * ck_ms),
        })
    });
    rows.collect()
}
