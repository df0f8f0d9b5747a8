//! Run of a path on the arc generator: the control computer that feeds it, and the resulting
//! commands.

use super::joints::{Hand, JointSignals, Joints};
use super::settings::Settings;
use crate::circuits::arc_generator::{ArcGenerator, generator};
use crate::circuits::blocks::record_memory::ARC;
use crate::circuits::blocks::record_sequencer::{self, FETCH, READY};
use crate::hdl::{At, Circuit, Place, Value};
use crate::input::COORDINATES;
use crate::jobs::record_writer::RecordWriter;
use crate::path::record::Record;
use crate::sim::{Observer, RunError, Sample, Simulator, Watcher};

/// Number of records that wait before the path begins, if the path has that many: the memory is
/// full then.
const HEAD_START: usize = 16;

#[must_use]
pub fn arc_generator(settings: &Settings) -> ArcGenerator {
    ArcGenerator::new(settings.rounding, settings.blend)
}

/// Commands of one sampling time.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Command {
    /// First tick of the commands.
    pub tick: u64,
    /// Commands x, y and z in counts.
    pub counts: [i64; COORDINATES],
}

/// Result of a path.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Played {
    /// Number of ticks of the run.
    pub ticks: u64,
    /// Command of every sample, with the start of the path first; empty if commands are passed to
    /// a caller.
    pub commands: Vec<Command>,
    /// Number of commands.
    pub samples: u64,
    pub last: Option<Command>,
    /// True if a sampling time began before its point was ready.
    pub late: bool,
    /// True if the path ended in motion.
    pub starved: bool,
    /// Greatest numbers of ticks from a sampling time to the next point.
    pub needed: Needed,
}

/// Greatest numbers of ticks from a sampling time to the tick in which the next point is ready; 0
/// if there was none.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Needed {
    /// To a point on the same line or blend.
    pub straight: u64,
    /// To a point on the same arc.
    pub arc: u64,
    /// To the first point of the next segment, which is fetched before.
    pub change: u64,
}

impl Needed {
    /// Returns the greatest of all.
    #[must_use]
    pub fn most(&self) -> u64 {
        self.straight.max(self.arc).max(self.change)
    }
}

/// Control computer: writes records as space allows, and records the commands.
pub(super) struct Bench<'a> {
    records: RecordWriter<'a>,
    /// Number of records that are written before the path begins.
    waiting: usize,
    sample_ticks: u64,
    started: bool,
    /// True if the inputs did not change in this tick.
    quiet: bool,
    /// True for each of start and record if it was given in this tick.
    given: [bool; 2],
    /// Sampling time whose next point is computed, and true if a segment is fetched for it.
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

    /// True if the next tick's inputs will be the same and nothing is recorded, provided that the
    /// observed signals do not change.
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

    /// Records a tick; returns its command.
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

/// Observed signals.
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

/// Plays a path on `circuit`, a sample every `sample_ticks` ticks; `observer` sees it too. An
/// empty path takes no tick.
///
/// # Errors
/// Returns the error of `observer`.
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

/// Plays as [`play`] does, but passes every command to `each` and keeps none. The joints of
/// `hand`, if given, are beside the circuit: those of each command from the tick after it on, with
/// which the run ends.
///
/// # Errors
/// Returns the errors of [`play`].
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
    /// Plays the records on a circuit.
    pub(super) fn play<C: Circuit<In<Value> = generator::In<Value>>>(
        mut self,
        circuit: &C,
        mut hand: Option<Hand>,
        observer: &mut dyn Observer<C>,
        each: &mut dyn FnMut(Command),
        look: impl FnOnce(&Watcher<'_, C>) -> See,
    ) -> Result<Played, RunError> {
        let needs = observer.needs();
        let (mut simulator, see) = match hand {
            None => Simulator::watching(circuit, needs, look)?,
            Some(_) => Simulator::watching_beside(circuit, &Joints, needs, look)?,
        };
        // Joints that no tick has shown yet.
        let mut joints = hand.as_ref().map(|hand| hand.joints);
        let mut stopped = self.over;
        while !stopped {
            let i = self.ports();
            if let Some(joints) = joints.take() {
                simulator.show::<Joints>(&JointSignals::of(joints))?;
            }
            simulator.watch_for(&observer);
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
