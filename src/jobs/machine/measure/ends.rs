//! End positions of both machines.

use crate::circuits::trajectory_controller::Widths;
use crate::input::Drawing;
use crate::jobs::machine::job::{Frame, Played};
use crate::jobs::machine::program::Program;
use crate::jobs::machine::settings::{Correction, Settings};

/// End positions of both machines.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ends {
    /// End of the job in mm.
    pub wanted_mm: [f64; 2],
    /// Position of the steppers in mm.
    pub stepper_mm: [f64; 2],
    /// Position commands of the servos in mm.
    pub command_mm: [f64; 2],
    /// Position of their motors in mm.
    pub motor_mm: [f64; 2],
    /// Position of the steppers in steps, from the machine's zero; and the step nearest to the
    /// end.
    pub stepper_steps: [[i64; 2]; 2],
    /// Commands in counts; and the count nearest to the end.
    pub command_counts: [[i64; 2]; 2],
    /// Position of the motors in counts.
    pub motor_counts: [i64; 2],
    /// Distance of the corrected command's end from the job's end, in counts.
    pub left_counts: [i64; 2],
    /// True if the motors are at the end of the corrected command.
    pub motor_at_rest: bool,
    /// True if everything is on the step or count nearest to the job's end, apart from the
    /// deviation of the motors that the correction leaves.
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
        let left_counts = match (last, program.moves.last()) {
            (Some(frame), Some(step)) => left_counts(settings, frame, step.to),
            _ => [0; 2],
        };
        let motor_at_rest = at_rest(settings, wanted_counts, left_counts, motor);
        Ends {
            wanted_mm: [end[0], end[1]],
            stepper_mm: axes.map(|axis| stepper[axis] as f64 / settings.steps_per_mm[axis]),
            command_mm: mm(command),
            motor_mm: mm(motor),
            stepper_steps: [stepper, wanted_steps],
            command_counts: [command, wanted_counts],
            motor_counts: motor,
            left_counts,
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
