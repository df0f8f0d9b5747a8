//! Segment store: holds the segments of the path and sends one of them to the blocks.
//!
//! ```text
//!                           ┌───────────────┐
//!  write, write_address, … ▶│               ├──▶ load, word, data
//!  fetch, segment ─────────▶│ segment_store ├──▶ loaded
//!                           └───────────────┘
//! ```
//!
//! A segment has 16 words, or 20 with a fourth axis. Segments are written before the path begins.
//! While the path runs, any segment can be fetched, any number of times.

use super::widths::PointWidths;
use crate::prelude::*;

/// Store of 2^A segments.
///
/// `load` is high from the second tick after `fetch` on, for as many ticks as a segment has words.
/// `loaded` is high in the tick after that.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SegmentStore {
    /// Word widths.
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
        /// Number of the segment, with the number of the word in the lowest bits.
        pub write_address: U(c.widths.address()) as Hex,
        /// Word to write.
        pub write_data: U(c.widths.data) as Hex,
        /// Starts to send a segment to the blocks; ignored while words are being read.
        pub fetch: Bit,
        /// Number of the segment to fetch; constant while it is being sent.
        pub segment: U(c.widths.segment),
    }
    /// Flip-flops and memory.
    pub struct Reg {
        /// Memory of the segments.
        segments: Ram(c.widths.address(), c.widths.data),
        /// Words of a segment are being read.
        reading: Bit = 0,
        /// Number of the word being read.
        read_word: U(c.widths.word) = 0,
        /// `word` and `data` hold a word of a segment.
        pub load: Bit = 0,
        /// Number of the word in `data`.
        pub word: U(c.widths.word) = 0,
        /// Word of the segment.
        pub data: U(c.widths.data) as Hex = 0,
        /// The last word of a segment was sent in the tick before.
        pub loaded: Bit = 0,
    }
    /// Nets.
    pub struct Net {
        /// Read address.
        read_address: U(c.widths.address()) as Hex,
        /// The last word of a segment is being read.
        last: Bit,
    }
}

impl Circuit for SegmentStore {
    const NAME: &'static str = "segment_store";
    const ABOUT: &'static str = "holds the segments of a path and sends them word by word";
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
