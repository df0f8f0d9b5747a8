//! Where both machines ended.

use crate::input::Drawing;
use crate::jobs::machine::job::Played;
use crate::jobs::machine::program::Program;
use crate::jobs::machine::settings::Settings;

/// Where both machines ended.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ends {
    /// The job's end in mm.
    pub wanted_mm: [f64; 2],
    /// The steppers, in mm.
    pub stepper_mm: [f64; 2],
    /// The position commands of the servos, in mm.
    pub command_mm: [f64; 2],
    /// Their motors, in mm.
    pub motor_mm: [f64; 2],
    /// The steppers in steps, from where the machine's zero is; and the step nearest to the end.
    pub stepper_steps: [[i64; 2]; 2],
    /// The commands in counts; and the count nearest to the end.
    pub command_counts: [[i64; 2]; 2],
    /// The motors in counts.
    pub motor_counts: [i64; 2],
    /// Everything is on the step or count that is nearest to the job's end.
    pub exact: bool,
}

impl Ends {
    pub(super) fn of(
        drawing: &Drawing,
        program: &Program,
        settings: &Settings,
        played: &Played,
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
        Ends {
            wanted_mm: [end[0], end[1]],
            stepper_mm: axes.map(|axis| stepper[axis] as f64 / settings.steps_per_mm[axis]),
            command_mm: mm(command),
            motor_mm: mm(motor),
            stepper_steps: [stepper, wanted_steps],
            command_counts: [command, wanted_counts],
            motor_counts: motor,
            exact: stepper == wanted_steps && command == wanted_counts && motor == wanted_counts,
        }
    }
}
