use super::{AnyCircuit, AnyModel};
use crate::kernel::Declarations;

/// Widths that circuits are made with for proofs and charts.
pub const WIDTHS: std::ops::RangeInclusive<u64> = 2..=4;

/// One circuit of the catalogue.
#[derive(Debug, Clone, Copy)]
pub struct Entry {
    /// Its name.
    pub name: &'static str,
    /// What it does, in one line.
    pub about: &'static str,
    /// Its patent and block.
    pub source: &'static str,
    /// Its widths by name, with their defaults.
    pub widths: &'static [(&'static str, usize)],
    /// Makes it with its default widths, as it is built.
    pub full: fn() -> Box<dyn AnyModel>,
    /// What it is made with otherwise, in words: the numbers that [`Entry::make`] and
    /// [`Entry::model`] take.
    pub arguments: &'static str,
    /// Makes it from those numbers for proofs, the first of them one of [`WIDTHS`]; `None` where
    /// there is none with them, or where it is too wide for proofs by exhaustion at any width.
    pub make: fn(&[u64]) -> Option<Box<dyn AnyCircuit>>,
    /// Makes it from the same numbers without its proofs, the first of them one of
    /// [`Entry::offered`].
    pub model: fn(&[u64]) -> Option<Box<dyn AnyModel>>,
    /// The widths that [`Entry::model`] takes; none where the circuit has no width.
    pub offered: &'static [u64],
    /// The width it is proved at unless another is asked for; `None` where it is not proved by
    /// exhaustion.
    pub proof_width: Option<u64>,
}

impl Entry {
    /// Its signals at the default widths.
    pub fn declarations(&self) -> Declarations {
        (self.full)().outline()
    }
}

/// Makes a circuit with a width that is known only when the program runs: one of those in
/// brackets.
macro_rules! at_width {
    ([$($bits:literal)*], $arguments:expr, $width:ident => $circuit:expr) => {
        match $arguments.first() {
            $(Some($bits) => Some(Box::new({
                const $width: usize = $bits;
                $circuit
            })),)*
            _ => None,
        }
    };
}

/// The functions of an [`Entry`] for a circuit without proofs by exhaustion, at some widths.
macro_rules! some_widths {
    ([$($bits:literal)*], |$width:ident| $circuit:expr) => {
        some_widths!([$($bits)*], |given, $width| $crate::registry::entry::alone(given, $circuit)?)
    };
    ([$($bits:literal)*], |$given:ident, $width:ident| $circuit:expr) => {
        Made {
            make: |_given| None,
            model: |$given| at_width!([$($bits)*], $given, $width => $circuit),
            offered: &[$($bits),*],
        }
    };
}

/// The functions of an [`Entry`] for a circuit that is proved at some widths and offered at some:
/// those that proofs, charts and tests ask for, since each costs time to build.
macro_rules! proved_at {
    ([$($proof:literal)*]; [$($bits:literal)*], |$width:ident| $circuit:expr) => {
        proved_at!(
            [$($proof)*]; [$($bits)*],
            |given, $width| $crate::registry::entry::alone(given, $circuit)?
        )
    };
    ([$($proof:literal)*]; [$($bits:literal)*], |$given:ident, $width:ident| $circuit:expr) => {
        Made {
            make: |$given| at_width!([$($proof)*], $given, $width => $circuit),
            model: |$given| at_width!([$($bits)*], $given, $width => $circuit),
            offered: &[$($bits),*],
        }
    };
}

/// A circuit that takes nothing but its width.
pub(super) fn alone<C>(given: &[u64], circuit: C) -> Option<C> {
    (given.len() <= 1).then_some(circuit)
}

/// How an entry is made from numbers.
pub(super) struct Made {
    pub make: fn(&[u64]) -> Option<Box<dyn AnyCircuit>>,
    pub model: fn(&[u64]) -> Option<Box<dyn AnyModel>>,
    pub offered: &'static [u64],
}

/// An entry for a circuit type, given with its default widths and how it is made otherwise.
macro_rules! entry {
    (
        $full:ty, $circuit:expr, $proof_width:expr, $source:literal, [$($name:literal = $bits:literal),*],
        $arguments:literal, $made:expr
    ) => {
        $crate::registry::Entry {
            name: <$full as $crate::kernel::Circuit>::NAME,
            about: <$full as $crate::kernel::Circuit>::ABOUT,
            source: $source,
            widths: &[$(($name, $bits)),*],
            full: || {
                let full: $full = $circuit;
                Box::new(full)
            },
            arguments: $arguments,
            make: { const MADE: Made = $made; MADE.make },
            model: { const MADE: Made = $made; MADE.model },
            offered: { const MADE: Made = $made; MADE.offered },
            proof_width: $proof_width,
        }
    };
}

pub(super) use {at_width, entry, proved_at, some_widths};
