//! Error bound of a rotation after n steps.
//!
//! A step is v ← R̂·v + ρ with R̂ = R + E. Every coefficient is off by at most half of its last bit,
//! 2^-(B+1), so |E·v| <= 3·2^-(B+1)·|v|. Every coordinate is rounded to guard units of 2^-G count:
//! |ρ| <= √3·2^-(G+1) to the nearest, twice that towards minus infinity. R keeps lengths, so with
//! ε = 3·2^-(B+1) the error follows e ← (1 + ε)·e + ε·r + |ρ|, in first order n·(ε·r + |ρ|).

use super::prepared::{Segment, Shape};
use super::settings::Settings;
use crate::circuits::arc_generator::sine_words::FINE;
use crate::circuits::arc_generator::{Blend, Rounding, Widths};
use crate::circuits::blocks::cordic_state::GAIN;
use std::f64::consts::TAU;

/// Error bound of a coefficient as `f64`: the sine, the cosine, and three roundings.
const COEFFICIENT_F64: f64 = 4.0 * f64::EPSILON;

/// Returns the greatest distance, in counts, of a point of the rotation from the exact arc's
/// point, after `steps` steps at a radius of `radius` counts. Includes the rounding of vector,
/// centre and coefficients to words, and of every step.
#[must_use]
pub fn rotation_error(radius: f64, steps: u64, widths: &Widths, rounding: Rounding) -> f64 {
    let coefficients = 3.0 * (half(widths.coefficient_fraction()) + COEFFICIENT_F64);
    grown(radius, steps, coefficients, widths, rounding)
}

/// Returns half a unit of a word with `bits` fraction bits.
fn half(bits: usize) -> f64 {
    (-((bits + 1) as f64)).exp2()
}

/// Returns the bound to which a matrix error and the rounding of every step grow.
fn grown(radius: f64, steps: u64, matrix: f64, widths: &Widths, rounding: Rounding) -> f64 {
    let guard = 3f64.sqrt() * half(widths.guard());
    let rounded = match rounding {
        Rounding::Nearest => guard,
        Rounding::Floor => 2.0 * guard,
    };
    // (1 + ε)^n − 1.
    let grown = (steps as f64 * matrix.ln_1p()).exp_m1();
    // The vector is the difference of two rounded points; the centre is rounded too.
    let begun = 2.0 * guard * (1.0 + grown) + guard;
    begun + grown / matrix * (matrix * radius + rounded)
}

/// Returns the greatest distance, in counts, of a coordinate from the exact quartic or line if it
/// is computed by products, before it is rounded to a guard unit.
///
/// The error of h is at most half a unit of 2^-B, and moves the point by |x'| <= 2^(P+1) guard
/// units per 1. The error of h² is as large, of which (2 − h)h³ has half, and its own rounding is
/// as large again, both times |S| <= 2^(P+1).
#[must_use]
pub fn product_error(widths: &Widths) -> f64 {
    let most = (widths.position as f64 + 1.0).exp2();
    2.5 * half(widths.coefficient_fraction()) * most
}

/// Returns the bound for a position command, which is rounded to counts.
#[must_use]
pub fn command_error(radius: f64, steps: u64, widths: &Widths, rounding: Rounding) -> f64 {
    rotation_error(radius, steps, widths, rounding) + 3f64.sqrt() / 2.0
}

/// Returns the greatest distance, in mm, of a position command of a segment from the exact point of
/// its sample. Points of lines and blends are exact except for rounding: √3/2 counts, and √3/2
/// guard units each for input and output. Blends by products add their error.
#[must_use]
pub fn segment_error(segment: &Segment, settings: &Settings) -> f64 {
    let (widths, per_mm) = (Widths::FULL, settings.counts_per_mm);
    if let Shape::Arc { circle, .. } = segment.shape {
        let (radius, rounding) = (circle.radius * per_mm, settings.rounding);
        return command_error(radius, segment.samples, &widths, rounding) / per_mm;
    }
    let unit = (-(widths.guard() as f64)).exp2();
    let products = match settings.blend {
        Blend::Differences => 0.0,
        Blend::Products => product_error(&widths),
    };
    3f64.sqrt() * (0.5 + unit + products) / per_mm
}

/// Returns the greatest distance, in counts, of a position command of the conventional circuit
/// from the exact point of its sample, after `steps` steps at a radius of `radius` counts.
///
/// The error of an angle is at most a unit and a half, independent of earlier samples: ramp and
/// end as words, and the angle itself. The matrix of a step belongs to an angle that is off by
/// half a unit for each entry of the CORDIC's table and two more. The elements of the matrix have
/// errors of sine and versine, of which each iteration rounds both coordinates down, of the axis
/// and its products, and of their own rounding.
#[must_use]
pub fn conventional_error(radius: f64, steps: u64, widths: &Widths, rounding: Rounding) -> f64 {
    let iterations = widths.coefficient as f64;
    let unit = TAU * (-iterations).exp2();
    let coefficient = half(widths.coefficient_fraction());
    let fine = half(widths.coefficient_fraction() + FINE);
    let sine = coefficient + 2.0 * iterations * 2f64.sqrt() * GAIN * fine;
    let element = 2.0 * (sine + COEFFICIENT_F64) + 4.0 * coefficient;
    let matrix = 3.0 * element + unit * (iterations / 2.0 + 2.0);
    let angle = 1.5 * unit * radius;
    grown(radius, steps, matrix, widths, rounding) + angle + 3f64.sqrt() / 2.0
}
