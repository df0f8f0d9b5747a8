//! Ports of the machine, a bundle for each circuit: what its control computer gives it.

use crate::signals;

/// Names of the axes' ports.
const A_NAMES: &[&str] = &["a_x", "a_y"];
const B_NAMES: &[&str] = &["b_x", "b_y"];
const POSITION_GAIN: &[&str] = &["position_gain_x", "position_gain_y"];
const SPEED_GAIN: &[&str] = &["speed_gain_x", "speed_gain_y"];
const INTEGRAL_GAIN: &[&str] = &["integral_gain_x", "integral_gain_y"];
const INERTIA: &[&str] = &["inertia_x", "inertia_y"];
const LIMIT: &[&str] = &["limit_x", "limit_y"];

signals! {
    /// To the pulse interpolator; see [`group::In`](crate::pulse_interpolator::group::In).
    pub struct Pulse<L> {
        /// A pattern is given, as the next.
        pub command: L::Bit,
        /// First address of it.
        pub base: L::U<12> as Hex,
        /// Last address of it.
        pub last: L::U<12> as Hex,
        /// It runs; low: it stops the one that runs.
        pub run: L::Bit,
        /// It is taken at the next end of a unit time; low: when the one that runs is over.
        pub now: L::Bit,
        /// Writes a word of the pattern memory.
        pub write: L::Bit,
        /// The axis written to.
        pub write_axis: L::U<3>,
        /// Address written to.
        pub write_address: L::U<12> as Hex,
        /// Half-period written.
        pub write_half_period: L::U<16>,
        /// Direction written.
        pub write_direction: L::Bit,
    }
}

signals! {
    /// To the linear interpolator; see [`interpolator::In`](crate::linear_interpolator::interpolator::In).
    pub struct Lines<L> {
        /// A target is given.
        pub push: L::Bit,
        /// Its X, on the way of all lines.
        pub target_x: L::I<32>,
        /// Its Y.
        pub target_y: L::I<32>,
        /// Steady speed there: counts of the master axis a scan, with 12 bits of fraction.
        pub speed: L::U<32>,
        /// Acceleration time in scans.
        pub acceleration_time: L::U<12>,
        /// Deceleration time in scans.
        pub deceleration_time: L::U<12>,
    }
}

signals! {
    /// To the arc generator; see [`generator::In`](crate::arc_generator::generator::In).
    pub struct Arcs<L> {
        /// Writes a word of the free record.
        pub write: L::Bit,
        /// Number of the word.
        pub write_word: L::U<5>,
        /// Its data.
        pub write_data: L::U<42> as Hex,
        /// The free record is complete.
        pub push: L::Bit,
        /// Begins an arc.
        pub start: L::Bit,
    }
}

signals! {
    /// To the trajectory controller; see
    /// [`controller::In`](crate::trajectory_controller::controller::In).
    pub struct Trajectory<L> {
        /// Writes a word of the free record of the profile.
        pub write: L::Bit,
        /// Number of the word.
        pub write_word: L::U<5>,
        /// Its data.
        pub write_data: L::U<55> as Hex,
        /// The free record is complete.
        pub push: L::Bit,
        /// Begins to move along the path.
        pub start: L::Bit,
        /// Writes where a segment of the path begins.
        pub write_begin: L::Bit,
        /// The segment.
        pub begin_segment: L::U<8>,
        /// The length at which it begins.
        pub begin_length: L::U<47>,
        /// Writes a word of a segment.
        pub write_path: L::Bit,
        /// The segment, and in the lower four bits the number of its word.
        pub path_address: L::U<12> as Hex,
        /// Its data.
        pub path_data: L::U<55> as Hex,
        /// The path's last segment.
        pub last: L::U<8>,
        /// L: the path's length.
        pub path_end: L::I<47>,
        /// K1 of all models.
        pub gain_1: L::U<16>,
        /// K2 of all models.
        pub gain_2: L::U<16>,
        /// Of the position controls.
        pub position_gain: [L::U<24>; 2] as Elements(POSITION_GAIN),
        /// Of the speed controls, proportional.
        pub speed_gain: [L::U<24>; 2] as Elements(SPEED_GAIN),
        /// Integral.
        pub integral_gain: [L::U<24>; 2] as Elements(INTEGRAL_GAIN),
        /// Of the feed-forward.
        pub inertia: [L::U<24>; 2] as Elements(INERTIA),
        /// Largest torques.
        pub limit: [L::U<16>; 2] as Elements(LIMIT),
        /// Encoders of the motors, channel A.
        pub a: [L::Bit; 2] as Elements(A_NAMES),
        /// Channel B.
        pub b: [L::Bit; 2] as Elements(B_NAMES),
    }
}

signals! {
    /// To the lead-angle compensator; see [`compensator::In`](crate::lead_angle::compensator::In).
    pub struct Lift<L> {
        /// Encoder of the pen lift, channel A.
        pub a: L::Bit,
        /// Channel B.
        pub b: L::Bit,
        /// The next step runs.
        pub run: L::Bit,
        /// Times are learned.
        pub learn: L::Bit,
        /// The step after which step 0 comes.
        pub last_step: L::U<4>,
        /// CKs without a change that are a standstill.
        pub standstill: L::U<16>,
        /// CKs from the control signal on after which a positioning is complete anyway.
        pub time_out: L::U<16>,
        /// CKs between two steps.
        pub rest: L::U<16>,
        /// The time that a step begins to learn with that has none.
        pub seed: L::U<11>,
        /// A target and its speed are written.
        pub write_target: L::Bit,
        /// The step that is written.
        pub write_step: L::U<4>,
        /// The target that is written.
        pub step_target: L::I<24>,
        /// The speed that is written.
        pub step_speed: L::U<16>,
    }
}
