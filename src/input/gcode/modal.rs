//! Modal state: values that stay in force from line to line.

use super::block::{Code, name};
use crate::input::Point;

/// Motion made by axis words.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Motion {
    Rapid,
    Line,
    Arc {
        clockwise: bool,
    },
    /// G5.
    Cubic,
    /// G5.1.
    Quadratic,
    /// G5.2.
    Nurbs,
    /// G5.3.
    NurbsEnd,
    /// G6.2.
    KnottedNurbs,
    /// G38.2 to G38.5, executed as if nothing was touched.
    Probe,
    /// G73, G81 to G86 and G89.
    Cycle(u32),
}

impl Motion {
    /// Returns the G word of the motion; G38 for a probe.
    pub(super) fn code(self) -> Code {
        match self {
            Self::Rapid => (0, 0),
            Self::Line => (1, 0),
            Self::Arc { clockwise: true } => (2, 0),
            Self::Arc { clockwise: false } => (3, 0),
            Self::Cubic => (5, 0),
            Self::Quadratic => (5, 1),
            Self::Nurbs => (5, 2),
            Self::NurbsEnd => (5, 3),
            Self::KnottedNurbs => (6, 2),
            Self::Probe => (38, 0),
            Self::Cycle(code) => (code, 0),
        }
    }

    pub(super) fn name(self) -> String {
        name('G', self.code())
    }
}

/// Plane of arcs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Plane {
    Xy,
    Zx,
    Yz,
}

impl Plane {
    /// Returns the two axes of the plane and the third, right-handed.
    pub(super) fn axes(self) -> [usize; 3] {
        match self {
            Self::Xy => [0, 1, 2],
            Self::Zx => [2, 0, 1],
            Self::Yz => [1, 2, 0],
        }
    }
}

/// Modal state of a machine.
#[derive(Debug, Clone, Copy)]
pub(super) struct Modal {
    pub(super) motion: Option<Motion>,
    pub(super) plane: Plane,
    pub(super) relative: bool,
    /// True if I, J and K are coordinates (G90.1).
    pub(super) centres_absolute: bool,
    pub(super) mm_per_unit: f64,
    pub(super) feed_mm_per_min: Option<f64>,
    /// True if F is one over the minutes of a move (G93).
    pub(super) inverse_time: bool,
    /// True if cycles end at R (G99).
    pub(super) ends_at_r: bool,
    /// True if the program has chosen G98 or G99.
    pub(super) end_chosen: bool,
    /// Tool length.
    pub(super) tool: Point,
    /// Coordinate system; 0 is G54.
    pub(super) system: usize,
}

impl Default for Modal {
    fn default() -> Self {
        Self {
            motion: None,
            plane: Plane::Xy,
            relative: false,
            centres_absolute: false,
            mm_per_unit: 1.0,
            feed_mm_per_min: None,
            inverse_time: false,
            ends_at_r: true,
            end_chosen: false,
            tool: [0.0; 3],
            system: 0,
        }
    }
}
