//! Control computer that writes to a record memory: one word per tick, as long as there is room.

use crate::circuits::blocks::RecordWrite;
use crate::hdl::Value;
use crate::path::record::{Record, WORDS};

/// Writer of records in sequence.
#[derive(Debug)]
pub(crate) struct RecordWriter<'a> {
    records: &'a [Record],
    record: usize,
    word: usize,
    /// True if a record was free in the tick before, and no push may have taken the last one.
    pub(crate) free: bool,
}

/// Idle state of the memory's ports.
const NOTHING: RecordWrite<Value> = RecordWrite {
    write: false,
    write_word: 0,
    write_data: 0,
    push: false,
};

impl<'a> RecordWriter<'a> {
    /// Creates a writer of records for an empty memory.
    pub(crate) fn new(records: &'a [Record]) -> Self {
        RecordWriter {
            records,
            record: 0,
            word: 0,
            free: true,
        }
    }

    /// Returns the number of records written.
    pub(crate) fn written(&self) -> usize {
        self.record
    }

    /// True if nothing of the first `records` records can be written before there is room.
    pub(crate) fn stands(&self, records: usize) -> bool {
        self.record >= records.min(self.records.len()) || !self.free
    }

    /// Returns the write of this tick.
    pub(crate) fn write(&mut self) -> RecordWrite<Value> {
        self.write_up_to(self.records.len())
    }

    /// Returns the write of this tick, among the first `records` records: a path that ends at rest
    /// ends only if no record waits.
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
