//! What came out: how far both machines left the job's path on the way, why, and where they ended.

mod ends;
mod measuring;
mod servos;
mod steppers;

pub use ends::Ends;
pub use measuring::{Measuring, Shown};

use super::job::{Event, Played};
use super::program::Program;
use super::settings::Settings;
use crate::input::{Drawing, Point};
use crate::path::pieces::Piece;
use crate::path::vector::{distance, dot, sub, unit};
use crate::plan::{Plan, PlanError};
use std::ops::RangeInclusive;

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
    /// The servos' models: they lag, less what the correction makes up for, and run on past an end.
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
    /// Counts by which the corrected command ends beside the piece's end.
    pub left_counts: [i64; 2],
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

/// Measured on a run.
#[derive(Debug, Clone, PartialEq)]
pub struct Measured {
    /// Every piece.
    pub pieces: Vec<PieceMeasured>,
    /// Times.
    pub times: Times,
    /// Ends.
    pub ends: Ends,
}

impl Measured {
    /// Measures the whole record of a run of a drawing's program.
    ///
    /// # Errors
    /// The path cannot be planned, which a program that is there rules out.
    pub fn of(
        drawing: &Drawing,
        program: &Program,
        settings: &Settings,
        played: &Played,
    ) -> Result<Self, PlanError> {
        let plan = Plan::new(drawing, &settings.motion)?;
        let mut measuring = Measuring::new(drawing, program, settings, &plan);
        let mut take = |event| measuring.take(event, &mut |_| {});
        for (steps, tick) in played.steps.iter().zip(&played.step_ticks) {
            let (steps, tick) = (*steps, *tick);
            take(Event::Unit { tick, steps });
        }
        let mut frames = played.frames.iter().peekable();
        for timed in &played.moves {
            let ends = [
                (timed.begun, Event::Begun(timed.begun)),
                (timed.ended, Event::Ended(timed.ended)),
            ];
            for (tick, event) in ends {
                while let Some(frame) = frames.next_if(|frame| frame.tick <= tick) {
                    take(Event::Frame(*frame));
                }
                take(event);
            }
        }
        frames.for_each(|frame| take(Event::Frame(*frame)));
        Ok(measuring.finish(played))
    }
}

/// The pieces of the job, as they should be.
#[derive(Clone, Copy)]
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
