//! Why a path cannot be generated.

use super::arm::Pose;
use super::circle::CircleError;
use crate::plan::digits::{round_down, round_up};
use crate::settings::tidy;
use std::fmt;

/// A piece that cannot be generated.
#[derive(Debug, Clone, PartialEq)]
pub struct PathError {
    /// The piece, from 0.
    pub piece: usize,
    /// Line of the input it stands in.
    pub line: Option<usize>,
    /// What is wrong.
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

/// What is wrong with a piece.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum Reason {
    /// The path has no piece.
    #[error("the path is empty")]
    Empty,
    /// The piece has no speed and there is none for all.
    #[error("missing")]
    NoSpeed,
    /// The speed is none.
    #[error("is {} mm/s", tidy(*speed))]
    Speed {
        /// In mm/s.
        speed: f64,
    },
    /// A coordinate is not a number.
    #[error("{axis} is {value}")]
    Coordinate {
        /// "x", "y" or "z".
        axis: &'static str,
        /// In mm.
        value: f64,
    },
    /// A coordinate of the point via is not a number.
    #[error("{axis} is {value}")]
    Via {
        /// "x", "y" or "z".
        axis: &'static str,
        /// In mm.
        value: f64,
    },
    /// The points make no line or arc.
    #[error(transparent)]
    Circle(#[from] CircleError),
    /// The circuit makes lines and arcs only.
    #[error("is a spline")]
    Spline,
    /// A fourth axis moves along a spline, which has no word for it.
    #[error("is a spline along which W moves")]
    Climb,
    /// The arc or spline does not begin or end where the path does.
    #[error("the curve is {} mm off the path's points", tidy(*gap))]
    Gap {
        /// Distance in mm.
        gap: f64,
    },
    /// A blend would reach farther around the arc than 60°.
    #[error(
        "at {} mm/s a blend reaches {} mm along an arc of {} mm radius",
        tidy(*speed),
        tidy(*chord),
        tidy(*radius)
    )]
    Tight {
        /// The wanted speed.
        speed: f64,
        /// Vs·ta.
        chord: f64,
        /// R.
        radius: f64,
        /// The largest speed that fits.
        most: f64,
    },
    /// The blends at both ends overlap.
    #[error(
        "at {} mm/s the blends at its ends take more than the piece, {} mm",
        tidy(*speed),
        tidy(*length)
    )]
    Overlap {
        /// The wanted speed.
        speed: f64,
        /// Length of the piece.
        length: f64,
        /// The largest speed that fits.
        most: f64,
    },
    /// The speed is too slow for the fraction that the linear interpolator has of it.
    #[error("at {} mm/s the axis with the longer way goes too few counts in a scan", tidy(*speed))]
    Slow {
        /// The wanted speed.
        speed: f64,
        /// The smallest speed that it can go in this direction.
        least: f64,
    },
    /// More samples than a record can hold.
    #[error("takes {} samples at {} mm/s", tidy(*samples), tidy(*speed))]
    Samples {
        /// The wanted speed.
        speed: f64,
        /// What it would take.
        samples: f64,
        /// What a record can hold.
        most: u64,
    },
    /// The memory has no room for so many segments.
    #[error("the path has {count} segments, which take addresses of A = {needed} bits")]
    Segments {
        /// Segments of the path.
        count: usize,
        /// What the memory holds.
        most: usize,
        /// The width that its address would need.
        needed: usize,
    },
    /// The arm cannot be in a pose that the piece needs, or is too near to one.
    #[error("{} s from the start {pose}", tidy(*time_s))]
    Pose {
        /// When, in seconds.
        time_s: f64,
        /// The pose.
        pose: Pose,
    },
    /// The path leaves the plane of two axes.
    #[error("leaves the plane of x and y by {} mm", tidy(*off))]
    Plane {
        /// How far, in mm.
        off: f64,
    },
    /// A coordinate, centre, radius or length does not fit in the words.
    #[error("{what} reaches {counts:.1} counts, which needs W = {needed}")]
    Reach {
        /// "x", "centre x", "radius" and so on.
        what: &'static str,
        /// How far it reaches, in counts, with the error of the arithmetic.
        counts: f64,
        /// The farthest that fits.
        most: i64,
        /// The width of the words.
        width: usize,
        /// The width that it would need.
        needed: usize,
    },
}

impl Reason {
    /// The key of a scenario's piece that is at fault.
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
            | Reason::Samples { .. } => "speed_mm_per_s",
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

    /// The word of a part program's block that is at fault.
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

    /// What would be right.
    #[must_use]
    pub fn allowed(&self) -> String {
        let at_most = |speed: &f64| {
            let least = round_down(*speed);
            format!("at most {least} mm/s (F{})", round_down(60.0 * least))
        };
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
                let least = round_up(*least);
                let feed = round_up(60.0 * least);
                format!("at least {least} mm/s (F{feed}) in this direction, or a longer scan")
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
