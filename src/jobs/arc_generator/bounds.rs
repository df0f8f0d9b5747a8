//! How far a rotation may be off after n steps.
//!
//! A step is v ← R̂·v + ρ with R̂ = R + E. Every coefficient is off by at most half of its last bit,
//! 2^-(B+1), so |E·v| <= 3·2^-(B+1)·|v|. Every coordinate is rounded to guard units of 2^-G count:
//! |ρ| <= √3·2^-(G+1) to the nearest, twice that towards minus infinity. R keeps lengths, so with
//! ε = 3·2^-(B+1) the error follows e ← (1 + ε)·e + ε·r + |ρ|, in first order n·(ε·r + |ρ|).

use crate::circuits::arc_generator::{Rounding, Widths};

/// How far the `f64` of a coefficient may be off: the sine, the cosine, and three roundings.
const COEFFICIENT_F64: f64 = 4.0 * f64::EPSILON;

/// Largest distance, in counts, of a point of the rotation from the exact arc's point, after `steps`
/// steps at a radius of `radius` counts: vector and centre as words, coefficients as words, and the
/// rounding of every step.
#[must_use]
pub fn rotation_error(radius: f64, steps: u64, widths: &Widths, rounding: Rounding) -> f64 {
    let half = |bits: usize| (-((bits + 1) as f64)).exp2();
    let guard = 3f64.sqrt() * half(widths.guard());
    let coefficients = 3.0 * (half(widths.coefficient_fraction()) + COEFFICIENT_F64);
    let rounded = match rounding {
        Rounding::Nearest => guard,
        Rounding::Floor => 2.0 * guard,
    };
    // (1 + ε)^n − 1.
    let grown = (steps as f64 * coefficients.ln_1p()).exp_m1();
    // The vector is the difference of two rounded points; the centre is rounded itself.
    let begun = 2.0 * guard * (1.0 + grown) + guard;
    begun + grown / coefficients * (coefficients * radius + rounded)
}

/// The same of a position command, which is rounded to counts.
#[must_use]
pub fn command_error(radius: f64, steps: u64, widths: &Widths, rounding: Rounding) -> f64 {
    rotation_error(radius, steps, widths, rounding) + 3f64.sqrt() / 2.0
}
