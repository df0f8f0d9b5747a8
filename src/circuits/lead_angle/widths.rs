//! Word lengths and variants of a compensator.

use super::{Comparing, Detector, Function, Placement, Sign, codes};

/// Widths of a compensator.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Widths {
    /// Stages of history.
    pub stages: usize,
    /// Width of a position.
    pub position: usize,
    /// Width of a step number.
    pub step: usize,
    /// Width of a speed.
    pub speed: usize,
    /// Width of times in CKs, other than lead times.
    pub cks: usize,
    /// Width of the period of CK in ticks.
    pub ck_period: usize,
    /// Width of an absolute encoder's word, or of a place in a pitch.
    pub code: usize,
    /// Width of the words of a resolver's A/D converters, no wider than a place.
    pub converter: usize,
}

impl Widths {
    /// Widths for the text's table, with headroom for the rest.
    pub const FULL: Self = Widths {
        stages: codes::STAGES as usize,
        position: 24,
        step: 4,
        speed: 16,
        cks: 16,
        ck_period: 24,
        code: 17,
        converter: 12,
    };

    /// Width of a lead time in CKs.
    #[must_use]
    pub fn time(&self) -> usize {
        codes::time_width(self.stages)
    }
}

impl Default for Widths {
    /// [`Widths::FULL`].
    fn default() -> Self {
        Widths::FULL
    }
}

/// Variants chosen when a compensator is built.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Variant {
    /// Value that the lead is added to.
    pub placement: Placement,
    /// Criterion for reaching the target.
    pub comparing: Comparing,
    /// Sign convention of the error.
    pub sign: Sign,
    /// Function of error and overrun.
    pub function: Function,
    /// Kind of the position detector.
    pub detector: Detector,
}
