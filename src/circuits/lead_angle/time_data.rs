//! Time data supply 21: memory 24 with a lead time for each step, ROM 25 with its initial contents,
//! buffer 29 for the time of the running step.
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
//! Departures: a write by the control computer is refused and flagged if the time is off the grid
//! of the [ratio logic](super::ratio_logic), or if a learned time is written in the same tick.
//! Buffer 29 is the memory's output register.

use crate::prelude::*;

/// Time data supply 21; a time is at the output in the tick after `load`.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TimeData {
    /// Width of a step number.
    pub step: usize,
    /// Width of a time.
    pub time: usize,
    /// Times at power-on, by step: the contents of 25. A step without a time begins without a lead.
    pub rom: Image,
}

impl TimeData {
    /// Without any time: every step begins without a lead.
    #[must_use]
    pub fn new(step: usize, time: usize) -> Self {
        let rom = Image::new(step, time);
        TimeData { step, time, rom }
    }

    /// The ROM with as many words as there are steps.
    fn contents(&self) -> Image {
        self.rom.resized(self.step, self.time)
    }
}

signals! { for TimeData as c;
    /// Input ports.
    pub struct In {
        /// Reads the time of the step that begins.
        pub load: Bit,
        /// Number of the running step.
        pub step: U(c.step),
        /// All steps share the time of step 0.
        pub common: Bit,
        /// Writes the learned time of the running step; has priority over `write`.
        pub learned: Bit,
        /// Δt2: learned time.
        pub learned_time: U(c.time),
        /// Writes a time; refused off the grid, or together with `learned`.
        pub write: Bit,
        /// Number of the step to write.
        pub write_step: U(c.step),
        /// Time to write.
        pub write_time: U(c.time),
        /// `write_time` is on the grid.
        pub write_on_grid: Bit,
        /// Clears `refused`.
        pub clear: Bit,
    }
    /// Output register and memory.
    pub struct Reg {
        /// 29: Δt1, lead time of the running step.
        pub lead_time: U(c.time) as Analog,
        /// A write was refused; cleared by `clear`.
        pub refused: Bit,
        /// 24: times, by step.
        times: Ram(c.step, c.time) = &c.contents(),
    }
    /// Nets.
    pub struct Net {
        /// Address of the step's time.
        address: U(c.step),
        /// The write is refused.
        refuse: Bit,
        /// The memory is written.
        store: Bit,
        /// Address to write.
        store_address: U(c.step),
        /// Time to write.
        store_time: U(c.time),
    }
}

impl Circuit for TimeData {
    const NAME: &'static str = "time_data";
    const ABOUT: &'static str = "lead time of each step, updated by learning";
    records!(In, Reg, Net);

    fn tick(&self, i: In, q: Reg, _: Nothing) -> (Net, Reg<Edge>) {
        let address = i.common.mux(0, i.step);
        let refuse = i.write & (i.learned | !i.write_on_grid);
        let store = i.learned | (i.write & i.write_on_grid);
        let store_address = i.learned.mux(address, i.write_step);
        let store_time = i.learned.mux(i.learned_time, i.write_time);
        let edge = Reg {
            lead_time: q.times.read_when(i.load, address, q.lead_time),
            refused: (q.refused & !i.clear) | refuse,
            times: q.times.write(store, store_address, store_time),
        };
        let net = Net {
            address,
            refuse,
            store,
            store_address,
            store_time,
        };
        (net, edge)
    }
}

impl Specified for TimeData {
    fn invariants(&self) -> Invariants<'_, Self> {
        let own = |i: &In<Value>| if i.common { 0 } else { i.step };
        Invariants::<Self>::new()
            .step(
                "lead_time is the time that was loaded last",
                move |now, next| {
                    let expected = match now.i.load {
                        true => now.q.times[own(now.i) as usize],
                        false => now.q.lead_time,
                    };
                    require(next.q.lead_time == expected, ["lead_time"], || {
                        format!("{expected} expected")
                    })
                },
            )
            .step(
                "a learned time is stored for its step, else a write on the grid for write_step",
                move |now, next| {
                    let i = now.i;
                    let right = (0..1 << self.step).all(|step: u64| {
                        let written = i.write && i.write_on_grid && !i.learned;
                        let expected = if i.learned && own(i) == step {
                            i.learned_time
                        } else if written && i.write_step == step {
                            i.write_time
                        } else {
                            now.q.times[step as usize]
                        };
                        next.q.times[step as usize] == expected
                    });
                    require(right, ["times"], || "another".into())
                },
            )
            .step(
                "refused is set by a write that is not stored, and stays until clear",
                |now, next| {
                    let i = now.i;
                    let done = i.write_on_grid && !i.learned;
                    let held = now.q.refused && !i.clear;
                    let refused = (i.write && !done) || held;
                    require(next.q.refused == refused, ["refused"], || {
                        format!("{refused} expected")
                    })
                },
            )
    }

    /// Two values of the data, which are only stored.
    fn applies(&self, i: &In<Value>) -> bool {
        let most = (1 << self.time) - 1;
        let two = |word: u64| word == 0 || word == most;
        two(i.learned_time) && two(i.write_time)
    }
}
