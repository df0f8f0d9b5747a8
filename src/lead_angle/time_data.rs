//! Time data supply 21: memory 24 with a lead time for each step, ROM 25 as what it holds at first,
//! buffer 29 for the time of the step that runs.
//!
//! ```text
//!                                     ┌───────────┐
//!  load, step, common ───────────────▶│           ├──▶ lead_time
//!  learned, learned_time ────────────▶│ time data │
//!  write, write_step, write_time, … ─▶│           ├──▶ refused
//!                                     └───────────┘
//! ```
//!
//! With `common` all steps share the time of step 0, as the text allows.
//!
//! Departures: a write of the control computer that is off the grid of the
//! [ratio logic](super::ratio_logic), or in the tick in which a learned time is written, is refused
//! and said so. Buffer 29 is the memory's output register.

use crate::check::{Invariants, Specified, require};
use crate::kernel::Circuit;
use crate::logic::{Bit, Image, Logic, Ram, Sim};
use crate::signals;

signals! {
    /// Ports in.
    pub struct In<L, const A: usize, const C: usize> {
        /// The time of the step that begins comes to the output.
        pub load: L::Bit,
        /// The step that runs.
        pub step: L::U<A>,
        /// All steps share one time.
        pub common: L::Bit,
        /// A time has been learned for the step that runs.
        pub learned: L::Bit,
        /// Δt2.
        pub learned_time: L::U<C>,
        /// The control computer writes a time.
        pub write: L::Bit,
        /// The step whose time is written.
        pub write_step: L::U<A>,
        /// The time that is written, in CKs.
        pub write_time: L::U<C>,
        /// The time that is written is on the grid.
        pub write_on_grid: L::Bit,
        /// Takes `refused` back.
        pub clear: L::Bit,
    }
}

signals! {
    /// Output register and memory.
    pub struct Reg<L, const A: usize, const C: usize> {
        /// 29: Δt1, the lead time of the step that runs.
        pub lead_time: L::U<C> as Analog,
        /// A write was refused since `clear`.
        pub refused: L::Bit,
        /// 24: times by step.
        times: L::Ram<A, C>,
    }
}

signals! {
    /// Nets.
    pub struct Net<L, const A: usize, const C: usize> {
        /// Where the time of the step stands.
        address: L::U<A>,
        /// A write of the control computer is refused.
        refuse: L::Bit,
        /// The memory is written.
        store: L::Bit,
        /// Address written to.
        store_address: L::U<A>,
        /// Time written.
        store_time: L::U<C>,
    }
}

/// Time data supply 21 of 2^`A` steps with times of `C` bits; a time stands at the output in the
/// tick after `load`.
#[derive(Debug, Clone)]
pub struct TimeData<const A: usize, const C: usize> {
    /// 25: the times at power-on.
    pub rom: Image<A, C>,
}

impl<const A: usize, const C: usize> Default for TimeData<A, C> {
    /// Without any time: every step begins without a lead.
    fn default() -> Self {
        TimeData {
            rom: Image::zeroed(),
        }
    }
}

impl<const A: usize, const C: usize> Circuit for TimeData<A, C> {
    const NAME: &'static str = "time_data";
    const ABOUT: &'static str = "lead time of each step, with what was learned";
    type In<L: Logic> = In<L, A, C>;
    type Reg<L: Logic> = Reg<L, A, C>;
    type Net<L: Logic> = Net<L, A, C>;

    fn comb<L: Logic>(&self, _: &Reg<L, A, C>, i: &In<L, A, C>) -> Net<L, A, C> {
        let address = i.common.mux(0.into(), i.step);
        let refuse = i.write & (i.learned | !i.write_on_grid);
        Net {
            address,
            refuse,
            store: i.learned | (i.write & i.write_on_grid),
            store_address: i.learned.mux(address, i.write_step),
            store_time: i.learned.mux(i.learned_time, i.write_time),
        }
    }

    fn next<L: Logic>(&self, q: Reg<L, A, C>, w: &Net<L, A, C>, i: &In<L, A, C>) -> Reg<L, A, C> {
        Reg {
            lead_time: q.times.read_when(i.load, w.address, q.lead_time),
            refused: (q.refused & !i.clear) | w.refuse,
            times: q.times.write(w.store, w.store_address, w.store_time),
        }
    }

    fn power_on(&self) -> Reg<Sim, A, C> {
        Reg {
            lead_time: 0.into(),
            refused: false.into(),
            times: self.rom.clone().into(),
        }
    }
}

impl<const A: usize, const C: usize> Specified for TimeData<A, C> {
    fn invariants(&self) -> Invariants<'_, Self> {
        let own = |i: &In<Sim, A, C>| if i.common.get() { 0 } else { i.step.get() };
        Invariants::<Self>::new()
            .step(
                "the output shows the time that was loaded last",
                move |now, next| {
                    let expected = match now.i.load.get() {
                        true => now.q.times.read(own(now.i).into()),
                        false => now.q.lead_time,
                    };
                    require(next.lead_time == expected, ["lead_time"], || {
                        format!("{} expected", expected.get())
                    })
                },
            )
            .step(
                "what is learned goes to the step that runs, a write on the grid to its own",
                move |now, next| {
                    let i = now.i;
                    let right = (0..1 << A).all(|step: u64| {
                        let written = i.write.get() && i.write_on_grid.get() && !i.learned.get();
                        let expected = if i.learned.get() && own(i) == step {
                            i.learned_time
                        } else if written && i.write_step.get() == step {
                            i.write_time
                        } else {
                            now.q.times.read(step.into())
                        };
                        next.times.read(step.into()) == expected
                    });
                    require(right, ["times"], || "another".into())
                },
            )
            .step(
                "a write that is not done is said to be refused",
                |now, next| {
                    let i = now.i;
                    let done = i.write_on_grid.get() && !i.learned.get();
                    let held = now.q.refused.get() && !i.clear.get();
                    let refused = (i.write.get() && !done) || held;
                    require(next.refused.get() == refused, ["refused"], || {
                        format!("{refused} expected")
                    })
                },
            )
    }

    /// Two values of what is only stored.
    fn applies(&self, i: &In<Sim, A, C>) -> bool {
        let most = (1 << C) - 1;
        let two = |word: u64| word == 0 || word == most;
        two(i.learned_time.get()) && two(i.write_time.get())
    }
}
