//! The record memory against a queue.

use super::below;
use motion_rtl::blocks::RecordMemory;
use motion_rtl::blocks::record_memory::{In, RECORD};
use motion_rtl::check::Random;
use motion_rtl::kernel::Simulator;
use motion_rtl::logic::Sim;
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

const RECORDS: usize = 2;

impl Program {
    /// The next tick.
    fn clock(&mut self, i: &In<Sim, 8>) {
        let ready = self.waiting.len() < RECORDS;
        self.loaded = matches!(self.bus, Some((31, _))) && !i.flush.get();
        self.bus = self
            .reading
            .map(|word| (word as u64, self.waiting[0][word]))
            .filter(|_| !i.flush.get());
        let takes = i.take.get() && !self.waiting.is_empty();
        self.reading = match self.reading {
            None => takes.then_some(0),
            Some(word) => (word + 1 < RECORD).then_some(word + 1),
        };
        if matches!(self.bus, Some((31, _))) {
            self.waiting.pop_front();
        }
        if ready && i.write.get() {
            self.free[i.write_word.get() as usize] = i.write_data.get();
        }
        if ready && i.push.get() {
            self.waiting.push_back(self.free);
        }
        if i.flush.get() {
            self.waiting.clear();
            self.reading = None;
        }
    }
}

#[test]
fn it_is_a_queue_of_records() {
    let circuit = RecordMemory::<1, 6, 8>;
    let mut simulator = Simulator::new(&circuit).unwrap();
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
        let i = In::<Sim, 8> {
            write: write.into(),
            write_word: word.into(),
            write_data: below(&mut random, 256).into(),
            push: push.into(),
            take: chance(&mut random, 16).into(),
            kind: below(&mut random, 3).into(),
            flush: chance(&mut random, 3000).into(),
        };
        if !full && write {
            written += 1;
        }
        if !full && (push || i.flush.get()) {
            written = 0;
        }
        let arc = i.kind.get() == 2;
        let (next, (ready, available, to_engines, to_rotation)) =
            simulator.step(i.clone(), |now| {
                let w = now.w;
                (w.ready, w.available, w.load_engines, w.load_rotation)
            });
        assert_eq!(ready.get(), program.waiting.len() < RECORDS);
        assert_eq!(available.get(), !program.waiting.is_empty());
        assert_eq!(to_engines.get(), program.bus.is_some() && !arc);
        assert_eq!(to_rotation.get(), program.bus.is_some() && arc);
        simulator = next;
        program.clock(&i);
        let q = simulator.registers();
        let bus = q.load.get().then(|| (q.word.get(), q.data.get()));
        assert_eq!(bus, program.bus);
        assert_eq!(q.loaded.get(), program.loaded);
        went += u64::from(program.loaded);
        flushed += u64::from(i.flush.get());
    }
    assert!(
        went > 1000 && flushed > 50,
        "{went} records, {flushed} flushes"
    );
}

#[test]
fn a_record_takes_its_latency() {
    let circuit = RecordMemory::<1, 6, 8>;
    let mut simulator = Simulator::new(&circuit).unwrap();
    for tick in 0..200 {
        let i = In::<Sim, 8> {
            write: (tick < 32).into(),
            write_word: tick.into(),
            write_data: (tick * 7).into(),
            push: (tick == 31).into(),
            take: (tick == 50).into(),
            kind: 0.into(),
            flush: false.into(),
        };
        simulator = simulator.step(i, |_| ()).0;
        let q = simulator.registers();
        let shown = tick + 1;
        assert_eq!(q.load.get(), (52..84).contains(&shown), "tick {shown}");
        let done = shown == 50 + RecordMemory::<1, 6, 8>::LATENCY;
        assert_eq!(q.loaded.get(), done, "tick {shown}");
        if q.load.get() {
            assert_eq!(
                (q.word.get(), q.data.get()),
                (shown - 52, (shown - 52) * 7 % 256)
            );
        }
    }
}
