//! Unit-time counter 30 (¶0016): counts the reference clock and pulses RST once per unit time.
//!
//! ```text
//!            ┌───────────────────┐
//!  period ──▶│ unit-time counter ├──▶ unit_rst
//!            └───────────────────┘
//! ```
//!
//! Departures: the text has RST on "equal"; here it is `count + 1 >= period`, so no T makes the
//! counter run to its wrap. T = 0 counts as 1.

use crate::check::{Invariants, Specified};
use crate::kernel::{Circuit, Moment, Property};
use crate::logic::{Bit, Logic, Unsigned};
use crate::signals;

signals! {
    /// Ports in.
    pub struct In<L, const T: usize> {
        /// Unit time in ticks, which the surrounding circuit keeps constant between two RST.
        pub period: L::U<T>,
    }
}

signals! {
    /// Flip-flops.
    pub struct Reg<L, const T: usize> {
        /// Ticks since the unit time began.
        pub(crate) count: L::U<T> as Analog = 0,
    }
}

signals! {
    /// Nets.
    pub struct Net<L, const T: usize> {
        /// `count + 1`: ticks of the unit time that are over after this one.
        next: L::U<T>,
        /// RST: this is the last tick of the unit time.
        pub unit_rst: L::Bit,
    }
}

/// Unit-time counter 30 with a count of `T` bits; `unit_rst` is high in the last tick of every
/// `period` ticks.
#[derive(Debug, Clone, Default)]
pub struct UnitTimeCounter<const T: usize>;

impl<const T: usize> Circuit for UnitTimeCounter<T> {
    const NAME: &'static str = "unit_time_counter";
    const ABOUT: &'static str = "counts the reference clock, pulses RST once per unit time";
    type In<L: Logic> = In<L, T>;
    type Reg<L: Logic> = Reg<L, T>;
    type Net<L: Logic> = Net<L, T>;

    fn comb<L: Logic>(&self, q: &Reg<L, T>, i: &In<L, T>) -> Net<L, T> {
        let next = q.count + 1;
        Net {
            next,
            unit_rst: !next.below(i.period),
        }
    }

    fn next<L: Logic>(&self, _: Reg<L, T>, w: &Net<L, T>, _: &In<L, T>) -> Reg<L, T> {
        Reg {
            count: w.unit_rst.mux(0.into(), w.next),
        }
    }

    fn properties<L: Logic>(
        &self,
        now: &Moment<'_, Self, L>,
        next: &Reg<L, T>,
    ) -> Vec<Property<L>> {
        let Moment { i, q, w } = now;
        let up = next.count.equals(q.count + 1) & q.count.below(next.count);
        vec![
            Property::step(
                "the count starts again after RST",
                &["count", "unit_rst"],
                !w.unit_rst | next.count.is_zero(),
            ),
            Property::step(
                "between two RST the count goes up by one and stays below T",
                &["count", "period"],
                w.unit_rst | (up & next.count.below(i.period)),
            ),
            Property::always(
                "the count never reaches its greatest value",
                &["count"],
                q.count.below(u64::MAX.into()),
            ),
        ]
    }
}

impl<const T: usize> Specified for UnitTimeCounter<T> {
    fn invariants(&self) -> Invariants<'_, Self> {
        Invariants::of(self)
    }
}
