//! The figures of a run: of each piece of the path, of each machine's end, of the pen lift.

use super::Job;
use motion_rtl::jobs::machine::job::Played;
use motion_rtl::jobs::machine::measure::{Ends, Farthest, Measured, PieceMeasured};
use motion_rtl::path::pieces::Course;
use serde::Serialize;
use std::ops::RangeInclusive;

/// Name of the servo motors in the table of ends.
pub const ENCODERS: &str = "encoders";
/// Name of the step motors in the table of ends.
pub const STEPPERS: &str = "steppers";

/// A point as near is on the path: floating point puts it there.
const ON_PATH_MM: f64 = 1e-9;

/// A piece of the path by both machines.
#[derive(Debug, Serialize)]
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
    pub steppers: Option<FarthestRow>,
    /// Time that the steppers took.
    pub steppers_s: f64,
    /// Largest distance of the servos' commands; `None` if the servos did not reach the piece.
    pub command_um: Option<f64>,
    /// Largest distance of the servos' models.
    pub model_um: Option<f64>,
    /// Largest distance of the motors.
    pub motor_um: Option<f64>,
    /// Farthest point of the loads.
    pub load: Option<FarthestRow>,
    /// Counts that the correction left the motors beside the piece's end.
    pub left_by_correction: Option<[i64; 2]>,
    /// Time that the servos took, until their motors were in position.
    pub servos_s: Option<f64>,
}

/// Point at which a machine is farthest from a piece.
#[derive(Debug, Serialize)]
pub struct FarthestRow {
    pub um: f64,
    pub tick: u64,
    /// Main cause of the distance; `None` if the machine is on the path.
    pub reason: Option<&'static str>,
    /// Share of the main cause.
    pub share_um: f64,
}

impl From<Farthest> for FarthestRow {
    fn from(farthest: Farthest) -> Self {
        let off = farthest.mm > ON_PATH_MM;
        FarthestRow {
            um: farthest.mm * 1e3,
            tick: farthest.tick,
            reason: off.then(|| farthest.reason.name()),
            share_um: if off { farthest.share_mm * 1e3 } else { 0.0 },
        }
    }
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
        steppers: one.steppers.farthest.map(FarthestRow::from),
        steppers_s: seconds(&one.steppers.ticks),
        command_um: servos.map(|servos| servos.command_mm * 1e3),
        model_um: servos.map(|servos| servos.model_mm * 1e3),
        motor_um: servos.map(|servos| servos.motor_mm * 1e3),
        load: servos.map(|servos| servos.load.into()),
        left_by_correction: servos.map(|servos| servos.left_counts),
        servos_s: servos.map(|servos| seconds(&servos.ticks)),
    })
}

/// End position of a machine.
#[derive(Debug, Serialize)]
pub struct EndRow {
    /// Name of the machine's drive.
    pub what: &'static str,
    /// Position in millimetres.
    pub mm: [f64; 2],
    /// Position in steps or counts from the machine's zero.
    pub position: [i64; 2],
    /// The position nearest to the job's end.
    pub wanted: [i64; 2],
    /// "steps" or "counts".
    pub unit: &'static str,
}

/// Returns the end positions.
pub fn ends(ends: &Ends) -> [EndRow; 3] {
    let [stepper, wanted_steps] = ends.stepper_steps;
    let [command, wanted_counts] = ends.command_counts;
    let row = |what, mm, position, wanted, unit| EndRow {
        what,
        mm,
        position,
        wanted,
        unit,
    };
    [
        row(STEPPERS, ends.stepper_mm, stepper, wanted_steps, "steps"),
        row(
            "commands",
            ends.command_mm,
            command,
            wanted_counts,
            "counts",
        ),
        row(
            ENCODERS,
            ends.motor_mm,
            ends.motor_counts,
            wanted_counts,
            "counts",
        ),
    ]
}

/// A step of the pen lift.
#[derive(Debug, Serialize)]
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
