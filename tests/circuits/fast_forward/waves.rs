//! The waves of the jobs of all circuits: where a circuit coasts they are those of a look at
//! everything.

use super::jobs::{self, Clock, Job};
use super::stimulus::Replay;
use motion_rtl::blocks::enable_counter::{self, EnableCounter};
use motion_rtl::kernel::{Circuit, Observer, RunError, Sample, Simulator};
use motion_rtl::trace::{self, Options, Vcd};
use std::ops::ControlFlow;

/// Waves that look at everything, or let themselves be told where the circuit coasts; counts the
/// ticks in which they were.
struct Look<O> {
    waves: O,
    everything: bool,
    from: u64,
    coasting: u64,
}

impl<C: Circuit, O: Observer<C>> Observer<C> for Look<O> {
    fn follows(&self, tick: u64) -> bool {
        !self.everything && Observer::<C>::follows(&self.waves, tick)
    }

    fn sample(&mut self, now: &Sample<'_, C>) -> Result<ControlFlow<()>, RunError> {
        self.coasting += u64::from(now.coasting && now.tick >= self.from);
        self.waves.sample(now)
    }
}

/// Runs the end of a job with both; in how many ticks of a hundred it coasts.
fn same<C: Circuit>(job: Job<C>, from: u64) -> u64 {
    let Job { circuit, stimulus } = job;
    let clock = trace::Clock::from_hz(100_000_000).expect("a good rate");
    let options = Options {
        ticks: from..u64::MAX,
        only: None,
    };
    // Two runs of one observer: as a pair in one run they take five times as long to compile.
    let [(glances, coasting), (looks, none)] = [false, true].map(|everything| {
        let mut look = Look {
            waves: Vcd::new(Vec::new(), &circuit, clock, &options).expect("a good circuit"),
            everything,
            from,
            coasting: 0,
        };
        let mut replay = Replay::<C>::new(&stimulus);
        Simulator::new(&circuit)
            .run(stimulus.ticks, |tick, _| replay.tick(tick), &mut look)
            .expect("room");
        (look.waves.finish().expect("room"), look.coasting)
    });
    assert_eq!(none, 0, "ticks that came as coasting");
    let differs = glances.iter().zip(&looks).position(|(a, b)| a != b);
    assert_eq!(differs, None, "the first byte that differs");
    assert_eq!(glances.len(), looks.len());
    println!("{}: {coasting} ticks", C::NAME);
    100 * coasting / (stimulus.ticks - from)
}

fn both<C: Circuit>(job: impl Fn(u64, Clock) -> Job<C>) {
    let _ = same(job(20_000, Clock::Shipped), 0);
    let coasting = same(job(300_000, Clock::Fast), 250_000);
    assert!(coasting > 80, "in {coasting} of 100 ticks");
}

/// Sees every other tick, and does not say so.
struct Sometimes<O>(O);

impl<C: Circuit, O: Observer<C>> Observer<C> for Sometimes<O> {
    fn sample(&mut self, now: &Sample<'_, C>) -> Result<ControlFlow<()>, RunError> {
        match now.tick.is_multiple_of(2) {
            true => self.0.sample(now),
            false => Ok(ControlFlow::Continue(())),
        }
    }
}

#[test]
fn a_tick_that_was_not_seen_is_an_error() {
    let counter = EnableCounter::<8>;
    let vcd = || {
        Vcd::new(
            Vec::new(),
            &counter,
            trace::Clock::default(),
            &Options::default(),
        )
    };
    let (all, some) = (vcd().unwrap(), Sometimes(vcd().unwrap()));
    let period = 100.into();
    let run = Simulator::new(&counter).run(9, |_, _| enable_counter::In { period }, (all, some));
    let error = run.unwrap_err().to_string();
    let expected =
        "tick 2 comes as one in which the circuit coasts, but the one before was not seen";
    assert!(error.contains(expected), "{error}");
}

#[test]
fn of_a_group_of_two_axes() {
    both(jobs::bracket);
}

#[test]
fn of_a_group_of_eight_axes() {
    assert!(same(jobs::eight_axes(20_000), 0) > 50);
}

#[test]
fn of_the_linear_interpolator() {
    both(jobs::plotting);
}

#[test]
fn of_the_lead_angle_compensator() {
    both(jobs::turntable);
}

#[test]
fn of_the_arc_generator() {
    both(jobs::weld);
}

#[test]
fn of_the_trajectory_controller() {
    both(jobs::pocket);
}

#[test]
fn of_the_machine() {
    both(jobs::machine);
}
