//! Runs of a model with arrays of inputs and outputs.

use super::replay::LONG;
use super::{Handle, Model, ModelError};
use crate::engine::InputChange;
use crate::netlist::Kind;

/// Number of ticks whose input changes are listed at a time.
const LISTED: usize = 1 << 16;

impl Model {
    /// Runs `ticks` ticks with an array of values, one per tick, for each of some input ports;
    /// returns an array for each signal in `seen`, settled, before the edge of each tick. Other
    /// input ports are constant.
    ///
    /// A value is a number of 64 bits. That of a signed signal is its two's complement:
    /// `value as i64` is the number.
    ///
    /// ```
    /// use motion_rtl::Model;
    ///
    /// let mut counter = Model::new("enable_counter", &["width=4".parse()?])?;
    /// let [period, enable] = [counter.find("period")?, counter.find("enable")?];
    /// let columns = counter.play(6, &[(period, &[2, 2, 2, 2, 4, 4])], &[enable])?;
    /// assert_eq!(columns, [[0, 1, 0, 1, 0, 0]]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// Returns an error if a handle is of another circuit, a signal to be set is not an input
    /// port, an array has not one value per tick, or a value does not fit its port. No tick
    /// happens then.
    pub fn play(
        &mut self,
        ticks: usize,
        inputs: &[(Handle, &[u64])],
        seen: &[Handle],
    ) -> Result<Vec<Vec<u64>>, ModelError> {
        let mut ports = Vec::with_capacity(inputs.len());
        for &(handle, values) in inputs {
            let port = self.port(handle)?;
            if values.len() != ticks {
                let (port, values) = (self.circuit.path(port), values.len());
                return Err(ModelError::Length {
                    port,
                    values,
                    ticks,
                });
            }
            for (tick, &value) in (self.tick..).zip(values) {
                let checked = self.circuit.ports.bits(port, value);
                checked.map_err(ModelError::at(tick))?;
            }
            ports.push((port, self.circuit.ports.mask(port), values));
        }
        let leaves = seen.iter().map(|&handle| self.leaf(handle));
        let leaves = leaves.collect::<Result<Vec<_>, _>>()?;
        if ticks as u64 >= LONG {
            self.watch(seen)?;
            return Ok(self.play_long(ticks, &ports, &leaves));
        }
        let mut columns = vec![Vec::with_capacity(ticks); leaves.len()];
        for tick in 0..ticks {
            for &(port, mask, values) in &ports {
                self.engine.drive(port, values[tick] & mask);
            }
            self.settled &= ports.is_empty();
            self.settle();
            for (&leaf, column) in leaves.iter().zip(&mut columns) {
                column.push(extended(self.engine.word(leaf), self.above(leaf)));
            }
            self.receive();
            self.edge();
        }
        Ok(columns)
    }

    /// Replays arrays of values for input ports, with the masks of their bits.
    fn play_long(
        &mut self,
        ticks: usize,
        ports: &[(usize, u64, &[u64])],
        leaves: &[usize],
    ) -> Vec<Vec<u64>> {
        let mut columns = vec![Vec::with_capacity(ticks); leaves.len()];
        let above: Vec<u32> = leaves.iter().map(|&leaf| self.above(leaf)).collect();
        let words = (0..self.ports().count()).map(|port| self.engine.port(port));
        let mut words: Vec<u64> = words.map(Option::unwrap_or_default).collect();
        let mut changes = Vec::new();
        let start = self.tick;
        for first in (0..ticks).step_by(LISTED) {
            let end = ticks.min(first + LISTED);
            changes.clear();
            for index in first..end {
                let tick = start + index as u64;
                for &(port, mask, values) in ports {
                    let word = values[index] & mask;
                    if std::mem::replace(&mut words[port], word) != word {
                        changes.push(InputChange { tick, port, word });
                    }
                }
            }
            let listed = (end - first) as u64;
            self.replay_tapped(listed, &changes, leaves, false, |now| {
                for (index, word) in now.changes() {
                    let column = &mut columns[index];
                    hold(column, (now.tick - start) as usize);
                    column.push(extended(word, above[index]));
                }
            });
            for column in &mut columns {
                hold(column, end);
            }
        }
        columns
    }

    /// Returns the number of bits above the sign of a leaf, 0 if it has none.
    fn above(&self, leaf: usize) -> u32 {
        let shape = self.shape_of(leaf);
        match shape.kind {
            Kind::Signed => 64 - shape.width as u32,
            Kind::Bit | Kind::Unsigned => 0,
        }
    }
}

/// Repeats the last value of a column until it has `ticks` values.
#[inline]
fn hold(column: &mut Vec<u64>, ticks: usize) {
    let last = column.last().copied().unwrap_or_default();
    column.resize(ticks, last);
}

/// Extends the sign of a word into the `above` bits above it.
#[inline]
fn extended(word: u64, above: u32) -> u64 {
    ((word << above) as i64 >> above) as u64
}
