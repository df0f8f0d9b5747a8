//! The readers, from the outside.

mod common;
mod gcode;
mod hpgl;
mod paths;
mod properties;
mod stimulus;
