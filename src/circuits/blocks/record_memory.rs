//! Record memory: a buffer for the records of the next segments, which sends their words to the
//! blocks.
//!
//! ```text
//!                           ┌────────────────┐
//!  write, write_word, … ───▶│                ├──▶ ready, available
//!  push ───────────────────▶│ record_memory  ├──▶ load, word, data
//!  take, kind ─────────────▶│                ├──▶ load_engines, load_rotation
//!  flush ──────────────────▶│                ├──▶ loaded
//!                           └────────────────┘
//! ```
//!
//! A record has 32 words. The control computer writes them into the free record, in any order, and
//! completes the record with `push`. Waiting records are taken first in, first out. A record is
//! free again when its last word has been read, so a path can have any length.

use crate::prelude::*;

/// Words of a record.
pub const RECORD: usize = 32;
/// Number of a record's last word.
const LAST_WORD: u64 = RECORD as u64 - 1;
/// Names of the kinds of segments, by the lower bits of a record's first word.
pub(crate) const KINDS: &[&str] = &["blend", "line", "arc"];
/// An arc among them.
pub(crate) const ARC: u64 = 2;

/// Memory of 2^`record` records.
///
/// `load` is high for 32 ticks from the second tick after `take` on; `loaded` is high in the tick
/// after them.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RecordMemory {
    /// Width of a record's number in bits.
    pub record: usize,
    /// Width of a word of a record.
    pub data: usize,
}

impl RecordMemory {
    /// Ticks from `take` to `loaded`.
    pub const fn latency(&self) -> u64 {
        RECORD as u64 + 2
    }

    /// Width of the number of a word among those of all records.
    fn address(&self) -> usize {
        self.record + log2(RECORD)
    }
}

signals! { for RecordMemory as c;
    /// Input ports.
    pub struct In {
        /// Port through which records are written.
        pub record: RecordWrite(&c.data) as Flat,
        /// Starts to send the next record to the blocks; ignored while one is being sent, or if
        /// none waits.
        pub take: Bit,
        /// Kind of segment of the record that is being sent; valid from its second word on.
        pub kind: U(2) as States(KINDS),
        /// Discards the waiting records, including one completed in this tick, and the rest of the
        /// record that is being sent.
        pub flush: Bit,
    }
    /// Flip-flops and memory.
    pub struct Reg {
        /// Memory of the records.
        records: Ram(c.address(), c.data),
        /// Number of the free record.
        write_record: U(c.record) = 0,
        /// Number of the record that is being sent, or is sent next.
        read_record: U(c.record) = 0,
        /// All records are in use.
        full: Bit = 0,
        /// Words of a record are being read.
        pub(crate) reading: Bit = 0,
        /// Number of the word being read.
        read_word: U(5) = 0,
        /// `word` and `data` hold a word of a record.
        pub load: Bit = 0,
        /// Number of the word in `data`.
        pub word: U(5) = 0,
        /// Word of the record.
        pub data: U(c.data) as Hex = 0,
        /// The last word of a record was sent in the tick before.
        pub loaded: Bit = 0,
    }
    /// Nets.
    pub struct Net {
        /// A word of a blend or a line is at `word` and `data`.
        pub load_engines: Bit,
        /// A word of an arc is at `word` and `data`.
        pub load_rotation: Bit,
        /// A record is free to be written.
        pub ready: Bit,
        /// A record is waiting or being sent.
        pub available: Bit,
        /// Write address.
        write_address: U(c.address()) as Hex,
        /// Read address.
        read_address: U(c.address()) as Hex,
        /// A word is written.
        store: Bit,
        /// The free record is completed in this tick.
        complete: Bit,
        /// The last word of a record is being read.
        last: Bit,
        /// `write_record` of the next tick.
        next_write: U(c.record),
        /// `read_record` of the next tick.
        next_read: U(c.record),
    }
}

signals! { for usize as data;
    /// A record as the control computer writes it; `data` is the width of a word.
    pub struct RecordWrite {
        /// Writes a word of the free record; ignored unless `ready`.
        pub write: Bit,
        /// Number of the word to write, 0 to 31.
        pub write_word: U(5),
        /// Word to write.
        pub write_data: U(*data) as Hex,
        /// Completes the free record, including a word written in this tick; ignored unless
        /// `ready`.
        pub push: Bit,
    }
    /// Word of a record on its way to the blocks; `data` is its width.
    pub struct RecordWord {
        /// A record word is in `data`, and its number is in `word`.
        pub load: Bit,
        /// Number of the word in `data`.
        pub word: U(5),
        /// Word of the record.
        pub data: U(*data) as Hex,
    }
}

impl Reg<Seen> {
    /// Its word for blocks that take it where `load` is high.
    pub fn record(&self, load: Bit) -> RecordWord {
        let (word, data) = (self.word, self.data);
        RecordWord { load, word, data }
    }
}

impl RecordWord {
    /// High if this is the word of that number, which is printed as a parameter `name`.
    #[track_caller]
    pub fn is(&self, name: &'static str, number: u64) -> Bit {
        self.load & self.word.equals(U::parameter(name, number, 5))
    }
}

impl RecordWord<Value> {
    /// Returns true if the word is one of these, or, without a word, if all is low: the range of a
    /// proof.
    pub(crate) fn is_among(&self, words: &[u64]) -> bool {
        match self.load {
            true => words.contains(&self.word),
            false => self.word == 0 && self.data == 0,
        }
    }
}

impl Circuit for RecordMemory {
    const NAME: &'static str = "record_memory";
    const ABOUT: &'static str = "buffers the records of the next segments, first in, first out";
    records!(In, Reg, Net);

    fn tick(&self, i: In, q: Reg, _: Nothing) -> (Net, Reg<Edge>) {
        let arc = i.kind.equals(ARC);
        let ready = !q.full;
        let available = q.full | !q.write_record.equals(q.read_record);
        let write_address = q.write_record.join(i.record.write_word);
        let read_address = q.read_record.join(q.read_word);
        let store = i.record.write & ready;
        let complete = i.record.push & !q.full;
        let last = q.reading & q.read_word.equals(LAST_WORD);
        let read_on = last.mux(q.read_record + 1, q.read_record);
        let write_on = complete.mux(q.write_record + 1, q.write_record);
        let next_write = i.flush.mux(q.write_record, write_on);
        let next_read = i.flush.mux(q.write_record, read_on);

        let reading = (i.take & available & !q.reading) | (q.reading & !last);
        let full = next_write.equals(next_read) & (q.full | complete) & !last;
        let load = q.reading & !i.flush;
        let net = Net {
            load_engines: q.load & !arc,
            load_rotation: q.load & arc,
            ready,
            available,
            write_address,
            read_address,
            store,
            complete,
            last,
            next_write,
            next_read,
        };
        let next = Reg {
            data: q.records.read_when(load, read_address, q.data),
            records: q.records.write(store, write_address, i.record.write_data),
            write_record: next_write,
            read_record: next_read,
            full: full & !i.flush,
            reading: reading & !i.flush,
            read_word: (q.reading & !i.flush).mux(q.read_word + 1, 0),
            load,
            word: load.mux(q.read_word, q.word),
            loaded: q.load & q.word.equals(LAST_WORD) & !i.flush,
        };
        (net, next)
    }
}
