//! Runs that are stepped and watched: an observer is shown the ticks that it looks at, no others.

use super::zoo::{Zoo, inputs};
use super::{SEED, clock, options, run_zoo};
use motion_rtl::hdl::Declarations;
use motion_rtl::netlist::Role;
use motion_rtl::sim::{Observer, RunError, Sample, Simulator};
use motion_rtl::trace::Vcd;
use std::ops::ControlFlow;

const TICKS: u64 = 700;

/// Looks at every seventh tick, writes down all that it is shown, and stops in tick 350.
#[derive(Default)]
struct Seventh(Vec<u64>);

impl Observer<Zoo> for Seventh {
    fn next_look(&self, tick: u64) -> u64 {
        tick.next_multiple_of(7)
    }

    fn sample(&mut self, now: &Sample<'_, Zoo>) -> Result<ControlFlow<()>, RunError> {
        self.0.push(now.tick);
        Ok(match now.tick {
            350 => ControlFlow::Break(()),
            _ => ControlFlow::Continue(()),
        })
    }
}

/// The words of all registers.
fn registers(simulator: &Simulator<Zoo>) -> Vec<u64> {
    let leaves = Declarations::of(&Zoo).leaves.into_iter().enumerate();
    let registers = leaves.filter(|(_, leaf)| leaf.role == Role::Register);
    let words = registers.map(|(leaf, _)| simulator.engine().leaf(leaf).unwrap());
    words.collect()
}

/// Steps to the end, or until the observer stops; the registers, and the ticks that were stepped.
fn step(mut observer: impl Observer<Zoo>) -> (Vec<u64>, Vec<u64>) {
    let mut inputs = inputs(SEED);
    let mut simulator = Simulator::new(&Zoo).unwrap();
    let mut stepped = Vec::new();
    for _ in 0..TICKS {
        let i = inputs.next().unwrap();
        let (tick, flow) = simulator
            .step_watched(&i, &mut observer, |now| now.tick)
            .unwrap();
        stepped.push(tick);
        if flow.is_break() {
            break;
        }
    }
    (registers(&simulator), stepped)
}

fn sevenths(and: &[u64]) -> Vec<u64> {
    let mut ticks = Vec::from_iter((0..=350).step_by(7));
    ticks.extend(and);
    ticks.sort_unstable();
    ticks
}

#[test]
fn a_window_is_that_of_a_run() {
    let options = options(100..151, &[]);
    let mut vcd = Vcd::new(Vec::new(), &Zoo, clock(), &options).unwrap();
    let (stepped_to, stepped) = step(&mut vcd);
    assert_eq!(stepped, Vec::from_iter(0..TICKS));
    assert!(vcd.finish().unwrap() == run_zoo(TICKS, &options).0);
    // Watched or not, the edges are the same.
    assert_eq!(stepped_to, step(()).0);
    let mut inputs = inputs(SEED);
    let mut ran = Simulator::new(&Zoo).unwrap();
    ran.run(TICKS, |_, _| inputs.next().unwrap(), ()).unwrap();
    assert_eq!(stepped_to, registers(&ran));
}

#[test]
fn it_is_shown_what_it_looks_at_and_ends_the_run() {
    let mut seventh = Seventh::default();
    let (_, stepped) = step((None::<Seventh>, (), Some(&mut seventh)));
    assert_eq!(seventh.0, sevenths(&[]));
    assert_eq!(stepped, Vec::from_iter(0..=350));
}

#[test]
fn what_one_of_them_looks_at_is_shown_to_all() {
    let options = options(10..13, &[]);
    let mut vcd = Vcd::new(Vec::new(), &Zoo, clock(), &options).unwrap();
    let mut seventh = Seventh::default();
    step((&mut vcd, &mut seventh));
    assert_eq!(seventh.0, sevenths(&[10, 11, 12]));
}
