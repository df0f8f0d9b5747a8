//! Errors of path generation.

use super::arm::Pose;
use super::circle::CircleError;
use crate::plan::digits::{round_down, round_up};
use crate::settings::tidy;
use std::fmt;

/// Piece that cannot be generated.
#[derive(Debug, Clone, PartialEq)]
pub struct PathError {
    /// Index of the piece, from 0.
    pub piece: usize,
    /// Line of the piece in the input.
    pub line: Option<usize>,
    pub reason: Reason,
}

impl std::error::Error for PathError {}

impl fmt::Display for PathError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "piece {}", self.piece)?;
        if let Some(line) = self.line {
            write!(f, " (line {line})")?;
        }
        write!(f, ": {}; allowed: {}", self.reason, self.reason.allowed())
    }
}

/// Reason why a piece cannot be generated.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum Reason {
    /// The path has no piece.
    #[error("the path is empty")]
    Empty,
    /// The piece has no speed and there is no default.
    #[error("missing")]
    NoSpeed,
    /// The speed is not positive.
    #[error("is {} mm/min", tidy(60.0 * speed))]
    Speed {
        /// Speed in mm/s.
        speed: f64,
    },
    /// A coordinate is not a number.
    #[error("{axis} is {value}")]
    Coordinate {
        /// Axis: "x", "y" or "z".
        axis: &'static str,
        /// Value in mm.
        value: f64,
    },
    /// A coordinate of the point via is not a number.
    #[error("{axis} is {value}")]
    Via {
        /// Axis: "x", "y" or "z".
        axis: &'static str,
        /// Value in mm.
        value: f64,
    },
    /// The points define no line or arc.
    #[error(transparent)]
    Circle(#[from] CircleError),
    /// The circuit supports lines and arcs only.
    #[error("is a spline")]
    Spline,
    /// A fourth axis moves along a spline, for which there is no record format.
    #[error("is a spline along which W moves")]
    Climb,
    /// The arc or spline does not begin or end at the path's points.
    #[error("the curve is {} mm off the path's points", tidy(*gap))]
    Gap {
        /// Distance in mm.
        gap: f64,
    },
    /// A blend would extend along the arc by more than 60°.
    #[error(
        "at {} mm/min a blend reaches {} mm along an arc of {} mm radius",
        tidy(60.0 * speed),
        tidy(*chord),
        tidy(*radius)
    )]
    Tight {
        /// Requested speed in mm/s.
        speed: f64,
        /// Length Vs·ta in mm.
        chord: f64,
        /// Radius R in mm.
        radius: f64,
        /// Greatest possible speed in mm/s.
        most: f64,
    },
    /// The blends at both ends overlap.
    #[error(
        "at {} mm/min the blends at its ends take more than the piece, {} mm",
        tidy(60.0 * speed),
        tidy(*length)
    )]
    Overlap {
        /// Requested speed in mm/s.
        speed: f64,
        /// Length of the piece in mm.
        length: f64,
        /// Greatest possible speed in mm/s.
        most: f64,
    },
    /// The speed is below the resolution of the linear interpolator.
    #[error("at {} mm/min the axis with the longer way goes too few counts in a scan", tidy(60.0 * speed))]
    Slow {
        /// Requested speed in mm/s.
        speed: f64,
        /// Least possible speed in this direction, in mm/s.
        least: f64,
    },
    /// The piece takes more samples than a record can hold.
    #[error("takes {} samples at {} mm/min", tidy(*samples), tidy(60.0 * speed))]
    Samples {
        /// Requested speed in mm/s.
        speed: f64,
        /// Number of samples needed.
        samples: f64,
        /// Greatest number of samples in a record.
        most: u64,
    },
    /// The memory has no space for all segments.
    #[error("the path has {count} segments, which take addresses of A = {needed} bits")]
    Segments {
        /// Number of segments of the path.
        count: usize,
        /// Number of segments in the memory.
        most: usize,
        /// Address width needed, in bits.
        needed: usize,
    },
    /// The arm cannot take a pose of the piece, or is too close to a singular one.
    #[error("{} s from the start {pose}", tidy(*time_s))]
    Pose {
        /// Time in seconds.
        time_s: f64,
        /// Pose at fault.
        pose: Pose,
    },
    /// The path leaves the plane of the two axes.
    #[error("leaves the plane of x and y by {} mm", tidy(*off))]
    Plane {
        /// Distance from the plane in mm.
        off: f64,
    },
    /// A coordinate, centre, radius or length does not fit in its words.
    #[error("{what} reaches {counts:.1} counts, which needs W = {needed}")]
    Reach {
        /// Name of the quantity: "x", "centre x", "radius" and so on.
        what: &'static str,
        /// Greatest value in counts, including the error of the arithmetic.
        counts: f64,
        /// Greatest value that fits, in counts.
        most: i64,
        /// Width of the words in bits.
        width: usize,
        /// Width needed in bits.
        needed: usize,
    },
}

impl Reason {
    /// Returns the key of the scenario's piece that is at fault.
    #[must_use]
    pub fn field(&self) -> &'static str {
        match self {
            Reason::Empty | Reason::Segments { .. } => "piece",
            Reason::Spline | Reason::Climb => "spline",
            Reason::NoSpeed
            | Reason::Speed { .. }
            | Reason::Tight { .. }
            | Reason::Overlap { .. }
            | Reason::Slow { .. }
            | Reason::Samples { .. } => "feed_mm_per_min",
            Reason::Via { .. }
            | Reason::Circle(CircleError::Collinear { .. })
            | Reason::Circle(CircleError::Coincident {
                points: ["start", "via"] | ["via", "end"],
            }) => "via_mm",
            Reason::Coordinate { .. }
            | Reason::Circle(_)
            | Reason::Gap { .. }
            | Reason::Plane { .. }
            | Reason::Pose { .. }
            | Reason::Reach { .. } => "to_mm",
        }
    }

    /// Returns the word of the part program's block that is at fault.
    #[must_use]
    pub fn word(&self) -> &'static str {
        match self {
            Reason::Empty | Reason::Segments { .. } => "path",
            Reason::NoSpeed
            | Reason::Speed { .. }
            | Reason::Tight { .. }
            | Reason::Overlap { .. }
            | Reason::Slow { .. }
            | Reason::Samples { .. } => "F",
            Reason::Circle(CircleError::Helix { .. }) | Reason::Plane { .. } => "Z",
            Reason::Spline | Reason::Climb => "G5",
            Reason::Pose { .. } => "arm",
            Reason::Circle(_) | Reason::Gap { .. } => "arc",
            Reason::Reach { what, .. } => what,
            Reason::Coordinate { axis, .. } | Reason::Via { axis, .. } => axis,
        }
    }

    /// Returns the allowed values.
    #[must_use]
    pub fn allowed(&self) -> String {
        let at_most = |speed: &f64| format!("at most {} mm/min", round_down(60.0 * speed));
        match self {
            Reason::Empty => "one piece or more".into(),
            Reason::NoSpeed => "a speed of the piece, or one for all".into(),
            Reason::Speed { .. } => "a speed above 0".into(),
            Reason::Coordinate { .. } | Reason::Via { .. } => "a number".into(),
            Reason::Circle(CircleError::Coincident { .. }) => "points apart".into(),
            Reason::Circle(CircleError::Collinear { .. }) => {
                "a point off the line, or a line: no point via".into()
            }
            Reason::Circle(CircleError::Helix { .. }) => {
                "an arc in a plane: a rotation has no feed along its axis".into()
            }
            Reason::Circle(CircleError::Radii { .. }) => "a centre as far from both".into(),
            Reason::Spline => "a line or an arc".into(),
            Reason::Climb => "a line or an arc, or W at rest".into(),
            Reason::Gap { .. } => "a curve from the end of the piece before to its own end".into(),
            Reason::Tight { most, .. } => {
                format!(
                    "{}, whose blends reach no farther than the radius",
                    at_most(most)
                )
            }
            Reason::Overlap { most, .. } => format!("{}, or shorter blends", at_most(most)),
            Reason::Slow { least, .. } => {
                let least = round_up(60.0 * least);
                format!("at least {least} mm/min in this direction, or a longer scan")
            }
            Reason::Samples { most, .. } => {
                format!("at most {most} samples: faster, shorter, or sampled less often")
            }
            Reason::Pose { pose, .. } => pose.allowed(),
            Reason::Plane { .. } => "the height of the start, or three axes".into(),
            Reason::Segments { most, .. } => format!("at most {most}"),
            Reason::Reach { most, width, .. } => {
                format!("-{most} to {most} counts at W = {width}: fewer counts per mm")
            }
        }
    }
}
