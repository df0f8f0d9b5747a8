//! Colours and curves of the picture.

pub const LINE: &str = "#0072b2";
pub const ARC: &str = "#d55e00";
pub const BLEND: &str = "#009e73";
/// Closed forms, bounds and what is wanted.
pub const EXPECTED: &str = "#8c8c8c";
pub const GAP: (f64, f64) = (f64::NAN, f64::NAN);
/// More arcs than these have no marks: their words would lie upon each other.
pub const ARCS_MARKED: usize = 2;

/// A curve with gaps.
pub type Points = Vec<(f64, f64)>;
