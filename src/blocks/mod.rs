//! Blocks that more than one circuit is made of.

pub mod mul_div;

pub use mul_div::MulDiv;
