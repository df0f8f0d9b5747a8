//! The trajectory controller of CN104204977.
//!
//! Its program on the control computer is in [`jobs`](crate::jobs::trajectory_controller).
//! `rtl_notes/trajectory_controller/README.md` is the note of this circuit.

pub mod arc_angle;
pub mod axis_row;
pub mod controlled_axis;
pub mod controller;
pub mod error_feedback;
pub mod feedback_sweep;
pub mod length_clamp;
pub mod length_powers;
pub mod model_state;
pub mod path_length;
pub mod path_point;
pub mod period_join;
pub mod point_sequencer;
pub mod reference_model;
pub mod segment_search;
pub mod segment_store;
pub mod servo;
pub mod servo_arithmetic;
pub mod vector_correction;
pub mod widths;

pub use crate::circuits::arc_generator::Rounding;
pub use arc_angle::ArcAngle;
pub use axis_row::AxisRow;
pub use controlled_axis::ControlledAxis;
pub use controller::TrajectoryController;
pub use error_feedback::ErrorFeedback;
pub use feedback_sweep::FeedbackSweep;
pub use length_clamp::LengthClamp;
pub use length_powers::LengthPowers;
pub use model_state::ModelState;
pub use path_length::PathLength;
pub use path_point::PathPoint;
pub use period_join::PeriodJoin;
pub use point_sequencer::PointSequencer;
pub use reference_model::ReferenceModel;
pub use segment_search::SegmentSearch;
pub use segment_store::SegmentStore;
pub use servo::Servo;
pub use servo_arithmetic::ServoArithmetic;
pub use vector_correction::VectorCorrection;
pub use widths::Widths;
