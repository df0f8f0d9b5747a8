use super::Circuit;
use crate::logic::Logic;

/// The signals of a tick in some meaning of [`Logic`], for a property.
#[derive(Debug)]
pub struct Moment<'a, C: Circuit, L: Logic> {
    /// Inputs.
    pub i: &'a C::In<L>,
    /// Registers.
    pub q: &'a C::Reg<L>,
    /// Nets.
    pub w: &'a C::Net<L>,
}

/// An invariant that is written in words: `check` proves it where words are narrow, and it stands
/// in the printed HDL as an assertion that other tools prove where they are wide.
#[derive(Debug, Clone)]
pub struct Property<L: Logic> {
    /// What holds.
    pub name: &'static str,
    /// The signals at fault where it does not.
    pub signals: &'static [&'static str],
    /// Whether it looks at the registers after the edge.
    pub step: bool,
    /// High where it holds.
    pub holds: L::Bit,
}

impl<L: Logic> Property<L> {
    /// Of the settled signals of a tick.
    pub fn always(name: &'static str, signals: &'static [&'static str], holds: L::Bit) -> Self {
        Property {
            name,
            signals,
            step: false,
            holds,
        }
    }

    /// Of the settled signals of a tick and the registers after its edge.
    pub fn step(name: &'static str, signals: &'static [&'static str], holds: L::Bit) -> Self {
        Property {
            step: true,
            ..Property::always(name, signals, holds)
        }
    }
}
