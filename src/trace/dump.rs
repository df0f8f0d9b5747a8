//! Waves of a run, whatever their format.

use super::layout::Layout;
use super::walk::{Change, Walk};
use super::{Clock, Options};
use crate::hdl::{LeafView as View, RunError};
use std::io;
use std::ops::{ControlFlow, Range};

/// How changes are written.
pub(crate) trait Format {
    /// What is left of it when it has ended.
    type Out;
    /// Takes the changes of a tick, at which `clk` rises and falls.
    fn tick(&mut self, rise: u64, fall: u64, changes: &[Change]) -> io::Result<()>;
    /// Writes what is left, up to the end of the last tick, if there was one.
    fn finish(self, end: Option<u64>) -> io::Result<Self::Out>;
}

/// Waves under way.
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

    /// The first tick from this one on that is asked for.
    pub fn next_look(&self, tick: u64) -> u64 {
        let next = tick.max(self.ticks.start);
        match self.ticks.contains(&next) {
            true => next,
            false => u64::MAX,
        }
    }

    /// Sees a tick, if it is one of those that are asked for.
    pub fn sample(&mut self, tick: u64, view: View<'_>) -> Result<ControlFlow<()>, RunError> {
        if self.ticks.contains(&tick) {
            self.tick(tick, view)?;
        }
        Ok(ControlFlow::Continue(()))
    }

    /// The same of a circuit whose type is forgotten.
    pub fn tick(&mut self, tick: u64, view: View<'_>) -> io::Result<()> {
        let (rise, fall) = self.walk.tick(tick, view)?;
        self.format.tick(rise, fall, self.walk.changes())
    }

    /// Gives the last tick its full length.
    pub fn finish(self) -> io::Result<F::Out> {
        let end = self.walk.end()?;
        self.format.finish(end)
    }
}

/// What writes a dump looks at every tick of it.
macro_rules! observes {
    ([$($bounds:tt)*] $name:ty) => {
        impl<Watched: $crate::hdl::Circuit, $($bounds)*> $crate::hdl::Observer<Watched> for $name {
            fn next_look(&self, tick: u64) -> u64 {
                self.dump.next_look(tick)
            }

            fn sample(
                &mut self,
                now: &$crate::hdl::Sample<'_, Watched>,
            ) -> Result<std::ops::ControlFlow<()>, $crate::hdl::RunError> {
                self.dump.sample(now.tick, now.view())
            }
        }
    };
}

pub(super) use observes;
