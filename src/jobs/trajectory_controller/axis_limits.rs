//! Acceleration limits along the path from the limits of each axis (¶0031).
//!
//! Along a direction t an acceleration a gives a·|t_k| on axis k. On an arc t and the normal
//! rotate, and a component of each has the amplitude e_k: together they give at most e_k·√(a² +
//! a_n²) on the axis. So the acceleration along the path, which is a single value for the whole
//! path, may use half of the square on curves, and the rest is left for the acceleration across.
//! On a helix the rise adds to the amplitude; W has a constant part of the motion. On a spline the
//! directions are not examined, and every axis that moves counts fully.

use super::segments::{Path, Segment};
use crate::circuits::trajectory_controller::path_point::AXES;
use crate::input::COORDINATES;
use std::f64::consts::SQRT_2;

/// Part of the whole below which an axis does not move: the remainder is rounding.
const STILL: f64 = 1e-9;

/// Returns the greatest acceleration along a path with which no axis exceeds its limit on any
/// line, and which on its curves leaves at least as much for the acceleration across.
#[must_use]
pub fn along(path: &Path, allowed: &[f64; AXES]) -> f64 {
    let segments = path.stretches.iter().map(|stretch| &stretch.segment);
    let each = segments.map(|segment| {
        let whole = least(segment, allowed);
        match (segment.arc, segment.powers) {
            (None, None) => whole,
            _ => whole / SQRT_2,
        }
    });
    each.fold(f64::INFINITY, f64::min)
}

/// Returns the greatest acceleration across a curve beside one along the path.
#[must_use]
pub fn across(curve: &Segment, allowed: &[f64; AXES], along: f64) -> f64 {
    let whole = least(curve, allowed);
    (whole * whole - along * along).max(0.0).sqrt()
}

/// Returns the greatest acceleration in any direction that a segment has.
fn least(segment: &Segment, allowed: &[f64; AXES]) -> f64 {
    let within = |axis: usize, part: f64| match part > STILL {
        true => allowed[axis] / part,
        false => f64::INFINITY,
    };
    let each = (0..COORDINATES).map(|axis| {
        let turning = segment.along[axis].hypot(segment.across[axis]);
        let part = match segment.powers {
            None => turning + segment.third[axis].abs(),
            Some(_) => f64::from(turning + segment.third[axis].abs() > STILL),
        };
        within(axis, part)
    });
    let fourth = segment.fourth.map_or(0.0, |fourth| fourth.along.abs());
    each.fold(within(COORDINATES, fourth), f64::min)
}
