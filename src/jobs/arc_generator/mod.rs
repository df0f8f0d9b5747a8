//! A path on the arc generator: prepared as records, played, and measured.
//!
//! [`prepare`](mod@prepare) ([pieces](crate::path::pieces) to segments), [`record`] (segments to
//! words), [`bounds`] (error bounds of the rotation), [`mod@reference`] (the same samples by
//! division), [`products`] (blends and lines by products), [`conventional`] (the patent's
//! comparison method), [`job`] (a path on the circuit), [`beside`] (its arcs on the conventional
//! circuit), [`measure`] (measures of the commands), [`joints`] (commands of an arm's joints),
//! [`mechanism`] (response of an elastic mechanism).

pub mod beside;
pub mod bounds;
pub mod conventional;
mod course;
pub mod job;
pub mod joints;
mod leaving;
pub mod measure;
pub mod mechanism;
pub mod prepare;
pub mod prepared;
pub mod products;
pub mod record;
pub mod reference;
pub mod settings;
