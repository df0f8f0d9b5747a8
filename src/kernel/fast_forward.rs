use super::Circuit;

/// What goes on in a circuit while it [coasts](Circuit::coasts_for) under inputs that stay as they
/// are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FreeRunning {
    /// Nothing: no register and no net changes.
    Nothing,
    /// What goes on in its parts. None of its own registers and nets changes, and no port in of a
    /// part.
    Parts,
    /// Registers and nets of its own, and whatever depends on them in its parts.
    All,
}

impl FreeRunning {
    /// What goes on in a part of it that by itself says `part`.
    pub(crate) const fn within(self, part: FreeRunning) -> FreeRunning {
        match self {
            FreeRunning::Parts => part,
            FreeRunning::Nothing | FreeRunning::All => self,
        }
    }
}

/// A circuit that [`Simulator::fast_forward`](super::Simulator::fast_forward) can run: while it
/// [coasts](Circuit::coasts_for) under inputs that stay as they are, no port out changes, those that
/// are nets included.
pub trait FastForward: Circuit {}

/// For how many ticks all of the parts coast, of which each coasts for so many.
pub fn least<const K: usize>(parts: [u64; K]) -> u64 {
    parts.into_iter().fold(u64::MAX, u64::min)
}

/// For how many ticks a counter that stands at `count` only counts, if it starts again at `limit`:
/// those after whose edge it is still below.
pub fn ticks_below(count: u64, limit: u64) -> u64 {
    limit.saturating_sub(1).saturating_sub(count)
}
