//! Measures of a run, folded while it goes on.

use super::Job;
use crate::cli::thinned::Thinned;
use motion_rtl::jobs::machine::job::{Event, Played};
use motion_rtl::jobs::machine::measure::{Beside, Measured, Measuring, Shown};
use motion_rtl::plan::Plan;
use std::collections::BTreeMap;

/// A run with its measures and the records of its picture.
#[derive(Debug)]
pub struct Run {
    /// Outcome of the run, without its records.
    pub played: Played,
    pub measured: Measured,
    /// The steppers at the ends of unit times.
    pub steppers: Points,
    /// The loads at sampling times of moves.
    pub loads: Points,
    pub lift: Lift,
}

/// Points beside the path, thinned.
pub type Points = Thinned<Beside, 3>;

/// The pen lift over time.
#[derive(Debug)]
pub struct Lift {
    /// Ticks and positions in counts, thinned.
    pub positions: Thinned<(u64, i64), 1>,
    /// Positions where the lift is stopped or at rest, by tick.
    pub marks: BTreeMap<u64, i64>,
    /// Ticks whose positions the next sampling time gives.
    pending: Vec<u64>,
    pub last: i64,
}

/// A run while it goes on.
pub struct UnderWay<'a> {
    measuring: Measuring<'a>,
    steppers: Points,
    loads: Points,
    lift: Lift,
}

impl<'a> UnderWay<'a> {
    /// Starts the measurements of a run.
    pub fn new(job: &'a Job, plan: &'a Plan<'a>) -> Self {
        let none = || Thinned::by(|one: &Beside| [one.mm(), one.actual[0], one.actual[1]]);
        UnderWay {
            measuring: Measuring::new(&job.drawing, &job.program, &job.settings, plan),
            steppers: none(),
            loads: none(),
            lift: Lift {
                positions: Thinned::by(|(_, position): &(u64, i64)| [*position as f64]),
                marks: BTreeMap::new(),
                pending: Vec::new(),
                last: 0,
            },
        }
    }

    /// Takes the next event.
    pub fn take(&mut self, event: Event) {
        let lift = &mut self.lift;
        match event {
            Event::Frame(frame) => {
                lift.positions.push((frame.tick, frame.lift));
                let pending = lift.pending.drain(..);
                lift.marks.extend(pending.map(|tick| (tick, frame.lift)));
                lift.last = frame.lift;
            }
            Event::Lift(tick) => lift.pending.push(tick),
            Event::Unit { .. } | Event::Begun(_) | Event::Ended(_) => {}
        }
        let show = &mut |shown| match shown {
            Shown::Steppers(beside) => self.steppers.push(beside),
            Shown::Loads(beside) => self.loads.push(beside),
        };
        self.measuring.take(event, show);
    }

    /// Result of the run.
    pub fn finish(self, played: Played) -> Run {
        Run {
            measured: self.measuring.finish(&played),
            steppers: self.steppers,
            loads: self.loads,
            lift: self.lift,
            played,
        }
    }
}
