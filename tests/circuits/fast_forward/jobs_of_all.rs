//! The jobs of all circuits: the ports out of every tick, stepped one by one, run, and gone over.

use super::jobs::{self, Clock, Job};
use super::ours::{Outputs, word};
use super::stimulus::Replay;
use motion_rtl::kernel::{Observer, RunError, Sample, Simulator, pack};
use std::ops::ControlFlow;

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

impl<C: Outputs> Observer<C> for Words<'_> {
    fn sample(&mut self, now: &Sample<'_, C>) -> Result<ControlFlow<()>, RunError> {
        self.hold(now.tick);
        self.words.push(word(self.outputs, now));
        Ok(ControlFlow::Continue(()))
    }
}

/// Runs a job tick by tick on the interpreter, where all nets are watched, and in all other ways.
fn same<C: Outputs>(job: Job<C>) {
    let Job { circuit, stimulus } = job;
    let ticks = stimulus.ticks;
    let whole = Simulator::watching(&circuit, true, C::outputs);
    let (whole, outputs) = whole.expect("a netlist");
    let ports = Simulator::watching(&circuit, false, C::outputs);
    let (ports, _) = ports.expect("a netlist");

    let mut replay = Replay::<C>::new(&stimulus);
    let mut step = whole.clone().interpreted();
    let mut words = Vec::new();
    for tick in 0..ticks {
        let (next, word) = step.step(replay.tick(tick), |now| word(&outputs, now));
        step = next;
        words.push(word);
    }
    let registers = pack(&*step.registers());

    let ways = [
        ("run", &whole, Way::Run),
        ("only ports out watched", &ports, Way::Run),
        ("changes", &ports, Way::Changes),
        (
            "changes, interpreted",
            &ports.clone().interpreted(),
            Way::Changes,
        ),
        ("gone over", &ports, Way::Forward),
        ("gone over, all watched", &whole, Way::Forward),
        (
            "gone over, interpreted",
            &ports.clone().interpreted(),
            Way::Forward,
        ),
    ];
    for (how, simulator, way) in ways {
        let simulator = simulator.clone();
        let mut seen = Words::new(&outputs);
        let mut replay = Replay::<C>::new(&stimulus);
        let run = match way {
            Way::Run => simulator.run(ticks, |tick, _| replay.tick(tick), &mut seen),
            Way::Changes => simulator.run_changes(ticks, |tick, _| replay.held(tick), &mut seen),
            Way::Forward => simulator.fast_forward(ticks, |tick, _| replay.held(tick), &mut seen),
        };
        let run = run.expect("no objection");
        seen.hold(ticks);
        let differs = words.iter().zip(&seen.words).position(|(a, b)| a != b);
        assert_eq!(differs, None, "{how}: the first tick that differs");
        assert_eq!(words.len(), seen.words.len(), "{how}");
        assert_eq!(run.tick(), ticks, "{how}");
        assert!(registers == pack(&*run.registers()), "{how}");
    }
}

#[derive(Debug, Clone, Copy)]
enum Way {
    Run,
    Changes,
    Forward,
}

/// At the clock of the scenario and at a fast one, in which most ticks are idle.
fn both<C: Outputs>(job: impl Fn(u64, Clock) -> Job<C>) {
    same(job(100_000, Clock::Shipped));
    same(job(400_000, Clock::Fast));
}

#[test]
fn a_group_of_two_axes() {
    both(jobs::bracket);
}

#[test]
fn a_group_of_eight_axes() {
    same(jobs::eight_axes(100_000));
}

#[test]
fn the_linear_interpolator() {
    both(jobs::plotting);
}

#[test]
fn the_lead_angle_compensator() {
    both(jobs::turntable);
}

#[test]
fn the_arc_generator() {
    both(jobs::weld);
}

#[test]
fn the_trajectory_controller() {
    both(jobs::pocket);
}

#[test]
fn the_machine() {
    both(jobs::machine);
}
