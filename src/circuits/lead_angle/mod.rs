//! The lead-angle compensator of JPH0646367B2.
//!
//! ```text
//!  a, b ─▶┌─────────────┐ Dx ┌──────────────────┐ Dx, Dx(−Δt/N) ┌──────┐ N·Δx ┌───────────┐
//!         │ detector 10 ├───▶│ history 11, 14   ├──────────────▶│ lead ├─────▶│ placement │
//!  CK ───▶└─────────────┘    └───────▲──────────┘               │15, 16│      │ 17, 20    │
//!                                    │ N, tap                   └──────┘      └─────┬─────┘
//!                            ┌───────┴────────┐      ┌──────────────────┐ Sx        ▼
//!                            │ ratio logic 13 │      │ target setter 18 ├──▶┌───────────────┐
//!                            └───────▲────────┘      └──────────────────┘   │ comparator 19 ├──▶ brake
//!                                    │ Δt1                                  └───────┬───────┘
//!                            ┌───────┴──────┐ Δt2 ┌───────────────┐ complete ┌──────▼────────┐
//!                            │ time data 21 │◀────┤ correction 23 │◀─────────┤ completion 26 │
//!                            └──────────────┘     └───────────────┘          └───────────────┘
//! ```
//!
//! A body that is to stop at a target must be braked before it arrives. Its remaining distance is
//! predicted from the distance travelled in the last Δt/N, and Δt is learned from how it stopped.
//! `rtl_notes/lead_angle/README.md` is the note of this circuit.

pub mod absolute_detector;
pub mod codes;
pub mod comparator;
pub mod compensator;
pub mod completion_detector;
pub mod correction;
pub mod correction_arithmetic;
pub mod detector;
pub mod difference_history;
pub mod divided_time;
pub mod exact_relation;
pub mod gray_receiver;
pub mod grid;
pub mod lead;
pub mod lead_products;
pub mod lead_source;
pub mod phase_counter;
pub mod phase_detector;
pub mod placement;
pub mod position_history;
pub mod ram_history;
pub mod ratio_logic;
pub mod refinement;
pub mod resolver_detector;
pub mod speed_detector;
pub mod speed_lead;
pub mod step_sequencer;
pub mod stop_error;
pub mod table_lead;
pub mod target_setter;
pub mod time_data;
pub mod time_lead;
pub mod time_limit;
pub mod touch_probe;
pub mod tracking_converter;
pub mod tracking_loop;
pub mod unwrapper;
pub mod widths;

pub use absolute_detector::AbsoluteDetector;
pub use comparator::{Comparator, Comparing};
pub use compensator::Compensator;
pub use completion_detector::CompletionDetector;
pub use correction::{Correction, Function};
pub use correction_arithmetic::CorrectionArithmetic;
pub use detector::Detector;
pub use difference_history::DifferenceHistory;
pub use divided_time::{DividedTime, Division};
pub use exact_relation::ExactRelation;
pub use gray_receiver::GrayReceiver;
pub use lead::Lead;
pub use lead_products::LeadProducts;
pub use lead_source::{LeadForm, LeadFrom, LeadSource};
pub use phase_counter::PhaseCounter;
pub use phase_detector::PhaseDetector;
pub use placement::{LeadPlacement, Placement};
pub use position_history::PositionHistory;
pub use ram_history::RamHistory;
pub use ratio_logic::RatioLogic;
pub use refinement::Refinement;
pub use resolver_detector::ResolverDetector;
pub use speed_detector::SpeedDetector;
pub use speed_lead::SpeedLead;
pub use step_sequencer::StepSequencer;
pub use stop_error::{Sign, StopError};
pub use table_lead::{LeadTable, TableLead};
pub use target_setter::TargetSetter;
pub use time_data::TimeData;
pub use time_lead::{Form, History, Memory, TimeLead};
pub use time_limit::TimeLimit;
pub use touch_probe::TouchProbe;
pub use tracking_converter::TrackingConverter;
pub use tracking_loop::TrackingLoop;
pub use unwrapper::Unwrapper;
pub use widths::{Variant, Widths};
