//! The model beside its own Verilog, compiled by Verilator: nanoseconds a tick, on the same inputs,
//! with outputs that are compared.
//!
//! Each job runs at the clock of its scenario, which is slow enough for a dump of all of it, and at
//! 10 MHz, where fewer things happen in a tick. Where idle ticks are gone over, the outputs
//! of every tick are read as well: those of idle ticks are held.
//!
//! Both get the inputs of a job that ships with the crate, as they were recorded. They run in turn,
//! and the medians are shown: of both, and of the ratios of runs one after the other, since a shared
//! machine is now fast and now slow; last stands the ratio of the fastest run of each. Settings are
//! inputs on both sides, so neither folds them. Waves are those of every signal and of `clk`; words
//! of memories with more than 256 are in ours only.
//!
//! It needs Verilator, a C++ compiler and make. `--alone` measures the model alone. `--quick` checks that
//! everything works: one run of few ticks each, Verilated code unoptimised. A word selects the circuits
//! whose names contain it.

mod ours;
mod theirs;

use motion_rtl::hdl::Circuit;
use motion_rtl::scenario::shipped::{self, Clock, Recorded, ShippedError};
use motion_rtl::sim::{RecordedInputs, Simulator};
use ours::{Ours, Waves, Way};
use std::time::{Duration, Instant};
use theirs::{Build, Builds, Verilated};

/// Outputs that are read now and then are read in every so many ticks.
const SELDOM: u64 = 1024;

/// Ticks of a run at most, the beginning of its job, and the last ticks of it, which have waves.
const UNTRACED: u64 = 1_000_000;
const TRACED: u64 = 100_000;

/// Runs of each, in turn. Odd, and many: what else runs on a shared machine changes within seconds.
const ROUNDS: usize = 15;

/// Options of the command line.
struct Asked {
    /// Few ticks, to see that all of it works.
    quick: bool,
    /// No Verilator: the model alone.
    alone: bool,
    /// The circuits whose names contain this.
    only: Option<String>,
    /// Circuits compiled by Verilator.
    builds: Builds,
}

impl Asked {
    fn rounds(&self) -> usize {
        if self.quick { 1 } else { ROUNDS }
    }

    fn ticks(&self, all: u64) -> u64 {
        if self.quick { all / 50 } else { all }
    }
}

/// Nanoseconds a tick of both.
#[derive(Default)]
struct Times {
    theirs: Vec<f64>,
    ours: Vec<f64>,
}

/// Median of an odd number of times.
fn median(times: &[f64]) -> f64 {
    let mut times = times.to_vec();
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}

fn fastest(times: &[f64]) -> f64 {
    times.iter().copied().fold(f64::INFINITY, f64::min)
}

impl Times {
    /// Runs both in turn.
    fn measure(
        asked: &Asked,
        ticks: u64,
        mut theirs: impl FnMut() -> (Duration, u64),
        mut ours: impl FnMut() -> (Duration, u64),
    ) -> Self {
        let mut times = Times::default();
        let each = |taken: Duration| taken.as_secs_f64() * 1e9 / ticks as f64;
        for _ in 0..asked.rounds() {
            let ((taken, sum), (their_time, their_sum)) = (ours(), theirs());
            assert_eq!(their_sum, sum, "the outputs differ");
            times.ours.push(each(taken));
            times.theirs.push(each(their_time));
        }
        times
    }

    fn print(&self, circuit: &str, what: &str) {
        let pairs = self.theirs.iter().zip(&self.ours);
        let ratios: Vec<_> = pairs.map(|(theirs, ours)| theirs / ours).collect();
        let (theirs, ours, ratio) = (median(&self.theirs), median(&self.ours), median(&ratios));
        let fastest = fastest(&self.theirs) / fastest(&self.ours);
        println!("{circuit:<36} {what:<28} {theirs:>9.1} {ours:>9.1} {ratio:>6.1} {fastest:>7.1}");
    }
}

/// Measures a circuit at both clocks.
fn circuit<C: Circuit>(
    asked: &Asked,
    name: &str,
    job: impl Fn(u64, Clock) -> Result<Recorded<C>, ShippedError>,
) {
    measure(asked, name, |ticks| job(ticks, Clock::Shipped));
    let fast = format!("{name}, 10 MHz");
    measure(asked, &fast, |ticks| job(ticks, Clock::Fast));
}

/// Measures a job: untraced over all of the stimulus, with waves over its end.
fn measure<C: Circuit>(
    asked: &Asked,
    name: &str,
    job: impl FnOnce(u64) -> Result<Recorded<C>, ShippedError>,
) {
    if asked.only.as_ref().is_some_and(|only| !name.contains(only)) {
        return;
    }
    let Recorded { circuit, inputs } = job(asked.ticks(UNTRACED)).expect("it ships");
    let (circuit, stimulus) = (&circuit, &inputs);
    if asked.alone {
        alone(asked, name, circuit, stimulus);
        return;
    }
    let builds = &asked.builds;
    let traced = asked.ticks(TRACED).min(stimulus.ticks);
    let from = stimulus.ticks - traced;
    let build = |what| Verilated::new(builds, circuit, stimulus, from, what);
    {
        let mut theirs = build(Build::Untraced);
        let ticks = stimulus.ticks;
        let compiled = Ours::new(circuit, stimulus, Way::Compiled);
        let interpreted = Ours::new(circuit, stimulus, Way::Interpreted);
        let forward = Ours::new(circuit, stimulus, Way::Forward);
        let run = || compiled.run(stimulus, 1);
        let every = Times::measure(asked, ticks, || theirs.run(1), run);
        every.print(name, "every output, compiled");
        let run = || interpreted.run(stimulus, 1);
        let every = Times::measure(asked, ticks, || theirs.run(1), run);
        every.print(name, "every output, interpreted");
        let run = || compiled.run(stimulus, SELDOM);
        let seldom = Times::measure(asked, ticks, || theirs.run(SELDOM), run);
        seldom.print(name, "outputs now and then");
        let run = || forward.run(stimulus, 1);
        let held = Times::measure(asked, ticks, || theirs.run(1), run);
        held.print(name, "idle ticks gone over");
    }
    let (a, b) = (&builds.path("a"), &builds.path("b"));
    let mut theirs = build(Build::Vcd);
    for (waves, what) in [
        (Waves::Vcd, "VCD, one thread"),
        (Waves::VcdBehind, "VCD, two threads"),
    ] {
        let run = || ours::dump(circuit, stimulus, from, waves, a);
        let dump = || theirs.dump(b);
        Times::measure(asked, traced, dump, run).print(name, what);
    }
    let mut theirs = build(Build::Fst);
    let run = || ours::dump(circuit, stimulus, from, Waves::Fst, a);
    let dump = || theirs.dump(b);
    Times::measure(asked, traced, dump, run).print(name, "FST");
}

/// The model without Verilator: how long it takes to elaborate, plan and compile it, and medians of
/// all ways to run it.
fn alone<C: Circuit>(asked: &Asked, name: &str, circuit: &C, stimulus: &RecordedInputs) {
    let begun = Instant::now();
    let (mut simulator, _) =
        Simulator::watching(circuit, false, |watch| watch.ports_out()).expect("a netlist");
    simulator.compile();
    let ready = begun.elapsed().as_secs_f64() * 1e3;
    let times = [Way::Compiled, Way::Interpreted, Way::Forward].map(|way| {
        let ours = Ours::new(circuit, stimulus, way);
        let each = |taken: Duration| taken.as_secs_f64() * 1e9 / stimulus.ticks as f64;
        let rounds = 0..asked.rounds();
        let times: Vec<_> = rounds.map(|_| each(ours.run(stimulus, 1).0)).collect();
        median(&times)
    });
    let [compiled, interpreted, over] = times;
    println!("{name:<36} {ready:>9.1} {compiled:>11.2} {interpreted:>11.1} {over:>11.2}");
}

fn main() {
    let (mut quick, mut alone, mut only) = (false, false, None);
    for argument in std::env::args().skip(1) {
        match argument.as_str() {
            "--quick" => quick = true,
            "--alone" => alone = true,
            "--bench" => {}
            _ => only = Some(argument),
        }
    }
    let asked = Asked {
        quick,
        alone,
        only,
        builds: Builds::new(quick),
    };
    let asked = &asked;
    if asked.alone {
        let columns = ["ready ms", "compiled", "interpreted", "gone over"];
        let [a, b, c, d] = columns;
        println!(
            "{:<36} {a:>9} {b:>11} {c:>11} {d:>11}",
            "nanoseconds a tick"
        );
    } else if !theirs::is_installed() {
        eprintln!("error: no verilator on PATH; this bench needs it, a C++ compiler and make");
        std::process::exit(1);
    }
    if !asked.alone {
        println!(
            "{:<36} {:<28} {:>9} {:>9} {:>6} {:>7}",
            "nanoseconds a tick", "", "Verilator", "ours", "ratio", "fastest"
        );
    }
    circuit(asked, "pulse interpolator, 2 axes", shipped::bracket);
    measure(asked, "pulse interpolator, 8 axes", shipped::eight_axes);
    circuit(asked, "linear interpolator", shipped::plotting);
    circuit(asked, "lead-angle compensator", shipped::turntable);
    circuit(asked, "arc generator", shipped::weld);
    circuit(asked, "trajectory controller", shipped::pocket);
    circuit(asked, "machine of all five", shipped::machine);
}
