//! The control computer of a job: what it writes to the trajectory controller, tick by tick.

use super::Widths;
use super::job::Ports;
use super::program::Program;
use super::segment_store;
use crate::arc_generator::record::WORDS;
use std::array::from_fn;

/// Words of a segment that are written.
const SEGMENT_WORDS: usize = 13;
/// Records of the profile that wait before the path begins, where there are so many.
const HEAD_START: usize = 16;

/// The control computer: it writes the path, then starts, and writes records as they find room.
pub(super) struct Host<'a> {
    program: &'a Program,
    /// The segment and the word of it that are written next, and the segment's words.
    segment: usize,
    word: usize,
    words: [u64; segment_store::WORDS],
    record: usize,
    record_word: usize,
    /// There was a free record in the tick before, and no push that may have taken the last.
    pub(super) free: bool,
    pub(super) started: bool,
}

impl<'a> Host<'a> {
    /// Of a program that is to be written from its first word on.
    pub(super) fn new(program: &'a Program) -> Self {
        let mut host = Host {
            program,
            segment: 0,
            word: 0,
            words: [0; segment_store::WORDS],
            record: 0,
            record_word: 0,
            free: true,
            started: false,
        };
        host.prepare();
        host
    }

    /// The words of the segment that is written next: the motors are at 0 where the path begins.
    fn prepare(&mut self) {
        let Some(stretch) = self.program.path.stretches.get(self.segment) else {
            return;
        };
        let mut segment = stretch.segment;
        for (base, origin) in segment.base.iter_mut().zip(self.program.origin) {
            *base -= origin;
        }
        self.words = segment.words(&Widths::FULL);
    }

    /// What it gives in this tick, with the encoders' channels.
    pub(super) fn ports<const AXES: usize, const A: usize, const E: usize>(
        &mut self,
        channels: [(bool, bool); AXES],
    ) -> Ports<AXES, A, E> {
        let program = self.program;
        let stretches = &program.path.stretches;
        let (segment, word) = (self.segment, self.word);
        let writing = stretches.get(segment);
        let record = program.records.get(self.record).filter(|_| self.free);
        let (record_word, last) = (self.record_word, self.record_word + 1 == WORDS);
        let waiting = program.records.len().min(HEAD_START);
        let start = !self.started && writing.is_none() && self.record == waiting;
        self.started |= start;
        let ports = Ports {
            write: record.is_some().into(),
            write_word: (record_word as u64).into(),
            write_data: record.map_or(0, |record| record.words[record_word]).into(),
            push: (record.is_some() && last).into(),
            start: start.into(),
            halt: false.into(),
            restart: false.into(),
            write_begin: (writing.is_some() && word == 0).into(),
            begin_segment: (segment as u64).into(),
            begin_length: writing.map_or(0, |stretch| stretch.begin).into(),
            write_path: writing.is_some().into(),
            path_address: ((segment as u64) << 4 | word as u64).into(),
            path_data: self.words[word].into(),
            last: (stretches.len() as u64 - 1).into(),
            path_end: (program.path.length as i64).into(),
            period: u64::from(program.period_ticks).into(),
            gain_1: program.gains.k1.into(),
            gain_2: program.gains.k2.into(),
            position_gain: from_fn(|axis| program.servo[axis].position.into()),
            speed_gain: from_fn(|axis| program.servo[axis].speed.into()),
            integral_gain: from_fn(|axis| program.servo[axis].integral.into()),
            inertia: from_fn(|axis| program.servo[axis].inertia.into()),
            limit: from_fn(|axis| program.servo[axis].limit.into()),
            a: channels.map(|(a, _)| a.into()),
            b: channels.map(|(_, b)| b.into()),
        };
        if record.is_some() {
            self.record_word = (record_word + 1) % WORDS;
            self.record += usize::from(last);
        }
        if writing.is_some() {
            self.word = (word + 1) % SEGMENT_WORDS;
            if self.word == 0 {
                self.segment += 1;
                self.prepare();
            }
        }
        ports
    }
}
