//! Patterns that stand in the memory and are never rewritten (¶0009, ¶0014): chosen by command
//! (¶0019, ¶0026), or played without a control computer (¶0032).

use super::table::Table;
use crate::circuits::pulse_interpolator::group::In;
use crate::circuits::pulse_interpolator::pattern_memory::Contents;
use crate::circuits::pulse_interpolator::{Group, Pattern, Variant, Widths};
use crate::hdl::{Value, zero};

/// A memory with its patterns, and what is played of them.
#[derive(Debug, Clone)]
pub struct Stored {
    /// The group, with the patterns in its memories.
    pub group: Group,
    /// First and last address of each pattern.
    pub places: Vec<[u64; 2]>,
    /// What is played, unit after unit.
    pub played: Table,
    /// The commands of the control computer; none where the group plays by itself.
    pub commands: Vec<Pattern>,
}

/// Why patterns cannot be stored or played; they are counted from 0.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum StoredError {
    /// It has other axes than the first.
    #[error("pattern {pattern} has {axes} axes, the first has {first}")]
    Axes {
        /// The pattern.
        pattern: usize,
        /// Its axes.
        axes: usize,
        /// Those of the first.
        first: usize,
    },
    /// The memory is full.
    #[error("pattern {pattern} has {units} unit times where {room} are free")]
    Full {
        /// The pattern.
        pattern: usize,
        /// Its unit times.
        units: usize,
        /// The addresses left.
        room: usize,
    },
    /// A group plays one pattern of one T by itself.
    #[error("{commands} commands")]
    Alone {
        /// As many commands it would take.
        commands: usize,
    },
    /// Nothing is played.
    #[error("nothing to play")]
    Nothing,
    /// What is played has too many unit times.
    #[error("too many unit times")]
    TooLong,
}

impl Stored {
    /// Puts `patterns` into the memory one behind the other, to be played in this `order`; `alone`
    /// without a control computer.
    ///
    /// # Errors
    /// See [`StoredError`].
    pub fn new(
        patterns: &[&Table],
        order: &[usize],
        variant: Variant,
        alone: bool,
    ) -> Result<Self, StoredError> {
        let widths = Widths::default();
        let Some(first) = order.first().and_then(|first| patterns.get(*first)) else {
            return Err(StoredError::Nothing);
        };
        let axes = first.axes();
        let mut memories = vec![Contents::new(widths.half_period, widths.address); axes];
        let (mut places, mut base) = (Vec::new(), 0);
        for (pattern, table) in patterns.iter().enumerate() {
            if table.axes() != patterns[0].axes() {
                return Err(StoredError::Axes {
                    pattern,
                    axes: table.axes(),
                    first: patterns[0].axes(),
                });
            }
            let (units, room) = (table.units(), (1 << widths.address) - base);
            if units > room {
                return Err(StoredError::Full {
                    pattern,
                    units,
                    room,
                });
            }
            for (index, word) in table.words().enumerate() {
                let contents = &mut memories[index % axes];
                let address = base + index / axes;
                contents
                    .half_periods
                    .set(address, word.half_period().into());
                contents.directions.set(address, word.negative().into());
            }
            places.push([base as u64, (base + units - 1) as u64]);
            base += units;
        }
        let (mut played, mut commands) = (first.empty(), Vec::new());
        for &pattern in order {
            let (table, [base, _]) = (patterns[pattern], places[pattern]);
            played.append(table).map_err(|_| StoredError::TooLong)?;
            commands.extend(table.patterns().iter().map(|part| {
                let base = base + part.first_unit as u64;
                Pattern {
                    base,
                    last: base + part.length as u64 - 1,
                    cyclic: false,
                    period: part.period.into(),
                }
            }));
        }
        let begins = commands[0];
        let group = match alone {
            false => Group::new(axes, widths, variant, begins.period),
            true if commands.len() > 1 => {
                let commands = commands.len();
                return Err(StoredError::Alone { commands });
            }
            true => {
                commands.clear();
                Group::free_running(axes, widths, variant, begins)
            }
        };
        Ok(Stored {
            group: Group { memories, ..group },
            places,
            played,
            commands,
        })
    }

    /// What the control computer gives, for [`play_by`](super::job::play_by): the next command as
    /// soon as none waits.
    pub fn computer(&self) -> impl FnMut(bool) -> Option<In<Value>> {
        let quiet = zero(&self.group);
        let mut commands = self.commands.iter();
        move |pending: bool| {
            let pattern = (!pending).then(|| commands.next()).flatten()?;
            Some(In {
                command: true,
                base: pattern.base,
                last: pattern.last,
                run: true,
                period: pattern.period,
                ..quiet.clone()
            })
        }
    }
}
