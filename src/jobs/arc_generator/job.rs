//! A path on the arc generator: the control computer that feeds it, and the commands that come out.

use crate::circuits::arc_generator::{ArcGenerator, Rounding, generator};
use crate::hdl::{At, Observer, RunError, Simulator, Value};
use crate::input::COORDINATES;
use crate::path::record::Record;
use crate::path::record_writer::RecordWriter;

/// Records that wait before the path begins, where there are so many: the memory is full then.
const HEAD_START: usize = 16;

/// The generator that plays a job.
#[must_use]
pub fn arc_generator(rounding: Rounding) -> ArcGenerator {
    ArcGenerator::new(rounding)
}

/// The commands of one sampling time.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Command {
    /// The tick from which on they stand.
    pub tick: u64,
    /// x, y and z in counts.
    pub counts: [i64; COORDINATES],
}

/// What came out of a path.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Played {
    /// The ticks of the run.
    pub ticks: u64,
    /// A command for every sample, the start of the path first.
    pub commands: Vec<Command>,
    /// A sampling time began before its point was ready.
    pub late: bool,
    /// The path ended in motion.
    pub starved: bool,
}

/// The control computer: it writes records as they find room.
struct Host<'a> {
    records: RecordWriter<'a>,
    /// Records that are written before the path begins.
    waiting: usize,
    sample_ticks: u64,
    started: bool,
    /// It gave nothing but what stands in this tick.
    quiet: bool,
}

impl Host<'_> {
    /// Whether it gives in the tick to come what it gave in this one, if what it looks at does not
    /// change.
    fn stands(&self) -> bool {
        self.quiet && self.records.stands(usize::MAX)
    }

    fn ports(&mut self) -> generator::In<Value> {
        let start = !self.started && self.records.written() == self.waiting;
        self.started |= start;
        let record = self.records.write();
        self.quiet = self.started && !start && !record.write;
        generator::In {
            segments: generator::Segments {
                write: record.write,
                write_word: record.word,
                write_data: record.data,
                push: record.push,
                start,
            },
            halt: false,
            sample_period: self.sample_ticks,
        }
    }
}

/// What is looked at.
struct See {
    ready: At<bool>,
    busy: At<bool>,
    sampled: At<bool>,
    command: [At<i64>; COORDINATES],
    late: At<bool>,
    starved: At<bool>,
}

/// Plays a path on `circuit`, a sample every `sample_ticks` ticks, seen by `observer` too. An empty
/// path makes no tick.
///
/// # Errors
/// What `observer` objects to.
pub fn play(
    circuit: &ArcGenerator,
    records: &[Record],
    sample_ticks: u32,
    mut observer: impl Observer<ArcGenerator>,
) -> Result<Played, RunError> {
    let mut host = Host {
        records: RecordWriter::new(records),
        waiting: records.len().min(HEAD_START),
        sample_ticks: u64::from(sample_ticks),
        started: false,
        quiet: false,
    };
    let mut played = Played::default();
    let all = observer.needs_all();
    let (mut simulator, see) = Simulator::watching(circuit, all, |watch| {
        let (q, w) = (&watch.p.sequencer.q, &watch.w);
        See {
            ready: watch.at(w.ready),
            busy: watch.at(w.busy),
            sampled: watch.at(w.sampled),
            command: [w.x, w.y, w.z].map(|word| watch.at(word)),
            late: watch.at(q.late),
            starved: watch.at(q.starved),
        }
    })?;
    let (mut over, mut stopped) = (records.is_empty(), false);
    while !over && !stopped {
        let i = host.ports();
        let (started, pushed) = (i.segments.start, i.segments.push);
        let mut quiet = true;
        let (busy, flow) = simulator.look(&i, &mut observer, |now| {
            host.records.free = now.get(see.ready) && !pushed;
            quiet = !now.get(see.sampled);
            if now.get(see.sampled) {
                let counts = see.command.map(|word| now.get(word));
                played.commands.push(Command {
                    tick: now.tick,
                    counts,
                });
            }
            now.get(see.busy)
        })?;
        played.ticks = simulator.tick() + 1;
        over = host.started && !started && !busy;
        stopped = flow.is_break();
        let most = match quiet && host.stands() && !over && !stopped {
            true => simulator.unseen(&observer),
            false => 1,
        };
        simulator.go_on(most);
    }
    played.late = simulator.get(see.late);
    played.starved = simulator.get(see.starved);
    Ok(played)
}
