//! The record memory against a queue.

use super::below;
use motion_rtl::check::Random;
use motion_rtl::circuits::blocks::record_memory::{In, RECORD};
use motion_rtl::circuits::blocks::{RecordMemory, RecordWrite};
use motion_rtl::hdl::{Cut, Value};
use motion_rtl::trace::LastTicks;
use std::collections::VecDeque;

/// A memory as a queue of records; what goes out is told by the tick of each word.
#[derive(Default)]
struct Program {
    free: [u64; RECORD],
    waiting: VecDeque<[u64; RECORD]>,
    /// The record on its way, and the word that is read in the tick to come.
    reading: Option<usize>,
    /// The word on the bus.
    bus: Option<(u64, u64)>,
    loaded: bool,
}

const MEMORY: RecordMemory = RecordMemory { record: 1, data: 8 };
const RECORDS: usize = 2;

impl Program {
    /// The next tick.
    fn clock(&mut self, i: &In<Value>) {
        let ready = self.waiting.len() < RECORDS;
        self.loaded = matches!(self.bus, Some((31, _))) && !i.flush;
        self.bus = self
            .reading
            .map(|word| (word as u64, self.waiting[0][word]))
            .filter(|_| !i.flush);
        let takes = i.take && !self.waiting.is_empty();
        self.reading = match self.reading {
            None => takes.then_some(0),
            Some(word) => (word + 1 < RECORD).then_some(word + 1),
        };
        if matches!(self.bus, Some((31, _))) {
            self.waiting.pop_front();
        }
        if ready && i.record.write {
            self.free[i.record.write_word as usize] = i.record.write_data;
        }
        if ready && i.record.push {
            self.waiting.push_back(self.free);
        }
        if i.flush {
            self.waiting.clear();
            self.reading = None;
        }
    }
}

#[test]
fn it_is_a_queue_of_records() {
    let mut simulator = LastTicks::simulator(&MEMORY).unwrap();
    let mut random = Random::new(1);
    let mut program = Program::default();
    let (mut went, mut flushed) = (0, 0);
    // All words are written before a push, so what the RAM held before does not matter.
    let mut written = 0;
    for _ in 0..400_000 {
        let full = program.waiting.len() == RECORDS;
        let chance = |random: &mut Random, end| below(random, end) == 0;
        let write = written < RECORD as u64 || chance(&mut random, 4);
        let word = match written < RECORD as u64 {
            true => written,
            false => below(&mut random, 32),
        };
        // A word that is written with the push counts.
        let push = match full {
            true => chance(&mut random, 2),
            false => written >= RECORD as u64 - 1 && write && chance(&mut random, 8),
        };
        let record = RecordWrite {
            write,
            write_word: word,
            write_data: below(&mut random, 256),
            push,
        };
        let i = In {
            record,
            take: chance(&mut random, 16),
            kind: below(&mut random, 3),
            flush: chance(&mut random, 3000),
        };
        if !full && write {
            written += 1;
        }
        if !full && (push || i.flush) {
            written = 0;
        }
        let arc = i.kind == 2;
        simulator
            .step_with(&i, |now| {
                let w = now.w;
                assert_eq!(w.ready, program.waiting.len() < RECORDS);
                assert_eq!(w.available, !program.waiting.is_empty());
                assert_eq!(w.load_engines, program.bus.is_some() && !arc);
                assert_eq!(w.load_rotation, program.bus.is_some() && arc);
            })
            .unwrap();
        program.clock(&i);
        let load = simulator.see(|s| s.q.load);
        let bus = load.then(|| (simulator.see(|s| s.q.word), simulator.see(|s| s.q.data)));
        assert_eq!(bus, program.bus);
        assert_eq!(simulator.see(|s| s.q.loaded), program.loaded);
        went += u64::from(program.loaded);
        flushed += u64::from(i.flush);
    }
    assert!(
        went > 1000 && flushed > 50,
        "{went} records, {flushed} flushes"
    );
}

#[test]
fn a_record_takes_its_latency() {
    let mut simulator = LastTicks::simulator(&MEMORY).unwrap();
    for tick in 0..200 {
        let record = RecordWrite {
            write: tick < 32,
            write_word: tick % 32,
            write_data: (tick * 7).cut(8),
            push: tick == 31,
        };
        let i = In {
            record,
            take: tick == 50,
            kind: 0,
            flush: false,
        };
        simulator.step_with(&i, |_| ()).unwrap();
        let q = simulator.registers().q;
        let shown = tick + 1;
        assert_eq!(q.load, (52..84).contains(&shown), "tick {shown}");
        let done = shown == 50 + MEMORY.latency();
        assert_eq!(q.loaded, done, "tick {shown}");
        if q.load {
            assert_eq!((q.word, q.data), (shown - 52, (shown - 52) * 7 % 256));
        }
    }
}
