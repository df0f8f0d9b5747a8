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

/// Size of a run.
#[derive(Debug, Clone, Copy)]
struct Size {
    axes: usize,
    machines: usize,
    ticks: u64,
}

impl Size {
    fn of([axes, machines, ticks]: [u64; 3]) -> Self {
        Size {
            axes: axes as usize,
            machines: machines as usize,
            ticks,
        }
    }

    /// Ticks of all axes, or of all machines.
    fn work(self) -> u64 {
        self.ticks * (self.axes + self.machines) as u64
    }

    fn name(self) -> String {
        let Size {
            axes,
            machines,
            ticks,
        } = self;
        let plural = |count: usize, one: &str, many: &str| match count {
            1 => format!("1 {one}"),
            _ => format!("{count} {many}"),
        };
        let what = match axes {
            0 => plural(machines, "machine", "machines"),
            _ => plural(axes, "axis", "axes"),
        };
        format!("{what}, {ticks} ticks")
    }
}

/// Axes, machines and ticks of the runs; the first run of a group is what the others are compared
/// with.
const GROUPS: [&[[u64; 3]]; 3] = [
    &[
        [1, 0, 10_000_000],
        [2, 0, 10_000_000],
        [4, 0, 10_000_000],
        [8, 0, 10_000_000],
    ],
    &[[2, 0, 1_000_000], [2, 0, 10_000_000], [2, 0, 100_000_000]],
    &[[0, 1, 200_000], [0, 10, 200_000], [0, 100, 200_000]],
];

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

/// Makes a run in a process of its own; returns its seconds, and its peak memory in bytes.
fn measure(size: Size) -> (f64, Option<u64>) {
    let program = std::env::current_exe().expect("a path");
    let numbers = [size.axes as u64, size.machines as u64, size.ticks];
    let output = Command::new(program)
        .arg("--run")
        .args(numbers.map(|number| number.to_string()))
        .output()
        .expect("it starts");
    assert!(output.status.success(), "{size:?}: {output:?}");
    let text = String::from_utf8(output.stdout).expect("text");
    let mut words = text.split_whitespace();
    let seconds = words.next().and_then(|word| word.parse().ok());
    let peak = words.next().and_then(|word| word.parse().ok());
    (seconds.expect("a time"), peak)
}

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    if let Some(("--run", numbers)) = arguments
        .split_first()
        .map(|(word, rest)| (&word[..], rest))
    {
        let numbers: Vec<u64> = numbers
            .iter()
            .map(|word| word.parse().expect("a number"))
            .collect();
        let size = Size::of(numbers.try_into().expect("three numbers"));
        let taken = match size.axes {
            0 => machines(size.machines, size.ticks),
            axes => interpolator(axes, size.ticks),
        };
        let peak = peak().map_or(String::new(), |peak| peak.to_string());
        println!("{} {peak}", taken.as_secs_f64());
        return;
    }
    let quick = arguments.iter().any(|argument| argument == "--quick");
    println!(
        "{:<36} {:>9} {:>9} {:>14} {:>9}",
        "", "seconds", "ns a tick", "against first", "peak MiB"
    );
    for group in GROUPS {
        let mut first = None;
        for &numbers in group {
            let mut size = Size::of(numbers);
            if quick {
                size.ticks /= 1000;
            }
            let (seconds, peak) = measure(size);
            let each = seconds * 1e9 / size.work() as f64;
            let first = *first.get_or_insert(each);
            let peak = peak.map_or("-".to_owned(), |peak| {
                format!("{:.1}", peak as f64 / f64::from(1 << 20))
            });
            println!(
                "{:<36} {seconds:>9.3} {each:>9.2} {:>14.2} {peak:>9}",
                size.name(),
                each / first
            );
        }
    }
}
