//! Behavioural model of control computer 2: plays a table of any length through the pattern
//! memory.
//!
//! The memory is used as two halves. While the pattern in one half plays, the computer writes the
//! next words into the other, one word of one axis per tick, and leaves the command to continue
//! there. A half is written again only when the command that ended its pattern has been taken. A
//! new unit time T begins a new pattern. If the computer is too slow, unit times without pulses
//! are inserted between two patterns; no pulse is lost.

use super::table::Table;
use crate::circuits::pulse_interpolator::Group;
use crate::circuits::pulse_interpolator::group::In;
use crate::circuits::pulse_interpolator::pattern_memory::WritePort;
use crate::hdl::{Value, zero};

/// Words of the table that are played as one pattern.
#[derive(Debug, Clone, Copy)]
struct Chunk {
    first: usize,
    length: usize,
    period: u32,
}

/// Control computer with a table to play.
#[derive(Debug, Clone)]
pub struct ControlComputer<'t> {
    axes: usize,
    /// Number of words of an axis in one half of the memory.
    half: usize,
    /// Inputs of the group with all bits low.
    quiet: In<Value>,
    table: &'t Table,
    chunks: Vec<Chunk>,
    /// Chunk that is being written, or waits to be.
    chunk: usize,
    /// Number of its words written, over all axes.
    written: usize,
    commands: usize,
}

impl<'t> ControlComputer<'t> {
    /// Creates a computer that plays `table` once on a group.
    pub fn new(group: &Group, table: &'t Table) -> Self {
        let half = 1 << (group.widths.address - 1);
        let chunks = table.patterns().iter().flat_map(|pattern| {
            (0..pattern.length).step_by(half).map(move |start| Chunk {
                first: pattern.first_unit + start,
                length: half.min(pattern.length - start),
                period: pattern.period,
            })
        });
        ControlComputer {
            axes: table.axes(),
            half,
            quiet: zero(group),
            table,
            chunks: chunks.collect(),
            chunk: 0,
            written: 0,
            commands: 0,
        }
    }

    /// True if every command has been given.
    pub fn has_given_all(&self) -> bool {
        self.commands == self.chunks.len()
    }

    /// Returns its outputs in one tick, in which the group's port holds a command or not; `None`
    /// if all stay low until a command is taken, or for ever.
    pub fn drive(&mut self, pending: bool) -> Option<In<Value>> {
        let chunk = self.chunks.get(self.chunk).copied()?;
        let taken = self.commands - usize::from(pending);
        let base = (self.chunk % 2 * self.half) as u64;
        if self.written < chunk.length * self.axes {
            // The half is free when the pattern after the one in it has begun.
            if self.chunk >= 2 && taken < self.chunk {
                return None;
            }
            let (unit, axis) = (self.written / self.axes, self.written % self.axes);
            let word = self.table.word(chunk.first + unit, axis);
            self.written += 1;
            return Some(In {
                port: WritePort {
                    write: true,
                    write_axis: axis as u64,
                    write_address: base + unit as u64,
                    write_half_period: word.half_period().into(),
                    write_direction: word.negative(),
                },
                ..self.quiet.clone()
            });
        }
        if pending {
            return None;
        }
        self.chunk += 1;
        self.written = 0;
        self.commands += 1;
        Some(In {
            command: true,
            base,
            last: base + chunk.length as u64 - 1,
            run: true,
            period: chunk.period.into(),
            ..self.quiet.clone()
        })
    }
}
