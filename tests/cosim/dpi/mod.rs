//! Checkers in SystemVerilog, in Verilator with the library of `bindings/c`.

mod mistakes;
mod verdicts;

use motion_rtl::Model;
use motion_rtl::registry::Pair;
use motion_rtl::verilog::{Binding, DpiChecker};
use std::fs;
use std::os::unix::fs::symlink;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::OnceLock;
use tempfile::TempDir;

pub const CHECKOUT: &str = env!("CARGO_MANIFEST_DIR");
pub const PAGE: &str = include_str!("../../../rtl_notes/bindings/systemverilog.md");

/// Verilator, which the environment may choose.
fn verilator() -> String {
    std::env::var("VERILATOR").unwrap_or_else(|_| "verilator".to_owned())
}

/// Directory below which cargo builds.
fn target() -> &'static Path {
    Path::new(env!("CARGO_TARGET_TMPDIR")).parent().unwrap()
}

/// Exit code and output of a command.
pub fn ended(command: &mut Command) -> (Option<i32>, String) {
    let Output {
        status,
        stdout,
        stderr,
    } = command.output().unwrap();
    let text = [stdout, stderr].map(|text| String::from_utf8_lossy(&text).into_owned());
    (status.code(), text.concat())
}

/// Runs a command, and expects it to end well.
#[track_caller]
pub fn run(command: &mut Command) -> String {
    let (code, text) = ended(command);
    assert_eq!(code, Some(0), "{command:?}: {text}");
    text
}

/// Directory with the library, installed once.
pub fn library() -> &'static Path {
    static LIBRARY: OnceLock<PathBuf> = OnceLock::new();
    LIBRARY.get_or_init(|| {
        let prefix = Path::new(env!("CARGO_TARGET_TMPDIR")).join("dpi");
        let mut make = Command::new("make");
        make.args(["-C", &format!("{CHECKOUT}/bindings/c"), "install"]);
        make.arg(format!("PREFIX={}", prefix.display()));
        run(make.env("CARGO_TARGET_DIR", target()).env_remove("DESTDIR"));
        prefix.join("lib")
    })
}

/// Writes the files of a checker; returns their paths.
fn write(folder: &Path, circuit: &str, settings: &str, binding: &Binding) -> Vec<PathBuf> {
    let pairs: Vec<Pair> = settings.lines().map(|pair| pair.parse().unwrap()).collect();
    let model = Model::new(circuit, &pairs).unwrap();
    let checker = DpiChecker::new(&model, settings, &[]).unwrap();
    let mut sources = Vec::from(checker.sources());
    sources.push(checker.binding(binding));
    let paths = sources.into_iter().map(|source| {
        let path = folder.join(source.name);
        fs::write(&path, source.text).unwrap();
        path
    });
    paths.collect()
}

/// Program in C++ that drives the port `clk` of the module `bench` until it finishes.
const MAIN: &str = r#"
#include "Vbench.h"
#include "verilated.h"
int main(int argc, char **argv) {
    VerilatedContext context;
    context.commandArgs(argc, argv);
    Vbench top{&context};
    top.clk = 0;
    while (!context.gotFinish()) {
        top.eval();
        context.timeInc(5);
        top.clk = !top.clk;
    }
    if (!context.commandArgsPlusMatch("early")[0]) top.final();
    return 0;
}
"#;

/// Way to drive the clock.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Clock {
    /// The bench has delays.
    Delays,
    /// A program in C++ drives a port.
    Program,
}

/// Compiles a bench with the library; returns the program, or what the compiler says.
fn compiled(folder: &Path, clock: Clock, files: &[PathBuf]) -> Result<PathBuf, String> {
    let mut command = Command::new(verilator());
    command.args([
        "--top-module",
        "bench",
        "-Mdir",
        "obj",
        "-Wall",
        "-Wno-fatal",
    ]);
    command.args(["-MAKEFLAGS", "OPT_FAST=-O0", "-MAKEFLAGS", "OPT_GLOBAL=-O0"]);
    match clock {
        Clock::Delays => command.arg("--binary"),
        Clock::Program => {
            fs::write(folder.join("main.cpp"), MAIN).unwrap();
            command.args(["--cc", "--exe", "--build", "--no-timing", "main.cpp"])
        }
    };
    command.args(files).arg(library().join("libmotion_rtl.so"));
    let (code, text) = ended(command.current_dir(folder));
    // Warnings about the bench do not count.
    let printed = ["motion_rtl_pkg.sv", "_checker.sv", "_bind.sv"];
    let warns =
        |line: &str| line.starts_with("%Warning") && printed.iter().any(|name| line.contains(name));
    match code == Some(0) && !text.lines().any(warns) {
        true => Ok(folder.join("obj/Vbench")),
        false => Err(text),
    }
}

/// Program with the path of the library.
fn started(folder: &Path, program: &Path) -> Command {
    let mut command = Command::new(program);
    command
        .current_dir(folder)
        .env("LD_LIBRARY_PATH", library());
    command
}

/// The blocks of a page: language and text.
pub fn blocks(page: &str) -> Vec<(&str, &str)> {
    let fenced = page.split("```").skip(1).step_by(2);
    fenced.filter_map(|block| block.split_once('\n')).collect()
}

/// Folder in which the commands of the page run.
pub fn folder_of_the_page() -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    for name in ["bindings", "rtl_notes"] {
        symlink(Path::new(CHECKOUT).join(name), folder.path().join(name)).unwrap();
    }
    folder
}

/// Shell with the program as it was built.
pub fn shell(folder: &Path, commands: &str) -> (Option<i32>, String) {
    let program = "cargo() { \"$MOTION_RTL\" \"${@:4}\"; }";
    let verilator = format!("verilator() {{ command {} \"$@\"; }}", verilator());
    let script = format!("exec 2>&1\n{program}\n{verilator}\n{commands}");
    let mut bash = Command::new("bash");
    bash.args(["-euo", "pipefail", "-c", &script]);
    bash.env("MOTION_RTL", env!("CARGO_BIN_EXE_motion-rtl"));
    ended(bash.env("CARGO_TARGET_DIR", target()).current_dir(folder))
}

#[test]
#[ignore = "needs Verilator and the library of bindings/c"]
fn the_commands_of_the_page_end_with_a_pass_and_a_fault_is_found() {
    let blocks = blocks(PAGE);
    let ("sh", commands) = blocks[0] else {
        panic!("{:?}", blocks[0]);
    };
    let [pass, first, verdict] = [1, 2, 3].map(|index| blocks[index].1);
    assert!(PAGE.lines().count() <= 150);
    let lines: Vec<&str> = commands.lines().collect();
    assert_eq!(lines.len(), 5);
    assert!(lines[0].starts_with("apt-get install"));
    let folder = folder_of_the_page();
    // Without what needs root.
    let (code, text) = shell(folder.path(), &lines[1..].join("\n"));
    assert!(code == Some(0) && text.contains(pass), "{text}");

    let design = folder.path().join("design");
    fs::create_dir(&design).unwrap();
    for name in ["step_channel", "tick_timer", "edge_maker", "line_reg"] {
        let file = format!("{CHECKOUT}/rtl_notes/golden_model/{name}.v");
        let text = fs::read_to_string(file).unwrap();
        let text = text.replace("run_up >= i_half", "run_q >= i_half");
        fs::write(design.join(format!("{name}.v")), text).unwrap();
    }
    let compile = lines[3].replace("-y rtl_notes/golden_model", "-y design");
    let (code, text) = shell(folder.path(), &format!("{compile}\n{}", lines[4]));
    assert_ne!(code, Some(0), "{text}");
    assert!(text.contains(first) && text.contains(verdict), "{text}");
    let waves = "step_channel_bench.dut.mrtl_checker";
    for extension in ["vcd", "gtkw"] {
        let file = folder.path().join(format!("{waves}.{extension}"));
        assert!(fs::metadata(file).unwrap().len() > 1000);
    }
}
