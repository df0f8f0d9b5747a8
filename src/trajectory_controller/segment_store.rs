//! Segment store: the path's segments, and the way one goes to the blocks.
//!
//! ```text
//!                           ┌───────────────┐
//!  write, write_address, … ▶│               ├──▶ load, word, data
//!  fetch, segment ─────────▶│ segment_store ├──▶ loaded
//!                           └───────────────┘
//! ```
//!
//! A segment is 16 words. They are written before the path begins; while it runs any of them is
//! fetched, as often as a length belongs to it.

use crate::kernel::Circuit;
use crate::logic::{Bit, Logic, Ram, Unsigned};
use crate::signals;

/// Words of a segment.
pub const WORDS: usize = 16;

signals! {
    /// Ports in.
    pub struct In<L, const A: usize, const K: usize, const D: usize> {
        /// Writes a word.
        pub write: L::Bit,
        /// The segment, and in the lower four bits the number of its word.
        pub write_address: L::U<K> as Hex,
        /// Its data.
        pub write_data: L::U<D> as Hex,
        /// A segment goes to the blocks, unless words are being read.
        pub fetch: L::Bit,
        /// Which; constant while it is on its way.
        pub segment: L::U<A>,
    }
}

signals! {
    /// Flip-flops and memory.
    pub struct Reg<L, const K: usize, const D: usize> {
        /// The segments.
        segments: L::Ram<K, D>,
        /// A segment is on its way: its words are read.
        reading: L::Bit = 0,
        /// The word that is read.
        read_word: L::U<4> = 0,
        /// A word of a segment stands at `word` and `data`.
        pub load: L::Bit = 0,
        /// Its number.
        pub word: L::U<4> = 0,
        /// The word.
        pub data: L::U<D> as Hex = 0,
        /// The last word was there in the tick before.
        pub loaded: L::Bit = 0,
    }
}

signals! {
    /// Nets.
    pub struct Net<L, const K: usize> {
        /// Where is read.
        read_address: L::U<K> as Hex,
        /// The last word is read.
        last: L::Bit,
    }
}

/// Store of 2^`A` segments with words of `D` bits; `K` = `A` + 4 is the width of its address.
///
/// `load` is high from the second tick after `fetch` on, for 16 ticks; `loaded` in the tick after
/// them.
#[derive(Debug, Clone, Default)]
pub struct SegmentStore<const A: usize, const K: usize, const D: usize>;

impl<const A: usize, const K: usize, const D: usize> SegmentStore<A, K, D> {
    /// Ticks from `fetch` to `loaded`.
    pub const LATENCY: u64 = WORDS as u64 + 2;
}

impl<const A: usize, const K: usize, const D: usize> Circuit for SegmentStore<A, K, D> {
    const NAME: &'static str = "segment_store";
    const ABOUT: &'static str = "the segments of a path, fetched word by word";
    type In<L: Logic> = In<L, A, K, D>;
    type Reg<L: Logic> = Reg<L, K, D>;
    type Net<L: Logic> = Net<L, K>;

    fn comb<L: Logic>(&self, q: &Reg<L, K, D>, i: &In<L, A, K, D>) -> Net<L, K> {
        const { assert!(K == A + 4, "a segment has 16 words") };
        Net {
            read_address: i.segment.join(q.read_word),
            last: q.reading & q.read_word.equals((WORDS as u64 - 1).into()),
        }
    }

    fn next<L: Logic>(&self, q: Reg<L, K, D>, w: &Net<L, K>, i: &In<L, A, K, D>) -> Reg<L, K, D> {
        Reg {
            data: q.segments.read_when(q.reading, w.read_address, q.data),
            segments: q.segments.write(i.write, i.write_address, i.write_data),
            reading: (i.fetch & !q.reading) | (q.reading & !w.last),
            read_word: q.reading.mux(q.read_word + 1, 0.into()),
            load: q.reading,
            word: q.reading.mux(q.read_word, q.word),
            loaded: q.load & q.word.equals((WORDS as u64 - 1).into()),
        }
    }
}
