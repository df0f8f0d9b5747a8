//! A path on the arc generator: prepared as records, played, and measured.
//!
//! [`circle`] (an arc from three points), [`path`] (pieces from taught points or a drawing),
//! [`prepare`](mod@prepare) (pieces as segments), [`record`] (segments as words), [`bounds`] (how far
//! the rotation may be off), [`mod@reference`] (the same samples by division), [`conventional`] (what
//! the patent compares itself with), [`job`] (a path on the circuit), [`measure`] (what came out).

pub mod bounds;
pub mod circle;
pub mod conventional;
pub mod error;
pub mod job;
pub mod measure;
pub mod path;
pub mod prepare;
pub mod prepared;
pub mod record;
pub(crate) mod record_writer;
pub mod reference;
pub mod settings;
pub mod vector;
