//! The control computer of a job: what it writes to the trajectory controller, tick by tick.

use super::job::Ports;
use super::path_writer::PathWriter;
use super::program::Program;
use crate::arc_generator::record_writer::RecordWriter;
use std::array::from_fn;

/// Records of the profile that wait before the path begins, where there are so many.
const HEAD_START: usize = 16;

/// The control computer: it writes the path, then starts, and writes records as they find room.
pub(super) struct Host<'a> {
    program: &'a Program,
    path: PathWriter<'a>,
    pub(super) records: RecordWriter<'a>,
    started: bool,
}

impl<'a> Host<'a> {
    /// Of a program that is to be written from its first word on.
    pub(super) fn new(program: &'a Program) -> Self {
        Host {
            program,
            path: PathWriter::new(program),
            records: RecordWriter::new(&program.records),
            started: false,
        }
    }

    /// What it gives in this tick, with the encoders' channels.
    pub(super) fn ports<const AXES: usize, const A: usize, const E: usize>(
        &mut self,
        channels: [(bool, bool); AXES],
    ) -> Ports<AXES, A, E> {
        let program = self.program;
        let waiting = program.records.len().min(HEAD_START);
        let start = !self.started && self.path.is_done() && self.records.written() == waiting;
        self.started |= start;
        let record = self.records.write();
        let path = self.path.write();
        Ports {
            write: record.write.into(),
            write_word: record.word.into(),
            write_data: record.data.into(),
            push: record.push.into(),
            start: start.into(),
            halt: false.into(),
            restart: false.into(),
            write_begin: path.write_begin.into(),
            begin_segment: path.segment.into(),
            begin_length: path.begin.into(),
            write_path: path.write.into(),
            path_address: (path.segment << 4 | path.word).into(),
            path_data: path.data.into(),
            last: (program.path.stretches.len().saturating_sub(1) as u64).into(),
            path_end: (program.path.length as i64).into(),
            period: u64::from(program.period_ticks).into(),
            gain_1: program.gains.k1.into(),
            gain_2: program.gains.k2.into(),
            position_gain: from_fn(|axis| program.servo[axis].position.into()),
            speed_gain: from_fn(|axis| program.servo[axis].speed.into()),
            integral_gain: from_fn(|axis| program.servo[axis].integral.into()),
            inertia: from_fn(|axis| program.servo[axis].inertia.into()),
            limit: from_fn(|axis| program.servo[axis].limit.into()),
            given: false.into(),
            given_command: from_fn(|_| 0.into()),
            a: channels.map(|(a, _)| a.into()),
            b: channels.map(|(_, b)| b.into()),
        }
    }
}
