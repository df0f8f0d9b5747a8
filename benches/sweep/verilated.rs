//! The cases as a loop around the exported Verilog, compiled by Verilator, in turn with ours.

use super::{FIRST, SCANS_A_CASE, integrator, law, threads};
use motion_rtl::check::{Law, Swept, sweep};
use motion_rtl::circuits::linear_interpolator::{Integrator, LineSweep};
use motion_rtl::hdl::Circuit;
use motion_rtl::verilog::Verilog;
use std::fs;
use std::ops::Range;
use std::path::Path;
use std::process::Command;
use std::time::Instant;

/// Runs of each.
const ROUNDS: usize = 7;
/// Cases of a run.
const VERILATED: u64 = 1 << 16;
const CASE_BY_CASE: u64 = 1 << 15;
const SIDE_BY_SIDE: u64 = 1 << 20;

/// `verilated.mk` has `-Os` of its own behind what `-CFLAGS` says.
const LEVELS: [&str; 3] = ["OPT_FAST=-O3", "OPT_SLOW=-O3", "OPT_GLOBAL=-O3"];

/// Returns true if `verilator` is found and starts.
pub fn is_installed() -> bool {
    let version = Command::new("verilator").arg("--version").output();
    version.is_ok_and(|version| version.status.success())
}

fn run(directory: &Path, program: &str, arguments: &[&str]) -> String {
    let output = Command::new(program)
        .args(arguments)
        .current_dir(directory)
        .output()
        .unwrap_or_else(|error| panic!("{program}: {error}"));
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{program}: {said}");
    String::from_utf8_lossy(&output.stdout).into_owned()
}

fn build(directory: &Path) {
    let verilog = Verilog::new(&integrator()).expect("a circuit that can be printed");
    let mut files = vec!["sweep.cpp".to_owned()];
    for source in verilog.sources() {
        fs::write(directory.join(&source.name), source.text).expect("room");
        files.extend(source.name.ends_with(".v").then_some(source.name));
    }
    fs::write(directory.join("sweep.cpp"), include_str!("sweep.cpp")).expect("room");
    let options = [
        "--cc",
        "--exe",
        "-O3",
        "--x-assign",
        "fast",
        "--x-initial",
        "fast",
    ];
    let top = [
        "--prefix",
        "Vtop",
        "--noassert",
        "-Wno-fatal",
        "-CFLAGS",
        "-O3",
    ];
    let name = ["--top-module", Integrator::NAME];
    let files: Vec<&str> = files.iter().map(String::as_str).collect();
    run(
        directory,
        "verilator",
        &[&options[..], &top, &name, &files].concat(),
    );
    let make = ["-C", "obj_dir", "-f", "Vtop.mk"];
    run(directory, "make", &[&make[..], &LEVELS].concat());
}

fn median(mut rates: Vec<f64>) -> f64 {
    rates.sort_by(f64::total_cmp);
    rates[rates.len() / 2]
}

/// Scans a second of our side on so many threads.
fn ours(
    count: usize,
    cases: u64,
    run: impl Fn(&LineSweep, Range<u64>) -> Swept<LineSweep> + Sync,
) -> f64 {
    let (law, pool) = (law(), threads(count));
    let begun = Instant::now();
    let swept = pool.install(|| run(&law, FIRST..FIRST + cases));
    let taken = begun.elapsed();
    assert!(swept.held().is_some(), "{swept:?}");
    (cases * SCANS_A_CASE) as f64 / taken.as_secs_f64()
}

fn side_by_side(count: usize) -> f64 {
    ours(count, SIDE_BY_SIDE, |law, cases| {
        sweep(law).range(cases).run().expect("narrow")
    })
}

fn case_by_case(count: usize) -> f64 {
    ours(count, CASE_BY_CASE, |law, cases| {
        sweep(law).range(cases).run_simulated().expect("narrow")
    })
}

/// Runs all of it in turn, and prints medians and ratios.
pub fn beside() {
    let directory = tempfile::tempdir().expect("room");
    let path = directory.path();
    build(path);
    let verilated = || {
        let (first, cases) = (FIRST.to_string(), VERILATED.to_string());
        let said = run(path, "./obj_dir/Vtop", &[&first, &cases]);
        let seconds: f64 = said.trim().parse().expect("a time");
        (VERILATED * SCANS_A_CASE) as f64 / seconds
    };
    let ways: [(&str, &dyn Fn() -> f64); 5] = [
        ("Verilated", &verilated),
        ("case by case", &|| case_by_case(1)),
        ("case by case, 2 threads", &|| case_by_case(2)),
        ("side by side", &|| side_by_side(1)),
        ("side by side, 2 threads", &|| side_by_side(2)),
    ];
    let mut rates = vec![Vec::new(); ways.len()];
    for _ in 0..ROUNDS {
        for (way, rates) in ways.iter().zip(&mut rates) {
            rates.push(way.1());
        }
    }
    let ticks = law().ticks() as f64 / SCANS_A_CASE as f64;
    let medians: Vec<_> = rates.into_iter().map(median).collect();
    println!(
        "{:<24} {:>9} {:>9} {:>12}",
        "", "scans/s", "ticks/s", "of Verilated"
    );
    for ((way, _), rate) in ways.iter().zip(&medians) {
        let (of, ticks) = (rate / medians[0], rate * ticks);
        println!("{way:<24} {rate:>9.2e} {ticks:>9.2e} {of:>12.1}");
    }
}
