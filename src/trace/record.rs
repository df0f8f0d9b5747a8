use super::layout::select;
use super::{LayoutError, Options};
use crate::hdl::{Circuit, Declaration};
use crate::nearest::nearest_paths;
use crate::sim::{Described, LeafView as View, Observer, RunError, Sample};
use std::collections::HashMap;
use std::io;
use std::ops::{ControlFlow, Range};

/// Greatest number of paths that an error suggests.
pub(super) const NEAR: usize = 5;

/// Recorder of a run in memory: a column of values for every chosen signal.
///
/// Memory use is eight bytes per signal and tick, and every word of a memory is a signal: choose
/// the signals or the ticks of a long run.
#[derive(Debug)]
pub struct Recorder {
    record: Record,
}

/// Error of a query to a [`Recorder`].
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum RecordError {
    /// The signal does not exist or was not chosen.
    #[error("no signal {path} was recorded{}", did_you_mean(near))]
    Unknown {
        /// Requested path.
        path: String,
        /// Recorded paths that are most similar, the nearest first.
        near: Vec<String>,
    },
    /// The tick was not recorded.
    #[error("tick {tick} was not recorded; recorded: {}..{}", recorded.start, recorded.end)]
    Tick {
        /// Requested tick.
        tick: u64,
        /// Recorded ticks, half-open.
        recorded: Range<u64>,
    },
}

impl Recorder {
    /// Creates a recorder for the ticks and signals that `options` selects.
    ///
    /// # Errors
    /// Returns an error if a selected path does not exist.
    pub fn new(circuit: &impl Described, options: &Options) -> Result<Self, LayoutError> {
        Ok(Recorder {
            record: Record::new(circuit.outlined().1.leaves, options)?,
        })
    }
}

impl Recorder {
    /// Returns the recorded signals, in the order of the walk.
    pub fn leaves(&self) -> &[Declaration] {
        &self.record.leaves
    }

    /// Returns the recorded ticks, half-open.
    pub fn ticks(&self) -> Range<u64> {
        self.record.ticks.clone()
    }

    /// Returns the index of a signal in [`leaves`](Recorder::leaves).
    ///
    /// # Errors
    /// Returns an error if no such signal was recorded.
    pub fn index(&self, path: &str) -> Result<usize, RecordError> {
        self.record.index(path)
    }

    /// Returns the values of a signal, one per tick; words of less than 64 bits have zeros above.
    ///
    /// # Errors
    /// Returns an error if no such signal was recorded.
    pub fn column(&self, path: &str) -> Result<&[u64], RecordError> {
        Ok(self.column_at(self.index(path)?))
    }

    /// Returns the values of the signal at `index` of [`leaves`](Recorder::leaves); empty if the
    /// index is past the end.
    pub fn column_at(&self, index: usize) -> &[u64] {
        self.record.column_at(index)
    }

    /// Returns the value of a signal at a tick.
    ///
    /// # Errors
    /// Returns an error if no such signal, or not that tick, was recorded.
    pub fn at(&self, tick: u64, path: &str) -> Result<u64, RecordError> {
        self.record.at(tick, path)
    }
}

impl<C: Circuit> Observer<C> for Recorder {
    fn sample(&mut self, now: &Sample<'_, C>) -> Result<ControlFlow<()>, RunError> {
        self.record.tick(now.tick, now.view())?;
        Ok(ControlFlow::Continue(()))
    }
}

/// Contents of a [`Recorder`], independent of the circuit's type.
#[derive(Debug)]
pub(super) struct Record {
    options: Range<u64>,
    leaves: Vec<Declaration>,
    by_path: HashMap<String, usize>,
    /// Leaf of each recorded signal.
    places: Vec<usize>,
    columns: Vec<Vec<u64>>,
    /// Recorded ticks.
    ticks: Range<u64>,
}

impl Record {
    pub(super) fn new(leaves: Vec<Declaration>, options: &Options) -> Result<Self, LayoutError> {
        let selected = select(&leaves, options.only.as_deref())?;
        let (mut places, mut kept) = (Vec::new(), Vec::new());
        for ((place, leaf), selected) in leaves.into_iter().enumerate().zip(selected) {
            if selected {
                places.push(place);
                kept.push(leaf);
            }
        }
        Ok(Record {
            options: options.ticks.clone(),
            by_path: kept
                .iter()
                .enumerate()
                .map(|(index, leaf)| (leaf.path(), index))
                .collect(),
            columns: vec![Vec::new(); kept.len()],
            leaves: kept,
            places,
            ticks: 0..0,
        })
    }

    /// Returns the recorded leaves.
    pub(super) fn places(&self) -> &[usize] {
        &self.places
    }

    /// Records a tick, if it is selected.
    pub(super) fn tick(&mut self, tick: u64, view: View<'_>) -> io::Result<()> {
        if !self.options.contains(&tick) {
            return Ok(());
        }
        if self.ticks.is_empty() {
            self.ticks = tick..tick;
        }
        if self.ticks.end != tick {
            let message = format!("tick {tick} does not follow tick {}", self.ticks.end - 1);
            return Err(io::Error::new(io::ErrorKind::InvalidInput, message));
        }
        self.ticks.end += 1;
        for (column, &place) in self.columns.iter_mut().zip(&self.places) {
            column.push(view.leaf(place));
        }
        Ok(())
    }

    fn index(&self, path: &str) -> Result<usize, RecordError> {
        self.by_path
            .get(path)
            .copied()
            .ok_or_else(|| RecordError::Unknown {
                path: path.to_owned(),
                near: nearest_paths(path, self.by_path.keys().map(String::as_str), NEAR),
            })
    }

    pub(super) fn column(&self, path: &str) -> Result<&[u64], RecordError> {
        Ok(self.column_at(self.index(path)?))
    }

    fn column_at(&self, index: usize) -> &[u64] {
        self.columns.get(index).map_or(&[], Vec::as_slice)
    }

    fn at(&self, tick: u64, path: &str) -> Result<u64, RecordError> {
        let column = self.column(path)?;
        let place = tick.checked_sub(self.ticks.start);
        place
            .and_then(|place| column.get(usize::try_from(place).ok()?))
            .copied()
            .ok_or_else(|| RecordError::Tick {
                tick,
                recorded: self.ticks.clone(),
            })
    }
}

fn did_you_mean(near: &[String]) -> String {
    if near.is_empty() {
        String::new()
    } else {
        format!("; near it: {}", near.join(", "))
    }
}
