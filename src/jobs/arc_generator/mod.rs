//! A path on the arc generator: prepared as records, played, and measured.
//!
//! [`prepare`](mod@prepare) ([pieces](crate::path::pieces) as segments), [`record`] (segments as
//! words), [`bounds`] (how far the rotation may be off), [`mod@reference`] (the same samples by
//! division), [`products`] (blends and lines by products), [`conventional`] (what the patent compares
//! itself with), [`job`] (a path on the circuit), [`beside`] (its arcs on the conventional circuit),
//! [`measure`] (what came out), [`joints`] (the commands as those of an arm's joints), [`mechanism`]
//! (what they make of an elastic one).

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
