use crate::registry::Entry;

/// The circuits of JP3608587B2.
pub(super) const CIRCUITS: &[Entry] = &[];
