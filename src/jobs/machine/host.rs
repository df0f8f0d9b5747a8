//! The control computer of the machine: one job for everything at once, tick by tick.
//!
//! The steppers play their table from power-on. The servos take the job move by move: when both
//! motors are in position the next line is pushed, or the next arc started, and with it the length
//! in time. Between a rapid move and one with the pen down the lift has its step first. Records go
//! to arc generator and trajectory controller as they find room.

use super::job::Plant;
use super::program::{Program, Way};
use super::settings::Settings;
use crate::jobs::lead_angle::settings::{self as lead_angle, SPEED_UNIT_COUNTS_PER_S};
use crate::jobs::pulse_interpolator::ControlComputer;
use crate::jobs::trajectory_controller::path_writer::PathWriter;
use crate::kernel::{At, Sample, Simulator, Watcher, zero};
use crate::logic::Sim;
use crate::machine::circuit::In;
use crate::machine::{enables, ports};
use crate::path::record_writer::RecordWriter;
use std::array::from_fn;

/// Address width of the pattern memory.
const A: usize = 12;
/// Ticks from the beginning of a move in which nobody says yet that it is busy.
const DEAF: u32 = 8;
/// Records of a move that wait before it begins, where there are so many.
const HEAD_START: usize = 4;
/// Sampling times in a row for which the motors must be in position.
const CALM: u32 = 4;

/// What the servos and the lift are at.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Stage {
    /// The path is written, and the lift's steps.
    Write,
    /// The next move is awaited: records, pen.
    Ready,
    /// The lift is to begin its step; it has begun.
    Lift(bool),
    /// A move is under way, begun so many ticks ago.
    Move(u32),
    /// The commands stand; the motors come.
    Settle,
    /// The last count to the job's end, where rounding left one.
    Close(u32),
    /// The job is done.
    Done,
}

/// What is looked at.
#[derive(Debug)]
struct See {
    pending: At<bool>,
    /// Commands of the arc generator.
    arcs: [At<i64>; 2],
    arcs_ready: At<bool>,
    profile_ready: At<bool>,
    /// Lines, arcs, profile.
    busy: [At<bool>; 3],
    lift_busy: At<bool>,
    sample: At<bool>,
    counts: [At<i64>; 2],
    position: [At<i64>; 2],
}

impl See {
    fn of(watch: &Watcher<Plant>) -> Self {
        let (q, w) = (&watch.q, &watch.w);
        let arcs = [&q.arc_generator.command_x, &q.arc_generator.command_y];
        See {
            pending: watch.at(q.pulse_interpolator.port.pending),
            arcs: arcs.map(|axis| watch.at(axis.command)),
            arcs_ready: watch.at(w.arcs_ready),
            profile_ready: watch.at(w.profile_ready),
            busy: [w.lines_busy, w.arcs_busy, w.profile_busy].map(|busy| watch.at(busy)),
            lift_busy: watch.at(w.lift_busy),
            sample: watch.at(w.enables.w.sample),
            counts: [w.counts_x, w.counts_y].map(|counts| watch.at(counts)),
            position: [w.position_x, w.position_y].map(|position| watch.at(position)),
        }
    }
}

/// The control computer.
#[derive(Debug)]
pub(super) struct Host<'a> {
    see: See,
    program: &'a Program,
    settings: &'a Settings,
    pulses: ControlComputer<'a, A>,
    path: PathWriter<'a>,
    arcs: RecordWriter<'a>,
    profile: RecordWriter<'a>,
    /// Records of these that are ended in this tick.
    pushed: [bool; 2],
    /// It gave nothing but what stands in this tick.
    quiet: bool,
    lift_steps: Vec<lead_angle::Step>,
    /// Lift steps that are written.
    lift_words: usize,
    pub(super) stage: Stage,
    /// The move that is next, or under way.
    pub(super) index: usize,
    /// Records up to the end of the move that is next, or under way.
    arcs_due: usize,
    profile_due: usize,
    pen_down: bool,
    calm: u32,
}

/// What the lift is given in every tick.
fn standing(lift: &lead_angle::Settings) -> ports::Lift<Sim> {
    let cks = |ms: f64| u64::from(lift.cks(ms)).into();
    ports::Lift {
        learn: true.into(),
        last_step: (lift.steps.len().saturating_sub(1) as u64).into(),
        standstill: cks(lift.standstill_ms),
        time_out: cks(lift.time_out_ms),
        rest: cks(lift.rest_ms),
        seed: lift.code(lift.seed_ms).unwrap_or(0).into(),
        ..zero()
    }
}

impl<'a> Host<'a> {
    pub(super) fn new(
        program: &'a Program,
        settings: &'a Settings,
        watch: &Watcher<Plant>,
    ) -> Self {
        Host {
            see: See::of(watch),
            program,
            settings,
            pulses: ControlComputer::new(&program.table),
            path: PathWriter::new(&program.path),
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

    /// What it gives in every tick, with all else low.
    pub(super) fn standing(&self) -> In<Sim> {
        let settings = self.settings;
        let period = |ticks: u32| u64::from(ticks).into();
        let program = &self.program.path;
        let servo = &program.servo;
        In {
            rates: enables::In {
                unit_period: period(settings.unit_ticks),
                scan_period: period(settings.scan_ticks),
                ck_period: period(settings.ck_ticks),
                sample_period: period(settings.sample_ticks),
            },
            trajectory: ports::Trajectory {
                last: (program.path.stretches.len().saturating_sub(1) as u64).into(),
                path_end: (program.path.length as i64).into(),
                gain_1: program.gains.k1.into(),
                gain_2: program.gains.k2.into(),
                position_gain: from_fn(|axis| servo[axis].position.into()),
                speed_gain: from_fn(|axis| servo[axis].speed.into()),
                integral_gain: from_fn(|axis| servo[axis].integral.into()),
                inertia: from_fn(|axis| servo[axis].inertia.into()),
                limit: from_fn(|axis| servo[axis].limit.into()),
                ..zero()
            },
            lift: standing(&settings.lift()),
            ..zero()
        }
    }

    /// Whether it gives in the tick to come what it gave in this one, and is at what it was, if what
    /// it looks at does not change.
    pub(super) fn stands(&self) -> bool {
        let waits = match self.stage {
            Stage::Move(age) | Stage::Close(age) => age >= DEAF,
            Stage::Lift(begun) => begun,
            // It looks at the ends of sampling times.
            Stage::Settle | Stage::Done => true,
            Stage::Write | Stage::Ready => false,
        };
        self.quiet
            && waits
            && self.arcs.stands(self.arcs_due)
            && self.profile.stands(self.profile_due)
    }

    /// What it gives in this tick, from the registers; the encoders are left as they are.
    pub(super) fn drive(&mut self, i: &mut In<Sim>, now: &Simulator<Plant>) {
        i.pulse = self.pulse(now.get(self.see.pending));
        i.lines = zero();
        i.arcs = self.arc_words();
        self.trajectory(&mut i.trajectory);
        self.lift(&mut i.lift);
        self.pushed = [i.arcs.push.get(), i.trajectory.push.get()];
        match self.stage {
            Stage::Write if self.path.is_done() && self.lift_words > 2 => {
                self.stage = self.turn_to(0);
            }
            Stage::Ready => self.begin(now, i),
            Stage::Lift(begun) => i.lift.run = (!begun).into(),
            Stage::Close(0) => {
                let to = self.program.moves.last().map_or([0; 2], |step| step.to);
                self.push_line(now, to, 1, i);
            }
            _ => {}
        }
        let strobes = [
            i.pulse.command,
            i.pulse.write,
            i.lines.push,
            i.arcs.write,
            i.arcs.start,
            i.trajectory.write,
            i.trajectory.start,
            i.trajectory.write_path,
            i.lift.write_target,
            i.lift.run,
        ];
        let written = self.lift_words > self.lift_steps.len();
        self.quiet = written && strobes.iter().all(|strobe| !strobe.get());
    }

    /// Begins the next move, or what must come before it.
    fn begin(&mut self, now: &Simulator<Plant>, i: &mut In<Sim>) {
        let Some(step) = self.program.moves.get(self.index) else {
            return;
        };
        if step.rapid == self.pen_down {
            self.stage = Stage::Lift(false);
            i.lift.run = true.into();
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
            Way::Arc { .. } => i.arcs.start = true.into(),
        }
        i.trajectory.start = true.into();
        self.stage = Stage::Move(0);
    }

    /// Gives a target: what lines have to add to the arcs' way.
    fn push_line(&self, now: &Simulator<Plant>, to: [i64; 2], speed: u64, i: &mut In<Sim>) {
        let arcs = self.see.arcs.map(|axis| now.get(axis));
        i.lines = ports::Lines {
            push: true.into(),
            target_x: (to[0] - arcs[0]).into(),
            target_y: (to[1] - arcs[1]).into(),
            speed: speed.into(),
            acceleration_time: self.program.ramp_scans.into(),
            deceleration_time: self.program.ramp_scans.into(),
        };
    }

    fn pulse(&mut self, pending: bool) -> ports::Pulse<Sim> {
        let Some(given) = self.pulses.drive::<16, 24>(pending) else {
            return zero();
        };
        ports::Pulse {
            command: given.command,
            base: given.base,
            last: given.last,
            run: given.run,
            now: given.now,
            write: given.write,
            write_axis: given.write_axis,
            write_address: given.write_address,
            write_half_period: given.write_half_period,
            write_direction: given.write_direction,
        }
    }

    fn arc_words(&mut self) -> ports::Arcs<Sim> {
        let written = self.arcs.write_up_to(self.arcs_due);
        ports::Arcs {
            write: written.write.into(),
            write_word: written.word.into(),
            write_data: written.data.into(),
            push: written.push.into(),
            start: false.into(),
        }
    }

    fn trajectory(&mut self, i: &mut ports::Trajectory<Sim>) {
        let written = self.profile.write_up_to(self.profile_due);
        i.write = written.write.into();
        i.write_word = written.word.into();
        i.write_data = written.data.into();
        i.push = written.push.into();
        i.start = false.into();
        let path = self.path.write();
        i.write_begin = path.write_begin.into();
        i.begin_segment = path.segment.into();
        i.begin_length = path.begin.into();
        i.write_path = path.write.into();
        i.path_address = (path.segment << 4 | path.word).into();
        i.path_data = path.data.into();
    }

    fn lift(&mut self, i: &mut ports::Lift<Sim>) {
        let steps = &self.lift_steps;
        let (place, step) = (self.lift_words, steps.get(self.lift_words));
        self.lift_words = (place + 1).min(steps.len() + 1);
        let speed = step.map_or(0, |step| step.speed_counts_per_s / SPEED_UNIT_COUNTS_PER_S);
        i.write_target = step.is_some().into();
        i.write_step = (place as u64).into();
        i.step_target = step.map_or(0, |step| step.target).into();
        i.step_speed = u64::from(speed).into();
        i.run = false.into();
    }

    /// Whether the steppers' table is given whole.
    pub(super) fn pulses_given(&self) -> bool {
        self.pulses.has_given_all()
    }

    /// Where the lift has the pen down.
    pub(super) fn pen_down_counts(&self) -> i64 {
        self.settings.pen_down_counts
    }

    /// Whether the step that the lift is at lowers the pen.
    pub(super) fn lowers(&self) -> bool {
        !self.pen_down
    }

    /// Takes up what the tick shows.
    pub(super) fn take(&mut self, now: &Sample<'_, Plant>) {
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

    /// Both motors within the window for some sampling times: the move is over.
    fn settle(&mut self, now: &Sample<'_, Plant>) -> Stage {
        if !now.get(self.see.sample) {
            return Stage::Settle;
        }
        let last = self.index + 1 >= self.program.moves.len();
        // The end is where it is, to the count.
        let window = if last {
            0
        } else {
            u64::from(self.settings.in_position_counts)
        };
        let counts = self.see.counts.map(|axis| now.get(axis));
        let position = self.see.position.map(|axis| now.get(axis));
        let near = [0, 1]
            .iter()
            .all(|&axis: &usize| counts[axis].abs_diff(position[axis]) <= window);
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

    /// The records of a move may be written: the one before is over.
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
