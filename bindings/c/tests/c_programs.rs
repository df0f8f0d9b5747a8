//! Programs in C on what `make install` installs, as the page of the C ABI has it.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::OnceLock;

const ROOT: &str = env!("CARGO_MANIFEST_DIR");

/// Options of gcc for every program.
const STRICT: [&str; 6] = [
    "-std=c99",
    "-pedantic",
    "-Wall",
    "-Wextra",
    "-Werror",
    "-O2",
];

/// Runs a command, and expects it to end well.
fn run(command: &mut Command) -> String {
    let (code, text) = ended(command);
    assert_eq!(code, Some(0), "{command:?}: {text}");
    text
}

/// Exit code and output of a command.
fn ended(command: &mut Command) -> (Option<i32>, String) {
    let Output {
        status,
        stdout,
        stderr,
    } = command.output().unwrap();
    let text = [stdout, stderr].map(|text| String::from_utf8(text).unwrap());
    (status.code(), text.concat())
}

/// Build directory of this test.
fn target() -> &'static Path {
    Path::new(env!("CARGO_TARGET_TMPDIR")).parent().unwrap()
}

/// Installs into a directory of the tests, once.
fn prefix() -> &'static Path {
    static PREFIX: OnceLock<PathBuf> = OnceLock::new();
    PREFIX.get_or_init(|| {
        let directory = Path::new(env!("CARGO_TARGET_TMPDIR")).join("c_programs");
        if directory.exists() {
            fs::remove_dir_all(&directory).unwrap();
        }
        let mut make = Command::new("make");
        make.args(["-C", ROOT, "install"]);
        make.arg(format!("PREFIX={}", directory.display()));
        run(make.env("CARGO_TARGET_DIR", target()).env_remove("DESTDIR"));
        directory
    })
}

/// What `pkg-config` prints about the library.
fn pkg_config(options: &[&str]) -> Vec<String> {
    let mut command = Command::new("pkg-config");
    command.args(options).arg("motion_rtl");
    let text = run(command.env("PKG_CONFIG_PATH", prefix().join("lib/pkgconfig")));
    text.split_whitespace().map(str::to_owned).collect()
}

/// Compiles a program for the shared library.
fn compiled(source: &str) -> PathBuf {
    let name = Path::new(source).file_stem().unwrap();
    let program = prefix().join(name);
    let mut gcc = Command::new("gcc");
    gcc.args(STRICT).arg(Path::new(ROOT).join(source));
    gcc.args(pkg_config(&["--cflags", "--libs"]))
        .arg("-pthread");
    run(gcc.arg("-o").arg(&program));
    program
}

/// Program with the path of the shared library.
fn started(program: &Path) -> Command {
    let mut command = Command::new(program);
    command.env("LD_LIBRARY_PATH", prefix().join("lib"));
    command
}

#[test]
fn a_design_in_c_equals_the_model_and_a_fault_in_it_is_found() {
    let program = compiled("examples/enable_counter.c");
    let text = run(&mut started(&program));
    assert!(
        text.starts_with("PASS: 100000 ticks compared, enable moved "),
        "{text}"
    );
    let (code, text) = ended(started(&program).arg("fault"));
    assert_eq!(code, Some(1), "{text}");
    assert!(
        text.starts_with("FAIL: tick ") && text.contains(": enable: design 0, model 1"),
        "{text}"
    );
}

#[test]
fn whatever_is_wrong_is_an_error() {
    assert_eq!(run(&mut started(&compiled("tests/c/refusals.c"))), "PASS\n");
}

#[test]
fn signals_ticks_snapshots_and_waves() {
    let program = compiled("tests/c/state.c");
    let base = prefix().join("waves/state");
    assert_eq!(run(started(&program).arg(&base)), "PASS\n");
    let mut files: Vec<_> = fs::read_dir(prefix().join("waves")).unwrap().collect();
    files.sort_by_key(|file| file.as_ref().unwrap().file_name());
    let names = files.into_iter().map(|file| file.unwrap().file_name());
    assert_eq!(names.collect::<Vec<_>>(), ["state.gtkw", "state.vcd"]);
    // Ticks 1000 to 1049 of ten units of time, and the end of the last.
    let vcd = fs::read_to_string(base.with_extension("vcd")).unwrap();
    let times: Vec<_> = vcd.lines().filter(|line| line.starts_with('#')).collect();
    assert_eq!((times[0], *times.last().unwrap()), ("#10000", "#10500"));
}

#[test]
fn models_are_used_from_threads() {
    assert_eq!(run(&mut started(&compiled("tests/c/threads.c"))), "PASS\n");
}

#[test]
fn a_program_can_contain_the_library() {
    let program = prefix().join("contained");
    let mut gcc = Command::new("gcc");
    gcc.args(STRICT)
        .arg(Path::new(ROOT).join("examples/enable_counter.c"));
    gcc.args(pkg_config(&["--cflags"]))
        .arg(prefix().join("lib/libmotion_rtl.a"));
    let libraries = pkg_config(&["--libs", "--static"]);
    gcc.args(
        libraries
            .iter()
            .filter(|library| *library != "-lmotion_rtl"),
    );
    run(gcc.arg("-o").arg(&program));
    assert!(run(&mut Command::new(&program)).starts_with("PASS"));
}

#[test]
fn a_missing_library_and_one_of_another_version_end_the_program_at_its_start() {
    let program = compiled("tests/c/abi.c");
    let (code, text) = ended(Command::new(&program).env_remove("LD_LIBRARY_PATH"));
    assert_eq!(code, Some(127), "{text}");
    assert!(
        text.contains("libmotion_rtl.so.1: cannot open shared object file"),
        "{text}"
    );

    let other = prefix().join("other");
    fs::create_dir(&other).unwrap();
    fs::copy(
        prefix().join("lib/libmotion_rtl.so"),
        other.join("libmotion_rtl.so.2"),
    )
    .unwrap();
    let (code, text) = ended(Command::new(&program).env("LD_LIBRARY_PATH", &other));
    assert_eq!(code, Some(127), "{text}");
    assert_eq!(run(&mut started(&program)), "ABI 1\n");
}

#[test]
fn cpp_takes_the_header() {
    let source = prefix().join("header.cpp");
    let text = "#include <motion_rtl.h>\nint main() { return mrtl_abi() == MRTL_ABI ? 0 : 1; }\n";
    fs::write(&source, text).unwrap();
    let program = prefix().join("header_cpp");
    let mut gcc = Command::new("g++");
    gcc.args(["-std=c++11", "-Wall", "-Wextra", "-Werror"])
        .arg(&source);
    run(gcc
        .args(pkg_config(&["--cflags", "--libs"]))
        .arg("-o")
        .arg(&program));
    run(&mut started(&program));
}

/// The blocks of code of a page: language and text.
fn blocks(page: &str) -> Vec<(&str, &str)> {
    let fenced = page.split("```").skip(1).step_by(2);
    fenced.filter_map(|block| block.split_once('\n')).collect()
}

const PAGE: &str = include_str!("../../../rtl_notes/bindings/c.md");

#[test]
fn the_code_of_the_page_is_compiled_and_runs() {
    let blocks = blocks(PAGE);
    let (_, code) = blocks
        .iter()
        .find(|(language, _)| *language == "c")
        .unwrap();
    let (head, body) = code.split_once("\n\n").unwrap();
    let source = prefix().join("of_the_page.c");
    let text = format!("{head}\nint main(void) {{\n{body}return position != 0;\n}}\n");
    fs::write(&source, text).unwrap();
    run(&mut started(&compiled(source.to_str().unwrap())));
}

#[test]
fn the_commands_of_the_page_end_with_a_pass() {
    let blocks = blocks(PAGE);
    let [("sh", commands), ("text", pass), ("text", fail)] = blocks[..3] else {
        panic!("{:?}", &blocks[..3]);
    };
    let commands: Vec<&str> = commands.lines().collect();
    assert_eq!(commands.len(), 5);
    assert!(commands[0].starts_with("apt-get install"));
    assert!(PAGE.lines().count() <= 150);
    // Without what needs root, and below a directory of the test.
    let build = prefix().join("page");
    fs::create_dir(&build).unwrap();
    let commands = commands[1..]
        .join("\n")
        .replace("$PWD/build", build.to_str().unwrap());
    let commands = commands.replace(
        "build/enable_counter",
        &format!("{}/enable_counter", build.display()),
    );
    let mut shell = Command::new("bash");
    shell.args(["-euo", "pipefail", "-c", &commands]);
    shell
        .current_dir(Path::new(ROOT).join("../.."))
        .env("CARGO_TARGET_DIR", target());
    let (code, text) = ended(&mut shell);
    assert!(code == Some(0) && text.contains(pass), "{commands}: {text}");
    let (_, text) = ended(started(&build.join("enable_counter")).arg("fault"));
    assert_eq!(text, fail);
}
