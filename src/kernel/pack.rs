use super::probe::{Probe, Source, part, show, supply};
use super::signals::{Field, Role, Shape, Signals};
use crate::logic::Sim;
use bitvec::prelude::*;

/// The leaves of a walk side by side, the first in the lowest bits.
pub type Bits = BitVec<u64, Lsb0>;

/// Packs a bundle into bits.
pub fn pack<S: Signals<Sim>>(signals: &S) -> Bits {
    struct Packer(Bits);
    impl Probe for Packer {
        fn leaf(&mut self, _: &'static Field, shape: Shape, bits: u64) {
            self.0
                .extend_from_bitslice(&bits.view_bits::<Lsb0>()[..shape.width]);
        }
    }
    let mut packer = Packer(Bits::new());
    signals.visit(const { &Field::named("") }, &mut packer);
    packer.0
}

/// Makes a bundle from packed bits; bits that are missing read zero.
pub fn unpack<S: Signals<Sim>>(bits: &BitSlice<u64, Lsb0>) -> S {
    struct Unpacker<'a>(&'a BitSlice<u64, Lsb0>);
    impl Source for Unpacker<'_> {
        fn leaf(&mut self, _: &'static Field, shape: Shape) -> u64 {
            let (leaf, rest) = self.0.split_at(shape.width.min(self.0.len()));
            self.0 = rest;
            if leaf.is_empty() { 0 } else { leaf.load_le() }
        }
    }
    S::make(const { &Field::named("") }, &mut Unpacker(bits))
}

/// The number of bits of a bundle.
pub fn width<S: Signals<Sim>>() -> usize {
    widths::<S>().iter().sum()
}

/// The words of a bundle's leaves, in their order.
pub fn words<S: Signals<Sim>>(signals: &S) -> Vec<u64> {
    struct Words(Vec<u64>);
    impl Probe for Words {
        fn leaf(&mut self, _: &'static Field, _: Shape, bits: u64) {
            self.0.push(bits);
        }
    }
    let mut words = Words(Vec::new());
    show(signals, Role::Input, &mut words);
    words.0
}

/// The number of bits of each leaf of a bundle.
pub fn widths<S: Signals<Sim>>() -> Vec<usize> {
    struct Counter(Vec<usize>);
    impl Source for Counter {
        fn leaf(&mut self, _: &'static Field, shape: Shape) -> u64 {
            self.0.push(shape.width);
            0
        }
    }
    let mut counter = Counter(Vec::new());
    supply::<S>(Role::Input, &mut counter);
    counter.0
}

/// A bundle with every bit low.
pub fn zero<S: Signals<Sim>>() -> S {
    S::make(part(Role::Input), &mut Zero)
}

struct Zero;

impl Source for Zero {
    fn leaf(&mut self, _: &'static Field, _: Shape) -> u64 {
        0
    }
}
