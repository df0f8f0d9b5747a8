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

use super::target_setter::words_to_compare;
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

    fn properties(&self, now: &Moment<Self>) -> Vec<Property> {
        let (i, q, next) = (&now.i, &now.q, &now.next.q);
        let own = i.common.mux(0, i.step);
        let lead_time = i.load.mux(q.times.read(own), q.lead_time);
        let done = i.write_on_grid & !i.learned;
        let mut stored = Bit::high();
        for step in words_to_compare(&q.times, [i.step, i.write_step]) {
            let writes = i.write & done & i.write_step.equals(step);
            let kept = writes.mux(i.write_time, q.times.read(step));
            let learns = i.learned & own.equals(step);
            let time = learns.mux(i.learned_time, kept);
            stored = stored & next.times.read(step).equals(time);
        }
        let refused = (i.write & !done) | (q.refused & !i.clear);
        vec![
            Property::step(
                "lead_time is the time that was loaded last",
                &["lead_time"],
                next.lead_time.equals(lead_time),
            ),
            Property::step(
                "a learned time is stored for its step, else a write on the grid for write_step",
                &["times"],
                stored,
            ),
            Property::step(
                "refused is set by a write that is not stored, and stays until clear",
                &["refused"],
                next.refused.equals(refused),
            ),
        ]
    }
}

impl Specified for TimeData {
    /// Two values of the data, which are only stored.
    fn applies(&self, i: &In<Value>) -> bool {
        let most = (1 << self.time) - 1;
        let two = |word: u64| word == 0 || word == most;
        two(i.learned_time) && two(i.write_time)
    }
}
