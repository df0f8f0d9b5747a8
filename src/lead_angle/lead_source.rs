//! What a compensator can take its lead from.

use super::time_lead::History;
use super::{SpeedLead, TimeLead, speed_lead, time_lead};
use crate::kernel::Circuit;
use crate::logic::Logic;
use std::fmt::Debug;

/// Where the lead comes from: a circuit beside its names in a compensator.
pub trait LeadSource<const C: usize, const W: usize, const N: usize>:
    Circuit + Clone + Debug + Default
{
    /// The name of a compensator with it.
    const COMPENSATOR: &'static str;
    /// What such a compensator is, in one line.
    const COMPENSATOR_ABOUT: &'static str;
    /// Its ports in.
    fn ports<L: Logic>(i: SourceIn<L, C, W, N>) -> Self::In<L>;
    /// Its ports out.
    fn outputs<L: Logic>(q: &Self::Reg<L>, w: &Self::Net<L>) -> SourceOut<L, W>;
}

/// What any source is given; it takes what it needs.
#[derive(Debug, Clone)]
pub struct SourceIn<L: Logic, const C: usize, const W: usize, const N: usize> {
    /// CK: a sample is taken.
    pub ck: L::Bit,
    /// What was sampled so far counts no more.
    pub restart: L::Bit,
    /// The position.
    pub position: L::I<W>,
    /// Δt in CKs.
    pub time: L::U<C>,
    /// a of Fig. 7.
    pub parameter: L::U<14>,
    /// CKs of a gate of Fig. 7.
    pub gate: L::U<N>,
}

/// What any source gives.
#[derive(Debug, Clone)]
pub struct SourceOut<L: Logic, const W: usize> {
    /// Dx: the present sample.
    pub present: L::I<W>,
    /// The lead.
    pub lead: L::I<W>,
    /// Both are new in this tick.
    pub fresh: L::Bit,
    /// They can be trusted.
    pub enough: L::Bit,
}

impl<
    H: History<T, W>,
    const K: usize,
    const T: usize,
    const C: usize,
    const W: usize,
    const N: usize,
> LeadSource<C, W, N> for TimeLead<H, K, T, C, W>
{
    const COMPENSATOR: &'static str = H::COMPENSATOR;
    const COMPENSATOR_ABOUT: &'static str = H::COMPENSATOR_ABOUT;

    fn ports<L: Logic>(i: SourceIn<L, C, W, N>) -> time_lead::In<L, C, W> {
        time_lead::In {
            ck: i.ck,
            restart: i.restart,
            position: i.position,
            lead_time: i.time,
        }
    }

    fn outputs<L: Logic>(_: &Self::Reg<L>, w: &Self::Net<L>) -> SourceOut<L, W> {
        SourceOut {
            present: w.present,
            lead: w.lead,
            fresh: w.fresh,
            enough: w.enough,
        }
    }
}

impl<const C: usize, const W: usize, const N: usize> LeadSource<C, W, N> for SpeedLead<W, N> {
    const COMPENSATOR: &'static str = "conventional_compensator";
    const COMPENSATOR_ABOUT: &'static str =
        "compensator whose lead is measured speed times a parameter";

    fn ports<L: Logic>(i: SourceIn<L, C, W, N>) -> speed_lead::In<L, W, N> {
        speed_lead::In {
            ck: i.ck,
            restart: i.restart,
            position: i.position,
            lead_parameter: i.parameter,
            gate: i.gate,
        }
    }

    fn outputs<L: Logic>(q: &Self::Reg<L>, w: &Self::Net<L>) -> SourceOut<L, W> {
        SourceOut {
            present: q.present,
            lead: w.lead,
            fresh: q.fresh,
            enough: q.enough,
        }
    }
}
