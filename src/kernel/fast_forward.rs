use super::Circuit;

/// A circuit that [`Simulator::fast_forward`](super::Simulator::fast_forward) can run: while it
/// [coasts](Circuit::coasts_for) under inputs that stay as they are, no port out changes, those that
/// are nets included.
pub trait FastForward: Circuit {}

/// For how many ticks all of the parts coast, of which each coasts for so many.
#[inline(always)]
pub fn least<const K: usize>(parts: [u64; K]) -> u64 {
    parts.into_iter().fold(u64::MAX, u64::min)
}

/// For how many ticks a counter that stands at `count` only counts, if it starts again at `limit`:
/// those after whose edge it is still below.
#[inline(always)]
pub fn ticks_below(count: u64, limit: u64) -> u64 {
    limit.saturating_sub(1).saturating_sub(count)
}
