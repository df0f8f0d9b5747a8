//! Conversion of a path's commands to those of an arm's joints: step 12 of Fig. 5, which follows
//! the generator on the control computer.

use crate::hdl::{Value, View, signals};
use crate::input::{COORDINATES, Point};
use crate::path::arm::{Arm, JOINTS, Pose};
use crate::path::vector::distance;
use crate::sim::Beside;
use serde::Serialize;

signals! { for Joints as _c;
    /// Commanded joints of an arm.
    pub struct JointSignals {
        /// Angle of the base in counts.
        pub base: I(40) as Analog,
        /// Elevation of the upper arm in counts.
        pub shoulder: I(40) as Analog,
        /// Angle of the forearm relative to the upper arm in counts.
        pub elbow: I(40) as Analog,
    }
}

/// Arm beside the circuit that commands its hand.
#[derive(Debug, Clone, Copy)]
pub struct Joints;

impl Beside for Joints {
    const SCOPE: &'static str = "arm";
    type Signals<V: View> = JointSignals<V>;
}

impl JointSignals<Value> {
    /// Returns the signals of joints in counts.
    #[must_use]
    pub fn of([base, shoulder, elbow]: [i64; JOINTS]) -> Self {
        JointSignals {
            base,
            shoulder,
            elbow,
        }
    }
}

/// Motion of a joint along a path.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct JointReport {
    /// Least and greatest angle in degrees.
    pub range_deg: [f64; 2],
    /// Greatest speed from sample to sample, in degrees per second.
    pub speed_deg_per_s: f64,
    /// Greatest acceleration over three samples, in degrees per second squared.
    pub acceleration_deg_per_s2: f64,
}

/// Motion of an arm's joints along a path.
#[derive(Debug, Clone, PartialEq)]
pub struct Followed {
    /// Joints in counts at the first command.
    pub start: [i64; JOINTS],
    /// Motion of each joint.
    pub joints: [JointReport; JOINTS],
    /// Greatest deviation of the hand from its command by rounding to counts, in mm.
    pub rounding_mm: f64,
}

/// Converter of commands of the hand to joints, one by one.
#[derive(Debug, Clone)]
pub struct Follower {
    arm: Arm,
    angles: Option<[f64; JOINTS]>,
}

impl Follower {
    /// Creates a converter before its first command.
    #[must_use]
    pub fn new(arm: &Arm) -> Self {
        Follower {
            arm: *arm,
            angles: None,
        }
    }

    /// Moves the hand to a command in mm; returns the joints in counts.
    ///
    /// # Errors
    /// Returns the pose that the arm cannot take; the arm stays where it was.
    pub fn follow(&mut self, command: Point) -> Result<[i64; JOINTS], Pose> {
        let angles = self.arm.next(self.angles, command)?;
        self.angles = Some(angles);
        let turn = self.arm.counts_per_radian();
        Ok(angles.map(|joint| (joint * turn).round() as i64))
    }
}

/// Arm whose hand a circuit commands, beside it in the waves.
#[derive(Debug, Clone)]
pub struct Hand {
    follower: Follower,
    counts_per_mm: f64,
    /// Joints in counts.
    pub(super) joints: [i64; JOINTS],
}

impl Hand {
    /// Creates an arm with its joints in counts before the first command, and the commands' counts
    /// per millimetre.
    #[must_use]
    pub fn new(arm: &Arm, start: [i64; JOINTS], counts_per_mm: f64) -> Self {
        Hand {
            follower: Follower::new(arm),
            counts_per_mm,
            joints: start,
        }
    }

    /// Follows a command in counts; if the arm cannot take the pose, it stays where it was.
    pub(super) fn follow(&mut self, command: [i64; COORDINATES]) {
        let point = command.map(|counts| counts as f64 / self.counts_per_mm);
        self.joints = self.follower.follow(point).unwrap_or(self.joints);
    }
}

/// Measurement of an arm's joints while commands come.
#[derive(Debug)]
pub struct Following {
    follower: Follower,
    sample_s: f64,
    commands: usize,
    start: [i64; JOINTS],
    motions: [Motion; JOINTS],
    rounding_mm: f64,
}

impl Following {
    /// Creates an arm before its first command; commands come `sample_s` apart.
    #[must_use]
    pub fn new(arm: &Arm, sample_s: f64) -> Self {
        Following {
            follower: Follower::new(arm),
            sample_s,
            commands: 0,
            start: [0; JOINTS],
            motions: [const { Motion::new() }; JOINTS],
            rounding_mm: 0.0,
        }
    }

    /// Adds the next command in mm.
    ///
    /// # Errors
    /// Returns the number of the command and the pose, if the arm cannot take it.
    pub fn take(&mut self, command: Point) -> Result<(), (usize, Pose)> {
        let number = self.commands;
        let counts = self.follower.follow(command);
        let counts = counts.map_err(|pose| (number, pose))?;
        if number == 0 {
            self.start = counts;
        }
        self.commands += 1;
        let Follower { arm, angles } = &self.follower;
        for (motion, angle) in self.motions.iter_mut().zip(angles.iter().flatten()) {
            motion.take(angle.to_degrees(), self.sample_s);
        }
        let turn = arm.counts_per_radian();
        let off = distance(arm.hand(counts.map(|count| count as f64 / turn)), command);
        self.rounding_mm = self.rounding_mm.max(off);
        Ok(())
    }

    /// Returns the result of all commands.
    #[must_use]
    pub fn finish(self) -> Followed {
        Followed {
            start: self.start,
            joints: self.motions.map(|motion| motion.report),
            rounding_mm: self.rounding_mm,
        }
    }
}

/// Measurement of a joint while commands come.
#[derive(Debug)]
struct Motion {
    report: JointReport,
    angle: Option<f64>,
    speed: Option<f64>,
}

impl Motion {
    const fn new() -> Self {
        Motion {
            report: JointReport {
                range_deg: [f64::INFINITY, f64::NEG_INFINITY],
                speed_deg_per_s: 0.0,
                acceleration_deg_per_s2: 0.0,
            },
            angle: None,
            speed: None,
        }
    }

    fn take(&mut self, angle: f64, sample_s: f64) {
        let report = &mut self.report;
        let [least, most] = report.range_deg;
        report.range_deg = [least.min(angle), most.max(angle)];
        let Some(last) = self.angle.replace(angle) else {
            return;
        };
        let speed = (angle - last) / sample_s;
        report.speed_deg_per_s = report.speed_deg_per_s.max(speed.abs());
        if let Some(last) = self.speed.replace(speed) {
            let acceleration = ((speed - last) / sample_s).abs();
            report.acceleration_deg_per_s2 = report.acceleration_deg_per_s2.max(acceleration);
        }
    }
}
