//! Every circuit's VHDL in GHDL, driven with seeded random inputs and resets.

use super::simulators::{all, all_own, drive, variants};
use super::testbench::do_not_fit;
use super::tools::run;
use motion_rtl::compare::{Map, Report, Settings, compare};
use motion_rtl::registry::{AnyModel, find};
use motion_rtl::trace::Clock;
use std::fs;
use std::path::Path;
use std::process::Command;

/// One tick of GHDL for so many of Icarus.
const SLOWER: u64 = 10;
const TICKS: u64 = 1_000;
const SEED: u64 = 3;

/// All warnings of GHDL.
const WARNINGS: [&str; 21] = [
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
    "attribute",
    "port-bounds",
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
    for source in vhdl
        .sources()
        .iter()
        .chain(&vhdl.testbench(Clock::default()))
    {
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

/// Holds a circuit and its VHDL against each other; returns how many ticks had a reset.
pub fn hold(circuit: &dyn AnyModel, seed: u64, ticks: u64) -> u64 {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path();
    let name = circuit.name();
    let (files, resets) = export(circuit, path, seed, ticks);
    analyse(path, &files);
    let (said, well) = simulate(path, name);
    let pass = format!("PASS: ports out are as expected in all of {ticks} ticks\n");
    let pass = if outputs(circuit) > 0 {
        pass
    } else {
        String::new()
    };
    assert!(well && said == pass, "{name}: {said}");
    let report = compared(circuit, path);
    assert!(report.is_equal(), "{report}");
    assert_eq!(report.ticks, ticks, "{report}");
    assert_eq!(report.without_partner, Vec::<String>::new(), "{report}");
    // GHDL's dump has no arrays.
    let outline = circuit.outline();
    let words: usize = outline.memories.iter().map(|memory| memory.words).sum();
    assert_eq!(report.ignored.len(), words, "{report}");
    assert_eq!(report.signals, outline.leaves.len() - words, "{report}");
    resets
}

/// The number of a circuit's output ports.
fn outputs(circuit: &dyn AnyModel) -> usize {
    let vhdl = circuit.vhdl().unwrap();
    let top = vhdl.design().modules.last().unwrap();
    top.outputs().count()
}

#[test]
#[ignore = "needs GHDL"]
fn every_circuit_equals_its_vhdl() {
    all(|circuit, ticks| assert!(hold(circuit, SEED, ticks / SLOWER) > 0));
}

#[test]
#[ignore = "needs GHDL"]
fn the_other_variants_equal_their_vhdl_too() {
    for circuit in variants() {
        assert!(hold(&*circuit, SEED, TICKS) > 0);
    }
}

#[test]
#[ignore = "needs GHDL"]
fn ghdl_synthesises_every_circuit() {
    all_own(|circuit| {
        let directory = tempfile::tempdir().unwrap();
        let (files, _) = export(circuit, directory.path(), SEED, 2);
        let (_, sources) = files.split_last().unwrap();
        let mut arguments = vec!["--synth", "--std=08"];
        arguments.extend(sources.iter().map(String::as_str));
        arguments.extend(["-e", circuit.name()]);
        run(directory.path(), "ghdl", &arguments);
    });
}

/// Replaces a text that a file has.
#[track_caller]
fn replace(path: &Path, from: &str, to: &str) {
    let text = fs::read_to_string(path).unwrap();
    assert!(text.contains(from), "{from}:\n{text}");
    fs::write(path, text.replacen(from, to, 1)).unwrap();
}

/// A fault in each kind of circuit: file, text, and what stands there in its place.
const FAULTS: [(&str, &str, &str, &str); 11] = [
    (
        "placement",
        "placement.vhd",
        "position + lead",
        "position - lead",
    ),
    (
        "enable_counter",
        "enable_counter.vhd",
        "next_s ?>= period",
        "next_s ?> period",
    ),
    (
        "sync_stage",
        "sync_stage.vhd",
        "pulse and not unit_rst",
        "pulse",
    ),
    (
        "target_data",
        "target_data.vhd",
        "xs(to_integer(write_address)) <=",
        "xs(to_integer(read_address)) <=",
    ),
    (
        "position_history",
        "position_history.vhd",
        "<= stages(0 to 197)",
        "<= (others => stages(0))",
    ),
    (
        "cordic_state",
        "cordic_state.vhd",
        "12e4051d9df",
        "12e4051d9de",
    ),
    (
        "unit_law",
        "sync_stage.vhd",
        "pulse and not unit_rst",
        "pulse",
    ),
    (
        "axis",
        "pulse_generator.vhd",
        "next_s ?>= half_period",
        "next_s ?> half_period",
    ),
    // A dropped reset.
    (
        "enable_counter",
        "enable_counter.vhd",
        "if rst then",
        "if false then",
    ),
    // An arithmetic shift as a logical one.
    (
        "error_feedback",
        "error_feedback.vhd",
        "shift_right(projected, 2)",
        "signed(shift_right(unsigned(projected), 2))",
    ),
    // A signed comparison as an unsigned one.
    (
        "unwrapper",
        "unwrapper.vhd",
        "half ?< gone",
        "unsigned(half) ?< unsigned(gone)",
    ),
];

/// Holds what the testbench says of a circuit with a fault against the dump that it leaves: the
/// first tick in which ports out differ, and each port that differs in it.
#[track_caller]
fn found((name, file, from, to): (&str, &str, &str, &str)) {
    let circuit = find(name).unwrap().full();
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path();
    let (files, _) = export(&*circuit, path, SEED, TICKS);
    replace(&path.join(file), from, to);
    analyse(path, &files);
    let (said, well) = simulate(path, name);
    assert!(!well && !said.contains("PASS"), "{from}: {said}");
    let report = compared(&*circuit, path);
    let ports = report.differences.iter();
    let ports: Vec<_> = ports
        .filter(|one| report.ports_out.contains(&one.golden))
        .collect();
    let tick = ports.iter().map(|port| port.tick).min();
    let tick = tick.expect("a port out differs");
    let mut expected: Vec<String> = ports
        .iter()
        .filter(|port| port.tick == tick)
        .map(|port| {
            let port = port.golden.split_once('.').unwrap().1.replace('.', "_");
            format!("FAIL: tick {tick}: {port} is ")
        })
        .collect();
    let lines = said.lines().filter(|line| line.starts_with("FAIL: tick "));
    let mut told: Vec<&str> = lines.collect();
    told.sort_unstable();
    expected.sort_unstable();
    assert_eq!(told.len(), expected.len(), "{said}\n{expected:#?}");
    for (line, begin) in told.iter().zip(&expected) {
        assert!(line.starts_with(begin), "{line}: not {begin}");
        let (seen, wanted) = line[begin.len()..].split_once(", expected ").expect(line);
        assert_ne!(seen, wanted, "{line}");
    }
    let last = said
        .lines()
        .find(|line| line.starts_with("FAIL: ports out differ in "));
    assert!(
        last.is_some_and(|line| line.ends_with(" of 1000 ticks")),
        "{said}"
    );
}

#[test]
#[ignore = "needs GHDL"]
fn a_testbench_names_the_tick_and_the_ports_of_a_fault() {
    for fault in FAULTS {
        found(fault);
    }
}

/// Files that do not fit: one is missing, or has fewer or more lines than the other.
#[test]
#[ignore = "needs GHDL"]
fn files_that_do_not_fit_are_no_pass() {
    let circuit = find("enable_counter").unwrap().full();
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path();
    let (files, _) = export(&*circuit, path, SEED, 100);
    analyse(path, &files);
    let more = [
        (
            0,
            "12\n",
            "FAIL: tick 99: enable_counter.stimulus has no word of 25 bits",
        ),
        (
            1,
            "\n",
            "FAIL: tick 99: enable_counter.expected has no word of 1 bits",
        ),
    ];
    do_not_fit(path, &more, || simulate(path, "enable_counter"));
}
