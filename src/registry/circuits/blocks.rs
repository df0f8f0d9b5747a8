use crate::registry::Entry;

/// Blocks that more than one circuit is made of.
pub(super) const CIRCUITS: &[Entry] = &[];
