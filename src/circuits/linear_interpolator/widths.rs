//! Widths that several circuits of the linear interpolator share, in bits, with the letters that the
//! ports' descriptions have for them.

use super::PatternGenerator;

/// Widths of the circuits that make position commands.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Widths {
    /// An address in the buffer of targets, which holds 2^`address` − 1 of them.
    pub address: usize,
    /// A position, P.
    pub position: usize,
    /// An acceleration or deceleration time, T, fewer than a position has; as many are the fraction
    /// of a speed.
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
    /// A position.
    pub position: usize,
    /// The gain.
    pub gain: usize,
    /// The gain's fraction, F, a part of it.
    pub fraction: usize,
    /// The D/A converter, D.
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
