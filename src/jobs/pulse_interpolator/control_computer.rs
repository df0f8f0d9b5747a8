//! The control computer 2, behavioural: plays a table of any length through the pattern memory.
//!
//! The memory is used as two halves. While the pattern in one half plays, the computer writes the
//! next words into the other, one word of one axis a tick, and leaves the command to go on there;
//! a half is written again only when the command that ended its pattern has been taken. A new unit
//! time T begins a new pattern. Where the computer does not keep up, unit times without pulses
//! stand between two patterns; no pulse is lost.

use super::table::{Table, Word};
use crate::kernel::zero;
use crate::logic::Sim;
use crate::pulse_interpolator::group::In;

/// Words of the table that are played as one pattern.
#[derive(Debug, Clone, Copy)]
struct Chunk {
    first: usize,
    length: usize,
    period: u32,
}

/// A control computer with a table to play.
#[derive(Debug, Clone)]
pub struct ControlComputer<'t, const A: usize> {
    axes: usize,
    words: &'t [Word],
    chunks: Vec<Chunk>,
    /// The chunk that is being written, or waits to be.
    chunk: usize,
    /// Words of it that are written, over all axes.
    written: usize,
    commands: usize,
}

impl<'t, const A: usize> ControlComputer<'t, A> {
    /// Words of an axis in one half of the memory.
    const HALF: usize = 1 << (A - 1);

    /// A computer that plays `table` once.
    pub fn new(table: &'t Table) -> Self {
        let chunks = table.patterns().iter().flat_map(|pattern| {
            (0..pattern.length).step_by(Self::HALF).map(|start| Chunk {
                first: pattern.first_unit + start,
                length: Self::HALF.min(pattern.length - start),
                period: pattern.period,
            })
        });
        ControlComputer {
            axes: table.axes(),
            words: table.words(),
            chunks: chunks.collect(),
            chunk: 0,
            written: 0,
            commands: 0,
        }
    }

    /// Whether every command is given.
    pub fn has_given_all(&self) -> bool {
        self.commands == self.chunks.len()
    }

    /// Its outputs in one tick, in which the group's port holds a command or not; none where all
    /// stay low until a command is taken, or for good.
    pub fn drive<const N: usize, const T: usize>(
        &mut self,
        pending: bool,
    ) -> Option<In<Sim, N, T, A>> {
        let chunk = self.chunks.get(self.chunk).copied()?;
        let taken = self.commands - usize::from(pending);
        let base = (self.chunk % 2 * Self::HALF) as u64;
        if self.written < chunk.length * self.axes {
            // The half is free when the pattern after the one it holds has begun.
            if self.chunk >= 2 && taken < self.chunk {
                return None;
            }
            let (unit, axis) = (self.written / self.axes, self.written % self.axes);
            let word = self.words[(chunk.first + unit) * self.axes + axis];
            self.written += 1;
            return Some(In {
                write: true.into(),
                write_axis: (axis as u64).into(),
                write_address: (base + unit as u64).into(),
                write_half_period: u64::from(word.half_period()).into(),
                write_direction: word.negative().into(),
                ..zero()
            });
        }
        if pending {
            return None;
        }
        self.chunk += 1;
        self.written = 0;
        self.commands += 1;
        Some(In {
            command: true.into(),
            base: base.into(),
            last: (base + chunk.length as u64 - 1).into(),
            run: true.into(),
            period: u64::from(chunk.period).into(),
            ..zero()
        })
    }
}
