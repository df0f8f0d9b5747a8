//! Record memory: the records of the segments to come, and the way their words go to the blocks.
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
//! A record is 32 words. The control computer writes them into the free record in any order and
//! completes it by `push`; records that wait are taken first in, first out, and each is free again
//! when its last word has been read. A path may so be of any length.

use crate::kernel::Circuit;
use crate::logic::{Bit, Logic, Ram, Unsigned};
use crate::signals;

/// Words of a record.
pub const RECORD: usize = 32;
/// Names of the kinds of segments, by the lower bits of a record's first word.
pub(crate) const KINDS: &[&str] = &["blend", "line", "arc"];
/// An arc among them.
pub(crate) const ARC: u64 = 2;

signals! {
    /// Ports in.
    pub struct In<L, const D: usize> {
        /// Writes a word of the free record; not taken unless `ready`.
        pub write: L::Bit,
        /// Number of the word.
        pub write_word: L::U<5>,
        /// Its data.
        pub write_data: L::U<D> as Hex,
        /// The free record is complete, with what is written in this tick; not taken unless `ready`.
        pub push: L::Bit,
        /// The next record goes to the blocks, if there is one and none is on its way.
        pub take: L::Bit,
        /// The kind of the record that is on its way, from its second word on.
        pub kind: L::U<2> as States(KINDS),
        /// Forgets the records that wait, one that is completed in this tick too, and the rest of
        /// one that is on its way.
        pub flush: L::Bit,
    }
}

signals! {
    /// Flip-flops and memory.
    pub struct Reg<L, const A: usize, const K: usize, const D: usize> {
        /// The records.
        records: L::Ram<K, D>,
        /// The free record.
        write_record: L::U<A> = 0,
        /// The record that is taken next, or is on its way.
        read_record: L::U<A> = 0,
        /// All records wait.
        full: L::Bit = 0,
        /// A record is on its way: its words are read.
        reading: L::Bit = 0,
        /// The word that is read.
        read_word: L::U<5> = 0,
        /// A word of a record stands at `word` and `data`.
        pub load: L::Bit = 0,
        /// Its number.
        pub word: L::U<5> = 0,
        /// The word.
        pub data: L::U<D> as Hex = 0,
        /// The last word of a record was there in the tick before.
        pub loaded: L::Bit = 0,
    }
}

signals! {
    /// Nets.
    pub struct Net<L, const A: usize, const K: usize> {
        /// The word is one of a blend or a line.
        pub load_engines: L::Bit,
        /// The word is one of an arc.
        pub load_rotation: L::Bit,
        /// There is a free record.
        pub ready: L::Bit,
        /// A record waits, or is on its way.
        pub available: L::Bit,
        /// Where is written.
        write_address: L::U<K> as Hex,
        /// Where is read.
        read_address: L::U<K> as Hex,
        /// A word is written.
        store: L::Bit,
        /// The free record is completed.
        complete: L::Bit,
        /// The last word of a record is read.
        last: L::Bit,
        /// The free record after this tick.
        next_write: L::U<A>,
        /// The record to be read after this tick.
        next_read: L::U<A>,
    }
}

/// Memory of 2^`A` records with words of `D` bits; `K` = `A` + 5 is the width of its address.
///
/// `load` is high from the second tick after `take` on, for 32 ticks; `loaded` in the tick after them.
#[derive(Debug, Clone, Default)]
pub struct RecordMemory<const A: usize, const K: usize, const D: usize>;

impl<const A: usize, const K: usize, const D: usize> RecordMemory<A, K, D> {
    /// Ticks from `take` to `loaded`.
    pub const LATENCY: u64 = RECORD as u64 + 2;
}

impl<const A: usize, const K: usize, const D: usize> Circuit for RecordMemory<A, K, D> {
    const NAME: &'static str = "record_memory";
    const ABOUT: &'static str = "coefficients of the segments to come, first in, first out";
    type In<L: Logic> = In<L, D>;
    type Reg<L: Logic> = Reg<L, A, K, D>;
    type Net<L: Logic> = Net<L, A, K>;

    fn comb<L: Logic>(&self, q: &Reg<L, A, K, D>, i: &In<L, D>) -> Net<L, A, K> {
        const { assert!(K == A + 5, "a record has 32 words") };
        let arc = i.kind.equals(ARC.into());
        let (ready, complete) = (!q.full, i.push & !q.full);
        let last = q.reading & q.read_word.equals((RECORD as u64 - 1).into());
        let next_read = last.mux(q.read_record + 1, q.read_record);
        let next_write = complete.mux(q.write_record + 1, q.write_record);
        Net {
            load_engines: q.load & !arc,
            load_rotation: q.load & arc,
            ready,
            available: q.full | !q.write_record.equals(q.read_record),
            write_address: q.write_record.join(i.write_word),
            read_address: q.read_record.join(q.read_word),
            store: i.write & ready,
            complete,
            last,
            next_write: i.flush.mux(q.write_record, next_write),
            next_read: i.flush.mux(q.write_record, next_read),
        }
    }

    fn next<L: Logic>(
        &self,
        q: Reg<L, A, K, D>,
        w: &Net<L, A, K>,
        i: &In<L, D>,
    ) -> Reg<L, A, K, D> {
        let reading = (i.take & w.available & !q.reading) | (q.reading & !w.last);
        let full = w.next_write.equals(w.next_read) & (q.full | w.complete) & !w.last;
        let loads = q.reading & !i.flush;
        Reg {
            data: q.records.read_when(loads, w.read_address, q.data),
            records: q.records.write(w.store, w.write_address, i.write_data),
            write_record: w.next_write,
            read_record: w.next_read,
            full: full & !i.flush,
            reading: reading & !i.flush,
            read_word: (q.reading & !i.flush).mux(q.read_word + 1, 0.into()),
            load: loads,
            word: loads.mux(q.read_word, q.word),
            loaded: q.load & q.word.equals((RECORD as u64 - 1).into()) & !i.flush,
        }
    }
}
