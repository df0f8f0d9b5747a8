//! Widths of the pulse interpolator's words.

/// Widths of a group in bits.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Widths {
    /// A half-period.
    pub half_period: usize,
    /// T, the unit time.
    pub period: usize,
    /// An address of the pattern memories.
    pub address: usize,
}

impl Default for Widths {
    fn default() -> Self {
        Widths {
            half_period: 16,
            period: 24,
            address: 12,
        }
    }
}
