//! The trajectory controller: its blocks against programs.

mod bench;
mod controller;
mod cordic;
mod feedback;
mod model;
mod point;
mod powers;
mod search;
mod servo;
mod whole;
