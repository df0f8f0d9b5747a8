//! What a compensator can have for its position detector 10.

use super::AbsoluteDetector;
use crate::circuits::blocks::QuadratureCounter;
use crate::hdl::prelude::*;
use serde::{Deserialize, Serialize};

/// The kind of a compensator's position detector.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Detector {
    /// An incremental encoder and a counter, sampled with a CK of the reference clock.
    #[default]
    Incremental,
    /// An absolute encoder of a turn, whose sampling clock is CK.
    Absolute,
}

choice! {
    /// 10.
    pub enum DetectorSource as DetectorPart {
        /// The counter.
        Incremental(QuadratureCounter),
        /// The words of a turn, continued.
        Absolute(AbsoluteDetector),
    }
}
