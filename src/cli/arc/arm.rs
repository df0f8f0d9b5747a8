//! The joints of an arm in the summary.

use super::Job;
use crate::cli::rows::{fixed, table};
use motion_rtl::path::arm::JOINT_NAMES;
use serde::Serialize;
use std::fmt::{self, Write};

/// The arm whose hand the commands are of.
#[derive(Debug, Serialize)]
pub struct ArmRows {
    /// Counts of a turn of a joint.
    pub counts_per_rev: u32,
    /// Largest error of the hand due to rounding the joints to whole counts.
    pub rounding_um: f64,
    /// Every joint, from the ground up.
    pub joints: [JointRow; 3],
}

/// A joint along the path.
#[derive(Debug, Serialize)]
pub struct JointRow {
    /// Name of the joint.
    pub joint: &'static str,
    /// Least and largest angle.
    pub range_deg: [f64; 2],
    /// Largest speed from sample to sample.
    pub speed_deg_per_s: f64,
    /// Largest acceleration over three samples.
    pub acceleration_deg_per_s2: f64,
}

/// The joints of a job that has an arm.
pub fn rows(job: &Job) -> Option<ArmRows> {
    let (arm, followed) = job.arm.as_ref()?;
    let joint = |number: usize| {
        let report = followed.joints[number];
        JointRow {
            joint: JOINT_NAMES[number],
            range_deg: report.range_deg,
            speed_deg_per_s: report.speed_deg_per_s,
            acceleration_deg_per_s2: report.acceleration_deg_per_s2,
        }
    };
    Some(ArmRows {
        counts_per_rev: arm.counts_per_rev,
        rounding_um: followed.rounding_mm * 1e3,
        joints: std::array::from_fn(joint),
    })
}

impl ArmRows {
    /// Writes the rows as text.
    pub fn write(&self, text: &mut String) -> fmt::Result {
        let heads = [
            ("joint   ", 0),
            ("from deg", 9),
            ("to deg", 9),
            ("largest deg/s", 0),
            ("deg/s2", 9),
        ];
        let cells = self.joints.iter().map(|row| {
            let [least, most] = row.range_deg.map(|angle| fixed(angle, 3));
            let rates = [row.speed_deg_per_s, row.acceleration_deg_per_s2];
            let [speed, acceleration] = rates.map(|rate| fixed(rate, 3));
            let joint = format!("{:<8}", row.joint);
            [joint, least, most, speed, acceleration]
        });
        table(text, heads, cells)?;
        writeln!(
            text,
            "joints of {} counts a turn put the hand at most {:.3} um off its command\n",
            self.counts_per_rev, self.rounding_um
        )
    }
}
