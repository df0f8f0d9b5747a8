//! The jobs of all circuits: the ports out of every tick, stepped one by one, run, and gone over.

use super::jobs::{self, Clock, Job};
use super::ours::Outputs;
use super::stimulus::Replay;
use motion_rtl::kernel::{Observer, RunError, Sample, Simulator, pack};
use std::ops::ControlFlow;

/// A word of the ports out for every tick; where a tick is not seen they are held.
#[derive(Default)]
struct Words {
    words: Vec<u64>,
}

impl Words {
    fn hold(&mut self, ticks: u64) {
        let last = self.words.last().copied().unwrap_or_default();
        self.words.resize(ticks as usize, last);
    }
}

impl<C: Outputs> Observer<C> for Words {
    fn sample(&mut self, now: &Sample<'_, C>) -> Result<ControlFlow<()>, RunError> {
        self.hold(now.tick);
        self.words.push(C::outputs(now).word);
        Ok(ControlFlow::Continue(()))
    }
}

/// Runs a job in all three ways.
fn same<C: Outputs>(job: Job<C>) {
    let Job { circuit, stimulus } = job;
    let (mut ran, mut jumped) = (Words::default(), Words::default());
    let ticks = stimulus.ticks;
    let mut replay = Replay::<C>::new(&stimulus);
    let mut step = Simulator::new(&circuit).unwrap();
    let mut words = Vec::new();
    for tick in 0..ticks {
        let (next, word) = step.step(replay.tick(tick), |now| C::outputs(now).word);
        step = next;
        words.push(word);
    }
    let mut replay = Replay::<C>::new(&stimulus);
    let run = Simulator::new(&circuit).unwrap().run(ticks, |tick, _| replay.tick(tick), &mut ran);
    let mut replay = Replay::<C>::new(&stimulus);
    let held = |tick, _: &motion_rtl::kernel::Part<'_, _>| replay.held(tick);
    let forward = Simulator::new(&circuit).unwrap().fast_forward(ticks, held, &mut jumped);
    let (run, forward) = (run.expect("no objection"), forward.expect("no objection"));
    jumped.hold(ticks);
    for (how, other) in [("run", &ran.words), ("gone over", &jumped.words)] {
        let differs = words.iter().zip(other).position(|(a, b)| a != b);
        assert_eq!(differs, None, "{how}: the first tick that differs");
        assert_eq!(words.len(), other.len(), "{how}");
    }
    assert_eq!((run.tick(), forward.tick()), (ticks, ticks));
    let registers = pack(&*step.registers());
    assert!(registers == pack(&*run.registers()), "run");
    assert!(registers == pack(&*forward.registers()), "gone over");
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
