use super::layout::select;
use super::{LayoutError, Options};
use crate::hdl;
use crate::hdl::{Declaration, Described, LeafView as View, RunError};
use std::collections::HashMap;
use std::io;
use std::ops::{ControlFlow, Range};
use strsim::osa_distance;

/// Keeps what a run does in memory: a column of values for every chosen signal.
///
/// It costs eight bytes per signal and tick, and every word of a memory is a signal: choose the
/// signals, or the ticks, of a long run.
#[derive(Debug)]
pub struct Recorder {
    record: Record,
}

/// What was asked of a [`Recorder`] that it does not hold.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum RecordError {
    /// No such signal, or one that was not chosen.
    #[error("no signal {path} was recorded{}", did_you_mean(near))]
    Unknown {
        /// The path asked for.
        path: String,
        /// The recorded paths that resemble it most, the nearest first.
        near: Vec<String>,
    },
    /// A tick that was not recorded.
    #[error("tick {tick} was not recorded; recorded: {}..{}", recorded.start, recorded.end)]
    Tick {
        /// The tick asked for.
        tick: u64,
        /// The ticks there are, half-open.
        recorded: Range<u64>,
    },
}

impl Recorder {
    /// A recorder for the ticks and signals that `options` chooses.
    ///
    /// # Errors
    /// A chosen path that does not exist.
    pub fn new(circuit: &impl Described, options: &Options) -> Result<Self, LayoutError> {
        Ok(Recorder {
            record: Record::new(circuit.outlined().1.leaves, options)?,
        })
    }
}

impl Recorder {
    /// The recorded signals, in the order of the walk.
    pub fn leaves(&self) -> &[Declaration] {
        &self.record.leaves
    }

    /// The recorded ticks, half-open.
    pub fn ticks(&self) -> Range<u64> {
        self.record.ticks.clone()
    }

    /// Where a signal stands in [`leaves`](Recorder::leaves).
    ///
    /// # Errors
    /// No such signal was recorded.
    pub fn index(&self, path: &str) -> Result<usize, RecordError> {
        self.record.index(path)
    }

    /// The values of a signal, one a tick; words of less than 64 bits have zeros above.
    ///
    /// # Errors
    /// No such signal was recorded.
    pub fn column(&self, path: &str) -> Result<&[u64], RecordError> {
        Ok(self.column_at(self.index(path)?))
    }

    /// The values of the signal at `index` of [`leaves`](Recorder::leaves); none where the index
    /// is past the end.
    pub fn column_at(&self, index: usize) -> &[u64] {
        self.record.column_at(index)
    }

    /// The value of a signal at a tick.
    ///
    /// # Errors
    /// No such signal, or not that tick, was recorded.
    pub fn at(&self, tick: u64, path: &str) -> Result<u64, RecordError> {
        self.record.at(tick, path)
    }
}

impl<C: hdl::Circuit> hdl::Observer<C> for Recorder {
    fn sample(&mut self, now: &hdl::Sample<'_, C>) -> Result<ControlFlow<()>, RunError> {
        self.record.tick(now.tick, now.view())?;
        Ok(ControlFlow::Continue(()))
    }
}

/// What a [`Recorder`] keeps, whatever the circuit.
#[derive(Debug)]
pub(super) struct Record {
    options: Range<u64>,
    leaves: Vec<Declaration>,
    by_path: HashMap<String, usize>,
    /// For every one of them its place in the walk.
    places: Vec<usize>,
    columns: Vec<Vec<u64>>,
    /// The ticks recorded.
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

    /// The places in the walk that it keeps.
    pub(super) fn places(&self) -> &[usize] {
        &self.places
    }

    /// Keeps a tick, if it is one of the chosen.
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
                near: near(path, self.by_path.keys().map(String::as_str)),
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

/// The candidates that resemble `wanted` most, at most five, the nearest first.
pub(super) fn near<'a>(wanted: &str, candidates: impl Iterator<Item = &'a str>) -> Vec<String> {
    let last = |path: &'a str| path.rsplit('.').next().unwrap_or(path);
    let wanted_last = wanted.rsplit('.').next().unwrap_or(wanted);
    let mut ranked: Vec<_> = candidates
        .map(|path| {
            (
                osa_distance(wanted_last, last(path)),
                osa_distance(wanted, path),
                path,
            )
        })
        .collect();
    ranked.sort_unstable();
    ranked.truncate(5);
    ranked
        .into_iter()
        .map(|(.., path)| path.to_owned())
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_names_come_first() {
        let paths = [
            "top.count",
            "top.a.counter",
            "top.phase",
            "top.x",
            "top.y",
            "top.z",
        ];
        let near = near("top.cuont", paths.into_iter());
        assert_eq!(near[0], "top.count");
        assert_eq!(near.len(), 5);
    }
}
