//! The joints of an arm in the summary.

use super::Job;
use crate::cli::columns::Table;
use crate::cli::rows::fixed;
use motion_rtl::jobs::arc_generator::joints::JointReport;
use motion_rtl::path::arm::JOINT_NAMES;
use serde::Serialize;
use std::fmt::{self, Write};

/// The arm whose hand the commands are of.
#[derive(Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
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
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct JointRow {
    /// Name of the joint.
    pub joint: &'static str,
    /// Its motion.
    #[serde(flatten)]
    pub report: JointReport,
}

/// The joints of a job that has an arm.
pub fn rows(job: &Job) -> Option<ArmRows> {
    let (arm, followed) = job.arm.as_ref()?;
    let joint = |number: usize| JointRow {
        joint: JOINT_NAMES[number],
        report: followed.joints[number],
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
        Table::of(&self.joints)
            .left("joint", 8, |row| row.joint)
            .col("from deg", 9, |row| fixed(row.report.range_deg[0], 3))
            .col("to deg", 9, |row| fixed(row.report.range_deg[1], 3))
            .col("largest deg/s", 0, |row| {
                fixed(row.report.speed_deg_per_s, 3)
            })
            .col("deg/s2", 9, |row| {
                fixed(row.report.acceleration_deg_per_s2, 3)
            })
            .write(text)?;
        writeln!(
            text,
            "joints of {} counts a turn put the hand at most {:.3} um off its command\n",
            self.counts_per_rev, self.rounding_um
        )
    }
}
