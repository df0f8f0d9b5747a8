//! What an exported testbench says of a circuit with a fault, and of files that do not fit.

use super::simulators::export;
use super::tools::run;
use motion_rtl::compare::{Settings, compare};
use motion_rtl::registry::{AnyModel, find};
use motion_rtl::trace::Clock;
use std::fs;
use std::path::Path;
use std::process::Command;

const SEED: u64 = 3;
const TICKS: u64 = 3_000;

/// Replaces a text that a file has once.
#[track_caller]
fn replace(path: &Path, from: &str, to: &str) {
    let text = fs::read_to_string(path).unwrap();
    assert_eq!(text.matches(from).count(), 1, "{from}:\n{text}");
    fs::write(path, text.replace(from, to)).unwrap();
}

/// Runs the testbench of an export in Icarus; what it prints, and whether it ends well.
#[track_caller]
fn simulate(path: &Path, name: &str, modules: &[String]) -> (String, bool) {
    let bench = format!("{name}_tb");
    let source = format!("{bench}.v");
    let files = modules.iter().chain([&source]).map(String::as_str);
    let options = ["-g2001", "-Wall", "-s", &bench, "-o", &bench];
    let said = run(
        path,
        "iverilog",
        &options.into_iter().chain(files).collect::<Vec<_>>(),
    );
    assert_eq!(said, "", "Icarus warns");
    let vvp = Command::new("vvp")
        .args(["-n", &bench])
        .current_dir(path)
        .output()
        .unwrap();
    let said = String::from_utf8(vvp.stdout).unwrap() + &String::from_utf8(vvp.stderr).unwrap();
    (said, vvp.status.success())
}

/// Holds what the testbench says of a circuit with a fault against the dump that it leaves: the
/// first tick in which ports out differ, and each port that differs in it.
#[track_caller]
fn found(circuit: &dyn AnyModel, file: &str, from: &str, to: &str) {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path();
    let name = circuit.name();
    let (modules, _) = export(circuit, path, SEED, TICKS);
    let (said, well) = simulate(path, name, &modules);
    assert!(well, "{said}");
    assert!(
        said.contains("PASS: ports out are as expected in all of 3000 ticks\n"),
        "{said}"
    );
    assert!(!said.contains("FAIL"), "{said}");

    replace(&path.join(file), from, to);
    let (said, well) = simulate(path, name, &modules);
    assert!(!well && !said.contains("PASS"), "{said}");
    let [golden, other] =
        [name, &format!("{name}_tb")].map(|stem| path.join(format!("{stem}.vcd")));
    let report = compare(&golden, &other, &Settings::default()).unwrap();
    let ports = report.differences.iter();
    let ports: Vec<_> = ports
        .filter(|one| report.ports_out.contains(&one.golden))
        .collect();
    let tick = ports
        .iter()
        .map(|port| port.tick)
        .min()
        .expect("a port out differs");
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
        last.is_some_and(|line| line.ends_with(" of 3000 ticks")),
        "{said}"
    );
}

/// A fault in each kind of circuit: file, text, and what stands there in its place.
const FAULTS: [(&str, &str, &str, &str); 8] = [
    // Without a clock, with signed ports.
    (
        "placement",
        "placement.v",
        "position + lead",
        "position - lead",
    ),
    // Registers and a net as the port out.
    (
        "enable_counter",
        "enable_counter.v",
        "next >= period",
        "next > period",
    ),
    // A register as the port out.
    ("sync_stage", "sync_stage.v", "pulse && !unit_rst", "pulse"),
    // A memory.
    (
        "target_data",
        "target_data.v",
        "xs[write_address] <=",
        "xs[read_address] <=",
    ),
    // A shift register.
    (
        "position_history",
        "position_history.v",
        "stages[stages_to - 1]",
        "stages[0]",
    ),
    // The contents of a ROM.
    (
        "cordic_state",
        "rom.hex",
        "20000000000\n12",
        "20000000001\n12",
    ),
    // Parts.
    ("unit_law", "sync_stage.v", "pulse && !unit_rst", "pulse"),
    // Parts, memories and a parameter.
    (
        "axis",
        "pulse_generator.v",
        "next >= half_period",
        "next > half_period",
    ),
];

#[test]
#[ignore = "needs Icarus Verilog"]
fn a_testbench_names_the_tick_and_the_ports_of_a_fault() {
    for (name, file, from, to) in FAULTS {
        found(&*find(name).unwrap().full(), file, from, to);
    }
}

/// Files that do not fit: one is missing, or has fewer or more lines than the other.
#[test]
#[ignore = "needs Icarus Verilog"]
fn files_that_do_not_fit_are_no_pass() {
    let circuit = find("enable_counter").unwrap().full();
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path();
    let (modules, _) = export(&*circuit, path, SEED, 100);
    let more = (1, "x\n", "FAIL: tick 99: enable is 1, expected x");
    do_not_fit(path, &[more], || simulate(path, "enable_counter", &modules));
}

/// Puts files of another length in place of those of a testbench of `enable_counter` with 100 ticks,
/// one at a time: each is refused with its line. Each of `more` is a file, stimulus or expected, a
/// line that takes the place of the last one, and what is said of it.
pub fn do_not_fit(
    path: &Path,
    more: &[(usize, &str, &str)],
    simulate: impl Fn() -> (String, bool),
) {
    let files = ["stimulus", "expected"].map(|end| format!("enable_counter.{end}"));
    let texts = files
        .each_ref()
        .map(|file| fs::read_to_string(path.join(file)).unwrap());
    let short = |file: usize| -> String {
        let lines = texts[file].lines().take(99);
        lines.map(|line| format!("{line}\n")).collect()
    };
    let mut cases = vec![
        (0, None, "FAIL: enable_counter.stimulus cannot be opened"),
        (1, None, "FAIL: enable_counter.expected cannot be opened"),
        (
            1,
            Some(short(1)),
            "FAIL: tick 99: enable_counter.expected has no line for it",
        ),
        (
            0,
            Some(short(0)),
            "FAIL: enable_counter.expected is not of a run of 99 ticks",
        ),
        (
            0,
            Some(String::new()),
            "FAIL: enable_counter.expected is not of a run of 0 ticks",
        ),
    ];
    let more = more.iter();
    cases.extend(more.map(|&(file, last, said)| (file, Some(short(file) + last), said)));
    for (file, text, line) in cases {
        for (file, text) in files.iter().zip(&texts) {
            fs::write(path.join(file), text).unwrap();
        }
        let file = path.join(&files[file]);
        match text {
            Some(text) => fs::write(file, text).unwrap(),
            None => fs::remove_file(file).unwrap(),
        }
        let (said, well) = simulate();
        assert!(
            !well && said.lines().any(|said| said == line),
            "{line}:\n{said}"
        );
        assert!(!said.contains("PASS"), "{said}");
    }
}

/// Times of the rising edges of `clk` in a dump of Icarus, in femtoseconds.
fn rises(dump: &str) -> Vec<u64> {
    let (_, scale) = dump.split_once("$timescale").unwrap();
    let unit = match scale.split_whitespace().next().unwrap() {
        "1ps" => 1_000,
        "1fs" => 1,
        other => panic!("{other}: neither that of modules nor that of the clock"),
    };
    let clk = dump
        .lines()
        .find(|line| line.contains(" clk $end"))
        .unwrap();
    let rise = format!("1{}", clk.split_whitespace().nth(3).unwrap());
    let mut time = 0;
    let mut rises = Vec::new();
    for line in dump.lines() {
        if let Some(begins) = line.strip_prefix('#') {
            time = begins.parse::<u64>().unwrap() * unit;
        } else if line == rise {
            rises.push(time);
        }
    }
    rises
}

/// The clock of a testbench has the period of the golden waves, in the coarsest unit and in the
/// finest one.
#[test]
#[ignore = "needs Icarus Verilog"]
fn a_testbench_has_the_time_of_its_clock() {
    let circuit = find("enable_counter").unwrap().full();
    let cases = [
        (1, 1_000_000_000_000_000),
        (7, 142_857_142_857_142),
        (1_000_000, 1_000_000_000),
        (3_000_000, 333_333_334),
        (50_000_000, 20_000_000),
    ];
    for (hz, period) in cases {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path();
        let (modules, _) = export(&*circuit, path, SEED, 5);
        let bench = circuit
            .verilog()
            .unwrap()
            .testbench(Clock::from_hz(hz).unwrap())
            .unwrap();
        fs::write(path.join(&bench.name), bench.text).unwrap();
        let (said, well) = simulate(path, "enable_counter", &modules);
        assert!(well, "{said}");
        let rises = rises(&fs::read_to_string(path.join("enable_counter_tb.vcd")).unwrap());
        let expected: Vec<u64> = (0..4).map(|tick| period / 2 + tick * period).collect();
        assert_eq!(rises, expected, "{hz} Hz");
    }
}
