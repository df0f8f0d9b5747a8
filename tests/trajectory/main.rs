//! The trajectory controller: its blocks against programs.

mod cordic;
mod model;
mod point;
mod search;
