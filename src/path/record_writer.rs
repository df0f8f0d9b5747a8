//! What a control computer gives to a record memory: a word a tick, as there is room.

use super::record::{Record, WORDS};
use crate::circuits::blocks::RecordWrite;
use crate::hdl::Value;

/// Records that are written one after the other.
#[derive(Debug)]
pub(crate) struct RecordWriter<'a> {
    records: &'a [Record],
    record: usize,
    word: usize,
    /// There was a free record in the tick before, and no push that may have taken the last.
    pub(crate) free: bool,
}

/// What stands at the memory's ports where nothing is written.
const NOTHING: RecordWrite<Value> = RecordWrite {
    write: false,
    write_word: 0,
    write_data: 0,
    push: false,
};

impl<'a> RecordWriter<'a> {
    /// Of records, for an empty memory.
    pub(crate) fn new(records: &'a [Record]) -> Self {
        RecordWriter {
            records,
            record: 0,
            word: 0,
            free: true,
        }
    }

    /// How many are written.
    pub(crate) fn written(&self) -> usize {
        self.record
    }

    /// Whether it writes nothing of the first so many records as long as there is no more room.
    pub(crate) fn stands(&self, records: usize) -> bool {
        self.record >= records.min(self.records.len()) || !self.free
    }

    /// The word of this tick.
    pub(crate) fn write(&mut self) -> RecordWrite<Value> {
        self.write_up_to(self.records.len())
    }

    /// The word of this tick, of the first so many records: a path that ends at rest ends where no
    /// record waits.
    pub(crate) fn write_up_to(&mut self, records: usize) -> RecordWrite<Value> {
        if self.record >= records {
            return NOTHING;
        }
        let Some(record) = self.records.get(self.record).filter(|_| self.free) else {
            return NOTHING;
        };
        let (word, push) = (self.word, self.word + 1 == WORDS);
        self.word = (word + 1) % WORDS;
        self.record += usize::from(push);
        RecordWrite {
            write: true,
            write_word: word as u64,
            write_data: record.words[word],
            push,
        }
    }
}
