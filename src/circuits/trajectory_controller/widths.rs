//! Widths of the trajectory controller's words.

use super::model_state::ModelWidths;
use super::servo_arithmetic::{FINE, LEFT, ServoWidths};
use crate::circuits::arc_generator::Widths as RecordWidths;
use crate::prelude::log2;

/// Words of a segment for three axes.
pub const SEGMENT_WORDS: usize = 16;

/// Bits of the product of an offset and a curvature below the offset's last.
pub const PRODUCT_FRACTION: usize = 4;

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
    /// Gains of the servo controls; the position gain has one integer bit.
    pub servo_gain: usize,
    /// Torques, signed.
    pub torque: usize,
}

impl Widths {
    /// Widths of the standard build.
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
        self.point.saturating_sub(self.position)
    }

    /// Fraction bits of the servo controls' gains, except the position gain.
    #[must_use]
    pub const fn torque_fraction(&self) -> usize {
        self.servo_gain - 1 + FINE - LEFT
    }

    /// Largest number of segments of a path.
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
        if self.word > 4 {
            SEGMENT_WORDS + 4
        } else {
            SEGMENT_WORDS
        }
    }

    /// Bits of a radius below the guard unit.
    #[must_use]
    pub const fn fine(&self) -> usize {
        self.radius - self.point
    }

    /// Width of the sum of an axis: three radii, doubled.
    #[must_use]
    pub const fn sum(&self) -> usize {
        self.radius + 3
    }

    /// Width of the product of an offset and a curvature: the sum of two offsets, with the extra
    /// bits below them.
    #[must_use]
    pub const fn product(&self) -> usize {
        self.point + PRODUCT_FRACTION + 1
    }

    /// Address of a word of a segment.
    #[must_use]
    pub const fn address(&self) -> usize {
        self.segment + self.word
    }
}

/// Widths of an error feedback in bits.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FeedbackWidths {
    /// W: positions of the motors in counts, signed.
    pub count: usize,
    /// P: points in guard units, signed, with P − W guard bits.
    pub position: usize,
    /// K: gains, half of them fraction bits.
    pub gain: usize,
}

impl FeedbackWidths {
    /// Guard bits, which are the fraction bits of a direction.
    pub(super) const fn guard(&self) -> usize {
        self.position - self.count
    }

    /// Pairs of bits of a direction: its fraction, its one and its sign.
    pub(super) const fn direction_pairs(&self) -> usize {
        (self.guard() + 2).div_ceil(2)
    }

    /// Width of a coordinate of a direction, signed.
    pub(super) const fn direction(&self) -> usize {
        2 * self.direction_pairs()
    }

    /// Pairs of bits of a gain.
    pub(super) const fn gain_pairs(&self) -> usize {
        self.gain.div_ceil(2)
    }

    /// Width of the number of a pair of either.
    pub(super) const fn pair(&self) -> usize {
        let (direction, gain) = (self.direction_pairs(), self.gain_pairs());
        log2(if direction > gain { direction } else { gain })
    }

    /// Fraction bits of a gain.
    pub const fn gain_fraction(&self) -> usize {
        self.gain / 2
    }

    /// Bits of a gain, or of a direction, that are not fraction.
    pub(super) const fn whole(&self) -> usize {
        let (gain, direction) = (
            2 * self.gain_pairs() - self.gain_fraction(),
            self.direction() - self.guard(),
        );
        if gain > direction { gain } else { direction }
    }

    /// Width of an error, normal or tangential.
    pub(super) const fn error(&self) -> usize {
        self.position + 2
    }

    /// Width of a sum: four times four errors, or a normal and a tangential error, and the integer
    /// bits of a factor.
    pub(super) const fn sum(&self) -> usize {
        self.position + self.whole() + 5
    }
}
