//! Blocks that more than one circuit is made of.

pub mod enable_counter;
pub mod mul_div;
pub mod quadrature_counter;

pub use enable_counter::EnableCounter;
pub use mul_div::MulDiv;
pub use quadrature_counter::QuadratureCounter;
