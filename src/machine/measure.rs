//! What came out: how far both machines left the job's path on the way, why, and where they ended.

use super::job::{Frame, Played};
use super::program::Program;
use super::settings::Settings;
use crate::arc_generator::path::{Course, Piece};
use crate::arc_generator::vector::{add, distance, dot, scale, sub, unit};
use crate::input::{Drawing, Point};
use crate::plan::{Plan, PlanError};
use crate::trajectory_controller::Widths;
use std::array::from_fn;
use std::ops::RangeInclusive;

/// Guard units of a count.
const COUNT: f64 = (1u64 << Widths::FULL.guard()) as f64;
/// By how many counts rounding alone puts a command beside the path: half a one of each axis,
/// and another half for the remainder that the linear interpolator carries.
const ROUNDING_COUNTS: f64 = 1.5;

/// Why a machine is beside the path.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Reason {
    /// Steppers stand on whole steps only.
    WholeSteps,
    /// In a unit time steppers go straight on, also where the path turns.
    Chord,
    /// A unit time's count of steps that no half-period gives, made up for in the next.
    Table,
    /// Commands of the servos are whole counts.
    WholeCounts,
    /// Blends cut the ends of an arc.
    Blend,
    /// The servos' models lag, less what the correction makes up for.
    Lag,
    /// Motors follow their models.
    Motor,
    /// The shaft between motor and load twists.
    Shaft,
}

impl Reason {
    /// In words.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Reason::WholeSteps => "whole steps",
            Reason::Chord => "chord",
            Reason::Table => "table",
            Reason::WholeCounts => "whole counts",
            Reason::Blend => "blend",
            Reason::Lag => "lag",
            Reason::Motor => "motor",
            Reason::Shaft => "shaft",
        }
    }
}

/// Where a machine is farthest from a piece of the path.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Farthest {
    /// The distance in mm.
    pub mm: f64,
    /// The tick.
    pub tick: u64,
    /// What most of it comes from.
    pub reason: Reason,
    /// How much of it comes from that, in mm: more than all where others work against it.
    pub share_mm: f64,
}

/// The steppers on a piece of the path.
#[derive(Debug, Clone, PartialEq)]
pub struct Steppers {
    /// The ticks in which they were at it.
    pub ticks: RangeInclusive<u64>,
    /// Farthest from it; none where no unit time ended on it.
    pub farthest: Option<Farthest>,
}

/// The servos on a piece of the path.
#[derive(Debug, Clone, PartialEq)]
pub struct Servos {
    /// The ticks from its beginning until both motors were in position.
    pub ticks: RangeInclusive<u64>,
    /// Largest distance of the commands from it, in mm.
    pub command_mm: f64,
    /// The same of the models.
    pub model_mm: f64,
    /// The same of the motors, by their encoders.
    pub motor_mm: f64,
    /// The loads, where they are farthest.
    pub load: Farthest,
}

/// A piece of the path by both machines.
#[derive(Debug, Clone, PartialEq)]
pub struct PieceMeasured {
    /// The piece.
    pub piece: usize,
    /// The steppers.
    pub steppers: Steppers,
    /// The servos; none where they did not come to it, or it has no length.
    pub servos: Option<Servos>,
}

/// A point beside the path at a sampling time or the end of a unit time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Beside {
    /// The tick.
    pub tick: u64,
    /// The piece.
    pub piece: usize,
    /// Where the machine was, in mm.
    pub actual: Point,
    /// The nearest point of the piece.
    pub nearest: Point,
}

impl Beside {
    /// Distance of both in mm.
    #[must_use]
    pub fn mm(&self) -> f64 {
        distance(self.actual, self.nearest)
    }
}

/// Where the time of the servos went, in ticks.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Times {
    /// From the first step of the steppers' table to its end.
    pub steppers: u64,
    /// From power-on until the servos' last move is over.
    pub servos: u64,
    /// Their commands were on the way.
    pub moving: u64,
    /// The commands stood, the motors came.
    pub settling: u64,
}

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

/// Measured on a run.
#[derive(Debug, Clone, PartialEq)]
pub struct Measured {
    /// Every piece.
    pub pieces: Vec<PieceMeasured>,
    /// The steppers at the end of every unit time.
    pub steppers: Vec<Beside>,
    /// The loads at every sampling time of a move.
    pub loads: Vec<Beside>,
    /// Times.
    pub times: Times,
    /// Ends.
    pub ends: Ends,
}

impl Measured {
    /// Measures the run of a drawing's program.
    ///
    /// # Errors
    /// The path cannot be planned, which a program that is there rules out.
    pub fn of(
        drawing: &Drawing,
        program: &Program,
        settings: &Settings,
        played: &Played,
    ) -> Result<Self, PlanError> {
        let path = Path {
            start: drawing.start,
            pieces: &program.pieces,
        };
        let units = units(drawing, program, settings, played)?;
        let servo = Servo::new(drawing, settings);
        let mut pieces: Vec<PieceMeasured> = (0..program.pieces.len())
            .map(|piece| PieceMeasured {
                piece,
                steppers: path.steppers(&units, piece),
                servos: None,
            })
            .collect();
        let mut loads = Vec::with_capacity(played.frames.len());
        let mut times = Times {
            steppers: match (units.first(), units.last()) {
                (Some(first), Some(last)) => last.tick - first.tick,
                _ => 0,
            },
            servos: played.moves.last().map_or(0, |timed| timed.ended),
            ..Times::default()
        };
        for (step, timed) in program.moves.iter().zip(&played.moves) {
            let within = |tick: u64| played.frames.partition_point(|frame| frame.tick < tick);
            let frames = &played.frames[within(timed.begun)..within(timed.ended + 1)];
            let moving = frames.iter().rfind(|frame| frame.moving);
            let stood = moving.map_or(timed.begun, |frame| frame.tick);
            times.moving += stood - timed.begun;
            times.settling += timed.ended.saturating_sub(stood);
            loads.extend(frames.iter().map(|frame| {
                let actual = servo.load(frame);
                Beside {
                    tick: frame.tick,
                    piece: step.piece,
                    actual,
                    nearest: path.nearest(step.piece, actual),
                }
            }));
            pieces[step.piece].servos =
                servo
                    .farthest(&path, step.piece, frames)
                    .map(|servos| Servos {
                        ticks: timed.begun..=timed.ended,
                        ..servos
                    });
        }
        let steppers = units.iter().map(|unit| Beside {
            tick: unit.tick,
            piece: unit.piece,
            actual: unit.actual,
            nearest: path.nearest(unit.piece, unit.actual),
        });
        Ok(Measured {
            steppers: steppers.collect(),
            ends: ends(drawing, program, settings, played),
            pieces,
            loads,
            times,
        })
    }
}

/// The pieces of the job, as they should be.
struct Path<'a> {
    start: Point,
    pieces: &'a [Piece],
}

impl Path<'_> {
    fn nearest(&self, piece: usize, point: Point) -> Point {
        let from = match piece {
            0 => self.start,
            _ => self.pieces[piece - 1].to,
        };
        let own = &self.pieces[piece];
        own.course.nearest(from, own.to, point)
    }

    /// How far a point is off a piece.
    fn off(&self, piece: usize, point: Point) -> Point {
        sub(point, self.nearest(piece, point))
    }

    fn steppers(&self, units: &[Unit], piece: usize) -> Steppers {
        let first = units.partition_point(|unit| unit.piece < piece);
        let last = units.partition_point(|unit| unit.piece <= piece);
        let mut farthest: Option<Farthest> = None;
        let mut take = |unit: &Unit| {
            let found = unit.farthest(self, piece);
            if farthest.is_none_or(|other| found.mm > other.mm) {
                farthest = Some(found);
            }
        };
        for at in first..last {
            take(&units[at]);
            // On the way from one end of a unit time to the next; to another piece the way is that
            // of the nearer.
            if let Some(next) = units.get(at + 1) {
                let middle = units[at].middle(next);
                if next.piece == piece || middle.mm(self, piece) < middle.mm(self, next.piece) {
                    take(&middle);
                }
            }
            if let Some(before) = at.checked_sub(1).map(|before| &units[before])
                && before.piece != piece
            {
                let middle = before.middle(&units[at]);
                if middle.mm(self, piece) <= middle.mm(self, before.piece) {
                    take(&middle);
                }
            }
        }
        let tick = |at: usize| units.get(at).map_or(0, |unit| unit.tick);
        let (begin, end) = (first.saturating_sub(1), last.saturating_sub(1));
        Steppers {
            ticks: tick(begin)..=tick(end.max(begin)),
            farthest: farthest.filter(|_| last > first),
        }
    }
}

/// The steppers at the end of a unit time.
#[derive(Debug, Clone, Copy)]
struct Unit {
    tick: u64,
    piece: usize,
    /// Where they are.
    actual: Point,
    /// Where the plan has them.
    planned: Point,
    /// The step nearest to that.
    nearest: Point,
}

/// The ends of all unit times, from where the steppers begin on.
fn units(
    drawing: &Drawing,
    program: &Program,
    settings: &Settings,
    played: &Played,
) -> Result<Vec<Unit>, PlanError> {
    let plan = Plan::new(drawing, &settings.motion)?;
    let mut sampler = plan.sampler();
    let unit_ticks = u64::from(settings.unit_ticks);
    let unit_s = unit_ticks as f64 / settings.clock_hz as f64;
    let height = drawing.start[2];
    let start: [i64; 2] = from_fn(|axis| i64::from(program.report.axes[axis].start_position));
    let mm = |steps: [f64; 2]| -> Point {
        let [x, y] = from_fn(|axis| steps[axis] / settings.steps_per_mm[axis]);
        [x, y, height]
    };
    let begin = played
        .step_ticks
        .first()
        .map_or(0, |tick| tick.saturating_sub(unit_ticks));
    let seen =
        std::iter::once((&[0; 2], &begin)).chain(played.steps.iter().zip(&played.step_ticks));
    let units = seen.enumerate().map(|(number, (steps, tick))| {
        let sample = sampler.at(number as f64 * unit_s);
        let [x, y, _] = sample.position;
        Unit {
            tick: *tick,
            piece: sample.index,
            actual: mm(from_fn(|axis| (start[axis] + steps[axis]) as f64)),
            planned: [x, y, height],
            nearest: mm(from_fn(|axis| {
                ([x, y][axis] * settings.steps_per_mm[axis]).round()
            })),
        }
    });
    Ok(units.collect())
}

impl Unit {
    /// Half-way to the next: all axes go at constant rates in between.
    fn middle(&self, next: &Unit) -> Unit {
        let half = |a: Point, b: Point| scale(add(a, b), 0.5);
        Unit {
            tick: self.tick.midpoint(next.tick),
            piece: self.piece,
            actual: half(self.actual, next.actual),
            planned: half(self.planned, next.planned),
            nearest: half(self.nearest, next.nearest),
        }
    }

    fn mm(&self, path: &Path<'_>, piece: usize) -> f64 {
        distance(self.actual, path.nearest(piece, self.actual))
    }

    fn farthest(&self, path: &Path<'_>, piece: usize) -> Farthest {
        let off = path.off(piece, self.actual);
        let shares = [
            (Reason::Chord, path.off(piece, self.planned)),
            (Reason::WholeSteps, sub(self.nearest, self.planned)),
            (Reason::Table, sub(self.actual, self.nearest)),
        ];
        farthest(self.tick, off, shares)
    }
}

/// The largest of the shares in the direction of all.
fn farthest<const N: usize>(tick: u64, off: Point, shares: [(Reason, Point); N]) -> Farthest {
    let direction = unit(off);
    let mut found = Farthest {
        mm: distance(off, [0.0; 3]),
        tick,
        reason: shares[0].0,
        share_mm: f64::NEG_INFINITY,
    };
    for (reason, share) in shares {
        let share = dot(share, direction);
        if share > found.share_mm {
            (found.reason, found.share_mm) = (reason, share);
        }
    }
    if !found.share_mm.is_finite() {
        // Nothing is off, in no direction.
        found.share_mm = 0.0;
    }
    found
}

/// Positions of the servos in mm.
struct Servo {
    origin: [f64; 2],
    height: f64,
    per_mm: f64,
}

impl Servo {
    fn new(drawing: &Drawing, settings: &Settings) -> Self {
        let per_mm = settings.counts_per_mm;
        Servo {
            origin: from_fn(|axis| (drawing.start[axis] * per_mm).round()),
            height: drawing.start[2],
            per_mm,
        }
    }

    fn point(&self, counts: [f64; 2]) -> Point {
        let [x, y] = from_fn(|axis| (self.origin[axis] + counts[axis]) / self.per_mm);
        [x, y, self.height]
    }

    fn command(&self, frame: &Frame) -> Point {
        self.point(frame.command.map(|counts| counts as f64))
    }

    fn model(&self, frame: &Frame) -> Point {
        self.point(frame.model.map(|units| units as f64 / COUNT))
    }

    fn motor(&self, frame: &Frame) -> Point {
        self.point(frame.motor.map(|counts| counts as f64))
    }

    fn load(&self, frame: &Frame) -> Point {
        self.point(frame.load)
    }

    /// How far the servos were from a piece in these frames, without their ticks.
    fn farthest(&self, path: &Path<'_>, piece: usize, frames: &[Frame]) -> Option<Servos> {
        let off = |point: Point| path.off(piece, point);
        let mm = |point: Point| distance(off(point), [0.0; 3]);
        let largest = |of: fn(&Self, &Frame) -> Point| {
            let all = frames.iter().map(|frame| mm(of(self, frame)));
            all.fold(0.0, f64::max)
        };
        let worst = frames
            .iter()
            .max_by(|a, b| mm(self.load(a)).total_cmp(&mm(self.load(b))))?;
        // The command to which the models owe it to be here is that of the same place, not time.
        let model = self.model(worst);
        let from = |frame: &&Frame| distance(self.command(frame), model);
        let command = frames.iter().min_by(|a, b| from(a).total_cmp(&from(b)))?;
        let [command, model, motor, load] = [
            self.command(command),
            model,
            self.motor(worst),
            self.load(worst),
        ]
        .map(off);
        let is_arc = matches!(path.pieces[piece].course, Course::Arc(_));
        let rounding = distance(command, [0.0; 3]) <= ROUNDING_COUNTS / self.per_mm;
        let commanded = match is_arc && !rounding {
            true => Reason::Blend,
            false => Reason::WholeCounts,
        };
        let shares = [
            (commanded, command),
            (Reason::Lag, sub(model, command)),
            (Reason::Motor, sub(motor, model)),
            (Reason::Shaft, sub(load, motor)),
        ];
        Some(Servos {
            ticks: 0..=0,
            command_mm: largest(Self::command),
            model_mm: largest(Self::model),
            motor_mm: largest(Self::motor),
            load: farthest(worst.tick, load, shares),
        })
    }
}

fn ends(drawing: &Drawing, program: &Program, settings: &Settings, played: &Played) -> Ends {
    let end = program
        .pieces
        .last()
        .map_or(drawing.start, |piece| piece.to);
    let axes = [0, 1];
    let steps = |mm: f64, axis: usize| (mm * settings.steps_per_mm[axis]).round() as i64;
    let counts = |mm: f64| (mm * settings.counts_per_mm).round() as i64;
    let stepper =
        axes.map(|axis| i64::from(program.report.axes[axis].start_position) + played.stepper[axis]);
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
