//! Positionings on the lead-angle compensator, with a body and its brake, and position logs.

mod computer;
pub mod job;
mod lead_table;
pub mod replay;
mod sensor;
pub mod settings;
