//! Pulse generator 20 (¶0015): reference-clock counter 201 and comparator 202.
//!
//! ```text
//!                ┌─────────────────┐
//!  half_period ─▶│ pulse generator ├──▶ pulse
//!  unit_rst ────▶│                 │
//!                └─────────────────┘
//! ```
//!
//! `pulse` is the comparator's output before the flip-flop 40, so that the toggle and the
//! flip-flop change in the same tick: n ticks into the unit time, 2n, … RST acts on the registers
//! only: `equal` and `pulse` may be high in its tick.
//!
//! Departures: a half-period of 0 gives no pulse and clears counter and toggle. In the *safe* variant
//! RST clears them too, and "equal" is `count + 1 >= half_period`, so no n makes the counter run to
//! its wrap. The *literal* variant ignores RST (¶0017 clears the flip-flop 40 alone) and has
//! `count + 1 == half_period`.

use super::Variant;
use crate::check::{Invariants, Specified};
use crate::kernel::{Circuit, Moment, Property};
use crate::logic::{Bit, Logic, Unsigned};
use crate::signals;

signals! {
    /// Ports in.
    pub struct In<L, const N: usize> {
        /// Half-period of the pulse signal in ticks; 0 for no pulse.
        pub half_period: L::U<N>,
        /// Last tick of the unit time.
        pub unit_rst: L::Bit,
    }
}

signals! {
    /// Flip-flops.
    pub struct Reg<L, const N: usize> {
        /// 201: ticks since the last toggle.
        pub(crate) count: L::U<N> as Analog = 0,
        /// 202: the level between toggles.
        pub(crate) toggle: L::Bit = 0,
    }
}

signals! {
    /// Nets.
    pub struct Net<L, const N: usize> {
        /// `count + 1`: ticks since the last toggle, this one included.
        next: L::U<N>,
        /// 202: the half-period is over with this tick. The name is the patent's; safe is `>=`.
        equal: L::Bit,
        /// The pulse signal; the flip-flop 40 shows it a tick later, except in the tick after RST.
        pub pulse: L::Bit,
    }
}

/// Pulse generator 20 with a half-period of `N` bits.
#[derive(Debug, Clone, Default)]
pub struct PulseGenerator<const N: usize> {
    /// What RST clears.
    pub variant: Variant,
}

impl<const N: usize> Circuit for PulseGenerator<N> {
    const NAME: &'static str = "pulse_generator";
    const ABOUT: &'static str = "toggles its pulse signal every half-period";
    type In<L: Logic> = In<L, N>;
    type Reg<L: Logic> = Reg<L, N>;
    type Net<L: Logic> = Net<L, N>;

    fn comb<L: Logic>(&self, q: &Reg<L, N>, i: &In<L, N>) -> Net<L, N> {
        let next = q.count + 1;
        let (over, exactly) = (!next.below(i.half_period), next.equals(i.half_period));
        let none = i.half_period.is_zero();
        let equal = match self.variant {
            Variant::Safe => over,
            Variant::Literal => exactly | none,
        };
        let turned = q.toggle ^ equal;
        Net {
            next,
            equal,
            pulse: turned & !none,
        }
    }

    fn next<L: Logic>(&self, _: Reg<L, N>, w: &Net<L, N>, i: &In<L, N>) -> Reg<L, N> {
        match self.variant {
            Variant::Safe => Reg {
                count: (w.equal | i.unit_rst).mux(0.into(), w.next),
                toggle: w.pulse & !i.unit_rst,
            },
            Variant::Literal => Reg {
                count: w.equal.mux(0.into(), w.next),
                toggle: w.pulse,
            },
        }
    }

    fn properties<L: Logic>(
        &self,
        now: &Moment<'_, Self, L>,
        next: &Reg<L, N>,
    ) -> Vec<Property<L>> {
        let Moment { i, q, w } = now;
        let none = i.half_period.is_zero();
        let over = !q.count.below(i.half_period - 1);
        let toggles = w.pulse ^ q.toggle;
        vec![
            Property::always(
                "a half-period of 0 gives no pulse",
                &["half_period", "pulse"],
                !(none & w.pulse),
            ),
            Property::step(
                "RST clears the counter and the toggle",
                &["count", "toggle", "unit_rst"],
                !i.unit_rst | (next.count.is_zero() & !next.toggle),
            ),
            Property::step(
                "the count stays below the half-period",
                &["count", "half_period"],
                next.count.below(i.half_period) | next.count.is_zero(),
            ),
            Property::step(
                "the pulse signal toggles when the half-period is over, and only then",
                &["pulse", "toggle", "count"],
                none | !(toggles ^ over),
            ),
            Property::step(
                "between two RST the toggle follows the pulse signal",
                &["toggle", "pulse"],
                i.unit_rst | !(next.toggle ^ w.pulse),
            ),
            Property::always(
                "the count never reaches its greatest value",
                &["count"],
                q.count.below(u64::MAX.into()),
            ),
        ]
    }
}

impl<const N: usize> Specified for PulseGenerator<N> {
    fn invariants(&self) -> Invariants<'_, Self> {
        Invariants::of(self)
    }
}
