//! The programs that are held against the model.

use motion_rtl::compare::{Report, Settings, compare};
use motion_rtl::trace::Clock;
use motion_rtl::verilog::Verilog;
use std::fs;
use std::path::Path;
use std::process::Command;

/// Runs a program; its output is shown where it fails or warns.
#[track_caller]
pub fn run(directory: &Path, program: &str, arguments: &[&str]) -> String {
    let output = Command::new(program)
        .args(arguments)
        .current_dir(directory)
        .output();
    let output = output.unwrap_or_else(|error| panic!("{program}: {error}"));
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(
        output.status.success(),
        "{program} {arguments:?}:\n{text}{errors}"
    );
    text + &errors
}

/// Writes the files of a design; returns the names of its modules' files.
pub fn write(directory: &Path, verilog: &Verilog) -> Vec<String> {
    let sources = verilog.sources();
    for source in sources.iter().chain(&verilog.testbench(Clock::default())) {
        fs::write(directory.join(&source.name), &source.text).unwrap();
    }
    let modules = sources.into_iter().map(|source| source.name);
    modules.filter(|name| name.ends_with(".v")).collect()
}

/// A simulator of Verilog.
#[derive(Debug, Clone, Copy)]
pub enum Simulator {
    Icarus,
    Verilator,
}

impl Simulator {
    /// Runs the testbench of `name` with what lies beside it, and compares the dump with the
    /// golden one, `<name>.vcd`.
    pub fn hold(self, directory: &Path, name: &str, modules: &[String]) -> Report {
        let bench = format!("{name}_tb");
        let source = format!("{bench}.v");
        let mut files: Vec<&str> = modules.iter().map(String::as_str).collect();
        files.push(&source);
        match self {
            Simulator::Icarus => {
                let said = run(
                    directory,
                    "iverilog",
                    &[&["-g2001", "-Wall", "-s", &bench, "-o", &bench], &files[..]].concat(),
                );
                assert_eq!(said, "", "Icarus warns");
                let said = run(directory, "vvp", &["-n", &bench]);
                passes(&said);
            }
            Simulator::Verilator => {
                let options = [
                    "--binary",
                    "--timing",
                    "--trace",
                    "--trace-underscore",
                    "--trace-max-array",
                    "65536",
                    // The model runs for less time than g++ takes to optimise it.
                    "-MAKEFLAGS",
                    "OPT_FAST=-O0",
                    "-MAKEFLAGS",
                    "OPT_GLOBAL=-O0",
                    "--top-module",
                    &bench,
                ];
                run(directory, "verilator", &[&options[..], &files].concat());
                let said = run(directory, &format!("obj_dir/V{bench}"), &[]);
                passes(&said);
            }
        }
        let [golden, other] = [name, &bench].map(|stem| directory.join(format!("{stem}.vcd")));
        compare(&golden, &other, &Settings::default()).unwrap_or_else(|fault| panic!("{fault}"))
    }
}

/// The testbench passes, and nothing else is said but where the dump and its end are.
#[track_caller]
fn passes(said: &str) {
    let notes = ["VCD info: dumpfile ", "FST info: dumpfile "];
    let lines = said.lines();
    let lines = lines.filter(|line| !notes.iter().any(|note| line.starts_with(note)));
    let lines: Vec<_> = lines
        .filter(|line| !line.ends_with(": Verilog $finish"))
        .collect();
    let passed = lines.first().is_some_and(|line| line.starts_with("PASS: "));
    assert!(passed && lines.len() == 1, "{said}");
}

/// Every golden signal was compared in every tick, and none differed.
#[track_caller]
pub fn complete(report: &Report, ticks: u64, signals: usize) {
    assert!(report.is_equal(), "{report}");
    assert_eq!(report.ticks, ticks, "{report}");
    assert_eq!(report.without_partner, Vec::<String>::new(), "{report}");
    assert_eq!(report.signals, signals, "{report}");
    assert_eq!(report.unknown_values, 0, "{report}");
    assert_eq!(report.values, ticks * signals as u64, "{report}");
}
