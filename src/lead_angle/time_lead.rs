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
//! The history is a parameter: the shift register, or the RAM that equals it in every tick.

use super::position_history::{self, Pair};
use super::{Lead, PositionHistory, RamHistory, RatioLogic, lead, ram_history, ratio_logic};
use crate::kernel::{Circuit, Instance, Nothing};
use crate::logic::{Logic, Sim};
use crate::signals;
use std::fmt::Debug;

/// A form of the memory 11.
pub trait History<const T: usize, const W: usize>: Circuit + Clone + Debug + Default {
    /// The name of a time lead with it.
    const TIME_LEAD: &'static str;
    /// What such a time lead is, in one line.
    const TIME_LEAD_ABOUT: &'static str;
    /// The name of a compensator with it.
    const COMPENSATOR: &'static str;
    /// What such a compensator is, in one line.
    const COMPENSATOR_ABOUT: &'static str;
    /// Its ports in.
    fn ports<L: Logic>(i: position_history::In<L, T, W>) -> Self::In<L>;
    /// Its ports out.
    fn pair<L: Logic>(q: &Self::Reg<L>) -> &Pair<L, T, W>;
}

impl<const K: usize, const T: usize, const W: usize> History<T, W> for PositionHistory<K, T, W> {
    const TIME_LEAD: &'static str = "time_lead";
    const TIME_LEAD_ABOUT: &'static str = "the lead of a time, from a shift register of samples";
    const COMPENSATOR: &'static str = "compensator";
    const COMPENSATOR_ABOUT: &'static str = "lead-angle compensator that learns its lead times";

    fn ports<L: Logic>(i: position_history::In<L, T, W>) -> Self::In<L> {
        i
    }

    fn pair<L: Logic>(q: &position_history::Reg<L, K, T, W>) -> &Pair<L, T, W> {
        &q.pair
    }
}

impl<const K: usize, const T: usize, const W: usize> History<T, W> for RamHistory<K, T, W> {
    const TIME_LEAD: &'static str = "ram_time_lead";
    const TIME_LEAD_ABOUT: &'static str = "the lead of a time, from a RAM of samples";
    const COMPENSATOR: &'static str = "ram_compensator";
    const COMPENSATOR_ABOUT: &'static str = "lead-angle compensator with its history in a RAM";

    fn ports<L: Logic>(i: position_history::In<L, T, W>) -> Self::In<L> {
        i
    }

    fn pair<L: Logic>(q: &ram_history::Reg<L, T, W>) -> &Pair<L, T, W> {
        &q.pair
    }
}

signals! {
    /// Ports in.
    pub struct In<L, const C: usize, const W: usize> {
        /// CK: a sample is taken.
        pub ck: L::Bit,
        /// What was sampled so far counts no more.
        pub restart: L::Bit,
        /// The position.
        pub position: L::I<W>,
        /// Δt in CKs.
        pub lead_time: L::U<C>,
    }
}

signals! {
    /// Registers of the blocks.
    pub struct Reg<L, type H: Circuit> {
        /// 11 and 14.
        pub history: H::Reg<L>,
    }
}

signals! {
    /// Nets of the blocks, and the ports out.
    pub struct Net<
        L,
        type H: Circuit,
        const K: usize,
        const T: usize,
        const C: usize,
        const W: usize,
    > {
        /// 13.
        pub ratio_logic: Instance<RatioLogic<K, T, C>, L>,
        /// 11 and 14.
        pub history: Instance<H, L>,
        /// 15 and 16.
        pub lead_arithmetic: Instance<Lead<W>, L>,
        /// Dx: the present sample.
        pub present: L::I<W> as Analog,
        /// N·Δx: the lead.
        pub lead: L::I<W> as Analog,
        /// Sample and lead are new in this tick.
        pub fresh: L::Bit,
        /// The history reaches back as far as the time wants.
        pub enough: L::Bit,
    }
}

/// Lead of a time, with history `H` of `K` stages, taps of `T` bits, times of `C`, positions of `W`.
///
/// A position that stands in the tick of CK is at the outputs, with its lead, in the tick after it.
#[derive(Debug, Clone, Default)]
pub struct TimeLead<H, const K: usize, const T: usize, const C: usize, const W: usize> {
    /// 13.
    pub ratio_logic: RatioLogic<K, T, C>,
    /// 11 and 14.
    pub history: H,
    /// 15 and 16.
    pub lead: Lead<W>,
}

impl<H: History<T, W>, const K: usize, const T: usize, const C: usize, const W: usize> Circuit
    for TimeLead<H, K, T, C, W>
{
    const NAME: &'static str = H::TIME_LEAD;
    const ABOUT: &'static str = H::TIME_LEAD_ABOUT;
    type In<L: Logic> = In<L, C, W>;
    type Reg<L: Logic> = Reg<L, H>;
    type Net<L: Logic> = Net<L, H, K, T, C, W>;

    fn comb<L: Logic>(&self, q: &Reg<L, H>, i: &In<L, C, W>) -> Net<L, H, K, T, C, W> {
        let ratio_logic = Instance::settle(
            &self.ratio_logic,
            &Nothing::new(),
            ratio_logic::In {
                lead_time: i.lead_time,
            },
        );
        let history: Instance<H, L> = Instance::settle(
            &self.history,
            &q.history,
            H::ports(position_history::In {
                ck: i.ck,
                restart: i.restart,
                position: i.position,
                tap: ratio_logic.w.tap,
                ratio: ratio_logic.w.ratio,
            }),
        );
        let pair = H::pair(&q.history);
        let lead_arithmetic = Instance::settle(
            &self.lead,
            &Nothing::new(),
            lead::In {
                present: pair.present,
                old: pair.old,
                ratio: pair.pair_ratio,
            },
        );
        Net {
            present: pair.present,
            lead: lead_arithmetic.w.lead,
            fresh: pair.fresh,
            enough: pair.enough,
            ratio_logic,
            history,
            lead_arithmetic,
        }
    }

    fn next<L: Logic>(
        &self,
        q: Reg<L, H>,
        w: &Net<L, H, K, T, C, W>,
        _: &In<L, C, W>,
    ) -> Reg<L, H> {
        Reg {
            history: w.history.next(&self.history, q.history),
        }
    }

    fn power_on(&self) -> Reg<Sim, H> {
        Reg {
            history: self.history.power_on(),
        }
    }
}
