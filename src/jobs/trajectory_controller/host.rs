//! Control computer of a job: its inputs to the trajectory controller, tick by tick.

use super::path_writer::PathWriter;
use super::program::Program;
use super::servo_gains::ServoGains;
use crate::circuits::trajectory_controller::TrajectoryController;
use crate::circuits::trajectory_controller::controller::In;
use crate::circuits::trajectory_controller::error_feedback::FeedbackGains;
use crate::circuits::trajectory_controller::model_state::ModelGains;
use crate::circuits::trajectory_controller::path_point::AXES;
use crate::circuits::trajectory_controller::vector_correction::Correction;
use crate::hdl::{Value, zero};
use crate::jobs::record_writer::RecordWriter;

/// Number of profile records that wait before the path begins, if the profile has that many.
const HEAD_START: usize = 16;

/// Control computer: writes the path, then starts, and writes records as space allows.
pub(super) struct Host<'a> {
    program: &'a Program,
    path: PathWriter<'a>,
    pub(super) records: RecordWriter<'a>,
    started: bool,
    /// True if the inputs did not change in this tick.
    quiet: bool,
}

impl<'a> Host<'a> {
    /// Creates a computer for a program that is to be written from its first word on.
    pub(super) fn new(program: &'a Program, correction: Correction) -> Self {
        Host {
            program,
            path: PathWriter::new(program, correction),
            records: RecordWriter::new(&program.records),
            started: false,
            quiet: false,
        }
    }

    /// Returns the inputs of a circuit that are constant, with all others low.
    pub(super) fn standing(&self, circuit: &TrajectoryController) -> In<Value> {
        let program = self.program;
        let servo = |word: fn(&ServoGains) -> u64| -> Vec<u64> {
            program.servo[..circuit.axes].iter().map(word).collect()
        };
        In {
            last: program.path.stretches.len().saturating_sub(1) as u64,
            path_end: program.path.length as i64,
            period: u64::from(program.period_ticks),
            model_gains: ModelGains {
                gain_1: program.tangential.k1,
                gain_2: program.tangential.k2,
            },
            feedback_gains: FeedbackGains {
                tangential_gain: program.feedback.tangential,
                normal_gain: program.feedback.normal,
            },
            axis_gain_1: program.gains.iter().map(|gains| gains.k1).collect(),
            axis_gain_2: program.gains.iter().map(|gains| gains.k2).collect(),
            position_gain: servo(|gains| gains.position),
            speed_gain: servo(|gains| gains.speed),
            integral_gain: servo(|gains| gains.integral),
            inertia: servo(|gains| gains.inertia),
            limit: servo(|gains| gains.limit),
            ..zero(circuit)
        }
    }

    /// True if the next tick's inputs will be the same, except for the encoders' channels,
    /// provided that the observed signals do not change.
    pub(super) fn stands(&self) -> bool {
        self.quiet && self.records.stands(self.program.records.len())
    }

    /// Sets the inputs of this tick, including the encoders' channels.
    pub(super) fn drive(&mut self, i: &mut In<Value>, channels: [(bool, bool); AXES]) {
        let waiting = self.program.records.len().min(HEAD_START);
        let start = !self.started && self.path.is_done() && self.records.written() == waiting;
        self.started |= start;
        i.start = start;
        i.record = self.records.write();
        i.path = self.path.write();
        let writes = i.record.write || i.path.write_path;
        self.quiet = self.started && !start && !writes && self.path.is_done();
        for ((a, b), given) in i.a.iter_mut().zip(&mut i.b).zip(channels) {
            (*a, *b) = given;
        }
    }
}
