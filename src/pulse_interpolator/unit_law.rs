//! The count law as a circuit that can be proved: one unit time after another, each with a
//! half-period and a T of its own, and ghost registers that no hardware has.
//!
//! ```text
//!                ┌──────────┐
//!  half_period ─▶│ unit law ├──▶ step
//!  period ──────▶│          │
//!                └──────────┘
//! ```

use super::{PulseGenerator, SyncStage, UnitTimeCounter, Variant};
use super::{counts, pulse_generator, sync_stage, unit_time_counter};
use crate::check::{Invariants, Specified, require};
use crate::kernel::{Circuit, Instance};
use crate::logic::{Bit, Logic};
use crate::signals;

signals! {
    /// Ports in.
    pub struct In<L, const W: usize> {
        /// Half-period of the unit time to come; sampled in the tick of RST only.
        pub half_period: L::U<W>,
        /// T of the unit time to come; sampled in the tick of RST only.
        pub period: L::U<W>,
    }
}

signals! {
    /// Flip-flops.
    pub struct Reg<L, const W: usize> {
        /// Unit-time counter 30.
        pub counter: unit_time_counter::Reg<L, W>,
        /// Pulse generator 20.
        pub generator: pulse_generator::Reg<L, W>,
        /// Sync stage 40.
        pub sync: sync_stage::Reg<L>,
        /// Half-period of this unit time.
        held_half_period: L::U<W>,
        /// T of this unit time.
        held_period: L::U<W> = 1,
        /// Ghost: pulses of this unit time before this tick.
        pulses: L::U<W>,
        /// Ghost: the level of step a tick ago, low in the first tick of a unit time.
        lagged: L::Bit,
    }
}

signals! {
    /// Nets.
    pub struct Net<L, const W: usize> {
        /// Unit-time counter 30.
        pub counter: Instance<UnitTimeCounter<W>, L>,
        /// Pulse generator 20.
        pub generator: Instance<PulseGenerator<W>, L>,
        /// Sync stage 40.
        pub sync: Instance<SyncStage, L>,
        /// Ghost: pulses of this unit time, this tick included.
        counted: L::U<W>,
        /// Step pulses.
        pub step: L::Bit,
    }
}

/// Unit times of free data, widths `W`.
#[derive(Debug, Clone, Default)]
pub struct UnitLaw<const W: usize> {
    counter: UnitTimeCounter<W>,
    generator: PulseGenerator<W>,
    sync: SyncStage,
}

impl<const W: usize> UnitLaw<W> {
    /// With RST clearing what `variant` says.
    pub fn new(variant: Variant) -> Self {
        UnitLaw {
            generator: PulseGenerator { variant },
            ..Self::default()
        }
    }
}

impl<const W: usize> Circuit for UnitLaw<W> {
    const NAME: &'static str = "unit_law";
    const ABOUT: &'static str = "unit times of free data, with a ghost that counts the pulses";
    type In<L: Logic> = In<L, W>;
    type Reg<L: Logic> = Reg<L, W>;
    type Net<L: Logic> = Net<L, W>;

    fn comb<L: Logic>(&self, q: &Reg<L, W>, _: &In<L, W>) -> Net<L, W> {
        let period = q.held_period;
        let counter = Instance::settle(&self.counter, &q.counter, unit_time_counter::In { period });
        let unit_rst = counter.w.unit_rst;
        let half_period = q.held_half_period;
        let generator = Instance::settle(
            &self.generator,
            &q.generator,
            pulse_generator::In {
                half_period,
                unit_rst,
            },
        );
        let pulse = generator.w.pulse;
        let sync = Instance::settle(&self.sync, &q.sync, sync_stage::In { pulse, unit_rst });
        let rises = q.sync.step & !q.lagged;
        Net {
            counter,
            generator,
            sync,
            counted: rises.mux(q.pulses + 1, q.pulses),
            step: q.sync.step,
        }
    }

    fn next<L: Logic>(&self, q: Reg<L, W>, w: &Net<L, W>, i: &In<L, W>) -> Reg<L, W> {
        let unit_rst = w.counter.w.unit_rst;
        Reg {
            counter: w.counter.next(&self.counter, q.counter),
            generator: w.generator.next(&self.generator, q.generator),
            sync: w.sync.next(&self.sync, q.sync),
            held_half_period: unit_rst.mux(i.half_period, q.held_half_period),
            held_period: unit_rst.mux(i.period, q.held_period),
            pulses: unit_rst.mux(0.into(), w.counted),
            lagged: !unit_rst & w.step,
        }
    }
}

impl<const W: usize> UnitLaw<W> {
    /// The count law alone: what the literal variant breaks with sound data.
    pub fn count_law(&self) -> Invariants<'_, Self> {
        Invariants::<Self>::new().always("the pulses of a unit time obey the count law", |now| {
            let (n, period) = (now.q.held_half_period.get(), now.q.held_period.get().max(1));
            let law = counts::pulses(n as u32, period as u32);
            let count = now.w.counted.get();
            let right = !now.w.counter.w.unit_rst.get() || count == u64::from(law);
            require(right, ["step", "counter.unit_rst", "counted"], || {
                format!("{count} pulses with n = {n} and T = {period}, the law says {law}")
            })
        })
    }
}

impl<const W: usize> Specified for UnitLaw<W> {
    fn invariants(&self) -> Invariants<'_, Self> {
        self.count_law()
            .always("step is low in the first tick of a unit time", |now| {
                let low = now.q.counter.count.get() != 0 || !now.w.step.get();
                require(low, ["step", "counter.count"], || "high across RST".into())
            })
            .always("where the unit time stands decides everything", |now| {
                let (elapsed, n) = (now.q.counter.count.get(), now.q.held_half_period.get());
                let (count, toggle) = match n {
                    0 => (0, false),
                    n => (elapsed % n, elapsed / n % 2 == 1),
                };
                let same = now.q.generator.count.get() == count
                    && now.q.generator.toggle.get() == toggle
                    && now.w.step.get() == toggle;
                require(
                    same,
                    ["generator.count", "generator.toggle", "step"],
                    || format!("tick {elapsed} of a unit time with n = {n}"),
                )
            })
            .always("a unit time has T ticks", |now| {
                let last = now.q.counter.count.get() + 1 == now.q.held_period.get().max(1);
                let right = last == now.w.counter.w.unit_rst.get();
                require(right, ["counter.count", "counter.unit_rst"], || {
                    "RST at another tick".into()
                })
            })
    }
}
