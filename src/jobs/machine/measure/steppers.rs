//! Deviation of the steppers from the path.

use super::{Beside, Farthest, Path, PieceMeasured, Reason, Steppers, farthest};
use crate::input::{Drawing, Point};
use crate::jobs::machine::program::Program;
use crate::jobs::machine::settings::Settings;
use crate::path::vector::{add, distance, scale, sub};
use crate::plan::{Plan, Sampler};
use std::array::from_fn;

/// Steppers at the end of a unit time.
#[derive(Debug, Clone, Copy)]
pub(super) struct Unit {
    pub tick: u64,
    pub piece: usize,
    /// Position.
    pub actual: Point,
    /// Planned position.
    planned: Point,
    /// Step nearest to the planned position.
    nearest: Point,
}

/// Ends of unit times, from the steppers' start on.
pub(super) struct Units<'a> {
    sampler: Sampler<'a, 'a>,
    settings: &'a Settings,
    start: [i64; 2],
    height: f64,
    /// Number of unit times so far, including the steppers' start.
    count: u64,
    first_tick: u64,
    latest: Option<Unit>,
    /// Deviation halfway from another piece, if that point is nearer to the piece of the latest
    /// end.
    before: Option<Farthest>,
}

impl<'a> Units<'a> {
    pub(super) fn new(
        drawing: &Drawing,
        program: &Program,
        settings: &'a Settings,
        plan: &'a Plan<'a>,
    ) -> Self {
        Units {
            sampler: plan.sampler(),
            settings,
            start: from_fn(|axis| i64::from(program.report.axes[axis].start_position)),
            height: drawing.start[2],
            count: 0,
            first_tick: 0,
            latest: None,
            before: None,
        }
    }

    fn unit(&mut self, tick: u64, steps: [i64; 2]) -> Unit {
        let settings = self.settings;
        let unit_s = f64::from(settings.unit_ticks) / settings.clock_hz as f64;
        let mm = |steps: [f64; 2]| -> Point {
            let [x, y] = from_fn(|axis| steps[axis] / settings.steps_per_mm[axis]);
            [x, y, self.height]
        };
        let sample = self.sampler.at(self.count as f64 * unit_s);
        let [x, y, _] = sample.position;
        Unit {
            tick,
            piece: sample.index,
            actual: mm(from_fn(|axis| (self.start[axis] + steps[axis]) as f64)),
            planned: [x, y, self.height],
            nearest: mm(from_fn(|axis| {
                ([x, y][axis] * settings.steps_per_mm[axis]).round()
            })),
        }
    }

    /// Adds the end of a unit time; the first gives the steppers' start.
    pub(super) fn take(
        &mut self,
        path: &Path<'_>,
        pieces: &mut [PieceMeasured],
        (tick, steps): (u64, [i64; 2]),
        show: &mut dyn FnMut(Beside),
    ) {
        if self.count == 0 {
            let begin = tick.saturating_sub(u64::from(self.settings.unit_ticks));
            self.one(path, pieces, (begin, [0; 2]), show);
        }
        self.one(path, pieces, (tick, steps), show);
    }

    fn one(
        &mut self,
        path: &Path<'_>,
        pieces: &mut [PieceMeasured],
        (tick, steps): (u64, [i64; 2]),
        show: &mut dyn FnMut(Beside),
    ) {
        let unit = self.unit(tick, steps);
        self.count += 1;
        if self.latest.is_none() {
            self.first_tick = tick;
        }
        // Moves from one end of a unit time to the next; the way to another piece belongs to the
        // nearer one.
        let (mut reached, mut before) = (0, None);
        if let Some(latest) = self.latest {
            let (middle, own) = (latest.middle(&unit), latest.piece == unit.piece);
            let on = [latest.piece, unit.piece].map(|piece| middle.mm(path, piece));
            let old = &mut pieces[latest.piece].steppers;
            if own || on[0] < on[1] {
                old.farther(middle.farthest(path, latest.piece));
            }
            if let Some(found) = self.before.take() {
                old.farther(found);
            }
            before = (!own && on[1] <= on[0]).then(|| middle.farthest(path, unit.piece));
            reached = latest.piece + 1;
        }
        let begin = self.latest.map_or(tick, |latest| latest.tick);
        for piece in pieces.iter_mut().take(unit.piece + 1).skip(reached) {
            piece.steppers.ticks = begin..=begin;
        }
        let new = &mut pieces[unit.piece].steppers;
        new.ticks = *new.ticks.start()..=tick;
        new.farther(unit.farthest(path, unit.piece));
        show(Beside {
            tick,
            piece: unit.piece,
            actual: unit.actual,
            nearest: path.nearest(unit.piece, unit.actual),
        });
        (self.latest, self.before) = (Some(unit), before);
    }

    /// Ends the last piece; returns the ticks from the first unit time to the last.
    pub(super) fn finish(&mut self, path: &Path<'_>, pieces: &mut [PieceMeasured]) -> u64 {
        if self.count == 0 && !pieces.is_empty() {
            self.one(path, pieces, (0, [0; 2]), &mut |_| {});
        }
        let Some(latest) = self.latest else {
            return 0;
        };
        if let Some(found) = self.before.take() {
            pieces[latest.piece].steppers.farther(found);
        }
        for piece in pieces.iter_mut().skip(latest.piece + 1) {
            piece.steppers.ticks = latest.tick..=latest.tick;
        }
        latest.tick - self.first_tick
    }
}

impl Steppers {
    pub(super) fn none() -> Self {
        Steppers {
            ticks: 0..=0,
            farthest: None,
        }
    }

    /// Keeps a deviation if it is greater than all before.
    fn farther(&mut self, found: Farthest) {
        if self.farthest.is_none_or(|other| found.um > other.um) {
            self.farthest = Some(found);
        }
    }
}

impl Unit {
    /// Returns the point halfway to the next end: all axes have constant rates in between.
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
