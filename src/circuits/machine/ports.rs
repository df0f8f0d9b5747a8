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
    /// To the pulse interpolator; see [`group::In`](crate::circuits::pulse_interpolator::group::In).
    pub struct Pulse {
        /// A pattern is given, as the next.
        pub command: Bit,
        /// First address of it.
        pub base: U(c.widths.address) as Hex,
        /// Last address of it.
        pub last: U(c.widths.address) as Hex,
        /// High: starts the pattern; low: stops the running one.
        pub run: Bit,
        /// High: the command is taken at the next end of a unit time; low: at the end of the
        /// running pattern.
        pub now: Bit,
        /// Writes the words of all axes.
        pub port: WritePort(&c.widths) as Flat,
    }
}

signals! { for LinearInterpolator as c;
    /// To the linear interpolator; see
    /// [`interpolator::In`](crate::circuits::linear_interpolator::interpolator::In).
    pub struct Lines {
        /// A target is given.
        pub push: Bit,
        /// Its X in counts; arcs are not counted.
        pub target_x: I(c.widths.position),
        /// Its Y.
        pub target_y: I(c.widths.position),
        /// Speed and times of the move to it.
        pub settings: Settings(&c.targets()) as Flat,
    }
}

signals! { for TrajectoryController as c;
    /// To the trajectory controller; see
    /// [`controller::In`](crate::circuits::trajectory_controller::controller::In).
    pub struct Trajectory {
        /// Records of the profile.
        pub record: RecordWrite(&c.widths.data) as Flat,
        /// Begins to move along the path.
        pub start: Bit,
        /// The path's segments.
        pub path: PathWrite(&c.widths.point().of_axes(c.axes)) as Flat,
        /// The path's last segment.
        pub last: U(c.widths.segment),
        /// L: the path's length.
        pub path_end: I(c.widths.point),
        /// K1 and K2 of all models.
        pub model_gains: ModelGains(&c.widths.model()) as Flat,
        /// Gains of the position controls.
        pub position_gain: [U(c.widths.servo_gain); c.axes] as Elements(POSITION_GAIN),
        /// Proportional gains of the speed controls.
        pub speed_gain: [U(c.widths.servo_gain); c.axes] as Elements(SPEED_GAIN),
        /// Integral gains of the speed controls.
        pub integral_gain: [U(c.widths.servo_gain); c.axes] as Elements(INTEGRAL_GAIN),
        /// Gains of the feed-forward.
        pub inertia: [U(c.widths.servo_gain); c.axes] as Elements(INERTIA),
        /// Largest torques.
        pub limit: [U(c.widths.torque); c.axes] as Elements(LIMIT),
        /// Encoders of the motors, channel A.
        pub a: [Bit; c.axes] as Elements(A_NAMES),
        /// Channel B.
        pub b: [Bit; c.axes] as Elements(B_NAMES),
    }
}

signals! { for Compensator as c;
    /// To the lead-angle compensator; see
    /// [`compensator::In`](crate::circuits::lead_angle::compensator::In).
    pub struct Lift {
        /// Encoder of the pen lift, channel A.
        pub a: Bit,
        /// Channel B.
        pub b: Bit,
        /// The next step runs.
        pub run: Bit,
        /// Times are learned.
        pub learn: Bit,
        /// The step after which step 0 comes.
        pub last_step: U(c.widths.step),
        /// CKs without a change that are a standstill.
        pub standstill: U(c.widths.cks),
        /// CKs from the control signal on after which a positioning is complete anyway.
        pub time_out: U(c.widths.cks),
        /// CKs between two steps.
        pub rest: U(c.widths.cks),
        /// The time that a step begins to learn with that has none.
        pub seed: U(c.widths.time()),
        /// A target and its speed are written.
        pub write_target: Bit,
        /// The step that is written.
        pub write_step: U(c.widths.step),
        /// The target that is written.
        pub step_target: I(c.widths.position),
        /// The speed that is written.
        pub step_speed: U(c.widths.speed),
    }
}
