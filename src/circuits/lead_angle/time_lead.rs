//! Control 22 without its comparator: ratio logic 13, position history 11 with tap selector 14,
//! subtractor 15 and multiplier 16.
//!
//! ```text
//!                          ┌───────────┐
//!  ck, position, restart ─▶│           ├──▶ present, lead
//!  lead_time ─────────────▶│ time lead ├──▶ fresh, enough
//!                          └───────────┘
//! ```
//!
//! The history is a choice: the shift register, or the RAM that equals it in every tick.

use super::{
    Lead, PositionHistory, RamHistory, RatioLogic, codes, lead, position_history, ratio_logic,
};
use crate::hdl::prelude::*;

/// The two forms of the memory 11.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Memory {
    /// A shift register with taps.
    #[default]
    ShiftRegister,
    /// A RAM with a moving address.
    Ram,
}

choice! {
    /// A history in one of the forms of the memory 11.
    pub enum History as HistoryPart {
        /// A shift register with taps.
        ShiftRegister(PositionHistory),
        /// A RAM with a moving address.
        Ram(RamHistory),
    }
}

/// Lead of a time.
///
/// A position that stands in the tick of CK is at the outputs, with its lead, in the tick after it.
#[derive(Debug, Clone)]
pub struct TimeLead {
    /// Stages of history.
    pub stages: usize,
    /// Width of a position.
    pub position: usize,
    /// What the history is kept in.
    pub memory: Memory,
}

impl TimeLead {
    fn history(&self) -> History {
        let &TimeLead {
            stages, position, ..
        } = self;
        match self.memory {
            Memory::ShiftRegister => History::ShiftRegister(PositionHistory { stages, position }),
            Memory::Ram => History::Ram(RamHistory { stages, position }),
        }
    }
}

signals! { for TimeLead as c;
    /// Ports in.
    pub struct In {
        /// CK: a sample is taken.
        pub ck: Bit,
        /// What was sampled so far counts no more.
        pub restart: Bit,
        /// The position.
        pub position: I(c.position),
        /// Δt in CKs.
        pub lead_time: U(codes::time_width(c.stages)),
    }
    /// The circuits inside.
    pub struct Parts {
        /// 13.
        pub ratio_logic: Part<RatioLogic>(RatioLogic { stages: c.stages }),
        /// 11 and 14.
        pub history: HistoryPart(&c.history()),
        /// 15 and 16.
        pub lead_arithmetic: Part<Lead>(Lead { position: c.position }),
    }
    /// Ports out.
    pub struct Net {
        /// Dx: the present sample.
        pub present: I(c.position) as Analog,
        /// N·Δx: the lead.
        pub lead: I(c.position) as Analog,
        /// Sample and lead are new in this tick.
        pub fresh: Bit,
        /// The history reaches back as far as the time wants.
        pub enough: Bit,
    }
}

impl Circuit for TimeLead {
    const NAME: &'static str = "time_lead";
    const ABOUT: &'static str = "the lead of a time, from a shift register of samples";
    records!(In, Nothing, Net, Parts);

    fn name(&self) -> &'static str {
        match self.memory {
            Memory::ShiftRegister => Self::NAME,
            Memory::Ram => "ram_time_lead",
        }
    }

    fn about(&self) -> &'static str {
        match self.memory {
            Memory::ShiftRegister => Self::ABOUT,
            Memory::Ram => "the lead of a time, from a RAM of samples",
        }
    }

    fn tick(&self, i: In, _: Nothing, p: Parts) -> (Net, Nothing) {
        let lead_time = i.lead_time;
        let ratio_logic = p.ratio_logic.settle(ratio_logic::In { lead_time });
        let ports = position_history::In {
            ck: i.ck,
            restart: i.restart,
            position: i.position,
            tap: ratio_logic.w.tap,
            ratio: ratio_logic.w.ratio,
        };
        let pair = match p.history {
            HistoryPart::ShiftRegister(part) => part.settle(ports).q.pair,
            HistoryPart::Ram(part) => part.settle(ports).q.pair,
        };
        let lead_arithmetic = p.lead_arithmetic.settle(lead::In {
            present: pair.present,
            old: pair.old,
            ratio: pair.pair_ratio,
        });
        let net = Net {
            present: pair.present,
            lead: lead_arithmetic.w.lead,
            fresh: pair.fresh,
            enough: pair.enough,
        };
        (net, Nothing)
    }
}
