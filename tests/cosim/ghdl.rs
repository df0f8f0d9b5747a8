//! Every circuit's VHDL in GHDL, driven with seeded random inputs and resets.

use super::simulators::{all_own, drive, variants, widths};
use super::tools::{missing_words, run};
use motion_rtl::compare::{Map, Report, Settings, compare};
use motion_rtl::registry::{AnyModel, Base, CATALOGUE, find};
use motion_rtl::trace::Clock;
use rayon::prelude::*;
use std::fs;
use std::path::Path;
use std::process::Command;

/// Ticks at narrow widths, at own widths, and at own widths with many signals and words of memories.
const TICKS: u64 = 3_000;
const FEWER_TICKS: u64 = 1_000;
const LEAST_TICKS: u64 = 300;
const MANY_WORDS: usize = 1_000;
const SEED: u64 = 3;

/// All warnings of GHDL.
const WARNINGS: [&str; 19] = [
    "library",
    "default-binding",
    "binding",
    "port",
    "reserved",
    "pure",
    "specs",
    "hide",
    "unused",
    "others",
    "nested-comment",
    "parenthesis",
    "vital-generic",
    "delayed-checks",
    "runtime-error",
    "body",
    "shared",
    "static",
    "universal",
];

/// Analyses files in their order; GHDL has nothing to say.
#[track_caller]
fn analyse(path: &Path, files: &[String]) {
    let warnings = WARNINGS.map(|warning| format!("--warn-{warning}"));
    let options = ["-a", "--std=08"].into_iter();
    let options = options.chain(warnings.iter().map(String::as_str));
    let files = files.iter().map(String::as_str);
    let said = run(path, "ghdl", &options.chain(files).collect::<Vec<_>>());
    assert_eq!(said, "", "GHDL warns in {}", path.display());
}

/// Writes a circuit's VHDL, and its testbench with the files for it; returns the names of the files
/// in the order of their analysis, and how many ticks had a reset.
pub fn export(circuit: &dyn AnyModel, path: &Path, seed: u64, ticks: u64) -> (Vec<String>, u64) {
    let vhdl = circuit.vhdl().unwrap();
    let mut files = Vec::new();
    for source in vhdl.sources().iter().chain(&vhdl.testbench(Clock::default())) {
        fs::write(path.join(&source.name), &source.text).unwrap();
        files.push(source.name.clone());
    }
    let resets = drive(circuit, path, seed, ticks);
    (files, resets)
}

/// Runs the testbench; returns what it prints, and whether it ends well.
fn simulate(path: &Path, name: &str) -> (String, bool) {
    let bench = format!("{name}_tb");
    let output = Command::new("ghdl")
        .args(["--elab-run", "--std=08", &bench])
        .args(["--ieee-asserts=disable-at-0", &format!("--vcd={bench}.vcd")])
        .current_dir(path)
        .output()
        .unwrap();
    let said = String::from_utf8(output.stdout).unwrap();
    let said = said + &String::from_utf8(output.stderr).unwrap();
    (said, output.status.success())
}

/// Compares the dump of the testbench with the golden one.
fn compared(circuit: &dyn AnyModel, path: &Path) -> Report {
    let name = circuit.name();
    let names = circuit.vhdl().unwrap().names();
    let settings = Settings {
        map: Map::parse(&names.name, &names.text).unwrap(),
        ..Settings::default()
    };
    let [golden, other] =
        [name, &format!("{name}_tb")].map(|stem| path.join(format!("{stem}.vcd")));
    compare(&golden, &other, &settings).unwrap_or_else(|fault| panic!("{name}: {fault}"))
}

/// Holds a circuit and its VHDL against each other.
fn hold(circuit: &dyn AnyModel, ticks: u64) {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path();
    let name = circuit.name();
    let (files, resets) = export(circuit, path, SEED, ticks);
    assert!(resets > 0, "{name}");
    analyse(path, &files);
    let (said, well) = simulate(path, name);
    let pass = format!("PASS: ports out are as expected in all of {ticks} ticks\n");
    assert!(well && said == pass, "{name}: {said}");
    let report = compared(circuit, path);
    assert!(report.is_equal(), "{report}");
    assert_eq!(report.ticks, ticks, "{report}");
    // GHDL's dump has no arrays.
    let words = missing_words(circuit);
    assert_eq!(report.without_partner, words, "{report}");
    let leaves = circuit.outline().leaves.len();
    assert_eq!(report.signals, leaves - words.len(), "{report}");
}

#[test]
#[ignore = "needs GHDL"]
fn every_circuit_equals_its_vhdl_in_ghdl() {
    let entries = CATALOGUE.par_iter().rev().with_max_len(1);
    entries.for_each(|entry| {
        for circuit in widths(entry) {
            let own = circuit.1;
            let ticks = match circuit.0.outline().leaves.len() > MANY_WORDS {
                true => LEAST_TICKS,
                false if own => FEWER_TICKS,
                false => TICKS,
            };
            hold(&*circuit.0, ticks);
        }
    });
}
