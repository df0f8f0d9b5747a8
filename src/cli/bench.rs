//! `verilog` and `vhdl`: a circuit in an HDL, with a testbench if one is asked for.

use super::chosen::Chosen;
use super::export::{Export, Printed};
use super::files::{self, Files};
use super::from_waves::FromWaves;
use super::names::Names;
use super::{Failure, print, warn};
use clap::Args;
use motion_rtl::check::{Drive, Untoggled, play};
use motion_rtl::engine::EngineError;
use motion_rtl::input::stimulus::{InputPort, PortInputs, read_path};
use motion_rtl::registry::AnyModel;
use motion_rtl::sim::RunError;
use motion_rtl::trace::Clock;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

/// Arguments that a checker has no use for. Clap does not ask for what an argument requires if that
/// conflicts with another one, so those of a testbench are here too.
pub const UNUSED: [&str; 7] = [
    "bench",
    "clock_hz",
    "ignore_case",
    "scope",
    "seed",
    "skip",
    "ticks",
];

/// A circuit and the files that are written of it.
#[derive(Debug, Args)]
pub struct Bench {
    #[command(flatten)]
    pub chosen: Chosen,
    /// Directory for the files.
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,
    /// Also writes a testbench, a stimulus of TICKS ticks, the expected output ports, the golden
    /// waves, and a list of the signals that never changed in them.
    #[arg(long, value_name = "TICKS", group = "bench", allow_negative_numbers = true, value_parser = clap::value_parser!(u64).range(2..=100_000_000))]
    testbench: Option<u64>,
    /// Also writes the files of --testbench, with your own inputs: a .csv with names of ports in its
    /// head and a line per tick, or a .stimulus.
    #[arg(
        long,
        value_name = "FILE",
        group = "bench",
        conflicts_with = "testbench"
    )]
    stimulus: Option<PathBuf>,
    #[command(flatten)]
    waves: FromWaves,
    #[command(flatten)]
    pub names: Names,
    /// Clock of the golden waves.
    #[arg(
        long,
        value_name = "HZ",
        allow_negative_numbers = true,
        requires = "bench"
    )]
    clock_hz: Option<u64>,
    /// Seed of the random stimulus.
    #[arg(
        long,
        value_name = "NUMBER",
        allow_negative_numbers = true,
        default_value_t = 1,
        requires = "testbench",
        conflicts_with_all = ["stimulus", "from_waves"]
    )]
    seed: u64,
}

/// Returns the error of a circuit that cannot be printed.
pub fn unprinted(error: &EngineError) -> Failure {
    Failure::Argument {
        field: "CIRCUIT",
        problem: error.to_string(),
        allowed: "circuits that can be printed".into(),
    }
}

/// Writes a printed circuit and, if requested, its testbench. The command is `verilog` or `vhdl`.
pub fn write(
    arguments: &Bench,
    circuit: &dyn AnyModel,
    printed: Printed<'_>,
    command: &str,
) -> Result<(), Failure> {
    for (read, extension) in [
        (arguments.stimulus.as_deref(), "stimulus"),
        (arguments.waves.path(), "vcd"),
    ] {
        let written = arguments
            .out
            .join(format!("{}.{extension}", circuit.name()));
        files::spare("--out", &written, read, "another directory")?;
    }
    let mut files = Files::begin(&arguments.out, circuit.name())?;
    let mut text = String::new();
    let name = format!("{command} {}", arguments.chosen);
    let clock = clock(arguments)?;
    let played = played(arguments, circuit, printed)?;
    let bench = (arguments.testbench.is_some() || played.is_some()).then_some(clock);
    files.export(Export::new(printed, bench, name))?;
    if bench.is_some() {
        let mut waves = files.create("vcd")?;
        let mut stimulus = files.create("stimulus")?;
        let mut expected = files.create("expected")?;
        let outputs = (&mut waves, &mut stimulus, &mut expected);
        let (what, driven) = match (&played, arguments.testbench) {
            (Some(Played { file, inputs, .. }), _) => {
                let elaborated = circuit.model().map_err(RunError::from)?;
                let driven = play(&elaborated, inputs, clock, outputs.0, outputs.1, outputs.2)?;
                let what = format!("{} ticks of {}", inputs.ticks(), file.display());
                (what, driven)
            }
            (None, ticks) => {
                let drive = Drive {
                    seed: arguments.seed,
                    ticks: ticks.unwrap_or_default(),
                    resets: true,
                    bounded: false,
                    clock,
                };
                let driven = circuit.drive(&drive, outputs.0, outputs.1, outputs.2)?;
                (
                    format!("{} ticks of seed {}", drive.ticks, drive.seed),
                    driven,
                )
            }
        };
        for file in [waves, stimulus, expected] {
            files.push(file);
        }
        let (seen, bits) = driven.coverage.bits();
        let still: Vec<_> = driven.coverage.still().collect();
        let lines = still.iter().map(|signal| match signal.width {
            1 => format!("{}\n", signal.path),
            width => format!("{} [{}:0]\n", signal.path, width - 1),
        });
        files.write("still", &lines.collect::<String>())?;
        // Writing to a string does not fail.
        let _ = writeln!(
            text,
            "{what}, {} of them with rst; {seen} of {bits} bits were 0 and 1",
            driven.resets
        );
        let signals = driven.coverage.signals();
        let _ = writeln!(text, "{}", never_changed(&still, signals, circuit.name()));
        if let Some(Played { inputs, source, .. }) = &played {
            text += source;
            if !inputs.low.is_empty() {
                let _ = writeln!(text, "ports that stay low: {}", inputs.low.join(", "));
            }
        }
        let _ = writeln!(
            text,
            "a word of the stimulus, from bit 0: {}",
            word(printed)
        );
    }
    for path in files.commit()? {
        let _ = writeln!(text, "{path}");
    }
    let testbench = format!("{}_tb{}", circuit.name(), printed.extension());
    let testbench = arguments.out.join(testbench);
    if bench.is_none() && testbench.exists() {
        warn(&format!(
            "{} is of an earlier export and need not fit this one",
            testbench.display()
        ));
    }
    print(&text)
}

/// Inputs of the user, to be played.
struct Played<'a> {
    file: &'a Path,
    inputs: PortInputs,
    /// Lines that say which part of the file they are.
    source: String,
}

/// Reads the inputs of the user, if there are any.
fn played<'a>(
    arguments: &'a Bench,
    circuit: &dyn AnyModel,
    printed: Printed<'_>,
) -> Result<Option<Played<'a>>, Failure> {
    let Bench { waves, names, .. } = arguments;
    if let Some(file) = waves.path() {
        let model = circuit.model().map_err(RunError::from)?;
        let taken = waves.read(file, names, &model)?;
        if let Some(reset) = &taken.possible_reset {
            warn(&format!(
                "{}: {reset} has the name of a reset, but the circuit gets no reset; allowed: --reset \
                 NAME, --reset '!NAME' if it is active low, or --reset none",
                file.display()
            ));
        }
        let golden = arguments.out.join(format!("{}.vcd", circuit.name()));
        return Ok(Some(Played {
            file,
            source: waves.text(file, names, &taken, &golden),
            inputs: taken.inputs,
        }));
    }
    let read = |file: &'a PathBuf| {
        let inputs = read_path(file, &ports(circuit, printed))?;
        let source = String::new();
        Ok(Played {
            file,
            inputs,
            source,
        })
    };
    arguments.stimulus.as_ref().map(read).transpose()
}

/// Returns the input ports with their names in waves and in Verilog.
pub fn ports(circuit: &dyn AnyModel, printed: Printed<'_>) -> Vec<InputPort> {
    let inputs = printed.top().into_iter().flat_map(|module| module.inputs());
    let declared = circuit.outline().leaves;
    let ports = inputs.zip(&declared).map(|(port, leaf)| InputPort {
        name: leaf.names().skip(1).collect::<Vec<_>>().join("."),
        verilog: port.name.clone(),
        shape: port.shape,
    });
    ports.collect()
}

/// Most signals that are named beside their count.
const NAMED: usize = 4;

/// Formats which of a circuit's signals never changed.
fn never_changed(still: &[Untoggled], signals: usize, name: &str) -> String {
    if still.is_empty() {
        return format!("each of {signals} signals changed");
    }
    let count = still.len();
    let named = still.iter().take(NAMED).map(|signal| &*signal.path);
    let named = named.collect::<Vec<_>>().join(", ");
    let more = match count.checked_sub(NAMED) {
        None | Some(0) => String::new(),
        Some(more) => format!(" and {more} more, which {name}.still lists"),
    };
    format!("{count} of {signals} signals never changed: {named}{more}")
}

fn clock(arguments: &Bench) -> Result<Clock, Failure> {
    let Some(hz) = arguments.clock_hz else {
        return Ok(Clock::default());
    };
    Clock::from_hz(hz).map_err(|error| Failure::Argument {
        field: "--clock-hz",
        problem: format!("is {}", error.hz),
        allowed: format!("1 to {} Hz", Clock::MAX_HZ),
    })
}

/// Returns the layout of a stimulus word: the circuit's input ports and their bits, lowest first.
fn word(printed: Printed<'_>) -> String {
    let mut low = 0;
    let mut parts = Vec::new();
    let inputs = printed.top().into_iter();
    for input in inputs.flat_map(|module| module.inputs()) {
        let width = input.shape.width;
        parts.push(match width {
            1 => format!("{} [{low}]", input.name),
            _ => format!("{} [{}:{low}]", input.name, low + width - 1),
        });
        low += width;
    }
    parts.push(format!("rst [{low}]"));
    parts.join(", ")
}
