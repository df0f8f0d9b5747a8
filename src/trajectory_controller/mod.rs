//! The trajectory controller of CN104204977.

pub mod cordic;
pub mod cordic_state;
pub mod model_state;
pub mod reference_model;
pub mod scaler;
pub mod segment_search;
pub mod shifter;

pub use crate::arc_generator::Rounding;
pub use cordic::Cordic;
pub use cordic_state::CordicState;
pub use model_state::ModelState;
pub use reference_model::ReferenceModel;
pub use scaler::Scaler;
pub use segment_search::SegmentSearch;
pub use shifter::Shifter;
