use super::Circuit;
use crate::logic::Sim;

/// A circuit that knows how long it only counts.
///
/// A tick is *idle* if its edge changes nothing but free-running counters, each of them by one,
/// and if no port out changes with it, those that are nets included. Which registers are such
/// counters the implementation says.
/// [`Simulator::fast_forward`](super::Simulator::fast_forward) goes over idle ticks in one.
pub trait FastForward: Circuit {
    /// How many ticks, from this one on, are idle if the inputs stay as they are. It may be fewer
    /// than there are, never more; 0 where this one is not.
    fn idle(&self, q: &Self::Reg<Sim>, i: &Self::In<Sim>) -> u64;

    /// Makes the registers those after so many idle ticks.
    fn forward(&self, q: &mut Self::Reg<Sim>, ticks: u64);
}
