//! The steppers beside the path.

use super::{Farthest, Path, Reason, Steppers, farthest};
use crate::input::{Drawing, Point};
use crate::jobs::machine::job::Played;
use crate::jobs::machine::program::Program;
use crate::jobs::machine::settings::Settings;
use crate::path::vector::{add, distance, scale, sub};
use crate::plan::{Plan, PlanError};
use std::array::from_fn;

/// The steppers at the end of a unit time.
#[derive(Debug, Clone, Copy)]
pub(super) struct Unit {
    pub tick: u64,
    pub piece: usize,
    /// Where they are.
    pub actual: Point,
    /// Where the plan has them.
    planned: Point,
    /// The step nearest to that.
    nearest: Point,
}

/// The ends of all unit times, from where the steppers begin on.
pub(super) fn units(
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
            (Reason::WholeSteps, sub(self.nearest, self.planned)),
            (Reason::Chord, path.off(piece, self.planned)),
            (Reason::Table, sub(self.actual, self.nearest)),
        ];
        farthest(self.tick, off, shares)
    }
}

impl Path<'_> {
    /// The steppers on a piece.
    pub(super) fn steppers(&self, units: &[Unit], piece: usize) -> Steppers {
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
