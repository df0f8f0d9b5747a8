//! Time and memory of runs by their size: axes of the pulse interpolator, ticks, and machines on
//! threads.
//!
//! Each run is a process of its own, whose peak memory Linux tells. The pulse interpolator plays a
//! pattern on every axis, tick by tick. The machines of all five circuits replay the inputs of the
//! shipped job; their memory includes the recording of these inputs. `--quick` makes runs of few
//! ticks.

use motion_rtl::circuits::pulse_interpolator::{Group, Pattern, Variant, Widths};
use motion_rtl::scenario::shipped::{self, Clock};
use motion_rtl::sim::Simulator;
use rayon::prelude::*;
use std::process::Command;
use std::time::{Duration, Instant};

/// Run: its parts, and the ticks of each.
#[derive(Debug, Clone, Copy)]
enum Run {
    Axes(usize, u64),
    Machines(usize, u64),
}

use Run::{Axes, Machines};

/// Runs; the first of a group is what the others are compared with.
const GROUPS: [&[Run]; 3] = [
    &[
        Axes(1, 10_000_000),
        Axes(2, 10_000_000),
        Axes(4, 10_000_000),
        Axes(8, 10_000_000),
    ],
    &[
        Axes(2, 1_000_000),
        Axes(2, 10_000_000),
        Axes(2, 100_000_000),
    ],
    &[
        Machines(1, 200_000),
        Machines(10, 200_000),
        Machines(100, 200_000),
    ],
];

impl Run {
    /// Returns the number of ticks of all parts.
    fn work(self) -> u64 {
        let (Axes(count, ticks) | Machines(count, ticks)) = self;
        count as u64 * ticks
    }

    fn name(self) -> String {
        let (count, ticks, one, many) = match self {
            Axes(count, ticks) => (count, ticks, "axis", "axes"),
            Machines(count, ticks) => (count, ticks, "machine", "machines"),
        };
        let name = if count == 1 { one } else { many };
        format!("{count} {name}, {ticks} ticks")
    }

    /// Makes the run, in this process.
    fn run(self) -> Duration {
        match self {
            Axes(count, ticks) => interpolator(count, ticks),
            Machines(count, ticks) => machines(count, ticks),
        }
    }
}

/// Runs an interpolator whose axes all play pulses.
fn interpolator(axes: usize, ticks: u64) -> Duration {
    let pattern = Pattern {
        base: 0,
        last: 0,
        cyclic: true,
        period: 1000,
    };
    let mut group = Group::free_running(axes, Widths::default(), Variant::Safe, pattern);
    for (axis, memory) in group.memories.iter_mut().enumerate() {
        memory.half_periods.set(0, 50 + 10 * axis as u64);
    }
    let begun = Instant::now();
    let watched = Simulator::watching(&group, false, |watch| watch.ports_out());
    let (mut simulator, outputs) = watched.expect("a netlist");
    let run = simulator.replay(ticks, &[], &outputs, |_| ());
    run.expect("no observer objects");
    begun.elapsed()
}

/// Runs machines on as many threads as the computer has.
fn machines(count: usize, ticks: u64) -> Duration {
    let job = shipped::machine(ticks, Clock::Shipped).expect("it ships");
    let begun = Instant::now();
    let watched = Simulator::watching(&job.circuit, false, |watch| watch.ports_out());
    let (simulator, outputs) = watched.expect("a netlist");
    let simulators = vec![simulator; count];
    simulators.into_par_iter().for_each(|mut simulator| {
        let run = simulator.replay(ticks, &job.inputs.changes, &outputs, |_| ());
        run.expect("no observer objects");
    });
    begun.elapsed()
}

/// Returns the peak memory of this process in bytes.
fn peak() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status
        .lines()
        .find_map(|line| line.strip_prefix("VmHWM:"))?;
    let kibibytes: u64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some(kibibytes * 1024)
}

/// Makes a run in a process of its own, by its place in a group; returns its seconds, and its peak
/// memory in bytes.
fn measure(group: usize, place: usize, part: u64) -> (f64, Option<u64>) {
    let program = std::env::current_exe().expect("a path");
    let numbers = [group.to_string(), place.to_string(), part.to_string()];
    let output = Command::new(program).arg("--run").args(numbers).output();
    let output = output.expect("it starts");
    assert!(output.status.success(), "{output:?}");
    let text = String::from_utf8(output.stdout).expect("text");
    let mut words = text.split_whitespace();
    let seconds = words.next().and_then(|word| word.parse().ok());
    let peak = words.next().and_then(|word| word.parse().ok());
    (seconds.expect("a time"), peak)
}

/// Returns a run of a group, with ticks divided by `part`.
fn run(group: usize, place: usize, part: u64) -> Run {
    match GROUPS[group][place] {
        Axes(count, ticks) => Axes(count, ticks / part),
        Machines(count, ticks) => Machines(count, ticks / part),
    }
}

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    if let [word, group, place, part] = &arguments[..]
        && word == "--run"
    {
        let [group, place] = [group, place].map(|number| number.parse().expect("a number"));
        let run = run(group, place, part.parse().expect("a number"));
        let seconds = run.run().as_secs_f64();
        let peak = peak().map_or(String::new(), |peak| peak.to_string());
        println!("{seconds} {peak}");
        return;
    }
    let quick = arguments.iter().any(|argument| argument == "--quick");
    let part = if quick { 1000 } else { 1 };
    println!(
        "{:<36} {:>9} {:>9} {:>14} {:>9}",
        "", "seconds", "ns a tick", "against first", "peak MiB"
    );
    for (group, runs) in GROUPS.iter().enumerate() {
        let mut first = None;
        for place in 0..runs.len() {
            let run = run(group, place, part);
            let (seconds, peak) = measure(group, place, part);
            let each = seconds * 1e9 / run.work() as f64;
            let ratio = each / *first.get_or_insert(each);
            let peak = peak.map(|peak| format!("{:.1}", peak as f64 / f64::from(1 << 20)));
            let peak = peak.as_deref().unwrap_or("-");
            let name = run.name();
            println!("{name:<36} {seconds:>9.3} {each:>9.2} {ratio:>14.2} {peak:>9}");
        }
    }
}
