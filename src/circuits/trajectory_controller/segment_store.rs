//! Segment store: holds the path's segments, and sends one of them to the blocks.
//!
//! ```text
//!                           ┌───────────────┐
//!  write, write_address, … ▶│               ├──▶ load, word, data
//!  fetch, segment ─────────▶│ segment_store ├──▶ loaded
//!                           └───────────────┘
//! ```
//!
//! A segment is 16 words, or 20 where there is a fourth axis. They are written before the path
//! begins; while it runs any of them is fetched, as often as a length belongs to it.

use super::widths::PointWidths;
use crate::prelude::*;

/// Store of 2^A segments.
///
/// `load` is high from the second tick after `fetch` on, for as many ticks as there are words;
/// `loaded` in the tick after them.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SegmentStore {
    /// Its widths.
    pub widths: PointWidths,
}

impl SegmentStore {
    /// Ticks from `fetch` to `loaded`.
    pub const fn latency(&self) -> u64 {
        self.widths.words() as u64 + 2
    }

    /// The number of a segment's last word.
    const fn last(&self) -> u64 {
        self.widths.words() as u64 - 1
    }
}

signals! { for SegmentStore as c;
    /// Input ports.
    pub struct In {
        /// Writes a word.
        pub write: Bit,
        /// The segment, and in the lowest bits the number of its word.
        pub write_address: U(c.widths.address()) as Hex,
        /// Its data.
        pub write_data: U(c.widths.data) as Hex,
        /// A segment goes to the blocks, unless words are being read.
        pub fetch: Bit,
        /// The segment to fetch; constant while it is being sent.
        pub segment: U(c.widths.segment),
    }
    /// Flip-flops and memory.
    pub struct Reg {
        /// The segments.
        segments: Ram(c.widths.address(), c.widths.data),
        /// A segment is being sent: its words are read.
        reading: Bit = 0,
        /// The word that is read.
        read_word: U(c.widths.word) = 0,
        /// A word of a segment is at `word` and `data`.
        pub load: Bit = 0,
        /// Its number.
        pub word: U(c.widths.word) = 0,
        /// The word.
        pub data: U(c.widths.data) as Hex = 0,
        /// The last word was there in the tick before.
        pub loaded: Bit = 0,
    }
    /// Nets.
    pub struct Net {
        /// Read address.
        read_address: U(c.widths.address()) as Hex,
        /// The last word is read.
        last: Bit,
    }
}

impl Circuit for SegmentStore {
    const NAME: &'static str = "segment_store";
    const ABOUT: &'static str = "the segments of a path, fetched word by word";
    records!(In, Reg, Net);

    fn tick(&self, i: In, q: Reg, _: Nothing) -> (Net, Reg<Edge>) {
        let read_address = i.segment.join(q.read_word);
        let last = q.reading & q.read_word.equals(self.last());
        let next = Reg {
            data: q.segments.read_when(q.reading, read_address, q.data),
            segments: q.segments.write(i.write, i.write_address, i.write_data),
            reading: (i.fetch & !q.reading) | (q.reading & !last),
            read_word: q.reading.mux(q.read_word + 1, 0),
            load: q.reading,
            word: q.reading.mux(q.read_word, q.word),
            loaded: q.load & q.word.equals(self.last()),
        };
        (Net { read_address, last }, next)
    }
}
