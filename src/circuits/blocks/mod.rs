//! Blocks that several circuits share.

pub mod coefficient_control;
pub mod cordic;
pub mod cordic_state;
pub mod difference_column;
pub mod difference_engine;
pub mod enable_counter;
pub mod mul_div;
pub mod quadrature_counter;
pub mod record_memory;
pub mod record_sequencer;
pub mod scaler;
pub mod shifter;

pub use coefficient_control::CoefficientControl;
pub use cordic::Cordic;
pub use cordic_state::CordicState;
pub use difference_column::DifferenceColumn;
pub use difference_engine::DifferenceEngine;
pub use enable_counter::EnableCounter;
pub use mul_div::MulDiv;
pub use quadrature_counter::QuadratureCounter;
pub use record_memory::{RecordMemory, RecordWord, RecordWrite};
pub use record_sequencer::RecordSequencer;
pub use scaler::Scaler;
pub use shifter::Shifter;
