//! The commands of a path as those of an arm's joints: step 12 of Fig. 5, which follows the
//! generator on the control computer.

use crate::hdl::{Beside, Value, View, signals};
use crate::input::Point;
use crate::path::arm::{Arm, JOINTS, Pose};
use crate::path::vector::distance;
use std::f64::consts::TAU;

signals! { for Joints as _c;
    /// The joints of an arm as they are commanded.
    pub struct JointSignals {
        /// Turn of the base in counts.
        pub base: I(40) as Analog,
        /// Elevation of the upper arm in counts.
        pub shoulder: I(40) as Analog,
        /// Angle of the forearm beyond it in counts.
        pub elbow: I(40) as Analog,
    }
}

/// An arm beside the circuit that commands its hand.
#[derive(Debug, Clone, Copy)]
pub struct Joints;

impl Beside for Joints {
    const SCOPE: &'static str = "arm";
    type Signals<V: View> = JointSignals<V>;
}

impl JointSignals<Value> {
    /// Of joints in counts.
    #[must_use]
    pub fn of([base, shoulder, elbow]: [i64; JOINTS]) -> Self {
        JointSignals {
            base,
            shoulder,
            elbow,
        }
    }
}

/// A joint along a path.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct JointReport {
    /// The least and the largest angle, in degrees.
    pub range_deg: [f64; 2],
    /// The largest speed from sample to sample, in degrees a second.
    pub speed_deg_per_s: f64,
    /// The largest acceleration over three samples, in degrees a second squared.
    pub acceleration_deg_per_s2: f64,
}

/// What an arm's joints do along a path.
#[derive(Debug, Clone, PartialEq)]
pub struct Followed {
    /// Of every command, in counts.
    pub counts: Vec<[i64; JOINTS]>,
    /// Of every joint.
    pub joints: [JointReport; JOINTS],
    /// How far whole counts put the hand off its command, at most, in mm.
    pub rounding_mm: f64,
}

/// The joints of `arm` along the commands of a path, `sample_s` apart.
///
/// # Errors
/// The number of the first command in whose pose the arm cannot be.
pub fn follow(arm: &Arm, commands: &[Point], sample_s: f64) -> Result<Followed, (usize, Pose)> {
    let angles = arm.follow(commands)?;
    let turn = f64::from(arm.counts_per_rev) / TAU;
    let counts: Vec<_> = angles
        .iter()
        .map(|joints| joints.map(|joint| (joint * turn).round() as i64))
        .collect();
    let off = counts.iter().zip(commands).map(|(counts, command)| {
        distance(arm.hand(counts.map(|count| count as f64 / turn)), *command)
    });
    Ok(Followed {
        rounding_mm: off.fold(0.0, f64::max),
        joints: std::array::from_fn(|joint| {
            let angles: Vec<f64> = angles.iter().map(|all| all[joint].to_degrees()).collect();
            report(&angles, sample_s)
        }),
        counts,
    })
}

fn report(angles: &[f64], sample_s: f64) -> JointReport {
    let largest = |values: &[f64]| values.iter().fold(0.0, |most, value| value.abs().max(most));
    let slopes = |values: &[f64]| -> Vec<f64> {
        let pairs = values.windows(2);
        pairs.map(|pair| (pair[1] - pair[0]) / sample_s).collect()
    };
    let speeds = slopes(angles);
    JointReport {
        range_deg: [
            angles.iter().copied().fold(f64::INFINITY, f64::min),
            angles.iter().copied().fold(f64::NEG_INFINITY, f64::max),
        ],
        speed_deg_per_s: largest(&speeds),
        acceleration_deg_per_s2: largest(&slopes(&speeds)),
    }
}
