//! A directory of its own for each test, and the program in it.

use assert_cmd::Command;
use serde_json::Value;
use std::collections::HashMap;
use std::fs;
use std::path::{Path, PathBuf};
use tempfile::TempDir;
use vcd::{Command as Change, Parser, ScopeItem, Value as Level};

/// The program under test.
pub const PROGRAM: &str = env!("CARGO_BIN_EXE_motion-rtl");

/// 10 mm along X with the pen down.
pub const LINE: &str = "PD400,0;";

/// Drawings and part programs, as faults list them.
pub const DRAWINGS: &str =
    "HPGL as .hpgl, .hpg, .plt or .hgl; G-code as .ngc, .gcode, .nc, .tap, .gc or .cnc";

/// Settings that make a run short: at the usual unit time a tenth of the ticks.
pub const SHORT: [&str; 4] = ["--set", "clock_hz=100000", "--set", "line_unit_ticks=500"];

/// An empty directory in which the program runs.
pub struct Bench {
    directory: TempDir,
}

/// What a command came to.
pub struct Done {
    pub code: i32,
    pub stdout: String,
    pub stderr: String,
}

impl Bench {
    pub fn new() -> Self {
        Bench {
            directory: tempfile::tempdir().unwrap(),
        }
    }

    /// With one file in it.
    pub fn with(name: &str, contents: impl AsRef<[u8]>) -> Self {
        let bench = Self::new();
        bench.write(name, contents);
        bench
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.directory.path().join(name)
    }

    pub fn write(&self, name: &str, contents: impl AsRef<[u8]>) {
        let path = self.path(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, contents).unwrap();
    }

    pub fn read(&self, name: &str) -> String {
        fs::read_to_string(self.path(name)).unwrap()
    }

    pub fn command(&self, arguments: &[&str]) -> Command {
        let mut command = Command::new(PROGRAM);
        command.current_dir(&self.directory).args(arguments);
        command
    }

    pub fn run(&self, arguments: &[&str]) -> Done {
        let output = self.command(arguments).output().unwrap();
        Done {
            code: output.status.code().expect("ended by a signal"),
            stdout: String::from_utf8(output.stdout).unwrap(),
            stderr: String::from_utf8(output.stderr).unwrap(),
        }
    }

    /// Runs what must succeed quietly, but for warnings and how far a long run is; gives its
    /// standard output.
    pub fn succeed(&self, arguments: &[&str]) -> String {
        let done = self.run(arguments);
        let told = |line: &&str| !is_progress(line) && !line.starts_with("warning: ");
        let said = done.stderr.lines().filter(told);
        let said: String = said.collect();
        assert_eq!((done.code, said.as_str()), (0, ""), "{arguments:?}");
        done.stdout
    }

    /// Runs with `--json` what must succeed quietly; its standard output must be one value.
    pub fn json(&self, arguments: &[&str]) -> Value {
        let text = self.succeed(&[arguments, &["--json"]].concat());
        serde_json::from_str(&text).unwrap()
    }

    /// Runs what must be refused with exactly this text first, and must leave no trace.
    #[track_caller]
    pub fn refuse(&self, arguments: &[&str], text: &str) {
        self.refuse_with(arguments, |stderr| {
            assert_eq!(
                stderr.lines().next(),
                Some(&*format!("error: {text}")),
                "{arguments:?}"
            );
            // Below it its line, and what else is wrong.
            for line in stderr.lines() {
                let of_excerpt = line.trim_start().trim_start_matches(char::is_numeric);
                assert!(
                    line.starts_with("error: ")
                        || line.contains("there may be more")
                        || of_excerpt.trim_start().starts_with('|'),
                    "{arguments:?}: {stderr}"
                );
            }
        });
    }

    /// Runs what must be refused, with code 2 and nothing left behind.
    pub fn refuse_with(&self, arguments: &[&str], check: impl Fn(&str)) {
        let before = self.names();
        let done = self.run(arguments);
        check(&done.stderr);
        assert_eq!((done.code, done.stdout.as_str()), (2, ""), "{arguments:?}");
        assert_eq!(self.names(), before, "{arguments:?} left something");
    }

    /// Everything in the directory, directories with a slash at the end; not the lists of what runs
    /// have written.
    pub fn names(&self) -> Vec<String> {
        let mut names = Vec::new();
        walk(self.directory.path(), "", &mut names);
        names.retain(|name| !name.ends_with(".motion-rtl-written"));
        names.sort();
        names
    }
}

/// The files of a circuit with its testbench, as they are listed; `stem` is directory and circuit.
pub fn testbench_files(stem: &str) -> [String; 7] {
    [
        ".v",
        "_tb.v",
        ".f",
        ".vcd",
        ".stimulus",
        ".expected",
        ".still",
    ]
    .map(|end| format!("{stem}{end}"))
}

/// The paths of the files that a summary names.
pub fn paths(summary: &Value) -> Value {
    let files = summary["files"].as_array().expect("a list of files");
    files.iter().map(|file| file["path"].clone()).collect()
}

/// A text without the sizes of the files that were written.
pub fn without_sizes(text: &str) -> String {
    let lines = text.split_inclusive('\n');
    let lines = lines.map(|line| match line.rsplit_once(" (") {
        Some((wrote, size)) if size.ends_with("B)\n") => format!("{wrote}\n"),
        _ => line.to_owned(),
    });
    lines.collect()
}

/// True if a line of standard error says how long a run takes, or how far it is.
pub fn is_progress(line: &str) -> bool {
    let seconds = line.split_once(" s: ").map(|(seconds, _)| seconds);
    let counted = seconds.is_some_and(|text| text.bytes().all(|digit| digit.is_ascii_digit()));
    counted || (line.contains(" ticks") && line.contains(", about "))
}

fn walk(directory: &Path, prefix: &str, names: &mut Vec<String>) {
    for entry in fs::read_dir(directory).unwrap() {
        let entry = entry.unwrap();
        let name = format!("{prefix}{}", entry.file_name().to_str().unwrap());
        if entry.file_type().unwrap().is_dir() {
            walk(&entry.path(), &format!("{name}/"), names);
            names.push(format!("{name}/"));
        } else {
            names.push(name);
        }
    }
}

/// The whole number at a JSON pointer.
#[track_caller]
pub fn whole(value: &Value, pointer: &str) -> i64 {
    let found = value.pointer(pointer);
    found
        .and_then(Value::as_i64)
        .unwrap_or_else(|| panic!("{pointer} is {found:?}"))
}

/// The number at a JSON pointer.
#[track_caller]
pub fn number(value: &Value, pointer: &str) -> f64 {
    let found = value.pointer(pointer);
    found
        .and_then(Value::as_f64)
        .unwrap_or_else(|| panic!("{pointer} is {found:?}"))
}

/// The list of that name in an object.
#[track_caller]
pub fn list<'a>(value: &'a Value, name: &str) -> &'a [Value] {
    let found = &value[name];
    found
        .as_array()
        .unwrap_or_else(|| panic!("{name} is {found:?}"))
}

/// The keys of an object, sorted.
pub fn keys(value: &Value) -> Vec<&str> {
    let mut keys: Vec<_> = value
        .as_object()
        .unwrap()
        .keys()
        .map(String::as_str)
        .collect();
    keys.sort_unstable();
    keys
}

#[track_caller]
pub fn near(value: f64, expected: f64, tolerance: f64) {
    assert!(
        (value - expected).abs() <= tolerance,
        "{value}, not {expected} within {tolerance}"
    );
}

/// The words of some signals in every tick of a VCD, by their paths; of one bit 0 and 1.
pub fn words(dump: &str, wanted: &[&str]) -> Vec<Vec<i64>> {
    let mut parser = Parser::new(dump.as_bytes());
    let header = parser.parse_header().unwrap();
    let mut codes = HashMap::new();
    let (top, _) = wanted[0].split_once('.').unwrap();
    let clock = header.find_var(&[top, "clk"]).unwrap().code;
    for (place, path) in wanted.iter().enumerate() {
        let (scope, name) = path.rsplit_once('.').unwrap();
        let scope: Vec<&str> = scope.split('.').collect();
        let scope = header.find_scope(&scope).unwrap();
        let var = scope.items.iter().find_map(|item| match item {
            ScopeItem::Var(var) if var.reference == name => Some(var),
            _ => None,
        });
        let var = var.unwrap();
        codes.insert(var.code, (place, 64 - var.size as usize));
    }
    let (mut now, mut ticks) = (vec![0; wanted.len()], Vec::new());
    for command in parser {
        match command.unwrap() {
            Change::ChangeVector(code, vector) => {
                let word = vector
                    .iter()
                    .fold(0u64, |word, bit| word << 1 | u64::from(bit == Level::V1));
                // Zeros in front are left out.
                if let Some(&(place, unused)) = codes.get(&code) {
                    now[place] = (word << unused) as i64 >> unused;
                }
            }
            Change::ChangeScalar(code, value) if code != clock => {
                if let Some(&(place, _)) = codes.get(&code) {
                    now[place] = i64::from(value == Level::V1);
                }
            }
            // When the clock falls, everything of the tick has been said.
            Change::ChangeScalar(_, Level::V0) => ticks.push(now.clone()),
            _ => {}
        }
    }
    ticks
}
