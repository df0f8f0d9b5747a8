//! The same cases as a loop around the exported Verilog, compiled by Verilator, in turn with ours.

use super::{FIRST, SCANS_A_CASE, law, threads};
use motion_rtl::check::{Law, Swept, sweep};
use motion_rtl::kernel::Circuit;
use motion_rtl::linear_interpolator::Integrator;
use motion_rtl::verilog::Verilog;
use std::fs;
use std::path::Path;
use std::process::Command;
use std::time::Instant;

/// Runs of each.
const ROUNDS: usize = 7;
/// Cases of a run.
const VERILATED: u64 = 1 << 16;
const OURS: u64 = 1 << 18;

/// `verilated.mk` has `-Os` of its own behind what `-CFLAGS` says.
const LEVELS: [&str; 3] = ["OPT_FAST=-O3", "OPT_SLOW=-O3", "OPT_GLOBAL=-O3"];

/// Whether `verilator` is found and starts.
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
    let verilog = Verilog::of(law().circuit()).expect("a circuit that can be printed");
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
    let name = ["--top-module", Integrator::<8, 16>::NAME];
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
fn ours(count: usize, run: impl Fn(&super::Law) -> Swept<Integrator<8, 16>> + Sync) -> f64 {
    let (law, pool) = (law(), threads(count));
    let begun = Instant::now();
    let swept = pool.install(|| run(&law));
    let taken = begun.elapsed();
    assert!(swept.held().is_some(), "{swept:?}");
    (OURS * SCANS_A_CASE) as f64 / taken.as_secs_f64()
}

fn lanes<const K: usize>(count: usize) -> f64 {
    ours(count, |law| {
        let cases = FIRST..FIRST + OURS;
        sweep(law).range(cases).run::<K, u16>().expect("narrow")
    })
}

fn simulated(count: usize) -> f64 {
    ours(count, |law| {
        let cases = FIRST..FIRST + OURS;
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
    let ways: [(&str, &dyn Fn() -> f64); 9] = [
        ("Verilated", &verilated),
        ("one by one", &|| simulated(1)),
        ("8 lanes", &|| lanes::<8>(1)),
        ("16 lanes", &|| lanes::<16>(1)),
        ("32 lanes", &|| lanes::<32>(1)),
        ("64 lanes", &|| lanes::<64>(1)),
        ("one by one, 2 threads", &|| simulated(2)),
        ("32 lanes, 2 threads", &|| lanes::<32>(2)),
        ("64 lanes, 2 threads", &|| lanes::<64>(2)),
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
        "{:<22} {:>9} {:>9} {:>12}",
        "", "scans/s", "ticks/s", "of Verilated"
    );
    for ((way, _), rate) in ways.iter().zip(&medians) {
        let (of, ticks) = (rate / medians[0], rate * ticks);
        println!("{way:<22} {rate:>9.2e} {ticks:>9.2e} {of:>12.1}");
    }
}
