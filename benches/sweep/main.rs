//! Cases a second of exhaustive checks: the integrator of the linear interpolator at 8 bits, case by
//! case and side by side, on one thread and on two. Before that, where Verilator is installed, the same
//! cases as a loop around the Verilated circuit, in turn with ours.

mod verilated;

use divan::counter::ItemsCount;
use motion_rtl::check::{Swept, sweep};
use motion_rtl::circuits::linear_interpolator::{Integrator, LineSweep, Rule};
use rayon::{ThreadPool, ThreadPoolBuilder};
use std::ops::Range;

/// A part of the 2^32 cases, two scans each.
const FIRST: u64 = 0x1234_0000;
const SCANS_A_CASE: u64 = 2;

fn integrator() -> Integrator {
    Integrator {
        position: 8,
        rule: Rule::Floor,
    }
}

fn law() -> LineSweep {
    LineSweep::new(integrator())
}

fn threads(count: usize) -> ThreadPool {
    let pool = ThreadPoolBuilder::new().num_threads(count).build();
    pool.expect("threads")
}

/// Measures in scans a second; none may fail.
fn measure(
    bencher: divan::Bencher<'_, '_>,
    count: usize,
    cases: u64,
    run: impl Fn(&LineSweep, Range<u64>) -> Swept<LineSweep> + Sync,
) {
    let (law, pool) = (law(), threads(count));
    bencher
        .counter(ItemsCount::new(cases * SCANS_A_CASE))
        .bench_local(|| {
            let swept = pool.install(|| run(&law, FIRST..FIRST + cases));
            assert!(swept.held().is_some(), "{swept:?}");
        });
}

#[divan::bench(args = [1, 2], sample_count = 10)]
fn case_by_case(bencher: divan::Bencher<'_, '_>, threads: usize) {
    measure(bencher, threads, 1 << 15, |law, cases| {
        sweep(law).range(cases).run_simulated().expect("narrow")
    });
}

#[divan::bench(args = [1, 2], sample_count = 10)]
fn side_by_side(bencher: divan::Bencher<'_, '_>, threads: usize) {
    measure(bencher, threads, 1 << 20, |law, cases| {
        sweep(law).range(cases).run().expect("narrow")
    });
}

fn main() {
    // A test of the benches does not need a comparison that takes minutes.
    let asked = |wanted| std::env::args().any(|argument| argument == wanted);
    if asked("--bench") && !asked("--test") {
        match verilated::is_installed() {
            true => verilated::beside(),
            false => println!("no verilator on PATH: without the Verilated circuit"),
        }
    }
    divan::main();
}
