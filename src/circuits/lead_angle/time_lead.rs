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
//! The history is a shift register, or the RAM that equals it in every tick. The forms that the
//! text gives as equal can be chosen too: time data that need no logic circuit 13, the two products
//! in place of 15, and 15 before 14. They take the same samples in the same ticks, and on the ring
//! of positions their predictions are equal.

use super::{
    DifferenceHistory, DividedTime, Division, Lead, LeadProducts, PositionHistory, RamHistory,
    RatioLogic, codes, divided_time, lead, lead_products, position_history, ratio_logic,
};
use crate::prelude::*;

/// The two forms of the memory 11.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Memory {
    /// A shift register with taps.
    #[default]
    ShiftRegister,
    /// A RAM with a moving address.
    Ram,
}

/// Method of the prediction.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Form {
    /// Subtractor 15 after the take-out 14, then multiplier 16.
    #[default]
    Difference,
    /// (N + 1)·Dx − N·Dx(−Δt/N), without 15.
    Products,
    /// Subtractor 15 before the take-out 14: one at each stage of a shift register.
    EarlyDifference,
}

choice! {
    /// A history in one of the forms of the memory 11.
    pub enum History as HistoryPart {
        /// A shift register with taps.
        ShiftRegister(PositionHistory),
        /// A RAM with a moving address.
        Ram(RamHistory),
        /// A shift register with subtractors before the taps.
        Differences(DifferenceHistory),
    }
}

choice! {
    /// Source of ratio and tap.
    pub enum Ratio as RatioPart {
        /// The logic circuit 13.
        Logic(RatioLogic),
        /// The time data themselves.
        Divided(DividedTime),
    }
}

choice! {
    /// Circuit of lead or prediction.
    pub enum Arithmetic as ArithmeticPart {
        /// 15 and 16.
        Difference(Lead),
        /// The two products.
        Products(LeadProducts),
    }
}

/// Lead of a time.
///
/// A position that is present in the tick of CK is at the outputs, with its lead, in the next
/// tick.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TimeLead {
    /// Stages of history.
    pub stages: usize,
    /// Width of a position.
    pub position: usize,
    /// Memory of the history.
    pub memory: Memory,
    /// Source of N.
    pub division: Division,
    /// Method of the prediction.
    pub form: Form,
}

impl TimeLead {
    /// The embodiment: N by the logic circuit 13, and 15 between 14 and 16.
    #[must_use]
    pub fn new(stages: usize, position: usize, memory: Memory) -> Self {
        TimeLead {
            stages,
            position,
            memory,
            division: Division::default(),
            form: Form::default(),
        }
    }

    fn history(&self) -> History {
        let &TimeLead {
            stages, position, ..
        } = self;
        match (self.memory, self.form) {
            (Memory::Ram, _) => History::Ram(RamHistory { stages, position }),
            (_, Form::EarlyDifference) => {
                History::Differences(DifferenceHistory { stages, position })
            }
            _ => History::ShiftRegister(PositionHistory { stages, position }),
        }
    }

    fn divided(&self) -> DividedTime {
        DividedTime {
            stages: self.stages,
            one: self.division == Division::One,
        }
    }

    fn ratio(&self) -> Ratio {
        match self.division {
            Division::Logic => Ratio::Logic(RatioLogic {
                stages: self.stages,
            }),
            _ => Ratio::Divided(self.divided()),
        }
    }

    fn arithmetic(&self) -> Arithmetic {
        let (position, one) = (self.position, self.division == Division::One);
        match self.form {
            Form::Products => Arithmetic::Products(LeadProducts { position, one }),
            _ => Arithmetic::Difference(Lead { position, one }),
        }
    }

    /// Width of the time data.
    #[must_use]
    pub fn word(&self) -> usize {
        match self.division {
            Division::Logic => codes::time_width(self.stages),
            _ => self.divided().word(),
        }
    }
}

signals! { for TimeLead as c;
    /// Input ports.
    pub struct In {
        /// CK: a sample is taken.
        pub ck: Bit,
        /// Discards the samples taken so far.
        pub restart: Bit,
        /// Position, in counts.
        pub position: I(c.position),
        /// Δt in CKs; with the division `beforehand`, N and Δt/N.
        pub lead_time: U(c.word()),
    }
    /// The circuits inside.
    pub struct Parts {
        /// Logic circuit 13, or the circuit in its place.
        pub ratio_logic: RatioPart(&c.ratio()),
        /// Memory 11 and take-out 14.
        pub history: HistoryPart(&c.history()),
        /// Subtractor 15 and multiplier 16, or the circuit in their place.
        pub lead_arithmetic: ArithmeticPart(&c.arithmetic()),
    }
    /// Output ports.
    pub struct Net {
        /// Dx: present sample.
        pub present: I(c.position) as Analog,
        /// Lead N·Δx; with the form `products`, the prediction Dx(+Δt).
        pub lead: I(c.position) as Analog,
        /// Sample and lead are new in this tick.
        pub fresh: Bit,
        /// The history goes back far enough for the lead time.
        pub enough: Bit,
        /// Δt in CKs, from time data that contain N and Δt/N.
        pub code: U(c.divided().time()) if (c.division == Division::Beforehand),
    }
}

impl Circuit for TimeLead {
    const NAME: &'static str = "time_lead";
    const ABOUT: &'static str = "lead for a lead time, from a shift register of samples";
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
            Memory::Ram => "lead for a lead time, from a RAM of samples",
        }
    }

    fn objection(&self) -> Option<String> {
        let wrong = (self.memory, self.form) == (Memory::Ram, Form::EarlyDifference);
        wrong.then(|| "a RAM is its own take-out: no subtractor stands before that".into())
    }

    fn tick(&self, i: In, _: Nothing, p: Parts) -> (Net, Nothing) {
        let lead_time = i.lead_time;
        let (tap, ratio, code) = match p.ratio_logic {
            RatioPart::Logic(part) => {
                let w = part.settle(ratio_logic::In { lead_time }).w;
                (w.tap, w.ratio, None)
            }
            RatioPart::Divided(part) => {
                let w = part.settle(divided_time::In { lead_time }).w;
                let code = (self.division == Division::Beforehand).then_some(w.code);
                (w.tap, w.ratio, code)
            }
        };
        let ports = position_history::In {
            ck: i.ck,
            restart: i.restart,
            position: i.position,
            tap,
            ratio,
        };
        // Operands of the subtraction, and the rest of the pair.
        let (ends, present, ratio, fresh, enough) = match p.history {
            HistoryPart::ShiftRegister(part) => {
                let pair = part.settle(ports).q.pair;
                let ends = [pair.present, pair.old];
                (ends, pair.present, pair.pair_ratio, pair.fresh, pair.enough)
            }
            HistoryPart::Ram(part) => {
                let pair = part.settle(ports).q.pair;
                let ends = [pair.present, pair.old];
                (ends, pair.present, pair.pair_ratio, pair.fresh, pair.enough)
            }
            HistoryPart::Differences(part) => {
                let pair = part.settle(ports).q.pair;
                let ends = [pair.difference, I::new(0, self.position)];
                (ends, pair.present, pair.pair_ratio, pair.fresh, pair.enough)
            }
        };
        let [minuend, subtrahend] = ends;
        let lead = match p.lead_arithmetic {
            ArithmeticPart::Difference(part) => {
                let ports = lead::In {
                    present: minuend,
                    old: subtrahend,
                    ratio,
                };
                part.settle(ports).w.lead
            }
            ArithmeticPart::Products(part) => {
                let ports = lead_products::In {
                    present: minuend,
                    old: subtrahend,
                    ratio,
                };
                part.settle(ports).w.predicted
            }
        };
        let net = Net {
            present,
            lead,
            fresh,
            enough,
            code,
        };
        (net, Nothing)
    }
}
