//! Sources of the positions in a series.

use super::Signals;
use crate::netlist::Shape;
use crate::sim::LeafView as View;
use crate::trace::value::number;
use std::fmt;
use std::io;

/// Source of a position.
#[derive(Debug, Clone, PartialEq)]
pub enum Position {
    /// Word of a signal, times `scale`.
    Signal {
        /// Path below the circuit.
        path: String,
        /// Unit of the word in units of the axis.
        scale: f64,
    },
    /// Word of a signal that counts turns over: the position nearest to the actual one that the
    /// word represents. For commanded positions.
    Nearest {
        /// Path below the circuit.
        path: String,
    },
    /// Steps counted on a step line and a direction line, which is high for steps down.
    Steps {
        /// Path of the step line below the circuit.
        step: String,
        /// Path of the direction line below the circuit.
        dir: String,
    },
    /// Position of a plan.
    Planned {
        /// Index of the plan in the layout.
        plan: usize,
        /// Index of the position in those of the plan.
        axis: usize,
    },
}

/// Positions over a count of ticks.
pub struct SeriesPlan<'a> {
    /// Path of the signal below the circuit whose ticks are counted, as `busy`.
    pub clock: String,
    /// Returns the positions of all axes once that signal has been high in this number of ticks,
    /// which never decreases from call to call. A tick for which it returns none has no row.
    pub at: Box<dyn FnMut(u64) -> Vec<f64> + 'a>,
}

impl fmt::Debug for SeriesPlan<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("SeriesPlan")
            .field("clock", &self.clock)
            .finish_non_exhaustive()
    }
}

/// Plan under way.
#[derive(Debug)]
pub(super) struct Plan<'a> {
    plan: SeriesPlan<'a>,
    clock: usize,
    count: u64,
    /// True if its clock was high in the tick looked at last.
    was_high: bool,
    positions: Vec<f64>,
}

impl<'a> Plan<'a> {
    pub(super) fn new(plan: SeriesPlan<'a>, signals: &Signals<'_>) -> io::Result<Self> {
        let clock = signals.find(&plan.clock)?;
        Ok(Plan {
            plan,
            clock,
            count: 0,
            was_high: false,
            positions: Vec::new(),
        })
    }

    /// Returns the leaf of its clock.
    pub(super) fn clock(&self) -> usize {
        self.clock
    }

    /// Counts a tick, and those before it in which the clock was as in the last one.
    pub(super) fn count(&mut self, skipped: u64, view: View<'_>) {
        self.count += skipped * u64::from(self.was_high);
        self.was_high = view.leaf(self.clock) & 1 == 1;
        self.count += u64::from(self.was_high);
    }

    /// Computes the positions; returns false if there are none yet.
    pub(super) fn evaluate(&mut self) -> bool {
        self.positions = (self.plan.at)(self.count);
        !self.positions.is_empty()
    }
}

/// Position whose signals are found.
#[derive(Debug)]
pub(super) enum Source {
    Signal {
        leaf: usize,
        shape: Shape,
        scale: f64,
    },
    Nearest {
        leaf: usize,
        width: usize,
    },
    Steps {
        step: usize,
        dir: usize,
        was_high: bool,
        position: i64,
    },
    Planned {
        plan: usize,
        axis: usize,
    },
}

impl Source {
    pub(super) fn new(position: Position, signals: &Signals<'_>) -> io::Result<Self> {
        Ok(match position {
            Position::Signal { path, scale } => {
                let leaf = signals.find(&path)?;
                Source::Signal {
                    leaf,
                    shape: signals.leaves[leaf].shape,
                    scale,
                }
            }
            Position::Nearest { path } => {
                let leaf = signals.find(&path)?;
                Source::Nearest {
                    leaf,
                    width: signals.leaves[leaf].shape.width,
                }
            }
            Position::Steps { step, dir } => Source::Steps {
                step: signals.find(&step)?,
                dir: signals.find(&dir)?,
                was_high: false,
                position: 0,
            },
            Position::Planned { plan, axis } => Source::Planned { plan, axis },
        })
    }

    /// Returns the leaves whose changes it counts.
    pub(super) fn watched(&self) -> impl Iterator<Item = usize> {
        let leaves = match *self {
            Source::Steps { step, dir, .. } => vec![step, dir],
            _ => Vec::new(),
        };
        leaves.into_iter()
    }

    /// Counts the steps of a tick.
    pub(super) fn count(&mut self, view: View<'_>) {
        if let Source::Steps {
            step,
            dir,
            was_high,
            position,
        } = self
        {
            let is_high = view.leaf(*step) & 1 == 1;
            if is_high && !*was_high {
                *position += if view.leaf(*dir) & 1 == 1 { -1 } else { 1 };
            }
            *was_high = is_high;
        }
    }

    /// Returns the position; `actual` is the axis' actual one.
    pub(super) fn value(&self, view: View<'_>, plans: &[Plan<'_>], actual: f64) -> f64 {
        match *self {
            Source::Signal { leaf, shape, scale } => number(shape, view.leaf(leaf)) as f64 * scale,
            Source::Nearest { leaf, width } => {
                let turn = (width as f64).exp2();
                let word = view.leaf(leaf) as f64;
                word + ((actual - word) / turn).round() * turn
            }
            Source::Steps { position, .. } => position as f64,
            Source::Planned { plan, axis } => {
                let positions = plans.get(plan).map(|plan| &plan.positions);
                let position = positions.and_then(|all| all.get(axis));
                position.copied().unwrap_or(f64::NAN)
            }
        }
    }
}
