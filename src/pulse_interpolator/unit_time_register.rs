//! Unit-time register: the setting T of the unit-time counter 30, rewritable at any time (¶0016).
//!
//! ```text
//!              ┌────────────────────┐
//!  write ─────▶│ shadow ──▶ active  ├──▶ active
//!  period ────▶│    loaded at RST   │
//!  unit_rst ──▶│                    │
//!  take ──────▶│ take_period goes   │
//!  take_period▶│ to both            │
//!              └────────────────────┘
//! ```
//!
//! Departures: the text lets the control computer rewrite T directly. Here a new T waits in a
//! shadow register until RST, so no unit time is cut or stretched; a pattern brings its T along,
//! and that T is in force from the pattern's first unit time on.

use crate::check::{Invariants, Specified, require};
use crate::kernel::Circuit;
use crate::logic::{Bit, Logic, Sim};
use crate::signals;

signals! {
    /// Ports in.
    pub struct In<L, const T: usize> {
        /// Writes `period` into the shadow register.
        pub write: L::Bit,
        /// Unit time in ticks, in force from the RST after the write on.
        pub period: L::U<T>,
        /// Last tick of the unit time.
        pub unit_rst: L::Bit,
        /// With `unit_rst`: a pattern begins.
        pub take: L::Bit,
        /// That pattern's unit time in ticks.
        pub take_period: L::U<T>,
    }
}

signals! {
    /// Flip-flops.
    pub struct Reg<L, const T: usize> {
        /// The unit time to come, in ticks.
        shadow: L::U<T>,
        /// The unit time in force, in ticks.
        pub active: L::U<T>,
    }
}

signals! {
    /// Nets.
    pub struct Net<L, const T: usize> {
        /// What is loaded at RST.
        load: L::U<T>,
    }
}

/// Shadow and active register of T, `T` bits each.
#[derive(Debug, Clone)]
pub struct UnitTimeRegister<const T: usize> {
    /// Unit time at power-on, in ticks.
    pub period: u64,
}

impl<const T: usize> Circuit for UnitTimeRegister<T> {
    const NAME: &'static str = "unit_time_register";
    const ABOUT: &'static str = "holds T; a new T waits in a shadow register until RST";
    type In<L: Logic> = In<L, T>;
    type Reg<L: Logic> = Reg<L, T>;
    type Net<L: Logic> = Net<L, T>;

    fn comb<L: Logic>(&self, q: &Reg<L, T>, i: &In<L, T>) -> Net<L, T> {
        Net {
            load: i.take.mux(i.take_period, q.shadow),
        }
    }

    fn next<L: Logic>(&self, q: Reg<L, T>, w: &Net<L, T>, i: &In<L, T>) -> Reg<L, T> {
        Reg {
            shadow: i.write.mux(i.period, w.load),
            active: i.unit_rst.mux(w.load, q.active),
        }
    }

    fn power_on(&self) -> Reg<Sim, T> {
        Reg {
            shadow: self.period.into(),
            active: self.period.into(),
        }
    }
}

impl<const T: usize> Specified for UnitTimeRegister<T> {
    fn invariants(&self) -> Invariants<'_, Self> {
        Invariants::<Self>::new()
            .step("T in force changes only at RST", |now, next| {
                let kept = now.i.unit_rst.get() || next.active == now.q.active;
                require(kept, ["active", "unit_rst"], || {
                    "changed in mid-unit".into()
                })
            })
            .step(
                "RST loads the pattern's T, or else what waits",
                |now, next| {
                    let due = match now.i.take.get() {
                        true => now.i.take_period,
                        false => now.q.shadow,
                    };
                    let loaded = !now.i.unit_rst.get() || next.active == due;
                    require(loaded, ["active", "shadow"], || {
                        format!("{:?}, not {due:?}", next.active)
                    })
                },
            )
            .step("a write waits until the RST after it", |now, next| {
                let waits = !now.i.write.get() || next.shadow == now.i.period;
                require(waits, ["shadow", "period"], || "a write is lost".into())
            })
            .step(
                "without a write or a pattern the setting stays",
                |now, next| {
                    let idle = !now.i.write.get() && !now.i.take.get();
                    let kept = !idle || next.shadow == now.q.shadow;
                    require(kept, ["shadow"], || "changed by itself".into())
                },
            )
    }
}
