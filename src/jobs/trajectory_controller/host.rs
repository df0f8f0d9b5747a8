//! The control computer of a job: what it writes to the trajectory controller, tick by tick.

use super::job::Ports;
use super::path_writer::PathWriter;
use super::program::Program;
use crate::kernel::zero;
use crate::path::record_writer::RecordWriter;
use std::array::from_fn;

/// Records of the profile that wait before the path begins, where there are so many.
const HEAD_START: usize = 16;

/// The control computer: it writes the path, then starts, and writes records as they find room.
pub(super) struct Host<'a> {
    program: &'a Program,
    path: PathWriter<'a>,
    pub(super) records: RecordWriter<'a>,
    started: bool,
    /// It gave nothing but what stands in this tick.
    quiet: bool,
}

impl<'a> Host<'a> {
    /// Of a program that is to be written from its first word on.
    pub(super) fn new(program: &'a Program) -> Self {
        Host {
            program,
            path: PathWriter::new(program),
            records: RecordWriter::new(&program.records),
            started: false,
            quiet: false,
        }
    }

    /// What it gives in every tick, with all else low.
    pub(super) fn standing<const AXES: usize, const A: usize, const E: usize>(
        &self,
    ) -> Ports<AXES, A, E> {
        let program = self.program;
        Ports {
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
            ..zero()
        }
    }

    /// Whether it gives in the tick to come what it gave in this one, the encoders' channels aside,
    /// if what it looks at does not change.
    pub(super) fn stands(&self) -> bool {
        self.quiet && self.records.stands(self.program.records.len())
    }

    /// What it gives in this tick, with the encoders' channels.
    pub(super) fn drive<const AXES: usize, const A: usize, const E: usize>(
        &mut self,
        i: &mut Ports<AXES, A, E>,
        channels: [(bool, bool); AXES],
    ) {
        let waiting = self.program.records.len().min(HEAD_START);
        let start = !self.started && self.path.is_done() && self.records.written() == waiting;
        self.started |= start;
        i.start = start.into();
        let record = self.records.write();
        i.write = record.write.into();
        i.write_word = record.word.into();
        i.write_data = record.data.into();
        i.push = record.push.into();
        let path = self.path.write();
        i.write_begin = path.write_begin.into();
        i.begin_segment = path.segment.into();
        i.begin_length = path.begin.into();
        i.write_path = path.write.into();
        i.path_address = (path.segment << 4 | path.word).into();
        i.path_data = path.data.into();
        self.quiet = self.started && !start && !record.write && self.path.is_done() && !path.write;
        i.a = channels.map(|(a, _)| a.into());
        i.b = channels.map(|(_, b)| b.into());
    }
}
