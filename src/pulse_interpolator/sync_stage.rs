//! Sync stage 40 (¶0017): a flip-flop that loads the pulse signal, or 0 in the tick of
//! RST.
//!
//! ```text
//!             ┌────────────┐
//!  pulse ────▶│ sync stage ├──▶ step
//!  unit_rst ─▶│            │
//!             └────────────┘
//! ```

use crate::check::{Invariants, Specified};
use crate::kernel::{Circuit, Moment, Nothing, Property};
use crate::logic::Logic;
use crate::signals;

signals! {
    /// Ports in.
    pub struct In<L> {
        /// The pulse signal.
        pub pulse: L::Bit,
        /// Last tick of the unit time.
        pub unit_rst: L::Bit,
    }
}

signals! {
    /// Flip-flops.
    pub struct Reg<L> {
        /// Step pulses to the motor driver; a step is a rising edge.
        pub step: L::Bit = 0,
    }
}

/// Sync stage 40: one tick of latency, low in the first tick of every unit time.
#[derive(Debug, Clone, Default)]
pub struct SyncStage;

impl Circuit for SyncStage {
    const NAME: &'static str = "sync_stage";
    const ABOUT: &'static str = "flip-flop that loads the pulse signal, or 0 in the tick of RST";
    type In<L: Logic> = In<L>;
    type Reg<L: Logic> = Reg<L>;
    type Net<L: Logic> = Nothing<L>;

    fn comb<L: Logic>(&self, _: &Reg<L>, _: &In<L>) -> Nothing<L> {
        Nothing::new()
    }

    fn next<L: Logic>(&self, _: Reg<L>, _: &Nothing<L>, i: &In<L>) -> Reg<L> {
        Reg {
            step: i.pulse & !i.unit_rst,
        }
    }

    fn properties<L: Logic>(&self, now: &Moment<'_, Self, L>, next: &Reg<L>) -> Vec<Property<L>> {
        let i = now.i;
        vec![
            Property::step(
                "low in the tick after RST",
                &["step", "unit_rst"],
                !i.unit_rst | !next.step,
            ),
            Property::step(
                "passes the pulse signal",
                &["step", "pulse"],
                i.unit_rst | !(next.step ^ i.pulse),
            ),
        ]
    }
}

impl Specified for SyncStage {
    fn invariants(&self) -> Invariants<'_, Self> {
        Invariants::of(self)
    }
}
