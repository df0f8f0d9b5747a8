//! Bundles of lanes and packed words: the layout of [`pack`](crate::kernel::pack), a word a lane.

use super::{Element, LaneBit, LaneInt, LaneRam, LaneShiftRegister, LaneUInt, Lanes};
use crate::kernel::{Field, Make, Signals, Visit, words};
use crate::logic::{Image, Sim};
use std::array::from_fn;

/// A bundle of at most 64 bits in every lane, the first leaf in the lowest bits. Bits beyond 64 are
/// lost: [`sweep`](crate::check::sweep) refuses such a law.
#[inline]
pub fn pack<const K: usize, E: Element, S: Signals<Lanes<K, E>>>(signals: &S) -> [u64; K] {
    let mut packer = Packer {
        words: [0; K],
        filled: 0,
    };
    signals.visit(const { &Field::named("") }, &mut packer);
    packer.words
}

/// Undoes [`pack`].
#[inline]
pub fn unpack<const K: usize, E: Element, S: Signals<Lanes<K, E>>>(words: [u64; K]) -> S {
    S::make(const { &Field::named("") }, &mut Unpacker(words))
}

/// A bundle of simulated signals in every lane.
pub fn spread<const K: usize, E: Element, S: Signals<Sim>, T: Signals<Lanes<K, E>>>(
    signals: &S,
) -> T {
    let mut values = words(signals).into_iter();
    T::make(const { &Field::named("") }, &mut Spreader(&mut values))
}

/// The leaves of lane `k`, in the order of the walk, a memory's words one by one.
pub fn lane<const K: usize, E: Element, S: Signals<Lanes<K, E>>>(
    signals: &S,
    k: usize,
) -> Vec<u64> {
    let mut values = Lane {
        k,
        values: Vec::new(),
    };
    signals.visit(const { &Field::named("") }, &mut values);
    values.values
}

/// What sees the bits of a leaf in all lanes.
trait Leaves<const K: usize> {
    fn leaf(&mut self, width: usize, bits: impl Fn(usize) -> u64);
}

struct Packer<const K: usize> {
    words: [u64; K],
    filled: usize,
}

impl<const K: usize> Leaves<K> for Packer<K> {
    #[inline(always)]
    fn leaf(&mut self, width: usize, bits: impl Fn(usize) -> u64) {
        for (k, word) in self.words.iter_mut().enumerate() {
            *word |= bits(k).checked_shl(self.filled as u32).unwrap_or(0);
        }
        self.filled += width;
    }
}

struct Lane {
    k: usize,
    values: Vec<u64>,
}

impl<const K: usize> Leaves<K> for Lane {
    fn leaf(&mut self, _: usize, bits: impl Fn(usize) -> u64) {
        self.values.push(bits(self.k));
    }
}

macro_rules! visitor {
    ($visitor:ident $(, $k:ident)?) => {
        impl<const K: usize, E: Element> Visit<Lanes<K, E>> for $visitor $(<$k>)? {
            #[inline(always)]
            fn enter(&mut self, _: &'static Field) {}
            #[inline(always)]
            fn leave(&mut self) {}
            #[inline(always)]
            fn element(&mut self, _: usize) {}
            #[inline(always)]
            fn bit(&mut self, _: &'static Field, value: LaneBit<K, E>) {
                Leaves::<K>::leaf(self, 1, |k| value.get(k).into());
            }
            #[inline(always)]
            fn unsigned<const N: usize>(&mut self, _: &'static Field, value: LaneUInt<K, E, N>) {
                Leaves::<K>::leaf(self, N, |k| value.get(k));
            }
            #[inline(always)]
            fn signed<const N: usize>(&mut self, _: &'static Field, value: LaneInt<K, E, N>) {
                let mask = u64::MAX >> (64 - N);
                Leaves::<K>::leaf(self, N, |k| value.get(k) as u64 & mask);
            }
            fn ram<const A: usize, const D: usize>(
                &mut self,
                field: &'static Field,
                ram: &LaneRam<K, E, A, D>,
            ) {
                ram.words().iter().for_each(|word| self.unsigned(field, *word));
            }
            fn shift_register<const S: usize, const D: usize>(
                &mut self,
                field: &'static Field,
                register: &LaneShiftRegister<K, E, S, D>,
            ) {
                register.stages().iter().for_each(|stage| self.unsigned(field, *stage));
            }
        }
    };
}

visitor!(Packer, K);
visitor!(Lane);

/// What gives the bits of a leaf to all lanes.
trait Given<const K: usize> {
    fn leaf(&mut self, width: usize) -> [u64; K];
}

struct Unpacker<const K: usize>([u64; K]);

impl<const K: usize> Given<K> for Unpacker<K> {
    #[inline(always)]
    fn leaf(&mut self, width: usize) -> [u64; K] {
        let leaf = self.0;
        // A leaf of 64 bits is the only one, nothing comes after it.
        let rest = |word: u64| word.checked_shr(width as u32).unwrap_or(0);
        self.0 = from_fn(|k| rest(leaf[k]));
        leaf
    }
}

struct Spreader<'a>(&'a mut dyn Iterator<Item = u64>);

impl<const K: usize> Given<K> for Spreader<'_> {
    fn leaf(&mut self, _: usize) -> [u64; K] {
        [self.0.next().unwrap_or(0); K]
    }
}

macro_rules! maker {
    ($maker:ty) => {
        impl<const K: usize, E: Element> Make<Lanes<K, E>> for $maker {
            #[inline(always)]
            fn enter(&mut self, _: &'static Field) {}
            #[inline(always)]
            fn leave(&mut self) {}
            #[inline(always)]
            fn element(&mut self, _: usize) {}
            #[inline(always)]
            fn bit(&mut self, _: &'static Field) -> LaneBit<K, E> {
                let bits: [u64; K] = self.leaf(1);
                LaneBit::each(|k| bits[k] & 1 == 1)
            }
            #[inline(always)]
            fn unsigned<const N: usize>(&mut self, _: &'static Field) -> LaneUInt<K, E, N> {
                let bits: [u64; K] = self.leaf(N);
                LaneUInt::each(|k| bits[k])
            }
            #[inline(always)]
            fn signed<const N: usize>(&mut self, _: &'static Field) -> LaneInt<K, E, N> {
                let bits: [u64; K] = self.leaf(N);
                LaneInt::each(|k| bits[k] as i64)
            }
            fn ram<const A: usize, const D: usize>(
                &mut self,
                field: &'static Field,
            ) -> LaneRam<K, E, A, D> {
                LaneRam::new((0..Image::<A, D>::WORDS).map(|_| self.unsigned(field)))
            }
            fn shift_register<const S: usize, const D: usize>(
                &mut self,
                field: &'static Field,
            ) -> LaneShiftRegister<K, E, S, D> {
                LaneShiftRegister::new((0..S).map(|_| self.unsigned(field)))
            }
        }
    };
}

maker!(Unpacker<K>);
maker!(Spreader<'_>);
