//! Ports of the machine, a bundle for each circuit with the inputs from its control computer. The
//! arc generator has its own.

use crate::circuits::blocks::RecordWrite;
use crate::circuits::lead_angle::Compensator;
use crate::circuits::linear_interpolator::LinearInterpolator;
use crate::circuits::linear_interpolator::target_data::Settings;
use crate::circuits::pulse_interpolator::Group;
use crate::circuits::pulse_interpolator::pattern_memory::WritePort;
use crate::circuits::trajectory_controller::TrajectoryController;
use crate::circuits::trajectory_controller::model_state::ModelGains;
use crate::circuits::trajectory_controller::path_point::PathWrite;
use crate::prelude::*;

/// Names of the axes' ports.
const A_NAMES: &[&str] = &["a_x", "a_y"];
const B_NAMES: &[&str] = &["b_x", "b_y"];
const POSITION_GAIN: &[&str] = &["position_gain_x", "position_gain_y"];
const SPEED_GAIN: &[&str] = &["speed_gain_x", "speed_gain_y"];
const INTEGRAL_GAIN: &[&str] = &["integral_gain_x", "integral_gain_y"];
const INERTIA: &[&str] = &["inertia_x", "inertia_y"];
const LIMIT: &[&str] = &["limit_x", "limit_y"];

signals! { for Group as c;
    /// Inputs of the pulse interpolator; see
    /// [`group::In`](crate::circuits::pulse_interpolator::group::In).
    pub struct Pulse {
        /// Gives a command for a pattern.
        pub command: Bit,
        /// First address of the command's pattern.
        pub base: U(c.widths.address) as Hex,
        /// Last address of the command's pattern.
        pub last: U(c.widths.address) as Hex,
        /// High: the command starts a pattern; low: it stops the running one.
        pub run: Bit,
        /// High: the command is taken at the next end of a unit time; low: at the end of the
        /// running pattern.
        pub now: Bit,
        /// Port through which the words of all axes are written.
        pub port: WritePort(&c.widths) as Flat,
    }
}

signals! { for LinearInterpolator as c;
    /// Inputs of the linear interpolator; see
    /// [`interpolator::In`](crate::circuits::linear_interpolator::interpolator::In).
    pub struct Lines {
        /// Gives a target; ignored unless `lines_ready`, or with `halt`.
        pub push: Bit,
        /// X of the target in counts, without the distance moved on arcs.
        pub target_x: I(c.widths.position),
        /// Y of the target in counts, without the distance moved on arcs.
        pub target_y: I(c.widths.position),
        /// Speed and times of the move to the target.
        pub settings: Settings(&c.targets()) as Flat,
    }
}

signals! { for TrajectoryController as c;
    /// Inputs of the trajectory controller; see
    /// [`controller::In`](crate::circuits::trajectory_controller::controller::In).
    pub struct Trajectory {
        /// Port through which records of the profile are written.
        pub record: RecordWrite(&c.widths.data) as Flat,
        /// Starts a motion along the path.
        pub start: Bit,
        /// Port through which segments of the path are written.
        pub path: PathWrite(&c.widths.point().of_axes(c.axes)) as Flat,
        /// Number of the last segment of the path.
        pub last: U(c.widths.segment),
        /// L: length of the path.
        pub path_end: I(c.widths.point),
        /// K1 and K2 of all models.
        pub model_gains: ModelGains(&c.widths.model()) as Flat,
        /// Position gain of this axis.
        pub position_gain: [U(c.widths.servo_gain); c.axes] as Elements(POSITION_GAIN),
        /// Proportional gain of the speed control of this axis.
        pub speed_gain: [U(c.widths.servo_gain); c.axes] as Elements(SPEED_GAIN),
        /// Integral gain of the speed control of this axis.
        pub integral_gain: [U(c.widths.servo_gain); c.axes] as Elements(INTEGRAL_GAIN),
        /// Feed-forward gain of this axis.
        pub inertia: [U(c.widths.servo_gain); c.axes] as Elements(INERTIA),
        /// Largest torque of this axis.
        pub limit: [U(c.widths.torque); c.axes] as Elements(LIMIT),
        /// Channel A of this axis' encoder.
        pub a: [Bit; c.axes] as Elements(A_NAMES),
        /// Channel B of this axis' encoder.
        pub b: [Bit; c.axes] as Elements(B_NAMES),
    }
}

signals! { for Compensator as c;
    /// Inputs of the lead-angle compensator; see
    /// [`compensator::In`](crate::circuits::lead_angle::compensator::In).
    pub struct Lift {
        /// Channel A of the pen lift's encoder.
        pub a: Bit,
        /// Channel B of the pen lift's encoder.
        pub b: Bit,
        /// Runs the steps one after the other; when it falls, the running step is the last.
        pub run: Bit,
        /// Enables learning.
        pub learn: Bit,
        /// Number of the last step; step 0 follows it.
        pub last_step: U(c.widths.step),
        /// CKs without a change that count as a standstill; 0 counts as 1.
        pub standstill: U(c.widths.cks),
        /// CKs from the control signal after which a positioning is complete in any case; 0 counts
        /// as 1.
        pub time_out: U(c.widths.cks),
        /// Pause between two steps, in CKs.
        pub rest: U(c.widths.cks),
        /// Lead time, in CKs, that a step without one gets after its first stop error.
        pub seed: U(c.widths.time()),
        /// Writes a target and its speed.
        pub write_target: Bit,
        /// Number of the step to write.
        pub write_step: U(c.widths.step),
        /// Target to write.
        pub step_target: I(c.widths.position),
        /// Speed to write.
        pub step_speed: U(c.widths.speed),
    }
}
