//! Path planning: converts a [`Drawing`](crate::input::Drawing) into a position over time.
//!
//! A [`Plan`] gives every move a trapezoidal speed profile along the path, with look-ahead over
//! all moves. The speed is limited by the feed (or the rapid rate), the centripetal limit on arcs,
//! and the corner speed at junctions; it is zero at both ends, and the tangential acceleration is
//! bounded. A [`Sampler`] then returns the position at any time.
//!
//! Tangential and centripetal acceleration are limited separately, so their sum while braking on
//! an arc at its limit may reach √2 times the setting.

pub(crate) mod chords;
pub(crate) mod digits;
mod geometry;
mod profile;
mod sampler;
#[cfg(test)]
mod tests;

pub use chords::outline;
pub(crate) use geometry::{check, norm};
pub(crate) use profile::junction;
pub use profile::{Plan, Segment};
pub use sampler::{Sample, Sampler};

use crate::input::REACH_MM;
use crate::settings::{SettingError, settings, tidy};

/// Allowed feed in mm/min.
pub const FEED_RANGE: std::ops::RangeInclusive<f64> = 1e-3..=1e7;

/// Allowed acceleration in mm/s².
pub const ACCELERATION_RANGE: std::ops::RangeInclusive<f64> = 1e-3..=1e9;

/// Greatest absolute value of an arc centre's coordinate, in millimetres.
pub const CENTRE_REACH_MM: f64 = 1e3 * REACH_MM;

settings! {
    /// Speeds and acceleration of a path.
    #[derive(Copy)]
    pub struct MotionLimits {
        /// Feed of the moves that set none.
        pub feed_mm_per_min: f64 = 1200.0, in FEED_RANGE;
        /// Speed with the pen up, and of G0.
        pub rapid_mm_per_min: f64 = 3000.0, in FEED_RANGE;
        /// Largest sudden change of the velocity vector at a corner; 0 stops at every corner.
        pub corner_mm_per_min: f64 = 60.0, in 0.0..=*FEED_RANGE.end();
        /// Largest tangential and largest centripetal acceleration.
        pub acceleration_mm_per_s2: f64 = 500.0, in ACCELERATION_RANGE;
    }
}

/// Reason why a path cannot be planned.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum PlanError {
    /// A limit is outside its range.
    #[error(transparent)]
    Setting(#[from] SettingError),
    /// A move's own feed is outside its range.
    #[error(
        "line {line}: feed {} mm/min: allowed are {} to {}",
        tidy(*value),
        FEED_RANGE.start(),
        FEED_RANGE.end()
    )]
    Feed {
        /// Line of the input.
        line: usize,
        /// Feed in mm/min.
        value: f64,
    },
    /// A coordinate is not a number or out of reach. Line 0 is the start of the drawing.
    #[error("line {line}: {coordinate} = {} mm: allowed are -{reach} to {reach}", tidy(*value))]
    Coordinate {
        /// Line of the input.
        line: usize,
        /// Name: "X", "Y", "Z", "centre X" or "centre Y".
        coordinate: &'static str,
        /// Value in millimetres.
        value: f64,
        /// Greatest absolute value allowed, in millimetres.
        reach: f64,
    },
    /// A move is on a spline.
    #[error("line {line}: a spline: allowed are lines and arcs, as without Options::splines")]
    Spline {
        /// Line of the input.
        line: usize,
    },
    /// An arc starts or ends at its centre.
    #[error("line {line}: arc of radius {} mm: allowed is any above 0", tidy(*radius_mm))]
    Radius {
        /// Line of the input.
        line: usize,
        /// Smaller of the radii at the start and at the end, in millimetres.
        radius_mm: f64,
    },
}
