//! Enable counter: one tick of enable in every `period` ticks, for whatever is slower than the
//! reference clock (scan, sample, velocity loop).
//!
//! ```text
//!            ┌────────────────┐
//!  period ──▶│ enable counter ├──▶ enable
//!            └────────────────┘
//! ```
//!
//! The end of a period is `count + 1 >= period`, so no period makes the counter run to its wrap.
//! A period of 0 counts as 1.

use crate::check::{Invariants, Specified};
use crate::kernel::{Circuit, Moment, Property};
use crate::logic::{Bit, Logic, Unsigned};
use crate::signals;

signals! {
    /// Ports in.
    pub struct In<L, const W: usize> {
        /// Ticks from one enable to the next; 0 counts as 1.
        pub period: L::U<W>,
    }
}

signals! {
    /// Flip-flops.
    pub struct Reg<L, const W: usize> {
        /// Ticks since the period began.
        pub(crate) count: L::U<W> as Analog = 0,
    }
}

signals! {
    /// Nets.
    pub struct Net<L, const W: usize> {
        /// `count + 1`: ticks of the period that are over after this one.
        next: L::U<W>,
        /// This is the last tick of the period.
        pub enable: L::Bit,
    }
}

/// Enable counter with a count of `W` bits; `enable` is high in the last tick of every `period`
/// ticks.
#[derive(Debug, Clone, Default)]
pub struct EnableCounter<const W: usize>;

impl<const W: usize> Circuit for EnableCounter<W> {
    const NAME: &'static str = "enable_counter";
    const ABOUT: &'static str = "divides the reference clock: one tick of enable per period";
    type In<L: Logic> = In<L, W>;
    type Reg<L: Logic> = Reg<L, W>;
    type Net<L: Logic> = Net<L, W>;

    fn comb<L: Logic>(&self, q: &Reg<L, W>, i: &In<L, W>) -> Net<L, W> {
        let next = q.count + 1;
        Net {
            next,
            enable: !next.below(i.period),
        }
    }

    fn next<L: Logic>(&self, _: Reg<L, W>, w: &Net<L, W>, _: &In<L, W>) -> Reg<L, W> {
        Reg {
            count: w.enable.mux(0.into(), w.next),
        }
    }

    fn properties<L: Logic>(
        &self,
        now: &Moment<'_, Self, L>,
        next: &Reg<L, W>,
    ) -> Vec<Property<L>> {
        let Moment { i, q, w } = now;
        let more = next.count.equals(q.count + 1) & q.count.below(next.count);
        let last = !q.count.below(i.period - 1) | i.period.is_zero();
        vec![
            Property::always(
                "enable is high in the last tick of a period, and only there",
                &["enable", "count", "period"],
                !(w.enable ^ last),
            ),
            Property::step(
                "a period begins after enable",
                &["count", "enable"],
                !w.enable | next.count.is_zero(),
            ),
            Property::step(
                "without enable the count goes up by one and stays below the period",
                &["count", "period"],
                w.enable | (more & next.count.below(i.period)),
            ),
            Property::always(
                "the count never reaches its greatest value",
                &["count"],
                q.count.below(u64::MAX.into()),
            ),
        ]
    }
}

impl<const W: usize> Specified for EnableCounter<W> {
    fn invariants(&self) -> Invariants<'_, Self> {
        Invariants::of(self)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::check::{Outcome, reach};
    use crate::kernel::Simulator;

    /// The ticks of enable, from the definition.
    #[test]
    fn enable_comes_every_period_ticks() {
        for period in 0..40u64 {
            let counter = EnableCounter::<6>;
            let mut simulator = Simulator::new(&counter).unwrap();
            for tick in 1..=200 {
                let i = In {
                    period: period.into(),
                };
                let (after, enable) = simulator.step(i, |now| now.w.enable.get());
                assert_eq!(enable, tick % period.max(1) == 0, "{period}, {tick}");
                simulator = after;
            }
        }
    }

    #[test]
    fn it_is_proved() {
        let circuit = EnableCounter::<4>;
        let all = circuit.invariants();
        let outcome = reach(&circuit, &all).run().expect("narrow enough");
        assert!(matches!(outcome, Outcome::Proof(_)), "{outcome}");
    }
}
