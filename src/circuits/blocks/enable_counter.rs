//! Enable counter: one tick of enable in every `period` ticks, for blocks slower than the
//! reference clock (scan, sample, velocity loop).
//!
//! ```text
//!            ┌────────────────┐
//!  period ──▶│ enable counter ├──▶ enable
//!            └────────────────┘
//! ```
//!
//! This is also the unit-time counter 30 of JP3640909B2 (¶0016), which counts the reference clock
//! and pulses RST once per unit time: `period` is T, which the surrounding circuit keeps constant
//! between two RST, and `enable` is RST.
//!
//! The end of a period is `count + 1 >= period`, so no period makes the counter run to its wrap.
//! A period of 0 counts as 1.
//!
//! Departures: the text has RST on "equal".

use crate::prelude::*;

/// Enable counter; `enable` is high in the last tick of every `period` ticks.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct EnableCounter {
    /// Width of the count in bits.
    pub width: usize,
}

signals! { for EnableCounter as c;
    /// Input ports.
    pub struct In {
        /// Ticks from one enable to the next; 0 counts as 1.
        pub period: U(c.width),
    }
    /// Flip-flops.
    pub struct Reg {
        /// Ticks since the period began.
        pub(crate) count: U(c.width) as Analog = 0,
    }
    /// Nets.
    pub struct Net {
        /// `count + 1`: ticks of the period, including this one.
        next: U(c.width),
        /// High in the last tick of the period.
        pub enable: Bit,
    }
}

impl Circuit for EnableCounter {
    const NAME: &'static str = "enable_counter";
    const ABOUT: &'static str = "divides the reference clock: one tick of enable per period";
    records!(In, Reg, Net);

    fn tick(&self, i: In, q: Reg, _: Nothing) -> (Net, Reg<Edge>) {
        let next = q.count + 1;
        let enable = !next.below(i.period);
        let count = enable.mux(0, next);
        (Net { next, enable }, Reg { count })
    }

    fn properties(&self, now: &Moment<Self>) -> Vec<Property> {
        let (i, q, w, next) = (&now.i, &now.q, &now.w, &now.next.q);
        let more = next.count.equals(q.count + 1) & q.count.below(next.count);
        let last = !q.count.below(i.period - 1) | i.period.is_zero();
        vec![
            Property::always(
                "enable is high in the last tick of a period, and only there",
                &["enable", "count", "period"],
                w.enable.equals(last),
            ),
            Property::step(
                "a period begins after enable",
                &["count", "enable"],
                w.enable.implies(next.count.is_zero()),
            ),
            Property::step(
                "without enable the count goes up by one and stays below the period",
                &["count", "period"],
                w.enable | (more & next.count.below(i.period)),
            ),
            Property::always(
                "the count never reaches its greatest value",
                &["count"],
                q.count.below(u64::MAX.cut(self.width)),
            ),
        ]
    }
}

impl Specified for EnableCounter {}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::trace::LastTicks;

    /// The ticks of enable, from the definition.
    #[test]
    fn enable_comes_every_period_ticks() {
        for period in 0..40 {
            let mut simulator = LastTicks::simulator(&EnableCounter { width: 6 }).unwrap();
            for tick in 1..=200 {
                let enable = simulator
                    .step_with(&In { period }, |now| now.w.enable)
                    .unwrap();
                assert_eq!(enable, tick % period.max(1) == 0, "{period}, {tick}");
            }
        }
    }

    #[test]
    fn it_is_proved() {
        let circuit = EnableCounter { width: 4 };
        let all = circuit.invariants();
        let outcome = reach(&circuit, &all).run().expect("narrow enough");
        assert!(matches!(outcome, Outcome::Proof(_)), "{outcome}");
    }
}
