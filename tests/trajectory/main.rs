//! The trajectory controller: its blocks against programs.

mod controller;
mod cordic;
mod model;
mod point;
mod search;
