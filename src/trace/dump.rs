//! Waves of a run in any format.

use super::layout::Layout;
use super::walk::{Change, Walk};
use super::{Clock, Options};
use crate::sim::{LeafView as View, RunError};
use std::io;
use std::ops::{ControlFlow, Range};

/// Writer of changes in a format.
pub(crate) trait Format {
    /// Result after the end.
    type Out;
    /// Writes the changes of a tick, in which `clk` rises and falls at these times.
    fn tick(&mut self, rise: u64, fall: u64, changes: &[Change]) -> io::Result<()>;
    /// Writes the rest up to the end of the last tick, if there was one.
    fn finish(self, end: Option<u64>) -> io::Result<Self::Out>;
}

/// Waves being written.
#[derive(Debug)]
pub(crate) struct Dump<F> {
    ticks: Range<u64>,
    walk: Walk,
    format: F,
}

impl<F: Format> Dump<F> {
    pub fn new(layout: &Layout, clock: Clock, options: &Options, format: F) -> Self {
        Dump {
            ticks: options.ticks.clone(),
            walk: Walk::new(layout, clock),
            format,
        }
    }

    /// Returns the first selected tick from `tick` on.
    pub fn next_look(&self, tick: u64) -> u64 {
        let next = tick.max(self.ticks.start);
        match self.ticks.contains(&next) {
            true => next,
            false => u64::MAX,
        }
    }

    /// Writes a tick if it is selected.
    pub fn sample(&mut self, tick: u64, view: View<'_>) -> Result<ControlFlow<()>, RunError> {
        if self.ticks.contains(&tick) {
            self.tick(tick, view)?;
        }
        Ok(ControlFlow::Continue(()))
    }

    /// Writes a tick.
    pub fn tick(&mut self, tick: u64, view: View<'_>) -> io::Result<()> {
        let (rise, fall) = self.walk.tick(tick, view)?;
        self.format.tick(rise, fall, self.walk.changes())
    }

    /// Gives the last tick its full length and ends the waves.
    pub fn finish(self) -> io::Result<F::Out> {
        let end = self.walk.end()?;
        self.format.finish(end)
    }
}

/// Makes the writer of a dump observe every tick.
macro_rules! observes {
    ([$($bounds:tt)*] $name:ty) => {
        impl<Watched: $crate::hdl::Circuit, $($bounds)*> $crate::sim::Observer<Watched> for $name {
            fn next_look(&self, tick: u64) -> u64 {
                self.dump.next_look(tick)
            }

            fn sample(
                &mut self,
                now: &$crate::sim::Sample<'_, Watched>,
            ) -> Result<std::ops::ControlFlow<()>, $crate::sim::RunError> {
                self.dump.sample(now.tick, now.view())
            }
        }
    };
}

pub(super) use observes;
