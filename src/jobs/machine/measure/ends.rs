//! End positions of both machines.

use crate::circuits::trajectory_controller::Widths;
use crate::input::Drawing;
use crate::jobs::machine::job::{Frame, Played};
use crate::jobs::machine::program::Program;
use crate::jobs::machine::settings::{Correction, Settings};
use serde::Serialize;

/// End position of a machine.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct End {
    /// Name of the machine's drive: steppers, commands or encoders.
    pub what: &'static str,
    /// Position in millimetres.
    pub mm: [f64; 2],
    /// Position in steps or counts, from the machine's zero.
    pub position: [i64; 2],
    /// Position nearest to the job's end.
    pub wanted: [i64; 2],
    /// "steps" or "counts".
    pub unit: &'static str,
}

/// End positions of both machines.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Ends {
    /// End of the job.
    pub end_mm: [f64; 2],
    /// Ends of steppers, of the servos' position commands, and of their motors by the encoders.
    pub ends: [End; 3],
    /// Distance of the corrected command's end from the job's end, in counts.
    pub left_by_correction: [i64; 2],
    /// Distance of steppers and commands.
    pub apart_um: f64,
    /// True if the motors are at the end of the corrected command.
    #[serde(skip)]
    pub motor_at_rest: bool,
    /// True if everything is on the step or count nearest to the job's end, apart from the
    /// deviation of the motors that the correction leaves.
    #[serde(skip)]
    pub exact: bool,
}

impl Ends {
    pub(super) fn of(
        drawing: &Drawing,
        program: &Program,
        settings: &Settings,
        played: &Played,
        last: Option<&Frame>,
    ) -> Self {
        let end = program
            .pieces
            .last()
            .map_or(drawing.start, |piece| piece.to);
        let axes = [0, 1];
        let steps = |mm: f64, axis: usize| (mm * settings.steps_per_mm[axis]).round() as i64;
        let counts = |mm: f64| (mm * settings.counts_per_mm).round() as i64;
        let stepper = axes
            .map(|axis| i64::from(program.report.axes[axis].start_position) + played.stepper[axis]);
        let [command, motor] = [played.command, played.motor]
            .map(|moved| axes.map(|axis| counts(drawing.start[axis]) + moved[axis]));
        let wanted_steps = axes.map(|axis| steps(end[axis], axis));
        let wanted_counts = axes.map(|axis| counts(end[axis]));
        let mm = |at: [i64; 2]| at.map(|counts| counts as f64 / settings.counts_per_mm);
        let left_by_correction = match (last, program.moves.last()) {
            (Some(frame), Some(step)) => left_counts(settings, frame, step.to),
            _ => [0; 2],
        };
        let motor_at_rest = at_rest(settings, wanted_counts, left_by_correction, motor);
        let stepper_mm = axes.map(|axis| stepper[axis] as f64 / settings.steps_per_mm[axis]);
        let servo = |what, position| End {
            what,
            mm: mm(position),
            position,
            wanted: wanted_counts,
            unit: "counts",
        };
        let steppers = End {
            what: "steppers",
            mm: stepper_mm,
            position: stepper,
            wanted: wanted_steps,
            unit: "steps",
        };
        let [x, y] = axes.map(|axis| stepper_mm[axis] - mm(command)[axis]);
        Ends {
            end_mm: [end[0], end[1]],
            ends: [
                steppers,
                servo("commands", command),
                servo("encoders", motor),
            ],
            left_by_correction,
            apart_um: x.hypot(y) * 1e3,
            motor_at_rest,
            exact: stepper == wanted_steps && command == wanted_counts && motor_at_rest,
        }
    }
}

/// Returns the distance of the corrected command from a position, in counts. Only the steady
/// correction ends beside the command.
pub(super) fn left_counts(settings: &Settings, frame: &Frame, place: [i64; 2]) -> [i64; 2] {
    let count = (1u64 << Widths::FULL.guard()) as f64;
    match settings.correction {
        Correction::Steady => [0, 1]
            .map(|axis: usize| (frame.corrected[axis] as f64 / count).round() as i64 - place[axis]),
        _ => [0; 2],
    }
}

/// True if the motors are at the end of the corrected command, which is between counts for the
/// steady correction.
fn at_rest(settings: &Settings, wanted: [i64; 2], left: [i64; 2], motor: [i64; 2]) -> bool {
    let most = u64::from(settings.correction == Correction::Steady);
    (0..2).all(|axis| motor[axis].abs_diff(wanted[axis] + left[axis]) <= most)
}
