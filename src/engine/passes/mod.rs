//! What is done with a netlist before it is planned. Each pass gives one that does the same.

mod constants;
mod dead;
mod equal;

pub use constants::constants;
pub use dead::dead;
pub use equal::equal;

use super::flat::Flat;

/// All passes: what is left does the same for whoever looks at the wanted leaves and properties.
///
/// A pass can make work for another, but two rounds leave next to nothing of it.
pub(crate) fn all(flat: &Flat, wanted: &[bool]) -> Flat {
    let once = equal(&constants(flat));
    dead(&equal(&constants(&once)), wanted)
}
