//! Positions at the end of every unit time of a table.

use super::Table;
use super::table::UnitWords;
use crate::circuits::pulse_interpolator::AXES_MAX;
use crate::circuits::pulse_interpolator::counts::pulses;
use crate::jobs::pulse_interpolator::Word;
use std::ops::Deref;

/// Returns the steps that a word makes in `period` ticks.
#[must_use]
pub fn steps_of(word: Word, period: u32) -> i64 {
    let steps = i64::from(pulses(word.half_period(), period));
    if word.negative() { -steps } else { steps }
}

/// Unit time in which an axis made a different number of steps than its word.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Miscount {
    /// Unit time, from 0.
    pub unit: u32,
    /// Axis, from 0.
    pub axis: u8,
    /// Steps beyond those of the word.
    pub steps: i32,
}

/// Positions at the end of every unit time of a table, in steps from the axes' start. Positions
/// according to the words take no memory; deviating counts do.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Positions {
    /// Number of completed unit times.
    pub units: usize,
    /// Deviating unit times, in order.
    pub miscounts: Vec<Miscount>,
}

/// Positions of all axes, X first.
#[derive(Debug, Clone, Copy)]
pub struct UnitPositions {
    at: [i32; AXES_MAX],
    axes: usize,
}

impl Deref for UnitPositions {
    type Target = [i32];

    fn deref(&self) -> &[i32] {
        &self.at[..self.axes]
    }
}

impl Positions {
    /// Returns the positions, unit after unit, of a run of `table`.
    pub fn of<'a>(&'a self, table: &'a Table) -> impl Iterator<Item = UnitPositions> + 'a {
        let (mut miscounts, axes) = (self.miscounts.iter().peekable(), table.axes());
        let mut at = [0i64; AXES_MAX];
        let units = table.iter().take(self.units).enumerate();
        units.map(move |(unit, (period, words))| {
            for (at, word) in at.iter_mut().zip(words.iter()) {
                *at += steps_of(*word, period);
            }
            while let Some(other) = miscounts.next_if(|other| other.unit as usize == unit) {
                at[usize::from(other.axis)] += i64::from(other.steps);
            }
            let at = at.map(|at| at as i32);
            UnitPositions { at, axes }
        })
    }
}

/// Positions of a table over time, in steps from the axes' start: each axis moves uniformly through
/// each unit time.
pub struct TableSteps<'t> {
    units: Box<dyn Iterator<Item = (u32, UnitWords)> + 't>,
    axes: usize,
    /// Current unit time, and the tick of its begin.
    unit: Option<(u32, UnitWords)>,
    begun: u64,
    /// Positions at its begin.
    at: [i64; AXES_MAX],
}

impl<'t> TableSteps<'t> {
    /// Creates the positions of a table.
    #[must_use]
    pub fn new(table: &'t Table) -> Self {
        let mut units = Box::new(table.iter());
        TableSteps {
            unit: units.next(),
            units,
            axes: table.axes(),
            begun: 0,
            at: [0; AXES_MAX],
        }
    }

    /// Returns the positions after this number of ticks, which must not decrease from call to
    /// call.
    pub fn at(&mut self, ticks: u64) -> Vec<f64> {
        while let Some((period, words)) = &self.unit
            && ticks.saturating_sub(self.begun) >= u64::from(*period)
        {
            for (at, word) in self.at.iter_mut().zip(words.iter()) {
                *at += steps_of(*word, *period);
            }
            self.begun += u64::from(*period);
            self.unit = self.units.next();
        }
        let mut at: Vec<_> = self.at[..self.axes].iter().map(|at| *at as f64).collect();
        if let Some((period, words)) = &self.unit {
            let share = (ticks.saturating_sub(self.begun)) as f64 / f64::from(*period);
            for (at, word) in at.iter_mut().zip(words.iter()) {
                *at += share * steps_of(*word, *period) as f64;
            }
        }
        at
    }
}

/// Positions that are being recorded.
pub(super) struct Counted<'t> {
    units: Box<dyn Iterator<Item = (u32, UnitWords)> + 't>,
    /// Position of each axis at the end of the unit time before.
    before: [i64; AXES_MAX],
    pub(super) positions: Positions,
}

impl<'t> Counted<'t> {
    pub(super) fn new(table: &'t Table) -> Self {
        Counted {
            units: Box::new(table.iter()),
            before: [0; AXES_MAX],
            positions: Positions::default(),
        }
    }

    /// Adds a completed unit time of the table, with the axes at these positions.
    pub(super) fn unit(&mut self, at: impl Iterator<Item = i64>) {
        let unit = self.units.next();
        for (axis, (at, before)) in at.zip(&mut self.before).enumerate() {
            let due = unit.map_or(0, |(period, words)| steps_of(words[axis], period));
            let beyond = at - std::mem::replace(before, at) - due;
            if beyond != 0 {
                self.positions.miscounts.push(Miscount {
                    unit: self.positions.units as u32,
                    axis: axis as u8,
                    steps: beyond as i32,
                });
            }
        }
        self.positions.units += 1;
    }
}
