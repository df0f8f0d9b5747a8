//! Following errors: positions of the axes at any time, compared with the path.

use super::demand::{Demand, Demands, Steps};
use super::error::TableError;
use super::report::FollowingError;
use super::settings::Settings;
use super::words::{Table, Word};
use crate::input::{COORDINATES, Drawing};
use crate::jobs::pulse_interpolator::positions::Positions;
use crate::plan::Plan;
use std::array::from_fn;

/// Errors of a completed unit time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct UnitErrors {
    /// Unit, from 0.
    pub unit: usize,
    /// End time in seconds.
    pub time_s: f64,
    /// Line of the input at that time.
    pub line: usize,
    /// True if that is a rapid move.
    pub rapid: bool,
    /// Demand minus position of each axis in steps, at its greatest absolute value in the unit; 0
    /// for axes that are not driven.
    pub errors: [f64; COORDINATES],
    /// Demand minus position of each axis in steps at the end.
    pub end_errors: [f64; COORDINATES],
    /// Positions at the end in steps from the axes' start; 0 for axes that are not driven.
    pub positions: [i32; COORDINATES],
}

/// Positions of a path at the end of a unit time, in steps from the axes' start; 0 for axes that
/// are not driven.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct UnitDemand {
    /// Unit time T in ticks.
    pub period: u32,
    /// Exact position.
    pub exact: [f64; COORDINATES],
    /// Position rounded to the nearest step.
    pub rounded: [i64; COORDINATES],
}

/// Positions of a path over time, in steps from the axes' start.
#[derive(Debug)]
pub struct PathSteps<'p, 'd> {
    demands: Demands<'p, 'd>,
    start: Demand,
}

impl<'p, 'd> PathSteps<'p, 'd> {
    /// Creates the positions of a planned drawing.
    ///
    /// # Errors
    /// Returns a [`TableError`] if a position does not fit.
    pub fn new(plan: &'p Plan<'d>, settings: &Settings) -> Result<Self, TableError> {
        let mut demands = Demands::new(plan, settings);
        let start = demands.at(0)?;
        Ok(PathSteps { demands, start })
    }

    /// Returns the exact position after this number of ticks; 0 for axes that are not driven.
    ///
    /// # Errors
    /// Returns a [`TableError`] if the position does not fit.
    pub fn at(&mut self, ticks: u64) -> Result<[f64; COORDINATES], TableError> {
        let demand = self.demands.at(ticks)?;
        Ok(from_fn(|axis| self.relative(&demand, axis)))
    }

    fn relative(&self, demand: &Demand, axis: usize) -> f64 {
        let begun = Steps::from_num(self.start.rounded(axis));
        (demand.steps[axis] - begun).to_num()
    }
}

/// Comparison of demand and position over a run, unit after unit.
struct Follower<'p, 'd> {
    demands: Demands<'p, 'd>,
    /// Position of each axis at the beginning of the unit.
    positions: Vec<i64>,
    largest: Vec<FollowingError>,
    unit: usize,
    ticks: u64,
    turns: Vec<f64>,
}

impl Follower<'_, '_> {
    /// Adds a unit with these words, which ends with the axes at `positions`.
    ///
    /// Between two steps, and between two points at which the path may reverse, the demand of an
    /// axis is monotonic and its position constant: the error is greatest at one of these.
    fn unit(
        &mut self,
        period: u32,
        words: &[Word],
        positions: impl Iterator<Item = i64>,
    ) -> Result<UnitErrors, TableError> {
        let (begin, end) = (self.ticks, self.ticks + u64::from(period));
        let (begin_s, end_s) = (self.demands.seconds(begin), self.demands.seconds(end));
        let mut turns = std::mem::take(&mut self.turns);
        self.demands.turns([begin_s, end_s], &mut turns);
        let last = self.demands.at(end)?;
        let mut unit = UnitErrors {
            unit: self.unit,
            time_s: end_s,
            line: last.line,
            rapid: last.rapid,
            errors: [0.0; COORDINATES],
            end_errors: [0.0; COORDINATES],
            positions: [0; COORDINATES],
        };
        for (axis, (word, to)) in words.iter().zip(positions).enumerate() {
            let from = std::mem::replace(&mut self.positions[axis], to);
            let steps = Staircase::new(period, *word);
            let mut see = |time_s: f64, demand: &Demand, position: i64| {
                let error = (demand.steps[axis] - Steps::from_num(position)).to_num::<f64>();
                if error.abs() > unit.errors[axis].abs() {
                    unit.errors[axis] = error;
                }
                let largest = &mut self.largest[axis];
                // Not if it is equal: the first is kept.
                if error.abs() > largest.steps {
                    *largest = FollowingError {
                        steps: error.abs(),
                        unit: self.unit,
                        time_s,
                        line: demand.line,
                    };
                }
            };
            // If a variant of the circuit made other steps than the word, their times are unknown.
            if from + steps.signed(steps.count) == to {
                for &time_s in &turns {
                    let ticks = (time_s - begin_s) / (end_s - begin_s) * f64::from(period);
                    let position = from + steps.signed(steps.until(ticks));
                    see(time_s, &self.demands.at_time(time_s)?, position);
                }
                for step in 0..steps.count {
                    let ticks = begin + steps.rise(step);
                    let demand = self.demands.at(ticks)?;
                    let time_s = self.demands.seconds(ticks);
                    see(time_s, &demand, from + steps.signed(step));
                    see(time_s, &demand, from + steps.signed(step + 1));
                }
            }
            see(end_s, &last, to);
            unit.end_errors[axis] = (last.steps[axis] - Steps::from_num(to)).to_num();
        }
        self.turns = turns;
        self.ticks = end;
        self.unit += 1;
        Ok(unit)
    }
}

/// Times of a word's steps within its unit time.
struct Staircase {
    half_period: u64,
    negative: bool,
    count: u64,
}

impl Staircase {
    fn new(period: u32, word: Word) -> Self {
        Staircase {
            half_period: u64::from(word.half_period()),
            negative: word.negative(),
            count: u64::from(crate::circuits::pulse_interpolator::counts::pulses(
                word.half_period(),
                period,
            )),
        }
    }

    /// Returns the tick in which a step, counted from 0, rises.
    fn rise(&self, step: u64) -> u64 {
        (2 * step + 1) * self.half_period
    }

    /// Returns the number of steps up to a time in ticks.
    fn until(&self, ticks: f64) -> u64 {
        match self.half_period {
            0 => 0,
            half => ((ticks / half as f64 + 1.0) / 2.0).floor().max(0.0) as u64,
        }
        .min(self.count)
    }

    fn signed(&self, steps: u64) -> i64 {
        let steps = i64::try_from(steps).unwrap_or(i64::MAX);
        if self.negative { -steps } else { steps }
    }
}

/// Compares the positions of a run of `table` with the path of `drawing`: calls `each` with every
/// unit time, and returns the greatest error of each axis at any time.
///
/// Within a unit, the half-period determines the times of the steps.
///
/// # Errors
///
/// Returns a [`TableError`] if `settings` are not those with which the table was compiled.
pub fn follow(
    drawing: &Drawing,
    settings: &Settings,
    table: &Table,
    positions: &Positions,
    mut each: impl FnMut(&UnitErrors),
) -> Result<Vec<FollowingError>, TableError> {
    let axes = table.axes();
    let plan = Plan::new(drawing, &settings.motion)?;
    let mut follower = follower(&plan, settings, axes)?;
    let start = follower.positions.clone();
    for ((period, words), at) in table.iter().zip(positions.of(table)) {
        let positions = start.iter().zip(at.iter());
        let positions = positions.map(|(start, &steps)| start + i64::from(steps));
        let mut unit = follower.unit(period, &words, positions)?;
        for (position, at) in unit.positions.iter_mut().zip(at.iter()) {
            *position = *at;
        }
        each(&unit);
    }
    Ok(follower.largest)
}

/// Returns the positions of `drawing` at the end of the first `units` unit times of `table`.
///
/// # Errors
///
/// Returns the errors of [`follow`].
pub fn demanded(
    drawing: &Drawing,
    settings: &Settings,
    table: &Table,
    units: usize,
) -> Result<Vec<UnitDemand>, TableError> {
    let plan = Plan::new(drawing, &settings.motion)?;
    let mut path = PathSteps::new(&plan, settings)?;
    let mut ticks = 0;
    let each = table.iter().take(units).map(|(period, _)| {
        ticks += u64::from(period);
        let demand = path.demands.at(ticks)?;
        let mut unit = UnitDemand {
            period,
            exact: [0.0; COORDINATES],
            rounded: [0; COORDINATES],
        };
        for axis in 0..table.axes() {
            unit.exact[axis] = path.relative(&demand, axis);
            unit.rounded[axis] = demand.rounded(axis) - path.start.rounded(axis);
        }
        Ok(unit)
    });
    each.collect()
}

/// Returns the greatest following errors of the steps in `table`.
pub(super) fn of_table(
    plan: &Plan<'_>,
    settings: &Settings,
    table: &Table,
) -> Result<Vec<FollowingError>, TableError> {
    let mut follower = follower(plan, settings, table.axes())?;
    for (period, words) in table.iter() {
        let pairs = follower.positions.iter().zip(words.iter());
        let positions: Vec<i64> = pairs
            .map(|(from, word)| {
                let steps = Staircase::new(period, *word);
                from + steps.signed(steps.count)
            })
            .collect();
        follower.unit(period, &words, positions.into_iter())?;
    }
    Ok(follower.largest)
}

fn follower<'p, 'd>(
    plan: &'p Plan<'d>,
    settings: &Settings,
    axes: usize,
) -> Result<Follower<'p, 'd>, TableError> {
    let mut demands = Demands::new(plan, settings);
    let start = demands.at(0)?;
    Ok(Follower {
        demands,
        positions: (0..axes).map(|axis| start.rounded(axis)).collect(),
        largest: vec![FollowingError::default(); axes],
        unit: 0,
        ticks: 0,
        turns: Vec::new(),
    })
}
