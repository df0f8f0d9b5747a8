//! Control computer that writes the path to the segment stores, one word per tick.

use super::program::Program;
use crate::circuits::trajectory_controller::Widths;
use crate::circuits::trajectory_controller::path_point::{AXES, PathWrite};
use crate::circuits::trajectory_controller::vector_correction::Correction;
use crate::circuits::trajectory_controller::widths::SEGMENT_WORDS;
use crate::hdl::Value;
use crate::input::COORDINATES;

/// Number of words read of a segment, and of one with a third coordinate.
const READ_WORDS: [usize; 2] = [13, SEGMENT_WORDS];

/// Number of words with a fourth axis, which are all read.
const MOST_WORDS: usize = Widths::FULL.point().of_axes(AXES).words();

/// Writer of a path, segment after segment.
#[derive(Debug)]
pub(crate) struct PathWriter<'a> {
    program: &'a Program,
    correction: Correction,
    /// Next segment and word to write, and the segment's words.
    segment: usize,
    word: usize,
    words: [u64; MOST_WORDS],
    /// Number of words to write.
    count: usize,
}

impl<'a> PathWriter<'a> {
    /// Creates a writer of a program from its first word on, for a controller with this
    /// correction.
    pub(crate) fn new(program: &'a Program, correction: Correction) -> Self {
        let mut writer = PathWriter {
            program,
            correction,
            segment: 0,
            word: 0,
            words: [0; MOST_WORDS],
            count: 0,
        };
        writer.prepare();
        writer
    }

    /// True if everything is written.
    pub(crate) fn is_done(&self) -> bool {
        self.segment >= self.program.path.stretches.len()
    }

    /// Prepares the words of the next segment, relative to the start of the path, where the motors
    /// are at 0.
    fn prepare(&mut self) {
        let Some(stretch) = self.program.path.stretches.get(self.segment) else {
            return;
        };
        let mut segment = stretch.segment_for(self.correction);
        let origin = self.program.origin;
        for (base, origin) in segment.base.iter_mut().zip(origin) {
            *base -= origin;
        }
        let words = segment.words(&Widths::FULL);
        self.words[..words.len()].copy_from_slice(&words);
        let spatial = words[0] >> 7 & 1;
        self.count = READ_WORDS[spatial as usize];
        if let Some(fourth) = &mut segment.fourth {
            fourth.base -= origin[COORDINATES];
        }
        if let Some(fourth) = segment.fourth_words(&Widths::FULL) {
            self.words[words.len()..].copy_from_slice(&fourth);
            self.count = MOST_WORDS;
        }
    }

    /// Returns the write of this tick.
    pub(crate) fn write(&mut self) -> PathWrite<Value> {
        let (segment, word) = (self.segment, self.word);
        let widths = Widths::FULL.point().of_axes(self.program.gains.len());
        let writing = self.program.path.stretches.get(segment);
        let given = PathWrite {
            write_path: writing.is_some(),
            write_begin: writing.is_some() && word == 0,
            begin_segment: segment as u64,
            begin_length: writing.map_or(0, |stretch| stretch.begin),
            path_address: (segment << widths.word | word) as u64,
            path_data: self.words[word],
        };
        if given.write_path {
            self.word += 1;
            if self.word == self.count {
                self.word = 0;
                self.segment += 1;
                self.prepare();
            }
        }
        given
    }
}
