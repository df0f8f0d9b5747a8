//! Control computer of the machine: one job for all parts at once, tick by tick.
//!
//! The steppers play their table from power-on. The servos execute the job move by move: when both
//! motors are in position the next line is pushed, or the next arc started, and with it the length
//! over time. Between a rapid move and one with the pen down the lift makes its step first.
//! Records are passed to arc generator and trajectory controller as space allows.

use super::program::{Program, Way};
use super::seen::motors;
use super::settings::{Correction, Settings};
use crate::circuits::arc_generator::generator::Segments;
use crate::circuits::machine::circuit::In;
use crate::circuits::machine::{Machine, enables, ports};
use crate::circuits::trajectory_controller::Widths;
use crate::circuits::trajectory_controller::model_state::ModelGains;
use crate::hdl::{At, Value, zero};
use crate::jobs::lead_angle::settings::{self as lead_angle, SPEED_UNIT_COUNTS_PER_S};
use crate::jobs::pulse_interpolator::ControlComputer;
use crate::jobs::record_writer::RecordWriter;
use crate::jobs::trajectory_controller::path_writer::PathWriter;
use crate::jobs::trajectory_controller::servo_gains::ServoGains;
use crate::sim::{Sample, State, Watcher};

/// Number of ticks from the beginning of a move in which no part reports busy yet.
const DEAF: u32 = 8;
/// Number of records that wait before a move begins, if the move has that many.
const HEAD_START: usize = 4;
/// Number of consecutive sampling times for which the motors must be in position.
const CALM: u32 = 4;

/// Stage of the servos and the lift.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Stage {
    /// Writing the path and the lift's steps.
    Write,
    /// Waiting for the next move's records and the pen.
    Ready,
    /// Waiting for the lift's step; true once it has begun.
    Lift(bool),
    /// Executing a move, for this number of ticks.
    Move(u32),
    /// Waiting for the motors to settle on constant commands.
    Settle,
    /// Executing the last count to the job's end, left by rounding.
    Close(u32),
    /// Job done.
    Done,
}

/// Number of guard bits per count.
const GUARD: usize = Widths::FULL.guard();

/// Gives a target for a line, or none.
fn give_line(i: &mut ports::Lines<Value>, push: bool, target: [i64; 2], speed: u64, ramp: u64) {
    (i.push, [i.target_x, i.target_y]) = (push, target);
    i.settings.speed.fill(speed);
    i.settings.acceleration_time.fill(ramp);
    i.settings.deceleration_time.fill(ramp);
}

/// Observed signals.
#[derive(Debug)]
struct See {
    pending: At<bool>,
    /// Commands of the arc generator.
    arcs: [At<i64>; 2],
    arcs_ready: At<bool>,
    profile_ready: At<bool>,
    /// Busy bits of lines, arcs, profile.
    busy: [At<bool>; 3],
    lift_busy: At<bool>,
    sample: At<bool>,
    counts: [At<i64>; 2],
    /// Corrected commands in guard units.
    corrected: [At<i64>; 2],
    position: [At<i64>; 2],
}

impl See {
    fn of(watch: &Watcher<'_, Machine>) -> Self {
        let (p, w) = (&watch.p, &watch.w);
        let arcs = &p.arc_generator.p;
        See {
            pending: watch.at(p.pulse_interpolator.p.port.q.pending),
            arcs: [0, 1].map(|axis: usize| watch.at(arcs.commands[axis].q.command)),
            arcs_ready: watch.at(w.arcs_ready),
            profile_ready: watch.at(w.profile_ready),
            busy: [w.lines_busy, w.arcs_busy, w.profile_busy].map(|busy| watch.at(busy)),
            lift_busy: watch.at(w.lift_busy),
            sample: watch.at(p.enables.w.sample),
            counts: [w.counts_x, w.counts_y].map(|counts| watch.at(counts)),
            corrected: [0, 1]
                .map(|axis: usize| p.trajectory_controller.p.axes[axis].p.corrector.q.corrected),
            position: motors(watch),
        }
    }
}

/// Control computer.
#[derive(Debug)]
pub(super) struct Host<'a> {
    see: See,
    program: &'a Program,
    settings: &'a Settings,
    pulses: ControlComputer<'a>,
    no_pulse: ports::Pulse<Value>,
    path: PathWriter<'a>,
    arcs: RecordWriter<'a>,
    profile: RecordWriter<'a>,
    /// True for each record memory whose record ends in this tick.
    pushed: [bool; 2],
    /// True if the inputs did not change in this tick.
    quiet: bool,
    lift_steps: Vec<lead_angle::Step>,
    /// Number of lift steps written.
    lift_words: usize,
    pub(super) stage: Stage,
    /// Index of the next or current move.
    pub(super) index: usize,
    /// Number of records up to the end of the next or current move.
    arcs_due: usize,
    profile_due: usize,
    pen_down: bool,
    calm: u32,
}

impl<'a> Host<'a> {
    pub(super) fn new(
        circuit: &Machine,
        program: &'a Program,
        settings: &'a Settings,
        watch: &Watcher<'_, Machine>,
    ) -> Self {
        Host {
            see: See::of(watch),
            program,
            settings,
            pulses: ControlComputer::new(&circuit.pulse_interpolator, &program.table),
            no_pulse: zero(circuit).pulse,
            path: PathWriter::new(&program.path, Correction::None),
            arcs: RecordWriter::new(&program.arcs),
            profile: RecordWriter::new(&program.profile),
            pushed: [false; 2],
            quiet: false,
            lift_steps: settings.lift().steps,
            lift_words: 0,
            stage: Stage::Write,
            index: 0,
            arcs_due: 0,
            profile_due: 0,
            pen_down: false,
            calm: 0,
        }
    }

    /// Returns the inputs that are constant, with all others low.
    pub(super) fn standing(&self, circuit: &Machine) -> In<Value> {
        let (settings, program) = (self.settings, &self.program.path);
        let low = zero(circuit);
        let gain = |of: fn(&ServoGains) -> u64| program.servo.iter().take(2).map(of).collect();
        let lift = settings.lift();
        let cks = |ms: f64| u64::from(lift.cks(ms));
        In {
            rates: enables::In {
                unit_period: settings.unit_ticks.into(),
                scan_period: settings.scan_ticks.into(),
                ck_period: settings.ck_ticks.into(),
                sample_period: settings.sample_ticks.into(),
            },
            trajectory: ports::Trajectory {
                last: program.path.stretches.len().saturating_sub(1) as u64,
                path_end: program.path.length as i64,
                model_gains: ModelGains {
                    gain_1: program.tangential.k1,
                    gain_2: program.tangential.k2,
                },
                position_gain: gain(|servo| servo.position),
                speed_gain: gain(|servo| servo.speed),
                integral_gain: gain(|servo| servo.integral),
                inertia: gain(|servo| servo.inertia),
                limit: gain(|servo| servo.limit),
                ..low.trajectory
            },
            lift: ports::Lift {
                learn: true,
                last_step: lift.steps.len().saturating_sub(1) as u64,
                standstill: cks(lift.standstill_ms),
                time_out: cks(lift.time_out_ms),
                rest: cks(lift.rest_ms),
                seed: lift.code(lift.seed_ms).unwrap_or(0),
                ..low.lift
            },
            ..low
        }
    }

    /// True if the next tick's inputs and stage will be the same, provided that the observed
    /// signals do not change.
    pub(super) fn stands(&self) -> bool {
        let waits = match self.stage {
            Stage::Move(age) | Stage::Close(age) => age >= DEAF,
            Stage::Lift(begun) => begun,
            // Depends on the ends of sampling times.
            Stage::Settle | Stage::Done => true,
            Stage::Write | Stage::Ready => false,
        };
        self.quiet
            && waits
            && self.arcs.stands(self.arcs_due)
            && self.profile.stands(self.profile_due)
    }

    /// Sets the inputs of this tick from the registers, except those of the encoders.
    pub(super) fn drive(&mut self, i: &mut In<Value>, now: &State<'_, Machine>) {
        i.pulse = self.pulse(now.get(self.see.pending));
        give_line(&mut i.lines, false, [0; 2], 0, 0);
        self.arc_words(&mut i.arcs);
        self.trajectory(&mut i.trajectory);
        self.lift(&mut i.lift);
        self.pushed = [i.arcs.record.push, i.trajectory.record.push];
        match self.stage {
            Stage::Write if self.path.is_done() && self.lift_words > 2 => {
                self.stage = self.turn_to(0);
            }
            Stage::Ready => self.begin(now, i),
            Stage::Lift(begun) => i.lift.run = !begun,
            Stage::Close(0) => {
                let to = self.program.moves.last().map_or([0; 2], |step| step.to);
                self.push_line(now, to, 1, i);
            }
            _ => {}
        }
        let strobes = [
            i.pulse.command,
            i.pulse.port.write,
            i.lines.push,
            i.arcs.record.write,
            i.arcs.start,
            i.trajectory.record.write,
            i.trajectory.start,
            i.trajectory.path.write_path,
            i.lift.write_target,
            i.lift.run,
        ];
        let written = self.lift_words > self.lift_steps.len();
        self.quiet = written && strobes == [false; 10];
    }

    /// Begins the next move, or the pen step that must precede it.
    fn begin(&mut self, now: &State<'_, Machine>, i: &mut In<Value>) {
        let Some(step) = self.program.moves.get(self.index) else {
            return;
        };
        if step.rapid == self.pen_down {
            self.stage = Stage::Lift(false);
            i.lift.run = true;
            return;
        }
        let written = [
            (&self.arcs, self.arcs_due, step.arcs()),
            (&self.profile, self.profile_due, step.records),
        ]
        .iter()
        .all(|(writer, due, records)| {
            writer.written() >= due - records + (*records).min(HEAD_START)
        });
        if !written {
            return;
        }
        match step.way {
            Way::Line { speed } => self.push_line(now, step.to, speed, i),
            Way::Arc { .. } => i.arcs.start = true,
        }
        i.trajectory.start = true;
        self.stage = Stage::Move(0);
    }

    /// Gives a target: the part of the way that lines must add to the arcs.
    fn push_line(&self, now: &State<'_, Machine>, to: [i64; 2], speed: u64, i: &mut In<Value>) {
        let arcs = self.see.arcs.map(|axis| now.get(axis));
        let target = [to[0] - arcs[0], to[1] - arcs[1]];
        give_line(&mut i.lines, true, target, speed, self.program.ramp_scans);
    }

    fn pulse(&mut self, pending: bool) -> ports::Pulse<Value> {
        match self.pulses.drive(pending) {
            None => self.no_pulse.clone(),
            Some(given) => ports::Pulse {
                command: given.command,
                base: given.base,
                last: given.last,
                run: given.run,
                now: given.now,
                port: given.port,
            },
        }
    }

    fn arc_words(&mut self, i: &mut Segments<Value>) {
        let record = self.arcs.write_up_to(self.arcs_due);
        let start = false;
        *i = Segments { record, start };
    }

    fn trajectory(&mut self, i: &mut ports::Trajectory<Value>) {
        i.record = self.profile.write_up_to(self.profile_due);
        i.start = false;
        i.path = self.path.write();
    }

    fn lift(&mut self, i: &mut ports::Lift<Value>) {
        let steps = &self.lift_steps;
        let (place, step) = (self.lift_words, steps.get(self.lift_words));
        self.lift_words = (place + 1).min(steps.len() + 1);
        let speed = step.map_or(0, |step| step.speed_counts_per_s / SPEED_UNIT_COUNTS_PER_S);
        i.write_target = step.is_some();
        i.write_step = place as u64;
        i.step_target = step.map_or(0, |step| step.target);
        i.step_speed = speed.into();
        i.run = false;
    }

    /// True if the steppers' table has been given completely.
    pub(super) fn pulses_given(&self) -> bool {
        self.pulses.has_given_all()
    }

    /// Returns the position of the lift with the pen down.
    pub(super) fn pen_down_counts(&self) -> i64 {
        self.settings.pen_down_counts
    }

    /// True if the lift's current step lowers the pen.
    pub(super) fn lowers(&self) -> bool {
        !self.pen_down
    }

    /// Records the signals of the tick.
    pub(super) fn take(&mut self, now: &Sample<'_, Machine>) {
        let see = &self.see;
        self.arcs.free = now.get(see.arcs_ready) && !self.pushed[0];
        self.profile.free = now.get(see.profile_ready) && !self.pushed[1];
        let busy = || see.busy.iter().any(|busy| now.get(*busy));
        self.stage = match self.stage {
            Stage::Lift(false) => Stage::Lift(now.get(see.lift_busy)),
            Stage::Lift(true) if !now.get(see.lift_busy) => {
                self.pen_down = !self.pen_down;
                Stage::Ready
            }
            Stage::Move(age) if age < DEAF => Stage::Move(age + 1),
            Stage::Move(_) if !busy() => Stage::Settle,
            Stage::Close(age) if age < DEAF => Stage::Close(age + 1),
            Stage::Close(_) if !busy() => Stage::Settle,
            Stage::Settle => self.settle(now),
            stage => stage,
        };
    }

    /// Ends the move when both motors have been within the window around the end of their
    /// corrected commands for some sampling times.
    fn settle(&mut self, now: &Sample<'_, Machine>) -> Stage {
        if !now.get(self.see.sample) {
            return Stage::Settle;
        }
        let last = self.index + 1 >= self.program.moves.len();
        // The end is exact to the count.
        let window = if last {
            0
        } else {
            u64::from(self.settings.in_position_counts)
        };
        let counts = self.see.counts.map(|axis| now.get(axis));
        let position = self.see.position.map(|axis| now.get(axis));
        let near = match self.settings.correction {
            // The motor settles beside the command, between counts.
            Correction::Steady => {
                let corrected = self.see.corrected.map(|axis| now.get(axis));
                let window = window.max(1) << GUARD;
                (0..2).all(|axis| (position[axis] << GUARD).abs_diff(corrected[axis]) <= window)
            }
            _ => (0..2).all(|axis| counts[axis].abs_diff(position[axis]) <= window),
        };
        self.calm = if near { self.calm + 1 } else { 0 };
        if self.calm < CALM {
            return Stage::Settle;
        }
        self.calm = 0;
        let to = self.program.moves.last().map_or([0; 2], |step| step.to);
        if last && counts != to {
            return Stage::Close(0);
        }
        self.turn_to(self.index + 1)
    }

    /// Allows the records of a move to be written: the one before is over.
    fn turn_to(&mut self, index: usize) -> Stage {
        self.index = index;
        match self.program.moves.get(index) {
            None => Stage::Done,
            Some(step) => {
                self.arcs_due += step.arcs();
                self.profile_due += step.records;
                Stage::Ready
            }
        }
    }
}
