//! Widths that several circuits of the linear interpolator share, in bits, with the letters that
//! stand for them in the descriptions of ports.

use super::PatternGenerator;

/// Widths of the circuits that compute position commands.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Widths {
    /// Addresses of the buffer of targets, which holds 2^`address` − 1 targets.
    pub address: usize,
    /// P: positions.
    pub position: usize,
    /// T: acceleration and deceleration times, narrower than positions. Speeds have as many
    /// fraction bits.
    pub time: usize,
}

impl Widths {
    /// Widths of the standard build.
    pub const FULL: Self = Widths {
        address: 6,
        position: 32,
        time: 12,
    };

    /// The pattern generator of such positions and times.
    pub(super) const fn pattern(self) -> PatternGenerator {
        PatternGenerator {
            position: self.position,
            time: self.time,
        }
    }
}

impl Default for Widths {
    fn default() -> Self {
        Self::FULL
    }
}

/// Widths of a position loop.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LoopWidths {
    /// Positions.
    pub position: usize,
    /// Position gain.
    pub gain: usize,
    /// F: fraction bits of the gain.
    pub fraction: usize,
    /// D: words of the D/A converter.
    pub converter: usize,
}

impl LoopWidths {
    /// Widths of the standard build.
    pub const FULL: Self = LoopWidths {
        position: 32,
        gain: 16,
        fraction: 8,
        converter: 16,
    };

    /// The product of a position and the gain.
    #[must_use]
    pub const fn product(self) -> usize {
        self.position + self.gain
    }
}

impl Default for LoopWidths {
    fn default() -> Self {
        Self::FULL
    }
}
