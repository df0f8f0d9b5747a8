use crate::engine::EngineError;
use crate::kernel::{Field, Probe, Shape, Signals, Source, width};
use crate::logic::Sim;

/// More bits than can be enumerated.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("{what} have {bits} bits, at most {most} can be enumerated")]
pub struct TooWide {
    /// What is too wide.
    pub what: &'static str,
    /// How wide it is.
    pub bits: usize,
    /// How wide it may be.
    pub most: usize,
}

/// Why a circuit cannot be checked.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum CheckError {
    /// There is too much to enumerate.
    #[error(transparent)]
    TooWide(#[from] TooWide),
    /// The circuit cannot be run.
    #[error(transparent)]
    Engine(#[from] EngineError),
}

impl TooWide {
    /// The width of a bundle, if it is at most `most`.
    pub(super) fn check<S: Signals<Sim>>(what: &'static str, most: usize) -> Result<usize, Self> {
        match width::<S>() {
            bits if bits > most => Err(TooWide { what, bits, most }),
            bits => Ok(bits),
        }
    }
}

/// Every value of a bundle, in the order of its packed bits.
///
/// An array is a bundle too: `all::<[In<Sim>; 4]>()` gives every sequence of four inputs.
///
/// # Errors
/// The bundle has more than 63 bits; that many would not come to an end anyway.
pub fn all<S: Signals<Sim>>() -> Result<impl Iterator<Item = S>, TooWide> {
    let bits = TooWide::check::<S>("the signals", 63)?;
    Ok((0..1u64 << bits).map(from_word))
}

/// A bundle of at most 64 bits in one word, the first leaf in the lowest bits.
///
/// The layout of [`pack`](crate::kernel::pack), without its allocation.
#[inline]
pub(super) fn to_word<S: Signals<Sim>>(signals: &S) -> u64 {
    struct Packer {
        word: u64,
        filled: usize,
    }
    impl Probe for Packer {
        #[inline]
        fn leaf(&mut self, _: &'static Field, shape: Shape, bits: u64) {
            self.word |= bits << self.filled;
            self.filled += shape.width;
        }
    }
    let mut packer = Packer { word: 0, filled: 0 };
    signals.visit(const { &Field::named("") }, &mut packer);
    packer.word
}

/// Undoes [`to_word`].
#[inline]
pub(super) fn from_word<S: Signals<Sim>>(word: u64) -> S {
    struct Unpacker(u64);
    impl Source for Unpacker {
        #[inline]
        fn leaf(&mut self, _: &'static Field, shape: Shape) -> u64 {
            let leaf = self.0;
            // A leaf of 64 bits is the only one, nothing comes after it.
            self.0 = leaf.checked_shr(shape.width as u32).unwrap_or(0);
            leaf
        }
    }
    S::make(const { &Field::named("") }, &mut Unpacker(word))
}

/// A stream of random words, the same on every machine for the same seed (SplitMix64).
///
/// As a [`Source`] it gives every leaf a random value.
#[derive(Debug, Clone)]
pub struct Random(u64);

impl Random {
    /// The stream that `seed` names.
    pub const fn new(seed: u64) -> Self {
        Random(seed)
    }

    /// The next 64 random bits.
    pub fn word(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        scramble(self.0)
    }

    /// A random bundle.
    pub fn signals<S: Signals<Sim>>(&mut self) -> S {
        S::make(const { &Field::named("") }, self)
    }
}

impl Source for Random {
    fn leaf(&mut self, _: &'static Field, _: Shape) -> u64 {
        self.word()
    }
}

/// Spreads every bit of a word over all of it; a bijection.
#[inline]
pub(super) const fn scramble(word: u64) -> u64 {
    let word = (word ^ (word >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let word = (word ^ (word >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    word ^ (word >> 31)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::pack;
    use crate::logic::sim::{Int, UInt};

    #[test]
    fn a_word_has_the_layout_of_pack_and_is_undone() {
        type Bundle = ([UInt<3>; 2], [Int<5>; 2]);
        let mut random = Random::new(7);
        for _ in 0..1000 {
            let (a, b): Bundle = (random.signals(), random.signals());
            assert_eq!(to_word(&a), pack(&a).into_vec()[0]);
            assert_eq!(to_word(&b), pack(&b).into_vec()[0]);
            assert_eq!(from_word::<[UInt<3>; 2]>(to_word(&a)), a);
            assert_eq!(from_word::<[Int<5>; 2]>(to_word(&b)), b);
        }
        for word in [0, 1, u64::MAX, 1 << 63] {
            assert_eq!(to_word(&from_word::<UInt<64>>(word)), word);
        }
    }

    #[test]
    fn the_stream_is_splitmix() {
        // The first words for seed 1234567 of the reference implementation.
        let mut random = Random::new(1_234_567);
        let words = [random.word(), random.word(), random.word()];
        assert_eq!(
            words,
            [
                6_457_827_717_110_365_317,
                3_203_168_211_198_807_973,
                9_817_491_932_198_370_423
            ]
        );
    }
}
