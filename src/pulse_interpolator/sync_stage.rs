//! Sync stage 40 (¶0017): a flip-flop that loads the pulse signal, or 0 in the tick of
//! RST.
//!
//! ```text
//!             ┌────────────┐
//!  pulse ────▶│ sync stage ├──▶ step
//!  unit_rst ─▶│            │
//!             └────────────┘
//! ```

use crate::check::{Invariants, Specified, require};
use crate::kernel::{Circuit, Nothing};
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

    #[inline(always)]
    fn comb<L: Logic>(&self, _: &Reg<L>, _: &In<L>) -> Nothing<L> {
        Nothing::new()
    }

    #[inline(always)]
    fn next<L: Logic>(&self, _: Reg<L>, _: &Nothing<L>, i: &In<L>) -> Reg<L> {
        Reg {
            step: i.pulse & !i.unit_rst,
        }
    }
}

impl Specified for SyncStage {
    fn invariants(&self) -> Invariants<'_, Self> {
        Invariants::<Self>::new()
            .step("low in the tick after RST", |now, next| {
                let low = !now.i.unit_rst.get() || !next.step.get();
                require(low, ["step", "unit_rst"], || "high across RST".into())
            })
            .step("passes the pulse signal", |now, next| {
                let passed = now.i.unit_rst.get() || next.step == now.i.pulse;
                require(passed, ["step", "pulse"], || "not passed".into())
            })
    }
}
