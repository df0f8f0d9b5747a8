//! Widths of the trajectory controller's words.

use super::arc_angle::EXTRA;
use super::error_feedback::FeedbackWidths;
use super::model_state::ModelWidths;
use super::segment_store::WORDS;
use super::servo_arithmetic::{FINE, LEFT, ServoWidths};
use crate::circuits::arc_generator::Widths as RecordWidths;

/// Widths in bits.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Widths {
    /// W: counts of a coordinate or of the path's length, signed.
    pub position: usize,
    /// P: points and lengths inside, signed, with P − W guard bits below the count.
    pub point: usize,
    /// R: radii and coordinates within a segment, signed, with R − P bits below the guard unit.
    pub radius: usize,
    /// C: coefficients of a segment, signed, with C − 2 fraction bits.
    pub coefficient: usize,
    /// M: mantissa of a curvature.
    pub curvature: usize,
    /// H: angles, in units of 2^−H turn.
    pub angle: usize,
    /// D: words of a segment, and of a record of the profile.
    pub data: usize,
    /// A: number of a segment.
    pub segment: usize,
    /// F: fractions of the profile's difference engine; the modulus is at most 2^(F − 1).
    pub fraction: usize,
    /// N: samples of a record of the profile.
    pub samples: usize,
    /// T: ticks of an interpolation period.
    pub period: usize,
    /// K: gains of the reference model, with K − 1 fraction bits.
    pub gain: usize,
    /// Gains of the servo controls; that of the position has all bits but one below the point.
    pub servo_gain: usize,
    /// Torques, signed.
    pub torque: usize,
}

impl Widths {
    /// The circuit's own.
    pub const FULL: Widths = Widths {
        position: 31,
        point: 47,
        radius: 55,
        coefficient: 42,
        curvature: 44,
        angle: 44,
        data: 55,
        segment: 12,
        fraction: 41,
        samples: 20,
        period: 24,
        gain: 16,
        servo_gain: 24,
        torque: 16,
    };

    /// G: bits below the count.
    #[must_use]
    pub const fn guard(&self) -> usize {
        self.point - self.position
    }

    /// Bits below the point of the servo controls' gains but that of the position.
    #[must_use]
    pub const fn torque_fraction(&self) -> usize {
        self.servo_gain - 1 + FINE - LEFT
    }

    /// The most segments of a path.
    #[must_use]
    pub const fn most_segments(&self) -> usize {
        1 << self.segment
    }

    /// Widths of the profile's records, which have the format of the arc generator's.
    #[must_use]
    pub const fn record(&self) -> RecordWidths {
        RecordWidths {
            position: self.position,
            point: self.point,
            coefficient: self.coefficient,
            fraction: self.fraction,
            data: self.data,
            samples: self.samples,
            period: self.period,
        }
    }

    /// Widths of the points on the path.
    #[must_use]
    pub const fn point(&self) -> PointWidths {
        PointWidths {
            point: self.point,
            radius: self.radius,
            coefficient: self.coefficient,
            curvature: self.curvature,
            angle: self.angle,
            data: self.data,
            segment: self.segment,
            word: 4,
        }
    }

    /// Widths of the reference models.
    #[must_use]
    pub const fn model(&self) -> ModelWidths {
        ModelWidths {
            position: self.point,
            gain: self.gain,
        }
    }

    /// Widths of the error feedback.
    #[must_use]
    pub const fn feedback(&self) -> FeedbackWidths {
        FeedbackWidths {
            count: self.position,
            position: self.point,
            gain: self.gain,
        }
    }

    /// Widths of the servo controls.
    #[must_use]
    pub const fn servo(&self) -> ServoWidths {
        ServoWidths {
            count: self.position,
            position: self.point,
            gain: self.servo_gain,
            torque: self.torque,
            model_gain: self.gain,
        }
    }
}

/// Widths of the point at a length along the path, in bits.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PointWidths {
    /// P: points and lengths, signed, in guard units.
    pub point: usize,
    /// R: radii and coordinates within a segment, signed, with R − P bits below the guard unit.
    pub radius: usize,
    /// C: coefficients of a segment, signed, with C − 2 fraction bits.
    pub coefficient: usize,
    /// M: mantissa of a curvature.
    pub curvature: usize,
    /// H: angles, in units of 2^−H turn.
    pub angle: usize,
    /// D: words of a segment.
    pub data: usize,
    /// A: number of a segment.
    pub segment: usize,
    /// Number of a word of a segment: 4, or 5 where it has words for a fourth axis.
    pub word: usize,
}

impl PointWidths {
    /// Returns the widths for this number of axes.
    #[must_use]
    pub const fn of_axes(self, axes: usize) -> Self {
        let word = if axes > 3 { 5 } else { 4 };
        PointWidths { word, ..self }
    }

    /// Words of a segment.
    #[must_use]
    pub const fn words(&self) -> usize {
        if self.word > 4 { WORDS + 4 } else { WORDS }
    }

    /// Bits of a radius below the guard unit.
    #[must_use]
    pub const fn fine(&self) -> usize {
        self.radius - self.point
    }

    /// Sum of an axis: three radii, doubled.
    #[must_use]
    pub const fn sum(&self) -> usize {
        self.radius + 3
    }

    /// Product of an offset and a curvature: a sum of two offsets with the bits below them.
    #[must_use]
    pub const fn product(&self) -> usize {
        self.point + EXTRA + 1
    }

    /// Address of a word of a segment.
    #[must_use]
    pub const fn address(&self) -> usize {
        self.segment + self.word
    }
}
