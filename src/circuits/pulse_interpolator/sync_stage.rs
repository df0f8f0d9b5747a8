//! Sync stage 40 (¶0017): a flip-flop that loads the pulse signal, or 0 in the tick of
//! RST.
//!
//! ```text
//!             ┌────────────┐
//!  pulse ────▶│ sync stage ├──▶ step
//!  unit_rst ─▶│            │
//!             └────────────┘
//! ```

use crate::prelude::*;

/// Sync stage 40: one tick of latency, low in the first tick of every unit time.
#[derive(Debug, Clone, Default, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SyncStage {}

signals! { for SyncStage as c;
    /// Input ports.
    pub struct In {
        /// Pulse signal of the pulse generator 20.
        pub pulse: Bit,
        /// RST: high in the last tick of the unit time.
        pub unit_rst: Bit,
    }
    /// Flip-flops.
    pub struct Reg {
        /// Step pulses to the motor driver; a step is a rising edge.
        pub step: Bit = 0,
    }
}

impl Circuit for SyncStage {
    const NAME: &'static str = "sync_stage";
    const ABOUT: &'static str = "flip-flop that loads the pulse signal, or 0 in the tick of RST";
    records!(In, Reg, Nothing);

    fn tick(&self, i: In, _: Reg, _: Nothing) -> (Nothing, Reg<Edge>) {
        let step = i.pulse & !i.unit_rst;
        (Nothing, Reg { step })
    }

    fn properties(&self, now: &Moment<Self>) -> Vec<Property> {
        let (i, next) = (&now.i, &now.next.q);
        vec![
            Property::step(
                "step is low in the tick after RST",
                &["step", "unit_rst"],
                i.unit_rst.implies(!next.step),
            ),
            Property::step(
                "step is pulse one tick later, except in the tick after RST",
                &["step", "pulse"],
                i.unit_rst | next.step.equals(i.pulse),
            ),
        ]
    }
}

impl Specified for SyncStage {}
