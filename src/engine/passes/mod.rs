//! Netlist passes before planning. Each returns a netlist with the same behaviour.

mod constants;
mod dead;
mod equal;

pub use constants::constants;
pub use dead::dead;
pub use equal::equal;

use super::flat::Flat;

/// Runs all passes; the wanted leaves and properties keep their behaviour.
///
/// A pass can make work for another, but two rounds leave almost none.
pub(crate) fn all(flat: &Flat, wanted: &[bool]) -> Flat {
    let once = equal(&constants(flat));
    dead(&equal(&constants(&once)), wanted)
}
