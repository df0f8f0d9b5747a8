//! The jobs of all circuits: the ports out of every tick, stepped one by one, run, and gone over.

use super::registers;
use motion_rtl::hdl::Circuit;
use motion_rtl::scenario::shipped::{self, Clock, Recorded, ShippedError};
use motion_rtl::sim::{Observer, ReplayTick, RunError, Sample, Simulator};
use std::ops::ControlFlow;

/// Returns one word in which every output has a part.
fn word<C: Circuit>(outputs: &[usize], now: &Sample<'_, C>) -> u64 {
    let engine = now.engine();
    outputs.iter().fold(0u64, |word, &leaf| {
        word.rotate_left(7) ^ engine.leaf(leaf).expect("it is a leaf")
    })
}

/// A word of the ports out for every tick; where a tick is not seen they are held.
struct Words<'o> {
    outputs: &'o [usize],
    words: Vec<u64>,
}

impl<'o> Words<'o> {
    fn new(outputs: &'o [usize]) -> Self {
        Words {
            outputs,
            words: Vec::new(),
        }
    }

    fn hold(&mut self, ticks: u64) {
        let last = self.words.last().copied().unwrap_or_default();
        self.words.resize(ticks as usize, last);
    }
}

impl<C: Circuit> Observer<C> for Words<'_> {
    fn sample(&mut self, now: &Sample<'_, C>) -> Result<ControlFlow<()>, RunError> {
        self.hold(now.tick);
        self.words.push(word(self.outputs, now));
        Ok(ControlFlow::Continue(()))
    }
}

/// Words of the ports out, from the ticks of a replay.
struct Rows<'s, 'o> {
    seen: &'s mut Words<'o>,
    words: Vec<u64>,
}

impl<'s, 'o> Rows<'s, 'o> {
    fn of(seen: &'s mut Words<'o>) -> Self {
        Rows {
            words: vec![0; seen.outputs.len()],
            seen,
        }
    }

    fn take(&mut self, now: &ReplayTick<'_>) {
        self.seen.hold(now.tick);
        for (index, word) in now.changes() {
            self.words[index] = word;
        }
        let words = self.words.iter();
        let word = words.fold(0u64, |word, new| word.rotate_left(7) ^ new);
        self.seen.words.push(word);
    }
}

/// Runs a job tick by tick on the interpreter, where all nets are watched, and in all other ways.
fn same<C: Circuit>(job: Result<Recorded<C>, ShippedError>) {
    let Recorded { circuit, inputs } = job.expect("it ships");
    let ticks = inputs.ticks;
    let watching =
        |all| Simulator::watching(&circuit, all, |watch| watch.ports_out()).expect("a netlist");
    let ((whole, outputs), (ports, _)) = (watching(true), watching(false));
    let interpreted = |simulator: &Simulator<C>| {
        let mut simulator = simulator.clone();
        simulator.interpret();
        simulator
    };

    let mut replay = inputs.playback();
    let mut step = interpreted(&whole);
    let mut words = Vec::new();
    for _ in 0..ticks {
        replay.tick(&mut step).unwrap();
        words.push(step.now(|now| word(&outputs, now)));
        step.step();
    }
    let due = registers(&step);

    let ways = [
        ("run", whole.clone(), Way::Run),
        ("only ports out watched", ports.clone(), Way::Run),
        ("changes", ports.clone(), Way::Changes),
        ("changes, interpreted", interpreted(&ports), Way::Changes),
        ("gone over", ports.clone(), Way::Forward),
        ("gone over, all watched", whole.clone(), Way::Forward),
        ("gone over, interpreted", interpreted(&ports), Way::Forward),
        ("replayed", ports.clone(), Way::Replay),
        ("replayed, all watched", whole.clone(), Way::Replay),
        ("replayed, interpreted", interpreted(&ports), Way::Replay),
        ("replayed, gone over", ports.clone(), Way::FastReplay),
        (
            "replayed, gone over, interpreted",
            interpreted(&ports),
            Way::FastReplay,
        ),
    ];
    for (how, mut simulator, way) in ways {
        let mut seen = Words::new(&outputs);
        let mut replay = inputs.playback();
        let run = match way {
            Way::Run => simulator.run_changes(ticks, |at| replay.tick(at), &mut seen),
            Way::Changes => simulator.run_changes(ticks, |at| replay.held(at), &mut seen),
            Way::Forward => simulator.fast_forward(ticks, |at| replay.held(at), &mut seen),
            Way::Replay => {
                let mut rows = Rows::of(&mut seen);
                simulator.replay(ticks, &inputs.changes, &outputs, |now| rows.take(&now))
            }
            Way::FastReplay => {
                let mut rows = Rows::of(&mut seen);
                simulator.fast_replay(ticks, &inputs.changes, &outputs, |now| rows.take(&now))
            }
        };
        run.expect("no objection");
        seen.hold(ticks);
        let differs = words.iter().zip(&seen.words).position(|(a, b)| a != b);
        assert_eq!(differs, None, "{how}: the first tick that differs");
        assert_eq!(words.len(), seen.words.len(), "{how}");
        assert_eq!(simulator.tick(), ticks, "{how}");
        assert!(due == registers(&simulator), "{how}");
    }
}

#[derive(Debug, Clone, Copy)]
enum Way {
    Run,
    Changes,
    Forward,
    Replay,
    FastReplay,
}

/// At the clock of the scenario and at a fast one, in which most ticks are idle.
fn both<C: Circuit>(job: impl Fn(u64, Clock) -> Result<Recorded<C>, ShippedError>) {
    same(job(100_000, Clock::Shipped));
    same(job(400_000, Clock::Fast));
}

#[test]
fn a_group_of_two_axes() {
    both(shipped::bracket);
}

#[test]
fn a_group_of_eight_axes() {
    same(shipped::eight_axes(100_000));
}

#[test]
fn the_linear_interpolator() {
    both(shipped::plotting);
}

#[test]
fn the_lead_angle_compensator() {
    both(shipped::turntable);
}

#[test]
fn the_arc_generator() {
    both(shipped::weld);
}

#[test]
#[ignore = "takes long"]
fn the_trajectory_controller() {
    both(shipped::pocket);
}

#[test]
#[ignore = "takes long"]
fn the_machine() {
    both(shipped::machine);
}
