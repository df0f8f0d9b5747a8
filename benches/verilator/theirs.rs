//! The exported Verilog, compiled by Verilator.

use motion_rtl::hdl::Circuit;
use motion_rtl::netlist::Role;
use motion_rtl::sim::RecordedInputs;
use motion_rtl::verilog::{SourceFile, Verilog};
use std::cell::RefCell;
use std::fmt::Write as _;
use std::fs::{self, File};
use std::io::{self, BufRead, BufReader, BufWriter, Write as _};
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};
use std::time::Duration;
use tempfile::TempDir;

/// Returns true if `verilator` is found and starts.
pub fn is_installed() -> bool {
    let version = Command::new("verilator").arg("--version").output();
    version.is_ok_and(|version| version.status.success())
}

/// Trace format of a Verilator build.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Build {
    Untraced,
    Vcd,
    Fst,
}

/// Programs that Verilator made. Circuits with the same Verilog share one, as a circuit at two clocks
/// often does.
pub struct Builds {
    directory: TempDir,
    /// Optimisation option of the C++ compiler.
    level: &'static str,
    /// Sources and directory of each build.
    built: RefCell<Vec<(Build, Vec<SourceFile>, PathBuf)>>,
}

impl Builds {
    /// None yet. Those that are run shortly are unoptimised.
    pub fn new(quick: bool) -> Self {
        Builds {
            directory: tempfile::tempdir().expect("room"),
            level: if quick { "-O0" } else { "-O3" },
            built: RefCell::default(),
        }
    }

    /// A place for a file.
    pub fn path(&self, name: &str) -> PathBuf {
        self.directory.path().join(name)
    }

    /// The directory of the program for a circuit, built where that is not done.
    fn program<C: Circuit>(&self, circuit: &C, build: Build) -> PathBuf {
        let verilog = Verilog::new(circuit).expect("a circuit that can be printed");
        let sources = verilog.sources();
        let mut built = self.built.borrow_mut();
        let same = built
            .iter()
            .find(|(of, from, _)| *of == build && *from == sources);
        if let Some((_, _, directory)) = same {
            return directory.clone();
        }
        let directory = self.path(&built.len().to_string());
        self.verilate(circuit.name(), &verilog, build, &directory);
        built.push((build, sources, directory.clone()));
        directory
    }

    fn verilate(&self, top: &str, verilog: &Verilog, build: Build, directory: &Path) {
        fs::create_dir(directory).expect("a new directory");
        let mut files = vec!["harness.cpp".to_owned()];
        for source in verilog.sources() {
            let text = shift_in_one_block(&source.text);
            fs::write(directory.join(&source.name), text).expect("room");
            if source.name.ends_with(".v") {
                files.push(source.name);
            }
        }
        fs::write(directory.join("harness.cpp"), include_str!("harness.cpp")).expect("room");
        fs::write(directory.join("ports.h"), ports(verilog)).expect("room");
        let mut options: Vec<String> = OPTIONS.map(str::to_owned).to_vec();
        options.extend(["--top-module".to_owned(), top.to_owned()]);
        let flags = format!("{} -DSELDOM={}", self.level, super::SELDOM);
        options.extend(["-CFLAGS".to_owned(), flags]);
        match build {
            Build::Untraced => {}
            Build::Vcd => options.extend(TRACE.map(str::to_owned)),
            Build::Fst => {
                options.extend(TRACE.map(str::to_owned));
                options.push("--trace-fst".to_owned());
            }
        }
        command(
            Command::new("verilator").args(options).args(files),
            directory,
        );
        let levels = LEVELS.map(|name| format!("{name}={}", self.level));
        let make = ["-C", "obj_dir", "-f", "Vtop.mk", "-j", "2"];
        command(Command::new("make").args(make).args(levels), directory);
    }
}

/// A Verilated circuit that waits for commands.
pub struct Verilated {
    child: Child,
    commands: Option<ChildStdin>,
    answers: BufReader<ChildStdout>,
}

/// Bits by which the ports of a checksum are rotated against each other.
pub const ROTATION: u32 = 7;

impl Verilated {
    /// Exports, compiles and starts a circuit; waves are those from tick `traced_from` on.
    pub fn new<C: Circuit>(
        builds: &Builds,
        circuit: &C,
        stimulus: &RecordedInputs,
        traced_from: u64,
        build: Build,
    ) -> Self {
        let directory = builds.program(circuit, build);
        write(stimulus, &directory.join("stimulus")).expect("room");
        let mut child = Command::new(directory.join("obj_dir/Vtop"))
            .arg("stimulus")
            .args([stimulus.ticks, traced_from].map(|tick| tick.to_string()))
            .current_dir(directory)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .expect("a program");
        Verilated {
            commands: child.stdin.take(),
            answers: BufReader::new(child.stdout.take().expect("a pipe")),
            child,
        }
    }

    fn ask(&mut self, command: &str) -> (Duration, u64) {
        let commands = self.commands.as_mut().expect("a pipe");
        writeln!(commands, "{command}").expect("a running program");
        let mut answer = String::new();
        self.answers.read_line(&mut answer).expect("an answer");
        let mut numbers = answer
            .split_whitespace()
            .map(|word| word.parse().expect("a number"));
        let taken = Duration::from_nanos(numbers.next().expect("a time"));
        (taken, numbers.next().expect("a sum"))
    }

    /// A run, and the checksum over the outputs of every tick, or of every so many.
    pub fn run(&mut self, every: u64) -> (Duration, u64) {
        self.ask(if every == 1 { "every" } else { "seldom" })
    }

    /// A run with waves of its end, and the checksum.
    pub fn dump(&mut self, path: &Path) -> (Duration, u64) {
        self.ask(&path.display().to_string())
    }
}

impl Drop for Verilated {
    fn drop(&mut self) {
        self.commands = None;
        let _ = self.child.wait();
    }
}

/// Writes the inputs for the Verilated model: 16 bytes a change.
fn write(inputs: &RecordedInputs, path: &Path) -> io::Result<()> {
    let mut out = BufWriter::new(File::create(path)?);
    for change in &inputs.changes {
        out.write_all(&(change.tick as u32).to_le_bytes())?;
        out.write_all(&(change.port as u32).to_le_bytes())?;
        out.write_all(&change.word.to_le_bytes())?;
    }
    // A change that comes in no tick is the end.
    out.write_all(&u32::MAX.to_le_bytes())?;
    out.write_all(&[0; 12])?;
    out.into_inner()?.sync_data()
}

fn command(command: &mut Command, directory: &Path) {
    let output = command
        .current_dir(directory)
        .output()
        .expect("Verilator and make");
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{command:?}: {said}");
}

const OPTIONS: [&str; 13] = [
    "--cc",
    "--exe",
    "-O3",
    "--prefix",
    "Vtop",
    "--x-assign",
    "fast",
    "--x-initial",
    "fast",
    "--noassert",
    // Verilator takes no non-blocking assignment in a loop that is not unrolled.
    "--unroll-count",
    "256",
    "-Wno-fatal",
];

/// `verilated.mk` has `-Os` of its own behind what `-CFLAGS` says.
const LEVELS: [&str; 3] = ["OPT_FAST", "OPT_SLOW", "OPT_GLOBAL"];

/// The stages of a shift register are dumped, as ours are; larger memories are in our waves only.
const TRACE: [&str; 3] = ["--trace", "--trace-max-array", "256"];

/// `apply` and `outputs` of the harness.
fn ports(verilog: &Verilog) -> String {
    let top = verilog.design().modules.last().expect("a module");
    let ports = top.signals.iter().filter(|signal| signal.is_port());
    let (mut apply, mut outputs) = (String::new(), String::new());
    let (mut port, mut place) = (0, 0);
    for signal in ports {
        let name = &signal.name;
        if signal.role == Role::Input {
            let _ = writeln!(apply, "    case {port}: top.{name} = value; break;");
            port += 1;
        } else {
            let _ = writeln!(outputs, "    sum ^= rotated(top.{name}, {place});");
            place = (place + ROTATION) % 64;
        }
    }
    format!(
        "static inline void apply(Vtop& top, uint32_t port, uint64_t value) {{\n    \
         switch (port) {{\n{apply}    }}\n}}\n\n\
         static inline uint64_t outputs(const Vtop& top) {{\n    \
         uint64_t sum = 0;\n{outputs}    return sum;\n}}\n"
    )
}

/// A shift register as a loop in one block: generated blocks, one for each stage, Verilator would
/// run much slower.
fn shift_in_one_block(text: &str) -> String {
    let mut lines = Vec::new();
    let mut text = text.lines().peekable();
    while let Some(line) = text.next() {
        let generated = line.trim() == "generate";
        match text
            .peek()
            .and_then(|line| line.trim().strip_prefix("genvar "))
        {
            Some(stage) if generated => {
                lines.push(format!("integer {stage}"));
                lines.push("always @(posedge clk)".to_owned());
                let inner = text.by_ref().skip(1);
                let inner = inner.take_while(|line| line.trim() != "endgenerate");
                lines.extend(
                    inner
                        .filter(|line| !line.contains("always"))
                        .map(str::to_owned),
                );
            }
            _ => lines.push(line.to_owned()),
        }
    }
    lines.join("\n") + "\n"
}
