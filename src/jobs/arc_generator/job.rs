//! A path on the arc generator: the control computer that feeds it, and the commands that come out.

use super::joints::{Hand, JointSignals, Joints};
use super::settings::Settings;
use crate::circuits::arc_generator::{ArcGenerator, generator};
use crate::circuits::blocks::record_memory::ARC;
use crate::circuits::blocks::record_sequencer::{self, FETCH, READY};
use crate::hdl::{At, Circuit, Observer, Place, RunError, Sample, Simulator, Value, Watcher};
use crate::input::COORDINATES;
use crate::path::record::Record;
use crate::path::record_writer::RecordWriter;

/// Records that wait before the path begins, where there are so many: the memory is full then.
const HEAD_START: usize = 16;

/// The generator that plays a job.
#[must_use]
pub fn arc_generator(settings: &Settings) -> ArcGenerator {
    ArcGenerator::new(settings.rounding, settings.blend)
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
    /// A command for every sample, the start of the path first; none where they are told to a
    /// caller as they come.
    pub commands: Vec<Command>,
    /// Commands that came.
    pub samples: u64,
    /// The last of them.
    pub last: Option<Command>,
    /// A sampling time began before its point was ready.
    pub late: bool,
    /// The path ended in motion.
    pub starved: bool,
    /// Most ticks from a sampling time to the next point.
    pub needed: Needed,
}

/// Most ticks from a sampling time to the tick in which the next point is ready; 0 where there was
/// none.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Needed {
    /// To one on the same line or blend.
    pub straight: u64,
    /// To one on the same arc.
    pub arc: u64,
    /// To the first of the next segment, which is fetched before.
    pub change: u64,
}

impl Needed {
    /// To any.
    #[must_use]
    pub fn most(&self) -> u64 {
        self.straight.max(self.arc).max(self.change)
    }
}

/// The control computer: it writes records as they find room, and takes down what comes.
pub(super) struct Bench<'a> {
    records: RecordWriter<'a>,
    /// Records that are written before the path begins.
    waiting: usize,
    sample_ticks: u64,
    started: bool,
    /// It gave nothing but what stands in this tick.
    quiet: bool,
    /// A start or a record was given in this tick.
    given: [bool; 2],
    /// The sampling time whose next point is made, and whether a segment is fetched for it.
    making: Option<(u64, bool)>,
    over: bool,
    played: Played,
}

impl<'a> Bench<'a> {
    pub(super) fn new(records: &'a [Record], sample_ticks: u32) -> Self {
        Bench {
            records: RecordWriter::new(records),
            waiting: records.len().min(HEAD_START),
            sample_ticks: u64::from(sample_ticks),
            started: false,
            quiet: false,
            given: [false; 2],
            making: None,
            over: records.is_empty(),
            played: Played::default(),
        }
    }

    /// Whether it gives in the tick to come what it gave in this one, and takes nothing down, if what
    /// it looks at does not change.
    fn stands(&self) -> bool {
        self.quiet && !self.over && self.records.stands(usize::MAX)
    }

    fn ports(&mut self) -> generator::In<Value> {
        let start = !self.started && self.records.written() == self.waiting;
        self.started |= start;
        let record = self.records.write();
        self.quiet = self.started && !start && !record.write;
        self.given = [start, record.push];
        generator::In {
            segments: generator::Segments { record, start },
            halt: false,
            sample_period: self.sample_ticks,
        }
    }

    /// Takes down a tick; returns its command.
    fn take<C: Circuit>(&mut self, now: &Sample<'_, C>, see: &See) -> Option<Command> {
        let [started, pushed] = self.given;
        let (state, sampled) = (now.get(see.state), now.get(see.sampled));
        self.records.free = now.get(see.ready) && !pushed;
        self.quiet &= !sampled;
        let played = &mut self.played;
        let command = sampled.then(|| Command {
            tick: now.tick,
            counts: see.command.map(|word| now.get(word)),
        });
        if let Some(Command { tick, .. }) = command {
            played.samples += 1;
            played.last = command;
            self.making = Some((tick - 1, false));
        }
        if let Some((since, fetched)) = &mut self.making {
            *fetched |= state == FETCH;
            if state == READY {
                let needed = match (*fetched, now.get(see.kind)) {
                    (true, _) => &mut played.needed.change,
                    (_, ARC) => &mut played.needed.arc,
                    _ => &mut played.needed.straight,
                };
                *needed = (now.tick - *since).max(*needed);
                self.making = None;
            }
        }
        played.ticks = now.tick + 1;
        played.late = now.get(see.late);
        played.starved = now.get(see.starved);
        self.over = self.started && !started && !now.get(see.busy);
        command
    }
}

/// What is looked at.
pub(super) struct See {
    ready: At<bool>,
    busy: At<bool>,
    sampled: At<bool>,
    command: [At<i64>; COORDINATES],
    late: At<bool>,
    starved: At<bool>,
    state: At<u64>,
    kind: At<u64>,
}

impl See {
    pub(super) fn of<C: Circuit>(
        watch: &Watcher<'_, C>,
        q: &record_sequencer::Reg<Place>,
        w: &generator::Net<Place>,
    ) -> Self {
        See {
            ready: watch.at(w.ready),
            busy: watch.at(w.busy),
            sampled: watch.at(w.sampled),
            command: [w.x, w.y, w.z].map(|word| watch.at(word)),
            late: watch.at(q.late),
            starved: watch.at(q.starved),
            state: watch.at(q.state),
            kind: watch.at(q.kind),
        }
    }
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
    observer: &mut dyn Observer<ArcGenerator>,
) -> Result<Played, RunError> {
    let mut commands = Vec::new();
    let each = &mut |command| commands.push(command);
    let played = play_each(circuit, records, sample_ticks, None, observer, each)?;
    Ok(Played { commands, ..played })
}

/// Does what [`play`] does, but tells every command to `each` as it comes and keeps none. The joints
/// of `hand`, if there is one, stand beside the circuit: those of each command from the tick after
/// it on, with which the run ends.
///
/// # Errors
/// Errors of [`play`].
pub fn play_each(
    circuit: &ArcGenerator,
    records: &[Record],
    sample_ticks: u32,
    hand: Option<Hand>,
    observer: &mut dyn Observer<ArcGenerator>,
    each: &mut dyn FnMut(Command),
) -> Result<Played, RunError> {
    let bench = Bench::new(records, sample_ticks);
    bench.play(circuit, hand, observer, each, |watch| {
        See::of(watch, &watch.p.sequencer.q, &watch.w)
    })
}

impl Bench<'_> {
    /// Plays its records on a circuit.
    pub(super) fn play<C: Circuit<In<Value> = generator::In<Value>>>(
        mut self,
        circuit: &C,
        mut hand: Option<Hand>,
        observer: &mut dyn Observer<C>,
        each: &mut dyn FnMut(Command),
        look: impl FnOnce(&Watcher<'_, C>) -> See,
    ) -> Result<Played, RunError> {
        let all = observer.needs_all();
        let (mut simulator, see) = match hand {
            None => Simulator::watching(circuit, all, look)?,
            Some(_) => Simulator::watching_beside(circuit, &Joints, all, look)?,
        };
        // Joints that no tick has shown.
        let mut joints = hand.as_ref().map(|hand| hand.joints);
        let mut stopped = self.over;
        while !stopped {
            let i = self.ports();
            if let Some(joints) = joints.take() {
                simulator.show::<Joints>(&JointSignals::of(joints))?;
            }
            let (command, flow) = simulator.look(&i, &mut *observer, |now| self.take(now, &see))?;
            if let Some(command) = command {
                each(command);
                if let Some(hand) = &mut hand {
                    hand.follow(command.counts);
                    joints = Some(hand.joints);
                }
            }
            stopped = flow.is_break() || self.over && joints.is_none();
            let most = match self.stands() && !stopped {
                true => simulator.unseen(&observer),
                false => 1,
            };
            simulator.go_on(most);
        }
        Ok(self.played)
    }
}
