//! One axis: pattern memory 10, pulse generator 20 and sync stage 40 (¶0012).
//!
//! ```text
//!                ┌──────┐
//!  unit_rst ────▶│      ├──▶ step
//!  read, blank ─▶│ axis ├──▶ dir
//!  address ─────▶│      │
//!  write… ──────▶│      │
//!                └──────┘
//! ```

use super::{PatternMemory, PulseGenerator, SyncStage, Variant};
use super::{pattern_memory, pulse_generator, sync_stage};
use crate::check::{Invariants, Specified, require};
use crate::kernel::{Circuit, Instance};
use crate::logic::{Logic, Sim};
use crate::signals;

signals! {
    /// Ports in.
    pub struct In<L, const N: usize, const A: usize> {
        /// Last tick of the unit time.
        pub unit_rst: L::Bit,
        /// Reads the word at `address` for the unit time to come.
        pub read: L::Bit,
        /// The unit time to come has no pulses.
        pub blank: L::Bit,
        /// Address of the unit time to come.
        pub address: L::U<A> as Hex,
        /// Writes a word of the axis that `write_axis` names.
        pub write: L::Bit,
        /// The axis written to.
        pub write_axis: L::U<3>,
        /// Address written to.
        pub write_address: L::U<A> as Hex,
        /// Half-period written.
        pub write_half_period: L::U<N>,
        /// Direction written.
        pub write_direction: L::Bit,
    }
}

signals! {
    /// Registers of the blocks.
    pub struct Reg<L, const N: usize, const A: usize> {
        /// Pattern memory 10.
        pub memory: pattern_memory::Reg<L, N, A>,
        /// Pulse generator 20.
        pub generator: pulse_generator::Reg<L, N>,
        /// Sync stage 40.
        pub sync: sync_stage::Reg<L>,
    }
}

signals! {
    /// Nets of the blocks, and the ports out.
    pub struct Net<L, const N: usize, const A: usize> {
        /// Pattern memory 10.
        pub memory: Instance<PatternMemory<N, A>, L>,
        /// Pulse generator 20.
        pub generator: Instance<PulseGenerator<N>, L>,
        /// Sync stage 40.
        pub sync: Instance<SyncStage, L>,
        /// Step pulses; a step is a rising edge.
        pub step: L::Bit,
        /// Direction; high counts down. Changes only with the first tick of a unit time.
        pub dir: L::Bit,
    }
}

/// One axis with half-periods of `N` bits and 2^`A` unit times of memory.
#[derive(Debug, Clone)]
pub struct Axis<const N: usize, const A: usize> {
    /// Pattern memory 10.
    pub memory: PatternMemory<N, A>,
    /// Pulse generator 20.
    pub generator: PulseGenerator<N>,
    /// Sync stage 40.
    pub sync: SyncStage,
}

impl<const N: usize, const A: usize> Axis<N, A> {
    /// Axis number `axis` with an empty memory.
    pub fn new(axis: u64, variant: Variant) -> Self {
        Axis {
            memory: PatternMemory::new(axis),
            generator: PulseGenerator { variant },
            sync: SyncStage,
        }
    }
}

impl<const N: usize, const A: usize> Circuit for Axis<N, A> {
    const NAME: &'static str = "axis";
    const ABOUT: &'static str = "pattern memory, pulse generator and sync stage of one axis";
    type In<L: Logic> = In<L, N, A>;
    type Reg<L: Logic> = Reg<L, N, A>;
    type Net<L: Logic> = Net<L, N, A>;

    fn comb<L: Logic>(&self, q: &Reg<L, N, A>, i: &In<L, N, A>) -> Net<L, N, A> {
        let memory = Instance::settle(
            &self.memory,
            &q.memory,
            pattern_memory::In {
                read: i.read,
                blank: i.blank,
                address: i.address,
                write: i.write,
                write_axis: i.write_axis,
                write_address: i.write_address,
                write_half_period: i.write_half_period,
                write_direction: i.write_direction,
            },
        );
        let generator = Instance::settle(
            &self.generator,
            &q.generator,
            pulse_generator::In {
                half_period: q.memory.half_period,
                unit_rst: i.unit_rst,
            },
        );
        let sync = Instance::settle(
            &self.sync,
            &q.sync,
            sync_stage::In {
                pulse: generator.w.pulse,
                unit_rst: i.unit_rst,
            },
        );
        Net {
            memory,
            generator,
            sync,
            step: q.sync.step,
            dir: q.memory.direction,
        }
    }

    fn next<L: Logic>(&self, q: Reg<L, N, A>, w: &Net<L, N, A>, _: &In<L, N, A>) -> Reg<L, N, A> {
        Reg {
            memory: w.memory.next(&self.memory, q.memory),
            generator: w.generator.next(&self.generator, q.generator),
            sync: w.sync.next(&self.sync, q.sync),
        }
    }

    fn power_on(&self) -> Reg<Sim, N, A> {
        Reg {
            memory: self.memory.power_on(),
            generator: self.generator.power_on(),
            sync: self.sync.power_on(),
        }
    }
}

impl<const N: usize, const A: usize> Specified for Axis<N, A> {
    fn invariants(&self) -> Invariants<'_, Self> {
        Invariants::<Self>::new()
            .step("step is low in the tick after RST", |now, next| {
                let low = !now.i.unit_rst.get() || !next.sync.step.get();
                require(low, ["sync.step", "unit_rst"], || "high across RST".into())
            })
            .step("dir changes only with a word read", |now, next| {
                let kept = next.memory.direction == now.q.memory.direction;
                require(kept || now.i.read.get(), ["dir", "read"], || {
                    "changed by itself".into()
                })
            })
            .always("the toggle and the flip-flop agree", |now| {
                let same = now.q.generator.toggle == now.q.sync.step;
                require(same, ["generator.toggle", "sync.step"], || {
                    "they differ".into()
                })
            })
    }

    /// A word is read or blanked at RST only, as the address sequencer does it; what stands on
    /// the write port without a write does not matter, nor which other axis is written to.
    fn applies(&self, i: &In<Sim, N, A>) -> bool {
        let unused = i.write_axis.get() == 0
            && i.write_address.get() == 0
            && i.write_half_period.get() == 0
            && !i.write_direction.get();
        let change = i.read.get() || i.blank.get();
        (i.write.get() || unused) && i.write_axis.get() < 2 && (i.unit_rst.get() || !change)
    }
}
