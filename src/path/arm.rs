//! Inverse kinematics of an articulated arm with three joints.
//!
//! ```text
//!                elbow
//!       upper  ●───────╮ fore
//!            ╱          ╲
//!  shoulder ●            ▼ hand        from above: base turns the plane of both
//!           ┃ base
//! ```
//!
//! `base` is the rotation about the vertical through the shoulder, 0 along x. `shoulder` is the
//! elevation of the upper arm. `elbow` is the angle of the forearm relative to the upper arm,
//! negative if the elbow is up. The position of the hand is:
//!
//! ```text
//! r = upper·cos(shoulder) + fore·cos(shoulder + elbow)
//! x = r·cos(base)    y = r·sin(base)    z = upper·sin(shoulder) + fore·sin(shoulder + elbow)
//! ```
//!
//! A pose is singular if r·sin(elbow) = 0: a joint would have to turn infinitely fast.

use super::vector::{add, sub};
use crate::input::Point;
use crate::plan::digits::{round_down, round_up};
use crate::settings::{Place, SettingError, choices, settings};
use serde::{Deserialize, Serialize};
use std::f64::consts::{PI, TAU};
use std::ops::RangeInclusive;

/// Number of joints of an arm.
pub const JOINTS: usize = 3;

/// Names of the joints, from the ground up.
pub const JOINT_NAMES: [&str; JOINTS] = ["base", "shoulder", "elbow"];

/// Allowed lengths of upper arm and forearm, in mm.
const LENGTH_RANGE_MM: RangeInclusive<f64> = 1e-3..=1e6;
/// Allowed distance from a singular pose in degrees.
const SINGULAR_RANGE_DEG: RangeInclusive<f64> = 0.01..=45.0;
/// Allowed counts per turn.
const COUNTS_RANGE: RangeInclusive<u32> = 1..=1 << 28;

/// On which side of the line from shoulder to hand the elbow is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Elbow {
    /// Above the line.
    #[default]
    Up,
    /// Below the line.
    Down,
}

choices!(Elbow);

settings! {
    /// An arm with three joints.
    #[derive(Copy)]
    pub struct Arm {
        /// Position of its shoulder.
        pub shoulder_mm: Point = [0.0; 3], in -*LENGTH_RANGE_MM.end()..=*LENGTH_RANGE_MM.end();
        /// Length from shoulder to elbow.
        pub upper_mm [required]: f64 = 0.0, in LENGTH_RANGE_MM;
        /// Length from elbow to hand.
        pub fore_mm [required]: f64 = 0.0, in LENGTH_RANGE_MM;
        /// Side of the line from shoulder to hand on which the elbow is.
        pub elbow: Elbow = Elbow::default();
        /// Margin to singular poses: a pose is refused where the elbow is nearer than this to
        /// straight or folded, or the hand as near to the vertical through the shoulder as the
        /// stretched arm leant by it.
        pub singular_deg: f64 = 1.0, in SINGULAR_RANGE_DEG;
        /// Counts per revolution of a joint.
        pub counts_per_rev: u32 = 1 << 20, in COUNTS_RANGE;
    }
}

/// Pose that the arm cannot take, or that is too close to a singular one.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum Pose {
    /// The elbow would be straight, or the arm is too short.
    #[error(
        "the hand is {distance:.3} mm from the shoulder, where the elbow is straight or beyond"
    )]
    Straight {
        /// Distance from shoulder to hand, in mm.
        distance: f64,
        /// Greatest distance that is not singular, in mm.
        most: f64,
    },
    /// The forearm would be folded onto the upper arm, or the hand is too close.
    #[error("the hand is {distance:.3} mm from the shoulder, where the elbow is folded or beyond")]
    Folded {
        /// Distance from shoulder to hand, in mm.
        distance: f64,
        /// Least distance that is not singular, in mm.
        least: f64,
    },
    /// The hand is above or below the shoulder, where the base may have any angle.
    #[error("the hand is {radius:.3} mm from the vertical through the shoulder")]
    Vertical {
        /// Horizontal distance in mm.
        radius: f64,
        /// Least distance that is not singular, in mm.
        least: f64,
    },
}

impl Pose {
    /// Returns the allowed distances.
    #[must_use]
    pub fn allowed(&self) -> String {
        match self {
            Pose::Straight { most, .. } => format!("at most {} mm", round_down(*most)),
            Pose::Folded { least, .. } | Pose::Vertical { least, .. } => {
                format!("at least {} mm", round_up(*least))
            }
        }
    }
}

impl Arm {
    /// Checks every field.
    ///
    /// # Errors
    /// Returns an error that names the first field at fault, its value and the allowed range.
    pub fn validate(&self) -> Result<(), SettingError> {
        self.ranges().map_err(|error| error.at(Place::Table("arm")))
    }

    /// Returns the joint angles for the hand at `point`, in radians; base from −π to π.
    ///
    /// # Errors
    /// Returns the pose if it is singular, closer to one than
    /// [`singular_deg`](Self::singular_deg), or out of reach.
    pub fn joints(&self, point: Point) -> Result<[f64; JOINTS], Pose> {
        let [x, y, z] = sub(point, self.shoulder_mm);
        let (upper, fore) = (self.upper_mm, self.fore_mm);
        let (radius, margin) = (x.hypot(y), self.singular_deg.to_radians());
        let distance = radius.hypot(z);
        let (squares, product) = (upper * upper + fore * fore, 2.0 * upper * fore);
        let most = (squares + product * margin.cos()).sqrt();
        let shortest = (squares - product * margin.cos()).sqrt();
        if distance > most {
            return Err(Pose::Straight { distance, most });
        }
        if distance < shortest {
            let least = shortest;
            return Err(Pose::Folded { distance, least });
        }
        let least = (upper + fore) * margin.sin();
        if radius < least {
            return Err(Pose::Vertical { radius, least });
        }
        let bend = ((distance * distance - squares) / product)
            .clamp(-1.0, 1.0)
            .acos();
        let elbow = match self.elbow {
            Elbow::Up => -bend,
            Elbow::Down => bend,
        };
        let lean = (fore * elbow.sin()).atan2(upper + fore * elbow.cos());
        Ok([y.atan2(x), z.atan2(radius) - lean, elbow])
    }

    /// Returns the position of the hand.
    #[must_use]
    pub fn hand(&self, [base, shoulder, elbow]: [f64; JOINTS]) -> Point {
        let (upper, fore) = (self.upper_mm, self.fore_mm);
        let along = upper * shoulder.cos() + fore * (shoulder + elbow).cos();
        let up = upper * shoulder.sin() + fore * (shoulder + elbow).sin();
        let hand = [along * base.cos(), along * base.sin(), up];
        add(self.shoulder_mm, hand)
    }

    /// Returns the joint angles for the hand at the next `point`, in radians: the base continues
    /// from `last` beyond half a turn.
    ///
    /// # Errors
    /// Returns the errors of [`Arm::joints`].
    pub fn next(&self, last: Option<[f64; JOINTS]>, point: Point) -> Result<[f64; JOINTS], Pose> {
        let [base, shoulder, elbow] = self.joints(point)?;
        let base = match last {
            None => base,
            Some([last, ..]) => last + (base - last + PI).rem_euclid(TAU) - PI,
        };
        Ok([base, shoulder, elbow])
    }

    /// Returns the counts per radian of a joint.
    #[must_use]
    pub fn counts_per_radian(&self) -> f64 {
        f64::from(self.counts_per_rev) / TAU
    }
}

#[cfg(test)]
mod tests {
    use super::super::vector::distance;
    use super::*;
    use proptest::prelude::*;

    const ARM: Arm = Arm {
        shoulder_mm: [10.0, -20.0, 350.0],
        upper_mm: 300.0,
        fore_mm: 350.0,
        elbow: Elbow::Up,
        singular_deg: 1.0,
        counts_per_rev: 1 << 20,
    };

    fn at(offset: Point) -> Point {
        add(ARM.shoulder_mm, offset)
    }

    #[test]
    fn a_right_angle_is_as_by_hand() {
        // Upper arm upright, forearm level.
        let joints = ARM.joints(at([350.0, 0.0, 300.0])).unwrap();
        let expected = [0.0, PI / 2.0, -PI / 2.0];
        for (joint, expected) in joints.iter().zip(expected) {
            assert!((joint - expected).abs() < 1e-12, "{joints:?}");
        }
        // The other elbow: upper arm horizontal, forearm vertical, turned to y.
        let down = Arm {
            elbow: Elbow::Down,
            ..ARM
        };
        let joints = down.joints(at([0.0, 300.0, 350.0])).unwrap();
        let expected = [PI / 2.0, 0.0, PI / 2.0];
        for (joint, expected) in joints.iter().zip(expected) {
            assert!((joint - expected).abs() < 1e-12, "{joints:?}");
        }
    }

    #[test]
    fn singular_poses_are_refused_at_their_bounds() {
        let along = |x| ARM.joints(at([x, 0.0, 0.0]));
        // An elbow of 1°: by the law of cosines.
        let cosine = 1f64.to_radians().cos();
        let most = (300f64.powi(2) + 350f64.powi(2) + 2.0 * 300.0 * 350.0 * cosine).sqrt();
        let least = (300f64.powi(2) + 350f64.powi(2) - 2.0 * 300.0 * 350.0 * cosine).sqrt();
        assert!(along(most - 1e-9).is_ok() && along(least + 1e-9).is_ok());
        assert!(matches!(along(most + 1e-9), Err(Pose::Straight { .. })));
        assert!(matches!(along(least - 1e-9), Err(Pose::Folded { .. })));
        assert!(matches!(
            along(651.0),
            Err(Pose::Straight {
                distance: 651.0,
                ..
            })
        ));
        assert!(matches!(along(1.0), Err(Pose::Folded { .. })));
        // Leaned by 1°.
        let radius = 650.0 * 1f64.to_radians().sin();
        let above = |x| ARM.joints(at([0.0, x, -400.0]));
        assert!(above(radius + 1e-9).is_ok());
        assert!(matches!(above(radius - 1e-9), Err(Pose::Vertical { .. })));
    }

    #[test]
    fn the_base_goes_on_over_half_a_turn() {
        let circle = |degrees: i32| {
            let angle = f64::from(degrees).to_radians();
            at([400.0 * angle.cos(), 400.0 * angle.sin(), 50.0])
        };
        for sign in [1, -1] {
            let path: Vec<_> = (0..=800).map(|k| circle(170 + sign * k)).collect();
            let mut last = None;
            for (k, point) in (0..).zip(path) {
                let joint = ARM.next(last, point).unwrap();
                last = Some(joint);
                let expected = f64::from(170 + sign * k).to_radians();
                assert!((joint[0] - expected).abs() < 1e-9, "{k}: {joint:?}");
            }
        }
    }

    proptest! {
        #[test]
        fn the_hand_is_where_its_joints_put_it(
            [x, y, z] in prop::array::uniform3(-660.0..660.0f64),
            up: bool,
        ) {
            let arm = Arm { elbow: if up { Elbow::Up } else { Elbow::Down }, ..ARM };
            let point = at([x, y, z]);
            if let Ok(joints) = arm.joints(point) {
                prop_assert!(distance(arm.hand(joints), point) < 1e-9);
                prop_assert_eq!(joints[2] < 0.0, up);
                prop_assert!(joints[2].abs() >= 1f64.to_radians() - 1e-9);
            }
        }
    }
}
