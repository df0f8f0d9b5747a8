//! Observers of a run.

use super::Sample;
use crate::engine::{EngineError, InputError};
use crate::hdl::Circuit;
use std::io;
use std::ops::ControlFlow;

/// Reason why a run ended early.
#[derive(thiserror::Error)]
#[non_exhaustive]
pub enum RunError {
    /// The circuit cannot be run.
    #[error(transparent)]
    Engine(#[from] EngineError),
    /// The waves could not be written.
    #[error("the waves could not be written: {0}")]
    Waves(#[from] io::Error),
    /// Another file that grows with the run could not be written.
    #[error("the {file} could not be written: {error}")]
    File {
        /// Kind of the file, such as `time series`.
        file: &'static str,
        /// Error of its writer.
        #[source]
        error: io::Error,
    },
    /// An input does not fit its port.
    #[error("tick {tick}: {error}")]
    Input {
        /// Tick of the input.
        tick: u64,
        /// Port and value that do not fit.
        #[source]
        error: InputError,
    },
    /// A monitor found a violation.
    #[error("tick {tick}: {message}{}", at_fault(signals))]
    Violation {
        /// Tick at fault.
        tick: u64,
        /// Signals at fault.
        signals: Vec<String>,
        /// Description of the violation.
        message: String,
    },
}

crate::netlist::debug_as_display!(RunError);

/// Returns the signals at fault in brackets, or nothing if there are none.
pub(crate) fn at_fault(signals: &[String]) -> String {
    match signals {
        [] => String::new(),
        signals => format!(" (signals: {})", signals.join(", ")),
    }
}

impl RunError {
    /// Returns a conversion of the error of this kind of file.
    pub fn of_file(file: &'static str) -> impl FnOnce(io::Error) -> RunError {
        move |error| RunError::File { file, error }
    }

    /// Returns a conversion of an input error at this tick.
    pub(crate) fn at(tick: u64) -> impl FnOnce(InputError) -> RunError {
        move |error| RunError::Input { tick, error }
    }
}

/// Signals that an observer reads beyond those that are watched anyway.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Needs {
    /// True if it reads all signals; see [`Observer::next_whole`].
    pub all: bool,
    /// Leaves of the circuit and of the signals beside it, which are watched in every tick.
    pub leaves: Vec<usize>,
}

impl Needs {
    /// No signal.
    pub const NONE: Self = Needs {
        all: false,
        leaves: Vec::new(),
    };

    /// All signals.
    pub const ALL: Self = Needs {
        all: true,
        leaves: Vec::new(),
    };

    /// Returns what both need.
    #[must_use]
    pub fn and(self, other: Self) -> Self {
        Needs {
            all: self.all || other.all,
            leaves: [self.leaves, other.leaves].concat(),
        }
    }
}

impl From<Vec<usize>> for Needs {
    fn from(leaves: Vec<usize>) -> Self {
        Needs { all: false, leaves }
    }
}

/// All signals or none.
impl From<bool> for Needs {
    fn from(all: bool) -> Self {
        match all {
            true => Needs::ALL,
            false => Needs::NONE,
        }
    }
}

/// Observes the ticks of a run: writes waves, records, checks, stops.
///
/// `()` observes nothing and costs nothing; a tuple passes each tick to its parts in turn.
#[diagnostic::on_unimplemented(
    message = "`{Self}` does not observe runs of `{C}`",
    note = "observers are `()`, `Vcd`, `Fst`, `Recorder`, `Monitor`, `Each`, `StopWhen`, references to them, \
            and tuples of two to four of them"
)]
pub trait Observer<C: Circuit> {
    /// Returns the first tick from `tick` on that the observer needs; [`sample`](Self::sample)
    /// ignores others. Where ticks are [looked](super::Simulator::look) at one by one, ticks that
    /// no observer needs are not shown.
    fn next_look(&self, tick: u64) -> u64 {
        tick
    }

    /// True if the observer takes this tick, where it is looked at anyway. An observer of changes
    /// takes every such tick, and needs few.
    fn looks(&self, tick: u64) -> bool {
        self.next_look(tick) == tick
    }

    /// Returns the signals that are to be [watched](super::Simulator::watching) for the observer.
    fn needs(&self) -> Needs {
        Needs::ALL
    }

    /// Returns the first tick from `tick` on in which the observer reads all signals, if it
    /// [needs](Self::needs) all. Until then a run may watch fewer.
    fn next_whole(&self, tick: u64) -> u64 {
        match self.needs().all {
            true => self.next_look(tick),
            false => u64::MAX,
        }
    }

    /// Receives one tick; `Break` ends the run after this tick's edge.
    ///
    /// # Errors
    /// Ends the run with the returned error.
    fn sample(&mut self, now: &Sample<'_, C>) -> Result<ControlFlow<()>, RunError>;
}

impl<C: Circuit> Observer<C> for () {
    fn next_look(&self, _: u64) -> u64 {
        u64::MAX
    }

    fn needs(&self) -> Needs {
        Needs::NONE
    }

    fn sample(&mut self, _: &Sample<'_, C>) -> Result<ControlFlow<()>, RunError> {
        Ok(ControlFlow::Continue(()))
    }
}

impl<C: Circuit, O: Observer<C> + ?Sized> Observer<C> for &mut O {
    fn next_look(&self, tick: u64) -> u64 {
        (**self).next_look(tick)
    }

    fn looks(&self, tick: u64) -> bool {
        (**self).looks(tick)
    }

    fn needs(&self) -> Needs {
        (**self).needs()
    }

    fn next_whole(&self, tick: u64) -> u64 {
        (**self).next_whole(tick)
    }

    fn sample(&mut self, now: &Sample<'_, C>) -> Result<ControlFlow<()>, RunError> {
        (**self).sample(now)
    }
}

impl<C: Circuit, O: Observer<C>> Observer<C> for Option<O> {
    fn next_look(&self, tick: u64) -> u64 {
        self.as_ref()
            .map_or(u64::MAX, |observer| observer.next_look(tick))
    }

    fn looks(&self, tick: u64) -> bool {
        self.as_ref().is_some_and(|observer| observer.looks(tick))
    }

    fn needs(&self) -> Needs {
        self.as_ref().map_or(Needs::NONE, Observer::needs)
    }

    fn next_whole(&self, tick: u64) -> u64 {
        self.as_ref()
            .map_or(u64::MAX, |observer| observer.next_whole(tick))
    }

    fn sample(&mut self, now: &Sample<'_, C>) -> Result<ControlFlow<()>, RunError> {
        match self {
            Some(observer) => observer.sample(now),
            None => Ok(ControlFlow::Continue(())),
        }
    }
}

macro_rules! together {
    ($($part:ident $place:tt),+) => {
        impl<C: Circuit, $($part: Observer<C>),+> Observer<C> for ($($part,)+) {
            fn next_look(&self, tick: u64) -> u64 {
                u64::MAX$(.min(self.$place.next_look(tick)))+
            }

            fn looks(&self, tick: u64) -> bool {
                $(self.$place.looks(tick))||+
            }

            fn needs(&self) -> Needs {
                Needs::NONE$(.and(self.$place.needs()))+
            }

            fn next_whole(&self, tick: u64) -> u64 {
                u64::MAX$(.min(self.$place.next_whole(tick)))+
            }

            fn sample(&mut self, now: &Sample<'_, C>) -> Result<ControlFlow<()>, RunError> {
                let mut stop = false;
                $( stop |= self.$place.sample(now)?.is_break(); )+
                Ok(if stop { ControlFlow::Break(()) } else { ControlFlow::Continue(()) })
            }
        }
    };
}

together!(A 0, B 1);
together!(A 0, B 1, D 2);
together!(A 0, B 1, D 2, E 3);

/// Calls a function with every tick of a run.
///
/// ```
/// use motion_rtl::circuits::blocks::EnableCounter;
/// use motion_rtl::hdl::zero;
/// use motion_rtl::sim::{Each, Sample, Simulator};
///
/// let counter = EnableCounter { width: 4 };
/// let mut inputs = zero(&counter);
/// inputs.period = 3;
/// let mut enables = Vec::new();
/// let each = Each(|now: &Sample<'_, EnableCounter>| enables.push(now.w.enable));
/// Simulator::new(&counter)?.run(6, |_, _| inputs.clone(), each)?;
/// assert_eq!(enables, [false, false, true, false, false, true]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct Each<F>(pub F);

impl<C: Circuit, F: FnMut(&Sample<'_, C>)> Observer<C> for Each<F> {
    fn sample(&mut self, now: &Sample<'_, C>) -> Result<ControlFlow<()>, RunError> {
        (self.0)(now);
        Ok(ControlFlow::Continue(()))
    }
}

/// Ends a run after the first tick in which the condition holds.
#[derive(Debug, Clone)]
pub struct StopWhen<F>(pub F);

impl<C: Circuit, F: FnMut(&Sample<'_, C>) -> bool> Observer<C> for StopWhen<F> {
    fn sample(&mut self, now: &Sample<'_, C>) -> Result<ControlFlow<()>, RunError> {
        Ok(if (self.0)(now) {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        })
    }
}
