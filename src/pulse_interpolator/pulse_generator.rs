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
//! Departures: in the *safe* variant RST clears counter and toggle, a half-period of 0 gives no
//! pulse, and "equal" is `count + 1 >= half_period`, so no n makes the counter run to its wrap.
//! The *literal* variant ignores RST (¶0017 clears the flip-flop 40 alone) and has
//! `count + 1 == half_period`; its half-period of 0 means 2^N.

use super::Variant;
use crate::check::{Invariants, Specified, require};
use crate::kernel::Circuit;
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

    #[inline(always)]
    fn comb<L: Logic>(&self, q: &Reg<L, N>, i: &In<L, N>) -> Net<L, N> {
        let next = q.count + 1;
        match self.variant {
            Variant::Safe => {
                let equal = !next.below(i.half_period);
                Net {
                    next,
                    equal,
                    pulse: (q.toggle ^ equal) & !i.half_period.is_zero(),
                }
            }
            Variant::Literal => {
                let equal = next.equals(i.half_period);
                Net {
                    next,
                    equal,
                    pulse: q.toggle ^ equal,
                }
            }
        }
    }

    #[inline(always)]
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
}

impl<const N: usize> Specified for PulseGenerator<N> {
    fn invariants(&self) -> Invariants<'_, Self> {
        Invariants::<Self>::new()
            .always("a half-period of 0 gives no pulse", |now| {
                let none = now.i.half_period.get() != 0 || !now.w.pulse.get();
                require(none, ["half_period", "pulse"], || "a pulse".into())
            })
            .step("RST clears the counter and the toggle", |now, next| {
                let clear = next.count.get() == 0 && !next.toggle.get();
                let held = !now.i.unit_rst.get() || clear;
                require(held, ["count", "toggle", "unit_rst"], || {
                    "left over from this unit".into()
                })
            })
            .step("the count stays below the half-period", |now, next| {
                let below = next.count.get() < now.i.half_period.get().max(1);
                require(below, ["count", "half_period"], || {
                    format!("{}", next.count.get())
                })
            })
            .step(
                "the pulse signal toggles when the half-period is over, and only then",
                |now, next| {
                    let n = now.i.half_period.get();
                    let over = now.q.count.get() + 1 >= n;
                    let toggled = now.w.pulse != now.q.toggle;
                    let held = n == 0 || toggled == over;
                    let kept = now.i.unit_rst.get() || next.toggle == now.w.pulse;
                    require(held && kept, ["pulse", "toggle", "count"], || {
                        format!("count {}, half-period {n}", now.q.count.get())
                    })
                },
            )
    }
}
