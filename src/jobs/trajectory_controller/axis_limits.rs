//! Acceleration within what each axis is allowed (¶0031).
//!
//! Along a direction t an acceleration a is a·|t_k| of axis k. On an arc t and the normal turn, and
//! a component of each has the amplitude e_k: together they are at most e_k·√(a² + a_n²) of the
//! axis. So the acceleration along the path, which is one for all of it, is held to half of the
//! square on curves, and what it leaves is for the acceleration across. On a helix the rise adds to
//! the amplitude; W has its part of the way all along; on a spline the directions are not looked at,
//! and every axis that moves counts for the whole.

use super::segments::{Path, Segment};
use crate::circuits::trajectory_controller::path_point::AXES;
use crate::input::COORDINATES;
use std::f64::consts::SQRT_2;

/// Below this part of the whole an axis does not move: what is left is rounding.
const STILL: f64 = 1e-9;

/// The largest acceleration along a path with which no axis has more than it is allowed on any of
/// its lines, and on its curves more than leaves as much for the acceleration across.
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

/// The largest acceleration across a curve beside one along the path.
#[must_use]
pub fn across(curve: &Segment, allowed: &[f64; AXES], along: f64) -> f64 {
    let whole = least(curve, allowed);
    (whole * whole - along * along).max(0.0).sqrt()
}

/// The largest acceleration in any direction that a segment has.
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
