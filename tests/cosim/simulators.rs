//! Every circuit of the catalogue, driven with seeded random inputs and resets.

use super::tools::{Simulator, complete, run, write};
use motion_rtl::check::Drive;
use motion_rtl::registry::{AnyModel, Base, CATALOGUE, Entry};
use motion_rtl::trace::Clock;
use rayon::prelude::*;
use std::fs::File;
use std::path::Path;

/// At 8 bits nearly all that can move moves in so many: the test of the stimulus asks for all, in
/// more.
const TICKS: u64 = 30_000;
/// At the least and at the own widths.
const FEWER_TICKS: u64 = 10_000;
/// At own widths with more than [`MANY_WORDS`] signals, words of memories among them: when one of
/// these is written, Icarus goes through all.
const LEAST_TICKS: u64 = 2_000;
const MANY_WORDS: usize = 1_000;
const SEED: u64 = 3;

/// Drives a circuit and writes its Verilog beside what comes of that; returns the files of its
/// modules, and how many ticks had a reset.
pub fn export(circuit: &dyn AnyModel, path: &Path, seed: u64, ticks: u64) -> (Vec<String>, u64) {
    let modules = write(path, &circuit.verilog().unwrap());
    (modules, drive(circuit, path, seed, ticks))
}

/// Drives a circuit and writes its waves, its stimulus and its outputs; returns how many ticks had a
/// reset.
pub fn drive(circuit: &dyn AnyModel, path: &Path, seed: u64, ticks: u64) -> u64 {
    let name = circuit.name();
    let drive = Drive {
        seed,
        ticks,
        resets: true,
        bounded: false,
        clock: Clock::default(),
    };
    let create = |extension: &str| File::create(path.join(format!("{name}.{extension}"))).unwrap();
    let driven = circuit.drive(
        &drive,
        &mut create("vcd"),
        &mut create("stimulus"),
        &mut create("expected"),
    );
    driven.unwrap().resets
}

/// Holds a circuit and its Verilog against each other; returns how many ticks had a reset.
pub fn hold(circuit: &dyn AnyModel, simulator: Simulator, seed: u64, ticks: u64) -> u64 {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path();
    let name = circuit.name();
    let (modules, resets) = export(circuit, path, seed, ticks);
    let report = simulator.hold(path, name, &modules);
    complete(&report, ticks, circuit.outline().leaves.len());
    resets
}

/// The circuit of an entry at several widths, with the ticks it is held for: an odd one where it can
/// be made so, a middle one, its own.
pub fn widths(entry: &Entry) -> Vec<(Box<dyn AnyModel>, u64)> {
    let made = |width| entry.scaled(width);
    let least = made(3).or_else(|| made(4)).map(|made| (made, FEWER_TICKS));
    let middle = made(8).map(|made| (made, TICKS));
    let own = entry.full();
    let ticks = match has_many_words(&*own) {
        true => LEAST_TICKS,
        false => FEWER_TICKS,
    };
    [least, middle, Some((own, ticks))]
        .into_iter()
        .flatten()
        .collect()
}

/// True for a circuit with more than [`MANY_WORDS`] signals and words of memories.
pub fn has_many_words(circuit: &dyn AnyModel) -> bool {
    circuit.outline().leaves.len() > MANY_WORDS
}

/// Every circuit of the catalogue at every width, on all cores.
pub fn all(work: impl Fn(&dyn AnyModel, u64) + Sync) {
    let entries = CATALOGUE.par_iter().with_max_len(1);
    entries.for_each(|entry| {
        for (circuit, ticks) in widths(entry) {
            work(&*circuit, ticks);
        }
    });
}

/// Every circuit of the catalogue at its own widths, on all cores.
pub fn all_own(work: impl Fn(&dyn AnyModel) + Sync) {
    let entries = CATALOGUE.par_iter().rev().with_max_len(1);
    entries.for_each(|entry| work(&*entry.full()));
}

#[test]
#[ignore = "needs Icarus Verilog"]
fn every_circuit_equals_its_verilog_in_icarus() {
    all(|circuit, ticks| assert!(hold(circuit, Simulator::Icarus, SEED, ticks) > 0));
}

/// Circuits that can be made otherwise than as the catalogue has them at a width.
const VARIANTS: [(&str, &[&str]); 12] = [
    ("pulse_generator", &["width=8", "variant=literal"]),
    (
        "axis",
        &[
            "memory.half_period=8",
            "memory.address=4",
            "variant=literal",
        ],
    ),
    ("unit_law", &["width=8", "variant=literal"]),
    (
        "record_sequencer",
        &["modulus=8", "samples=8", "data=11", "waits=true"],
    ),
    ("arc_generator", &["blend=products", "widths.fraction=5"]),
    ("conventional_pulse_interpolator", &["arcs=true"]),
    ("integrator", &["position=8", "rule=truncating"]),
    ("integrator", &["position=8", "rule=centred"]),
    (
        "mul_div",
        &["multiplier=25", "word=58", "architecture=radix4"],
    ),
    (
        "mul_div",
        &["multiplier=5", "word=9", "architecture=radix4"],
    ),
    (
        "mul_div",
        &["multiplier=25", "word=58", "architecture=combinational"],
    ),
    (
        "mul_div",
        &["multiplier=9", "word=5", "architecture=combinational"],
    ),
];

pub fn variants() -> impl Iterator<Item = Box<dyn AnyModel>> {
    VARIANTS.into_iter().map(|(name, given)| {
        let entry = motion_rtl::registry::find(name).unwrap();
        let pairs: Vec<_> = given.iter().map(|pair| pair.parse().unwrap()).collect();
        entry.made(Base::Small, &pairs).unwrap()
    })
}

#[test]
#[ignore = "needs Icarus Verilog"]
fn the_other_variants_equal_their_verilog_too() {
    for circuit in variants() {
        assert!(hold(&*circuit, Simulator::Icarus, SEED, TICKS) > 0);
    }
}

#[test]
#[ignore = "needs Verilator"]
fn the_top_circuits_equal_their_verilog_in_verilator() {
    let find = |name| motion_rtl::registry::find(name).unwrap();
    let made = |entry: &Entry, pairs: &[&str]| {
        let pairs: Vec<_> = pairs.iter().map(|pair| pair.parse().unwrap()).collect();
        entry.made(Base::Full, &pairs).unwrap()
    };
    // With memories of few words: of each it compiles a wave.
    let circuits = [
        find("unit_law").full(),
        made(find("axis"), &["memory.address=4"]),
        made(
            find("pulse_interpolator"),
            &["widths.address=3", "widths.period=16"],
        ),
        find("controller").full(),
    ];
    for circuit in circuits {
        assert!(hold(&*circuit, Simulator::Verilator, SEED, TICKS) > 0);
    }
}

#[test]
#[ignore = "needs Verilator"]
fn verilator_finds_nothing_to_warn_of() {
    all(|circuit, _| lint(circuit));
    variants().for_each(|circuit| lint(&*circuit));
}

/// Verilator finds nothing to warn of.
pub fn lint(circuit: &dyn AnyModel) {
    let directory = tempfile::tempdir().unwrap();
    let modules = write(directory.path(), &circuit.verilog().unwrap());
    let options = ["--lint-only", "-Wall", "--top-module", circuit.name()];
    let files: Vec<&str> = modules.iter().map(String::as_str).collect();
    let said = run(
        directory.path(),
        "verilator",
        &[&options[..], &files].concat(),
    );
    assert_eq!(said, "", "{}", circuit.name());
}
