//! What a control computer gives to a record memory: a word a tick, as there is room.

use super::record::{Record, WORDS};

/// Records that are written one after the other.
#[derive(Debug)]
pub(crate) struct RecordWriter<'a> {
    records: &'a [Record],
    record: usize,
    word: usize,
    /// There was a free record in the tick before, and no push that may have taken the last.
    pub(crate) free: bool,
}

/// What stands at the memory's ports in a tick; all 0 where nothing is written.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Written {
    /// A word is written.
    pub(crate) write: bool,
    /// Its number.
    pub(crate) word: u64,
    /// Its data.
    pub(crate) data: u64,
    /// It is the record's last.
    pub(crate) push: bool,
}

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
    pub(crate) fn write(&mut self) -> Written {
        self.write_up_to(self.records.len())
    }

    /// The word of this tick, of the first so many records: a path that ends at rest ends where no
    /// record waits.
    pub(crate) fn write_up_to(&mut self, records: usize) -> Written {
        if self.record >= records {
            return Written::default();
        }
        let Some(record) = self.records.get(self.record).filter(|_| self.free) else {
            return Written::default();
        };
        let (word, push) = (self.word, self.word + 1 == WORDS);
        self.word = (word + 1) % WORDS;
        self.record += usize::from(push);
        Written {
            write: true,
            word: word as u64,
            data: record.words[word],
            push,
        }
    }
}
