//! The note on the crate as a golden model: its commands are run in their order, and what they
//! print is what stands below them. `UPDATE_NOTES=1` writes that anew.

use super::tools::run;
use motion_rtl::compare::{Map, Report, Settings, compare};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use tempfile::TempDir;

/// The program of the note.
mod own_stimulus {
    include!("../../rtl_notes/golden_model/own_stimulus.rs");
}

const NOTE: &str = "rtl_notes/golden_model.md";
const FILES: &str = "rtl_notes/golden_model";
const GHOSTS: [&str; 6] = [
    "unit_law.pulses",
    "unit_law.lagged",
    "unit_law.toggles",
    "unit_law.rest",
    "unit_law.counted",
    "unit_law.ends",
];

/// Shell functions for the commands of the note: the program as it was built, and no window.
const SHELL: &str = r#"
cargo() {
    [[ "$1 $2 $3" == "run --release --" ]] || { echo "cargo $*: not known to this test"; exit 9; }
    "$MOTION_RTL" "${@:4}"
}
gtkwave() {
    [[ $# == 1 && -s $1 ]] || { echo "gtkwave $*: no file"; exit 9; }
}
"#;

fn checkout() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// A folder with the files of the note where the note has them.
fn folder() -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    let files = folder.path().join(FILES);
    fs::create_dir_all(&files).unwrap();
    for entry in fs::read_dir(checkout().join(FILES)).unwrap() {
        let entry = entry.unwrap();
        fs::copy(entry.path(), files.join(entry.file_name())).unwrap();
    }
    folder
}

/// Runs commands; what they print, and whether all went well.
fn shell(folder: &Path, commands: &str) -> (String, bool) {
    let output = Command::new("bash")
        .args(["-c", &format!("set -e\nexec 2>&1\n{SHELL}\n{commands}")])
        .env("MOTION_RTL", env!("CARGO_BIN_EXE_motion-rtl"))
        .current_dir(folder)
        .output()
        .unwrap();
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    (text, output.status.success())
}

/// A fenced block of the note.
struct Block<'a> {
    language: &'a str,
    text: &'a str,
    /// Where its text begins and ends in the note.
    range: std::ops::Range<usize>,
    /// Nothing but an empty line is between it and the block before.
    follows: bool,
}

fn blocks(note: &str) -> Vec<Block<'_>> {
    let mut blocks = Vec::new();
    let (mut place, mut behind) = (0, 0);
    let mut open: Option<(&str, usize, bool)> = None;
    for line in note.split_inclusive('\n') {
        let end = place + line.len();
        if let Some(mark) = line.strip_prefix("```") {
            match open.take() {
                None => {
                    let follows = !blocks.is_empty() && note[behind..place].trim().is_empty();
                    open = Some((mark.trim(), end, follows));
                }
                Some((language, start, follows)) => {
                    let range = start..place;
                    let text = &note[start..place];
                    blocks.push(Block {
                        language,
                        text,
                        range,
                        follows,
                    });
                    behind = end;
                }
            }
        }
        place = end;
    }
    assert!(open.is_none(), "a block of the note has no end");
    blocks
}

/// The note as it has to be: every command run, every file that it shows as it is.
fn fresh(note: &str, folder: &Path) -> String {
    let mut fresh = String::new();
    let mut written = 0;
    let file = |name: &str| fs::read_to_string(checkout().join(FILES).join(name)).unwrap();
    let all = blocks(note);
    for (index, block) in all.iter().enumerate() {
        let before = index.checked_sub(1).map(|before| &all[before]);
        let (place, text) = match block.language {
            "sh" => {
                let (said, well) = shell(folder, block.text);
                let answer = all
                    .get(index + 1)
                    .filter(|next| next.follows && next.language == "text");
                let expected = !answer.is_some_and(|answer| answer.text.contains("error: "));
                assert_eq!(well, expected, "{}\n{said}", block.text);
                let Some(answer) = answer else {
                    assert_eq!(said, "", "{}", block.text);
                    continue;
                };
                (answer.range.clone(), said)
            }
            "text" => {
                let command = block.follows && before.is_some_and(|block| block.language == "sh");
                assert!(command, "no command prints\n{}", block.text);
                continue;
            }
            "toml" => (block.range.clone(), file("names.toml")),
            "rust" => (block.range.clone(), file("own_stimulus.rs")),
            chart if chart.starts_with("chart ") => continue,
            other => panic!("{other}: a block that this test does not check"),
        };
        fresh += &note[written..place.start];
        fresh += &text;
        written = place.end;
    }
    fresh + &note[written..]
}

/// Compares a note with what its commands print, or writes it anew.
#[track_caller]
fn keep(path: &str, note: &str, fresh: &str) {
    if fresh != note && std::env::var_os("UPDATE_NOTES").is_some_and(|value| value == "1") {
        return fs::write(checkout().join(path), fresh).unwrap();
    }
    let mut lines = fresh.lines().zip(note.lines()).zip(1..);
    let other = lines.find(|((fresh, old), _)| fresh != old);
    if let Some(((fresh, old), line)) = other {
        panic!(
            "{path}:{line}: not what is printed:\n  {old}\n  {fresh}\n  UPDATE_NOTES=1 cargo test \
             --release --test cosim note_shows -- --ignored writes it anew"
        );
    }
    assert_eq!(fresh, note);
}

/// Runs the commands of another note in such a folder, and compares what they print.
#[track_caller]
pub fn hold_note(path: &str) {
    let note = fs::read_to_string(checkout().join(path)).unwrap();
    let folder = folder();
    let fresh = fresh(&note, folder.path());
    keep(path, &note, &fresh);
}

fn hold(golden: PathBuf, other: PathBuf, map: &str) -> Report {
    let map = Map::parse("names.toml", map).unwrap();
    let settings = Settings {
        map,
        ..Settings::default()
    };
    compare(&golden, &other, &settings).unwrap_or_else(|fault| panic!("{fault}"))
}

fn names() -> String {
    fs::read_to_string(checkout().join(FILES).join("names.toml")).unwrap()
}

/// Every signal but the ghosts was compared in every tick.
#[track_caller]
fn complete(report: &Report, ticks: u64) {
    assert_eq!(report.ticks, ticks, "{report}");
    assert_eq!(report.signals, 19, "{report}");
    assert_eq!(report.values, ticks * 19, "{report}");
    assert_eq!(report.unknown_values, 0, "{report}");
    assert_eq!(report.ignored, GHOSTS, "{report}");
    assert_eq!(report.without_partner, Vec::<String>::new(), "{report}");
    assert!(report.different_widths.is_empty(), "{report}");
    assert!(report.too_wide.is_empty(), "{report}");
}

#[test]
#[ignore = "needs Icarus Verilog, Verilator and GHDL"]
fn the_note_shows_what_its_commands_print() {
    let note = fs::read_to_string(checkout().join(NOTE)).unwrap();
    let folder = folder();
    let fresh = fresh(&note, folder.path());

    // The results that the run must have, whatever the note says.
    let build = folder.path().join("build");
    let golden = build.join("unit_law/unit_law.vcd");
    let held = |run: &str, map: &str| {
        let other = build.join(run).join("step_channel_tb.vcd");
        hold(golden.clone(), other, map)
    };
    for run in ["icarus", "verilator", "fst"] {
        let report = held(run, &names());
        complete(&report, 20_000);
        assert!(report.is_equal(), "{run}: {report}");
    }
    let wide = fs::read_to_string(build.join("wide.toml")).unwrap();
    assert_eq!(wide.matches("[15:0]").count(), 5, "{wide}");
    let report = held("wide", &wide);
    complete(&report, 20_000);
    assert!(report.is_equal(), "{report}");
    let report = held("late", &names());
    complete(&report, 20_000);
    let first = report.first.as_ref().expect("the fault is found");
    assert_eq!((first.tick, first.signals), (88, 3), "{report}");
    assert_eq!(first.golden, "unit_law.generator.equal", "{report}");
    assert_eq!(first.other, "step_channel_tb.dut.u_edges.due", "{report}");
    assert_eq!(
        (&*first.golden_value, &*first.other_value),
        ("1", "0"),
        "{report}"
    );
    assert_eq!(report.differences.len(), 8, "{report}");

    keep(NOTE, &note, &fresh);
}

/// Runs the design of the note, with one text of it replaced, on the stimulus in `run`.
fn simulate(folder: &Path, run_in: &str, change: Option<(&str, &str, &str)>) {
    let target = folder.join(run_in);
    let mut files = vec!["step_channel_tb.v".to_owned()];
    for name in [
        "tick_timer.v",
        "edge_maker.v",
        "line_reg.v",
        "step_channel.v",
    ] {
        let mut text = fs::read_to_string(folder.join(FILES).join(name)).unwrap();
        if let Some((_, from, to)) = change.filter(|change| change.0 == name) {
            assert_eq!(text.matches(from).count(), 1, "{name}: {from}");
            text = text.replace(from, to);
        }
        fs::write(target.join(name), text).unwrap();
        files.push(name.to_owned());
    }
    fs::copy(folder.join(FILES).join(&files[0]), target.join(&files[0])).unwrap();
    let files: Vec<&str> = files.iter().map(String::as_str).collect();
    let options = ["-g2001", "-o", "sim"];
    run(&target, "iverilog", &[&options[..], &files].concat());
    run(&target, "vvp", &["-n", "sim"]);
}

/// The places where the design resets its registers.
const RESETS: [(&str, &str, &str); 5] = [
    ("tick_timer.v", "srst || ", ""),
    ("edge_maker.v", "srst || i_lap || due", "i_lap || due"),
    ("edge_maker.v", "if (srst || i_lap) ", "if (i_lap) "),
    ("line_reg.v", "srst | ", ""),
    ("step_channel.v", "if (srst)", "if (1'b0)"),
];

/// Number of resets that could be left out unnoticed, on the stimulus of this command; and the
/// ticks in which that has a reset.
fn unseen(command: &str) -> (usize, Vec<usize>) {
    let folder = folder();
    let (said, well) = shell(folder.path(), command);
    assert!(well, "{said}");
    let run = folder.path().join("build/unit_law");
    let equal = RESETS.iter().filter(|&&change| {
        simulate(folder.path(), "build/unit_law", Some(change));
        let [golden, other] = ["unit_law", "step_channel_tb"].map(|n| run.join(n));
        let [golden, other] = [golden, other].map(|path| path.with_extension("vcd"));
        let report = hold(golden, other, &names());
        complete(&report, 20_000);
        report.is_equal()
    });
    let equal = equal.count();
    let stimulus = fs::read_to_string(run.join("unit_law.stimulus")).unwrap();
    let lines = stimulus.lines().enumerate();
    let resets = lines.filter(|(_, line)| line.starts_with('1'));
    (equal, resets.map(|(tick, _)| tick).collect())
}

#[test]
#[ignore = "needs Icarus Verilog"]
fn a_reset_that_is_left_out_is_found_with_the_stimulus_of_the_note() {
    let note = fs::read_to_string(checkout().join(NOTE)).unwrap();
    let all = blocks(&note);
    let first = all.iter().find(|block| block.language == "sh").unwrap();
    let (missed, resets) = unseen(first.text);
    assert_eq!(missed, 0, "{resets:?}");
}

#[test]
#[ignore = "needs Icarus Verilog"]
fn the_design_equals_the_model_on_a_stimulus_of_ones_own() {
    let folder = folder();
    let run = folder.path().join("own");
    fs::create_dir(&run).unwrap();
    own_stimulus::write(&run).unwrap();
    simulate(folder.path(), "own", None);
    let report = hold(
        run.join("unit_law.vcd"),
        run.join("step_channel_tb.vcd"),
        &names(),
    );
    complete(&report, 4000);
    assert!(report.is_equal(), "{report}");
}

#[test]
fn blocks_are_found() {
    let note = "a\n```sh\nx\ny\n```\n\n```text\nz\n```\nb\n```text\n```\n";
    let found: Vec<_> = blocks(note)
        .iter()
        .map(|block| (block.language, block.text, block.follows))
        .collect();
    let expected = [
        ("sh", "x\ny\n", false),
        ("text", "z\n", true),
        ("text", "", false),
    ];
    assert_eq!(found, expected);
}
