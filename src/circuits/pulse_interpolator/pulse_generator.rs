//! Pulse generator 20 (¶0015): reference-clock counter 201 and comparator 202.
//!
//! ```text
//!                ┌─────────────────┐
//!  half_period ─▶│ pulse generator ├──▶ pulse
//!  unit_rst ────▶│                 │
//!                └─────────────────┘
//! ```
//!
//! `pulse` is the comparator's output before the flip-flop 40. So the toggle and the flip-flop
//! change in the same tick: n, 2n, … ticks into the unit time. RST acts on the registers only:
//! `equal` and `pulse` may be high in the tick of RST.
//!
//! Departures: a half-period of 0 gives no pulse and clears counter and toggle. In the *safe* variant
//! RST clears them too, and "equal" is `count + 1 >= half_period`, so no n makes the counter run to
//! its wrap. The *literal* variant ignores RST (¶0017 clears the flip-flop 40 alone) and has
//! `count + 1 == half_period`.

use super::Variant;
use crate::prelude::*;

/// Pulse generator 20.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PulseGenerator {
    /// Width of a half-period in bits.
    pub width: usize,
    /// Registers that RST clears.
    pub variant: Variant,
}

signals! { for PulseGenerator as c;
    /// Input ports.
    pub struct In {
        /// Half-period of the pulse signal in ticks; 0 for no pulse.
        pub half_period: U(c.width),
        /// RST: high in the last tick of the unit time.
        pub unit_rst: Bit,
    }
    /// Flip-flops.
    pub struct Reg {
        /// 201: ticks since the last toggle.
        pub(crate) count: U(c.width) as Analog = 0,
        /// 202: level of the pulse signal since the last toggle.
        pub(crate) toggle: Bit = 0,
    }
    /// Nets.
    pub struct Net {
        /// `count + 1`: ticks since the last toggle, including this one.
        next: U(c.width),
        /// 202: the half-period ends with this tick. The patent's name; the safe variant compares
        /// with `>=`.
        equal: Bit,
        /// Pulse signal; the flip-flop 40 outputs it one tick later, except in the tick after RST.
        pub pulse: Bit,
    }
}

impl Circuit for PulseGenerator {
    const NAME: &'static str = "pulse_generator";
    const ABOUT: &'static str = "toggles its pulse signal every half-period";
    records!(In, Reg, Net);

    fn tick(&self, i: In, q: Reg, _: Nothing) -> (Net, Reg<Edge>) {
        let next = q.count + 1;
        let none = i.half_period.is_zero();
        let equal = match self.variant {
            Variant::Safe => !next.below(i.half_period),
            Variant::Literal => next.equals(i.half_period) | none,
        };
        let turned = q.toggle ^ equal;
        let pulse = turned & !none;
        let (clear, toggle) = match self.variant {
            Variant::Safe => (equal | i.unit_rst, pulse & !i.unit_rst),
            Variant::Literal => (equal, pulse),
        };
        let count = clear.mux(0, next);
        (Net { next, equal, pulse }, Reg { count, toggle })
    }

    fn properties(&self, now: &Moment<Self>) -> Vec<Property> {
        let (i, q, w, next) = (&now.i, &now.q, &now.w, &now.next.q);
        let none = i.half_period.is_zero();
        let over = !q.count.below(i.half_period - 1);
        let toggles = w.pulse ^ q.toggle;
        vec![
            Property::always(
                "pulse is low if half_period is 0",
                &["half_period", "pulse"],
                !(none & w.pulse),
            ),
            Property::step(
                "RST clears count and toggle",
                &["count", "toggle", "unit_rst"],
                i.unit_rst.implies(next.count.is_zero() & !next.toggle),
            ),
            Property::step(
                "count stays below half_period or becomes 0",
                &["count", "half_period"],
                next.count.below(i.half_period) | next.count.is_zero(),
            ),
            Property::step(
                "pulse toggles at the end of each half-period, and only there",
                &["pulse", "toggle", "count"],
                none | toggles.equals(over),
            ),
            Property::step(
                "toggle takes the value of pulse, except at RST",
                &["toggle", "pulse"],
                i.unit_rst | next.toggle.equals(w.pulse),
            ),
            Property::always(
                "count never reaches its greatest value",
                &["count"],
                q.count.below(u64::MAX.cut(self.width)),
            ),
        ]
    }
}

/// High if count and toggle go on by one tick: at the end of each half-period the count starts again
/// and toggle changes.
pub(super) fn goes_on(now: &Reg<Open>, next: &Reg<Open>, half_period: U) -> Bit {
    let more = now.count + 1;
    let ends = more.equals(half_period);
    half_period.is_zero().mux(
        next.count.is_zero() & !next.toggle,
        next.count.equals(ends.mux(0, more)) & next.toggle.equals(now.toggle ^ ends),
    )
}

impl Specified for PulseGenerator {}
