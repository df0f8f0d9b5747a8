//! Widths of the trajectory controller's words, as numbers.

use crate::arc_generator::widths::Widths as RecordWidths;

/// Widths in bits.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Widths {
    /// W: counts of a coordinate or of the path's length, signed.
    pub position: u32,
    /// P: points and lengths inside, signed, with P − W guard bits below the count.
    pub point: u32,
    /// R: radii and coordinates within a segment, signed, with R − P bits below the guard unit.
    pub radius: u32,
    /// C: coefficients of a segment, signed, with C − 2 fraction bits.
    pub coefficient: u32,
    /// M: mantissa of a curvature.
    pub curvature: u32,
    /// H: angles, in units of 2^−H turn.
    pub angle: u32,
    /// D: words of a segment, and of a record of the profile.
    pub data: u32,
    /// A: number of a segment.
    pub segment: u32,
    /// F: fractions of the profile's difference engine; the modulus is at most 2^(F − 1).
    pub fraction: u32,
    /// N: samples of a record of the profile.
    pub samples: u32,
    /// T: ticks of an interpolation period.
    pub period: u32,
    /// K: gains of the reference model, with K − 1 fraction bits.
    pub gain: u32,
    /// Gains of the servo controls; that of the position has all bits but one below the point.
    pub servo_gain: u32,
    /// Bits below the point of their other gains.
    pub torque_fraction: u32,
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
        torque_fraction: 21,
    };

    /// G: bits below the count.
    #[must_use]
    pub const fn guard(&self) -> u32 {
        self.point - self.position
    }

    /// The most segments of a path.
    #[must_use]
    pub const fn most_segments(&self) -> usize {
        1 << self.segment
    }

    /// Those of the profile's records, in the words of the arc generator, whose format they have.
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
}
