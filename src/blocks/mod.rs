//! Blocks that more than one circuit is made of.

pub mod enable_counter;
pub mod quadrature_counter;

pub use enable_counter::EnableCounter;
pub use quadrature_counter::QuadratureCounter;
