//! The trajectory controller of CN104204977.
//!
//! On the control computer: [`segments`] (pieces of a path by their length), [`speed_limits`] and
//! [`planner`] (how fast it is run where, by [`ramp`]s, as a [`profile`](mod@profile)),
//! [`profile_record`] (the profile as words), [`servo_gains`], [`program`] (all of it together),
//! [`job`] (a path on the circuit, with motors), [`measure`] (what came out), [`closed`] (what comes
//! out on a circle), [`settings`], [`widths`].

pub mod arc_angle;
pub mod axis_row;
pub mod closed;
pub mod controlled_axis;
pub mod controller;
pub mod cordic;
pub mod cordic_state;
mod extent;
mod host;
pub mod job;
pub mod length_clamp;
pub mod measure;
pub mod model_state;
pub mod path_length;
pub mod path_point;
pub(crate) mod path_writer;
pub mod period_join;
pub mod planner;
pub mod point_sequencer;
pub mod profile;
pub mod profile_record;
pub mod program;
pub mod ramp;
pub mod reference_model;
pub mod scaler;
pub mod segment_search;
pub mod segment_store;
pub mod segments;
pub mod servo;
pub mod servo_arithmetic;
pub mod servo_gains;
pub mod settings;
pub mod shifter;
pub mod speed_limits;
pub mod vector_correction;
pub mod widths;

pub use crate::arc_generator::Rounding;
pub use arc_angle::ArcAngle;
pub use axis_row::AxisRow;
pub use controlled_axis::ControlledAxis;
pub use controller::TrajectoryController;
pub use cordic::Cordic;
pub use cordic_state::CordicState;
pub use length_clamp::LengthClamp;
pub use model_state::ModelState;
pub use path_length::PathLength;
pub use path_point::PathPoint;
pub use period_join::PeriodJoin;
pub use point_sequencer::PointSequencer;
pub use reference_model::ReferenceModel;
pub use scaler::Scaler;
pub use segment_search::SegmentSearch;
pub use segment_store::SegmentStore;
pub use servo::Servo;
pub use servo_arithmetic::ServoArithmetic;
pub use shifter::Shifter;
pub use vector_correction::VectorCorrection;
pub use widths::Widths;
