//! Measures of a run: the deviation of both machines from the job's path, its reasons, and their
//! end positions.

mod ends;
mod measuring;
mod servos;
mod steppers;

pub use ends::{End, Ends};
pub use measuring::{Measuring, Shown};

use super::job::{Event, Played};
use super::program::Program;
use super::settings::Settings;
use crate::input::{Drawing, Point};
use crate::path::pieces::Piece;
use crate::path::vector::{distance, dot, sub, unit};
use crate::plan::{Plan, PlanError};
use serde::Serialize;
use std::ops::RangeInclusive;

/// A point as near is on the path: floating point puts it there.
const ON_PATH_MM: f64 = 1e-9;

/// Reason for a deviation from the path.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Reason {
    /// Steppers have whole steps only.
    #[serde(rename = "whole steps")]
    WholeSteps,
    /// In a unit time steppers move straight, also if the path curves.
    Chord,
    /// A count of steps in a unit time for which there is no half-period, compensated in the next.
    Table,
    /// Commands of the servos are whole counts.
    #[serde(rename = "whole counts")]
    WholeCounts,
    /// Blends cut the ends of an arc.
    Blend,
    /// The servos' models lag, apart from the part that the correction compensates, and overshoot
    /// an end.
    Lag,
    /// Motors follow their models.
    Motor,
    /// The shaft between motor and load twists.
    Shaft,
}

impl Reason {
    /// Returns the reason in words.
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

/// Point at which a machine is farthest from a piece of the path.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Farthest {
    /// Distance from the piece.
    pub um: f64,
    /// Tick of the deviation.
    pub tick: u64,
    /// Reason for the largest part of it; `None` if the machine is on the path.
    pub reason: Option<Reason>,
    /// Part of it with that reason: more than all if others work against it.
    pub share_um: f64,
}

/// Measures of the steppers on a piece of the path.
#[derive(Debug, Clone, PartialEq)]
pub struct Steppers {
    /// Ticks in which they were on it.
    pub ticks: RangeInclusive<u64>,
    /// Greatest deviation; `None` if no unit time ended on it.
    pub farthest: Option<Farthest>,
}

/// Measures of the servos on a piece of the path.
#[derive(Debug, Clone, PartialEq)]
pub struct Servos {
    /// Ticks from its beginning until both motors were in position.
    pub ticks: RangeInclusive<u64>,
    /// Greatest distance of the commands from it.
    pub command_um: f64,
    /// Greatest distance of the models from it.
    pub model_um: f64,
    /// Greatest distance of the motors from it by their encoders.
    pub motor_um: f64,
    /// Greatest deviation of the loads.
    pub load: Farthest,
    /// Distance of the corrected command's end from the piece's end, in counts.
    pub left_by_correction: [i64; 2],
}

/// Measures of a piece of the path for both machines.
#[derive(Debug, Clone, PartialEq)]
pub struct PieceMeasured {
    /// Index of the piece.
    pub piece: usize,
    /// Measures of the steppers.
    pub steppers: Steppers,
    /// Measures of the servos; `None` if they did not reach it, or it has no length.
    pub servos: Option<Servos>,
}

/// Point beside the path at a sampling time or the end of a unit time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Beside {
    pub tick: u64,
    /// Index of the piece.
    pub piece: usize,
    /// Position of the machine in mm.
    pub actual: Point,
    /// Nearest point of the piece.
    pub nearest: Point,
}

impl Beside {
    /// Returns the distance of both points in mm.
    #[must_use]
    pub fn mm(&self) -> f64 {
        distance(self.actual, self.nearest)
    }
}

/// Use of the servos' time, in ticks.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Times {
    /// Ticks from the first step of the steppers' table to its end.
    pub steppers: u64,
    /// Ticks from power-on until the end of the servos' last move.
    pub servos: u64,
    /// Ticks in which their commands moved.
    pub moving: u64,
    /// Ticks in which the commands were constant and the motors settled.
    pub settling: u64,
}

/// Measures of a run.
#[derive(Debug, Clone, PartialEq)]
pub struct Measured {
    /// Measures of each piece.
    pub pieces: Vec<PieceMeasured>,
    /// Use of the time.
    pub times: Times,
    /// End positions.
    pub ends: Ends,
}

impl Measured {
    /// Measures the complete record of a run of a drawing's program.
    ///
    /// # Errors
    /// Returns an error if the path cannot be planned, which an existing program rules out.
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

/// Nominal pieces of the job.
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

    /// Returns the vector from the nearest point of a piece to a point.
    fn off(&self, piece: usize, point: Point) -> Point {
        sub(point, self.nearest(piece, point))
    }
}

/// Returns the greatest share in the direction of the total deviation.
fn farthest<const N: usize>(tick: u64, off: Point, shares: [(Reason, Point); N]) -> Farthest {
    let (mm, direction) = (distance(off, [0.0; 3]), unit(off));
    let shares = shares.map(|(reason, share)| (reason, dot(share, direction)));
    // Of equal shares the first.
    let largest = shares.into_iter().rev();
    let largest = largest.max_by(|(_, a), (_, b)| a.total_cmp(b));
    let largest = largest.filter(|_| mm > ON_PATH_MM);
    Farthest {
        um: mm * 1e3,
        tick,
        reason: largest.map(|(reason, _)| reason),
        share_um: largest.map_or(0.0, |(_, share_mm)| share_mm * 1e3),
    }
}
