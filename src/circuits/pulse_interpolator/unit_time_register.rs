//! Unit-time register: the setting T of the unit-time counter 30, which can be rewritten at any
//! time (¶0016).
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
//! shadow register until RST, so no unit time is cut or stretched. A pattern brings its own T, in
//! force from the first unit time of the pattern on.

use crate::prelude::*;

/// Shadow and active register of T.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct UnitTimeRegister {
    /// Width of T in bits.
    pub width: usize,
    /// Unit time at power-on, in ticks.
    pub period: u64,
}

signals! { for UnitTimeRegister as c;
    /// Input ports.
    pub struct In {
        /// Writes `period` into the shadow register.
        pub write: Bit,
        /// Unit time in ticks, in force from the next RST on.
        pub period: U(c.width),
        /// RST: high in the last tick of the unit time.
        pub unit_rst: Bit,
        /// Loads `take_period` in place of the shadow register; allowed with `unit_rst` only.
        pub take: Bit,
        /// Unit time to load with `take`, in ticks.
        pub take_period: U(c.width),
    }
    /// Flip-flops.
    pub struct Reg {
        /// Next unit time, in ticks.
        shadow: U(c.width) = c.period,
        /// Current unit time, in ticks.
        pub active: U(c.width) = c.period,
    }
    /// Nets.
    pub struct Net {
        /// Unit time to load at RST.
        load: U(c.width),
    }
}

impl Circuit for UnitTimeRegister {
    const NAME: &'static str = "unit_time_register";
    const ABOUT: &'static str = "holds T; a new T waits in a shadow register until RST";
    records!(In, Reg, Net);

    fn tick(&self, i: In, q: Reg, _: Nothing) -> (Net, Reg<Edge>) {
        let load = i.take.mux(i.take_period, q.shadow);
        let next = Reg {
            shadow: i.write.mux(i.period, load),
            active: i.unit_rst.mux(load, q.active),
        };
        (Net { load }, next)
    }

    fn properties(&self, now: &Moment<Self>) -> Vec<Property> {
        let (i, q, next) = (&now.i, &now.q, &now.next.q);
        let due = i.take.mux(i.take_period, q.shadow);
        vec![
            Property::step(
                "the active unit time changes only at RST",
                &["active", "unit_rst"],
                i.unit_rst | next.active.equals(q.active),
            ),
            Property::step(
                "RST loads take_period if take is high, otherwise shadow",
                &["active", "shadow"],
                i.unit_rst.implies(next.active.equals(due)),
            ),
            Property::step(
                "a write puts period into shadow",
                &["shadow", "period"],
                i.write.implies(next.shadow.equals(i.period)),
            ),
            Property::step(
                "without write and take, shadow keeps its value",
                &["shadow"],
                i.write | i.take | next.shadow.equals(q.shadow),
            ),
        ]
    }
}

impl Specified for UnitTimeRegister {}
