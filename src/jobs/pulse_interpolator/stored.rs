//! Patterns that are in the memory and are never rewritten (¶0009, ¶0014): selected by command
//! (¶0019, ¶0026), or played without a control computer (¶0032).

use super::table::{MAX_UNITS, Table, UNIT_RANGE_TICKS};
use crate::circuits::pulse_interpolator::group::In;
use crate::circuits::pulse_interpolator::pattern_memory::Contents;
use crate::circuits::pulse_interpolator::{Group, Pattern, Variant, Widths};
use crate::hdl::{Value, zero};
use crate::settings::settings;

/// Memory with its patterns, and the patterns that are played.
#[derive(Debug, Clone)]
pub struct Stored {
    /// Group with the patterns in its memories.
    pub group: Group,
    /// First and last address of each pattern.
    pub places: Vec<[u64; 2]>,
    /// Patterns played, unit after unit.
    pub played: Table,
    /// Commands of the control computer; empty if the group plays by itself.
    pub commands: Vec<Pattern>,
    /// End of each pattern that is played, as a unit time.
    ends: Vec<usize>,
    /// Ticks in which the control computer writes T, with the T.
    pub writes: Vec<(u64, u32)>,
}

settings! {
    /// A unit time T that is written while patterns are played: a table `[[rewrite]]`.
    #[derive(Copy, Eq)]
    pub struct Rewrite {
        /// Unit time of the run in whose middle T is written, from 0.
        pub unit [required]: usize = 0, within 0..=MAX_UNITS - 1, "a unit time of the run";
        /// T from the next unit time on, up to the end of the pattern.
        pub period as "unit_ticks" [required]: u32 = 0, within UNIT_RANGE_TICKS, "4 or more, and enough for the half-periods";
    }
}

/// Least unit time in whose middle T can be written: its first ticks belong to a command.
const SHORTEST: u32 = 4;

/// Reason why patterns cannot be stored or played; patterns are counted from 0.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum StoredError {
    /// A pattern has other axes than the first.
    #[error("pattern {pattern} has {axes} axes, the first has {first}")]
    Axes {
        pattern: usize,
        /// Number of its axes.
        axes: usize,
        /// Number of axes of the first pattern.
        first: usize,
    },
    /// The memory is full.
    #[error("pattern {pattern} has {units} unit times where {room} are free")]
    Full {
        pattern: usize,
        /// Number of its unit times.
        units: usize,
        /// Number of free addresses.
        room: usize,
    },
    /// A group by itself plays a single pattern with a single T.
    #[error("{commands} commands")]
    Alone {
        /// Number of commands needed.
        commands: usize,
    },
    /// T is written at a time without effect, or is invalid.
    #[error("rewrite {rewrite} at unit time {unit}")]
    Rewrite {
        /// Rewrite, from 0.
        rewrite: usize,
        /// Its unit time.
        unit: usize,
    },
    /// There is nothing to play.
    #[error("nothing to play")]
    Nothing,
    /// The patterns to play have too many unit times.
    #[error("too many unit times")]
    TooLong,
}

impl Stored {
    /// Stores `patterns` one after the other, to be played in this `order`; with `alone` without a
    /// control computer.
    ///
    /// # Errors
    /// Returns a [`StoredError`].
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
        let (mut played, mut commands, mut ends) = (first.empty(), Vec::new(), Vec::new());
        for &pattern in order {
            let (table, [base, _]) = (patterns[pattern], places[pattern]);
            played.append(table).map_err(|_| StoredError::TooLong)?;
            commands.extend(table.patterns().iter().map(|part| {
                ends.push(ends.last().copied().unwrap_or(0) + part.length);
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
            ends,
            writes: Vec::new(),
        })
    }

    /// Makes the control computer write T while the patterns are played.
    ///
    /// # Errors
    /// Returns [`StoredError::Rewrite`] if the writes are not in order, a unit time is the last of
    /// its pattern, after which the next one sets its own T, or shorter than 4 ticks, or T does
    /// not fit its word.
    pub fn rewritten(mut self, rewrites: &[Rewrite]) -> Result<Self, StoredError> {
        // A pattern sets its own T.
        let mut periods: Vec<u32> = self.played.iter().map(|(period, _)| period).collect();
        let mut next = 0;
        for (index, rewrite) in rewrites.iter().enumerate() {
            let Rewrite { unit, period } = *rewrite;
            let refused = StoredError::Rewrite {
                rewrite: index,
                unit,
            };
            let end = self.ends.iter().copied().find(|end| unit < *end);
            let end = end.filter(|end| unit >= next && unit + 1 < *end);
            let fits = period > 0 && u64::from(period) >> self.group.widths.period == 0;
            let (Some(end), true) = (
                end,
                fits && periods.get(unit).is_some_and(|period| *period >= SHORTEST),
            ) else {
                return Err(refused);
            };
            periods[unit + 1..end].fill(period);
            next = unit + 1;
            // A silent unit time precedes the first.
            let begin: u64 = periods[..unit].iter().copied().map(u64::from).sum();
            let tick = self.group.period + begin + u64::from(periods[unit] / 2);
            self.writes.push((tick, period));
        }
        let played = self.played.with_periods(&periods);
        self.played = played.map_err(|_| StoredError::TooLong)?;
        Ok(self)
    }

    /// Returns the control computer for [`play_by`](super::job::play_by): it gives the next
    /// command as soon as none waits, and T in the ticks in which it is written. If there are such
    /// writes, it must be called in every tick.
    pub fn computer(&self) -> impl FnMut(bool) -> Option<In<Value>> {
        let quiet = zero(&self.group);
        let mut commands = self.commands.iter();
        let mut writes = self.writes.iter().peekable();
        let mut tick = 0;
        move |pending: bool| {
            tick += 1;
            if let Some((_, period)) = writes.next_if(|(at, _)| at + 1 == tick) {
                return Some(In {
                    write_period: true,
                    period: (*period).into(),
                    ..quiet.clone()
                });
            }
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
