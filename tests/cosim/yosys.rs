//! The circuits in synthesis, and their assertions proved at full width.

use super::tools::{run, write};
use motion_rtl::circuits::blocks::MulDiv;
use motion_rtl::circuits::blocks::mul_div::Architecture;
use motion_rtl::registry::{AnyModel, Base, CATALOGUE, Entry};
use rayon::prelude::*;
use std::collections::HashMap;
use std::fmt::Write as _;
use std::path::Path;

/// The note of Verilog.
const VERILOG: &str = "rtl_notes/verilog.md";

/// Runs a script; returns what Yosys says.
#[track_caller]
fn yosys(circuit: &dyn AnyModel, script: impl Fn(&str) -> String) -> String {
    let directory = tempfile::tempdir().unwrap();
    let mut modules = write(directory.path(), &circuit.verilog().unwrap());
    // The result of Yosys depends on the order of the files: that of their names, as of `*.v`.
    modules.sort();
    let script = script(&modules.join(" "));
    run(directory.path(), "yosys", &["-p", &script])
}

/// The number of cells of a kind in the last statistics.
fn cells(said: &str, wanted: impl Fn(&str) -> bool) -> u64 {
    let last = said.rsplit("Number of cells:").next().unwrap_or_default();
    let rows = last.lines().skip(1).map_while(|line| {
        let (kind, count) = line.trim().split_once(' ')?;
        Some((kind, count.trim().parse::<u64>().ok()?))
    });
    rows.filter(|(kind, _)| wanted(kind))
        .map(|(_, count)| count)
        .sum()
}

/// Up to so many bytes of Verilog a circuit is measured again although its row stands: the tools
/// still say what the note says.
const SHORT: usize = 2_000;

/// LUTs, flip-flops, carries and block RAMs of every circuit at its own widths. A row of `old` whose
/// Verilog is what it was stands, if the same Yosys has measured it: large circuits take minutes.
fn synthesis(old: &str) -> String {
    let version = run(Path::new("."), "yosys", &["-V"]);
    let stand = old.starts_with(&version);
    let old: HashMap<&str, &str> = old
        .split_inclusive('\n')
        .filter_map(|row| Some((row.split('|').nth(1)?.trim().trim_matches('`'), row)))
        .filter(|_| stand)
        .collect();
    // The machine is the sum of its parts, which stand in the table one by one.
    let entries: Vec<&Entry> = CATALOGUE
        .iter()
        .filter(|entry| entry.name != "machine")
        .collect();
    // From the end of the catalogue: what takes longest is there.
    let rows = entries
        .par_iter()
        .with_max_len(1)
        .rev()
        .map(|entry| row(entry, old.get(entry.name).copied().unwrap_or_default()));
    let mut rows: Vec<String> = rows.collect();
    rows.reverse();
    format!(
        "{version}\n| circuit | widths | Verilog | LUTs | flip-flops | carries | block RAMs |\n\
         |---|---|---|---|---|---|---|\n{}",
        rows.concat()
    )
}

/// A row of the table: `old`, if it is of the same circuit.
fn row(entry: &Entry, old: &str) -> String {
    let circuit = entry.full();
    let name = circuit.name();
    let widths = entry.sizes(Base::Full, &[]).into_iter();
    let widths: Vec<String> = widths
        .map(|(name, bits)| format!("{name} = {bits}"))
        .collect();
    let sources = circuit.verilog().unwrap().sources();
    let text: String = sources
        .iter()
        .flat_map(|source| code(&source.text))
        .collect();
    let begin = format!("| `{name}` | {} | {:016x} |", widths.join(", "), fnv(&text));
    if text.len() > SHORT && old.starts_with(&begin) {
        return old.to_owned();
    }
    let said = yosys(&*circuit, |files| {
        format!("read_verilog {files}; synth_ice40 -top {name}; stat")
    });
    let warnings: Vec<&str> = said
        .lines()
        .filter(|line| line.starts_with("Warning:"))
        // A shift register is flip-flops; no other memory may become them.
        .filter(|line| !line.contains(r"Replacing memory \stages with list of registers"))
        .collect();
    assert!(warnings.is_empty(), "{name}: {warnings:#?}");
    let count = |kind: &'static str| cells(&said, move |cell| cell.starts_with(kind));
    format!(
        "{begin} {} | {} | {} | {} |\n",
        count("SB_LUT4"),
        count("SB_DFF"),
        count("SB_CARRY"),
        count("SB_RAM40"),
    )
}

/// The lines of a file without comments and assertions.
fn code(text: &str) -> impl Iterator<Item = &str> {
    let mut formal = false;
    let lines = text.lines().filter(move |line| {
        let begins = line.trim() == "`ifdef FORMAL";
        let ends = formal && line.trim() == "`endif";
        let skipped = formal || begins;
        formal = (formal || begins) && !ends;
        !skipped
    });
    let lines = lines.filter_map(|line| line.split("//").next());
    let lines = lines.map(str::trim_end).filter(|line| !line.is_empty());
    lines.flat_map(|line| [line, "\n"])
}

/// FNV-1a of a text.
fn fnv(text: &str) -> u64 {
    text.bytes().fold(0xcbf2_9ce4_8422_2325, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x100_0000_01b3)
    })
}

/// Circuits whose assertions Yosys does not decide in a minute: they have products, or many words of
/// memory.
const UNDECIDED: &[&str] = &[
    "pattern_memory",
    "position_control",
    "position_history",
    "ram_history",
    "target_data",
];

/// The assertions of every circuit that has some and no parts, proved by induction at its own
/// widths.
fn induction() -> String {
    let mut text = String::from(
        "| circuit | assertions | `check`: every state and input at | Yosys: by induction at |\n\
         |---|---|---|---|\n",
    );
    for entry in CATALOGUE {
        let circuit = entry.full();
        let verilog = circuit.verilog().unwrap();
        let names = verilog.assertions();
        let module = verilog.design().modules.last().unwrap();
        if names.is_empty() || !module.instances.is_empty() {
            continue;
        }
        let name = circuit.name();
        if entry.proved {
            let small = entry.proof(&[]).unwrap().invariants();
            for property in &names {
                assert!(small.iter().any(|invariant| invariant == property));
            }
        }
        let [proof_widths, full_widths] = [Base::Small, Base::Full].map(|base| {
            let sizes = entry.sizes(base, &[]).into_iter();
            let sizes = sizes.map(|(key, bits)| format!("{key} = {bits}"));
            match sizes.collect::<Vec<_>>().join(", ") {
                none if none.is_empty() => "all there is".to_owned(),
                sizes => sizes,
            }
        });
        let proof_widths = match entry.proved {
            true => proof_widths,
            false => "too wide".to_owned(),
        };
        let full_widths = match UNDECIDED.contains(&name) {
            true => "not decided".to_owned(),
            false => {
                yosys(&*circuit, |files| {
                    format!(
                        "read_verilog -formal {files}; prep -top {name}; memory_map; async2sync; \
                         dffunmap; sat -tempinduct -prove-asserts -set-assumes -verify"
                    )
                });
                full_widths
            }
        };
        let _ = writeln!(
            text,
            "| `{name}` | {} | {proof_widths} | {full_widths} |",
            names.len(),
        );
    }
    text
}

/// Latency, cells and longest path of the multiplier-divider in each architecture.
fn architectures() -> String {
    let version = run(Path::new("."), "yosys", &["-V"]);
    let all = [
        Architecture::Radix2,
        Architecture::Radix4,
        Architecture::Combinational,
    ];
    let circuits = all.iter().flat_map(|&architecture| {
        [(4, 8), (8, 16), (16, 32)].map(|(multiplier, word)| MulDiv {
            multiplier,
            word,
            architecture,
        })
    });
    let circuits: Vec<_> = circuits.collect();
    let rows = circuits.par_iter().with_max_len(1).map(architecture);
    let rows: Vec<String> = rows.collect();
    format!(
        "{version}\n| architecture | M | Q | ticks | ticks with `product_only` | LUTs | \
         flip-flops | carries | gates of the longest path |\n\
         |---|---|---|---|---|---|---|---|---|\n{}",
        rows.concat()
    )
}

/// A row of the table of architectures.
fn architecture(circuit: &MulDiv) -> String {
    let key = toml::Value::try_from(circuit.architecture).unwrap();
    let said = yosys(circuit, |files| {
        format!("read_verilog {files}; synth_ice40 -top mul_div; stat")
    });
    let count = |kind: &'static str| cells(&said, move |cell| cell.starts_with(kind));
    let said = yosys(circuit, |files| {
        format!("read_verilog {files}; synth -top mul_div; ltp -noff")
    });
    let (_, path) = said
        .split_once("Longest topological path in mul_div (length=")
        .unwrap();
    let (path, _) = path.split_once(')').unwrap();
    format!(
        "| `{}` | {} | {} | {} | {} | {} | {} | {} | {path} |\n",
        key.as_str().unwrap(),
        circuit.multiplier,
        circuit.word,
        circuit.latency(),
        circuit.product_latency(),
        count("SB_LUT4"),
        count("SB_DFF"),
        count("SB_CARRY"),
    )
}

/// Compares the text between the marks of a note with the tools' present output.
#[track_caller]
fn measured(note: &str, what: &str, fresh: impl FnOnce(&str) -> String) {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let path = root.join(note);
    let note = std::fs::read_to_string(&path).unwrap();
    let begin = format!("<!-- begin measured: {what} -->\n");
    let (before, rest) = note.split_once(&begin).expect("the note has the mark");
    let (old, after) = rest
        .split_once("<!-- end measured -->")
        .expect("the mark ends");
    let fresh = fresh(old);
    if std::env::var_os("UPDATE_NOTES").is_some_and(|value| value == "1") {
        let text = format!("{before}{begin}{fresh}<!-- end measured -->{after}");
        std::fs::write(&path, text).unwrap();
    } else {
        assert_eq!(
            old, fresh,
            "UPDATE_NOTES=1 cargo test --release --test cosim -- --ignored"
        );
    }
}

#[test]
#[ignore = "needs Yosys"]
fn every_circuit_goes_through_synthesis_and_the_note_has_its_cells() {
    measured(VERILOG, "synthesis", synthesis);
}

#[test]
#[ignore = "needs Yosys"]
fn the_note_has_latency_cells_and_path_of_the_architectures_of_mul_div() {
    measured("rtl_notes/blocks/mul_div.md", "architectures", |_| {
        architectures()
    });
}

#[test]
#[ignore = "needs Yosys"]
fn assertions_are_proved_by_induction_at_full_width() {
    let table = induction();
    assert!(table.lines().count() >= 2 + 5, "{table}");
    measured(VERILOG, "induction", |_| table);
}

/// Checks that Yosys refutes the assertions of a circuit in which `from` is replaced by `to`.
#[track_caller]
fn refute(circuit: &dyn AnyModel, [from, to]: [&str; 2]) {
    let directory = tempfile::tempdir().unwrap();
    let name = circuit.name();
    write(directory.path(), &circuit.verilog().unwrap());
    let path = directory.path().join(format!("{name}.v"));
    let text = std::fs::read_to_string(&path).unwrap();
    assert!(text.contains(from), "{text}");
    std::fs::write(&path, text.replacen(from, to, 1)).unwrap();
    let script = format!(
        "read_verilog -formal {name}.v; prep -top {name}; async2sync; dffunmap; \
         sat -tempinduct -prove-asserts -maxsteps 20"
    );
    let said = run(directory.path(), "yosys", &["-p", &script]);
    assert!(said.contains("model found for base case: FAIL!"), "{said}");
}

#[test]
#[ignore = "needs Yosys"]
fn what_does_not_hold_is_refuted() {
    let make = |name, pairs: &[&str]| {
        let pairs: Vec<_> = pairs.iter().map(|pair| pair.parse().unwrap()).collect();
        motion_rtl::registry::find(name)
            .unwrap()
            .made(Base::Full, &pairs)
    };
    let counter = make("enable_counter", &["width=8"]).unwrap();
    refute(&*counter, ["next >= period", "next > period"]);
    refute(&*counter, ["count <= next", "count <= period"]);
    let generator = make("pulse_generator", &[]).unwrap();
    refute(&*generator, [" && half_period != 16'd0", ""]);
    refute(&*generator, ["pulse && !unit_rst", "pulse"]);
    refute(&*generator, ["next >= half_period", "next == half_period"]);
    let stage = make("sync_stage", &[]).unwrap();
    refute(&*stage, ["pulse && !unit_rst", "pulse"]);
    let port = make("command_port", &["address=4", "period=4"]).unwrap();
    refute(&*port, ["pending && !take", "pending"]);
    refute(&*port, ["valid && (ready || now)", "valid && ready"]);
    let sequencer = make("sequencer", &["position=8"]).unwrap();
    refute(&*sequencer, ["way_x < way_y", "way_x <= way_y"]);
    refute(&*sequencer, ["far_x || far_y", "far_x"]);
    refute(
        &*sequencer,
        [
            "wire [7:0] way_y = delta_y[7] ?",
            "wire [7:0] way_y = delta_y[6] ?",
        ],
    );
    refute(&*sequencer, ["(late || early)", "late"]);
    // The variant that the patent's words give.
    let literal = make("pulse_generator", &["variant=literal"]).unwrap();
    refute(&*literal, ["", ""]);
}
