//! Commands that the documents show: each is run, and each filter of `cargo test` selects a test.
//!
//! `.ci/run` itself runs the README's first two commands, `mutate` and the benches;
//! `cosim::golden_model` runs those of `golden_model.md` and compares what they print,
//! `cosim::equal` those of `equal.md`, `cosim::dpi` those of the page on SystemVerilog, and tests in
//! `bindings` those of the pages on other languages.

use rayon::prelude::*;
use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use std::process::Command;

const CHECKOUT: &str = env!("CARGO_MANIFEST_DIR");

/// The words of a document's commands in a shell: the program as it is built, no window, and
/// nothing for steps that `.ci/run` does by itself.
const SHELL: &str = r#"
program() {
    case "$*" in
        mutate) ;;
        # Serves until it is ended; tests of its page run it.
        serve) ;;
        # All of it takes minutes: a part.
        "check integrator --width 8") "$MOTION_RTL" "$@" --shard 1/64 ;;
        *) "$MOTION_RTL" "$@" ;;
    esac
}
cargo() {
    case "$1" in
        run)
            [[ "$2" == --release ]] || { echo "cargo $*: without --release"; return 9; }
            # Features that are off by default are built by `.ci/run`.
            [[ $# == 2 || "$3" == --features ]] || program "${@:4}" ;;
        bench | check | clippy | fmt | test) ;;
        *) echo "cargo $*: not known to this test"; return 9 ;;
    esac
}
gtkwave() {
    local file
    for file; do [[ -s $file ]] || { echo "gtkwave: no $file"; return 9; }; done
}
motion-rtl() { program "$@"; }
target/release/motion-rtl() { program "$@"; }
/usr/bin/time() { "${@:2}"; }
.ci/run() { :; }
.ci/pictures() { :; }
"#;

/// Files that the reader brings, and how they are made here.
const BROUGHT: [(&str, &str); 2] = [
    (
        "waves/bracket.vcd",
        "cargo run --release -- run waves/bracket.toml",
    ),
    ("tb.vcd", "cp waves/bracket.vcd tb.vcd"),
];

/// Documents whose commands are run elsewhere, and a folder of such documents.
const RUN_ELSEWHERE: [&str; 3] = [
    "rtl_notes/golden_model.md",
    "rtl_notes/equal.md",
    "rtl_notes/bindings/",
];

/// Circuits that the walk-through has the reader write.
const CIRCUITS_OF_THE_READER: [&str; 2] = ["debouncer", "limit_switch"];

/// Commands that show how something fails: what they end with.
const FAILS: [(&str, i32); 2] = [
    ("check unit_law --set variant=literal", 1),
    // The loop is at its limit, and does not settle.
    ("--set tangential_gain=0 --set normal_gain=12", 1),
];

/// Commands of a document that are run together, in one folder.
struct Unit {
    document: String,
    lines: Vec<String>,
}

/// Every block of shell commands, and every command within the text that no block has.
fn units() -> Vec<Unit> {
    let mut documents = vec!["README.md".to_owned()];
    let mut folders = vec!["rtl_notes".to_owned()];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(Path::new(CHECKOUT).join(&folder)).unwrap() {
            let entry = entry.unwrap();
            let name = format!("{folder}/{}", entry.file_name().to_str().unwrap());
            if entry.file_type().unwrap().is_dir() {
                folders.push(name);
            } else if name.ends_with(".md")
                && !RUN_ELSEWHERE.iter().any(|start| name.starts_with(start))
            {
                documents.push(name);
            }
        }
    }
    documents.sort();
    let mut units = Vec::new();
    for document in &documents {
        let text = fs::read_to_string(Path::new(CHECKOUT).join(document)).unwrap();
        units.extend(blocks(&text).map(|lines| Unit {
            document: document.clone(),
            lines,
        }));
    }
    let mut seen: BTreeSet<String> = units.iter().flat_map(|unit| unit.lines.clone()).collect();
    for document in &documents {
        let text = fs::read_to_string(Path::new(CHECKOUT).join(document)).unwrap();
        for span in spans(&text).filter(|span| is_command(span)) {
            if seen.insert(span.to_owned()) {
                units.push(Unit {
                    document: document.clone(),
                    lines: vec![span.to_owned()],
                });
            }
        }
    }
    units
}

/// The lines of each block of shell commands, without what follows `  #`.
fn blocks(text: &str) -> impl Iterator<Item = Vec<String>> {
    let mut lines = text.lines();
    std::iter::from_fn(move || {
        loop {
            let language = lines.by_ref().find_map(|line| line.strip_prefix("```"))?;
            let block = lines.by_ref().take_while(|line| !line.starts_with("```"));
            let block = block.map(|line| line.split("  #").next().unwrap_or_default().trim_end());
            let block: Vec<_> = block.map(str::to_owned).collect();
            if language == "sh" {
                return Some(block);
            }
        }
    })
}

/// What stands between backticks within lines.
fn spans(text: &str) -> impl Iterator<Item = &str> {
    let mut fenced = false;
    let lines = text.lines().filter(move |line| {
        let fence = line.starts_with("```");
        fenced ^= fence;
        !fence && !fenced
    });
    lines.flat_map(|line| line.split('`').skip(1).step_by(2))
}

/// A whole command, without a word that stands for another.
fn is_command(span: &str) -> bool {
    let begins = ["cargo ", "motion-rtl ", "UPDATE_NOTES=1 cargo "];
    let stands_for = |word: &str| {
        let word = word.rsplit('=').next().unwrap_or(word);
        !word.is_empty() && word.chars().all(|letter| letter.is_ascii_uppercase())
    };
    begins.iter().any(|begin| span.starts_with(begin))
        && !span.contains('…')
        && !span.split([' ', ',']).any(stands_for)
}

/// Runs git in a folder; returns what it prints.
fn git(folder: &Path, arguments: &[&str]) -> String {
    let identity = ["-c", "user.name=a", "-c", "user.email=a@example.org"];
    let output = Command::new("git")
        .args(identity)
        .args(arguments)
        .current_dir(folder)
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "git {arguments:?}: {said}");
    String::from_utf8(output.stdout).unwrap()
}

/// Returns what commands have changed or left in a checkout, except what the reader brings.
fn left(folder: &Path) -> Option<String> {
    let status = git(folder, &["status", "--porcelain"]);
    let brought = |line: &str| BROUGHT.iter().any(|(file, _)| line.ends_with(file));
    let left: Vec<_> = status.lines().filter(|line| !brought(line)).collect();
    (!left.is_empty()).then(|| format!("git status:\n{}", left.join("\n")))
}

/// A checkout of the files that commands read.
fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let ignored = ".gitignore";
    fs::copy(
        Path::new(CHECKOUT).join(ignored),
        folder.path().join(ignored),
    )
    .unwrap();
    fs::create_dir(folder.path().join("rtl_notes")).unwrap();
    for (from, ends) in [
        ("rtl_notes/golden_model", &[".toml", ".v", ".vhd"][..]),
        ("rtl_notes/pictures", &[".gtkw"]),
        ("waves", &[".csv", ".gtkw", ".hpgl", ".ngc", ".toml"]),
    ] {
        let to = folder.path().join(from);
        fs::create_dir(&to).unwrap();
        for entry in fs::read_dir(Path::new(CHECKOUT).join(from)).unwrap() {
            let entry = entry.unwrap();
            let name = entry.file_name().into_string().unwrap();
            if ends.iter().any(|end| name.ends_with(end)) {
                fs::copy(entry.path(), to.join(name)).unwrap();
            }
        }
    }
    git(folder.path(), &["init", "--quiet"]);
    git(folder.path(), &["add", "--force", "."]);
    git(folder.path(), &["commit", "--quiet", "-m", "checkout"]);
    folder
}

/// A line that must end with the code of [`FAILS`], or as it stands.
fn wrapped(line: &str) -> String {
    match FAILS.iter().find(|(part, _)| line.contains(part)) {
        Some((_, code)) => format!("code=0; {line} || code=$?; [[ $code == {code} ]]"),
        None => line.to_owned(),
    }
}

/// What lines print where one of them does not end as it should.
fn objection(folder: &Path, lines: &[String]) -> Option<String> {
    let lines: Vec<_> = lines.iter().map(|line| wrapped(line)).collect();
    let trap = r#"trap 'echo "ends with $?: $BASH_COMMAND"' ERR"#;
    let script = format!(
        "set -eEo pipefail\nexec 2>&1 </dev/null\n{SHELL}\n{trap}\n{}",
        lines.join("\n")
    );
    let output = Command::new("bash")
        .args(["-c", &script])
        .env("MOTION_RTL", super::support::PROGRAM)
        .current_dir(folder)
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&output.stdout);
    let end: Vec<_> = said.lines().rev().take(12).collect();
    let end: Vec<_> = end.into_iter().rev().collect();
    (!output.status.success()).then(|| end.join("\n"))
}

#[test]
#[ignore = "needs git and Yosys and takes long"]
fn every_command_of_the_documents_runs_and_leaves_the_checkout_clean() {
    let units = units();
    let commands: usize = units.iter().map(|unit| unit.lines.len()).sum();
    assert!(commands > 80, "{commands} commands");
    let objections = units.par_iter().filter_map(|unit| {
        let folder = folder();
        let word = |wanted: &str| {
            unit.lines
                .iter()
                .any(|line| line.split(' ').any(|word| word == wanted))
        };
        let brought = BROUGHT.iter().filter(|(file, _)| word(file));
        let brought = brought.map(|(_, command)| (*command).to_owned());
        let of_reader = |line: &&String| {
            CIRCUITS_OF_THE_READER
                .iter()
                .any(|circuit| line.contains(circuit))
        };
        let own = unit.lines.iter().filter(|line| !of_reader(line)).cloned();
        let lines: Vec<_> = brought.chain(own).collect();
        let said = objection(folder.path(), &lines).or_else(|| left(folder.path()))?;
        Some(format!(
            "{}: {}\n{said}",
            unit.document,
            unit.lines.join("\n")
        ))
    });
    let objections: Vec<_> = objections.collect();
    assert!(objections.is_empty(), "{}", objections.join("\n\n"));
}

/// The target of `cargo test` in a command, as cargo's own options, and the filter.
fn filter(command: &str) -> Option<(Vec<&str>, &str)> {
    let words: Vec<_> = command.split_whitespace().collect();
    let start = words.windows(2).position(|two| two == ["cargo", "test"])?;
    let own = words[start + 2..].iter().take_while(|word| **word != "--");
    let own: Vec<&str> = own.copied().filter(|word| *word != "--release").collect();
    match own[..] {
        ["--lib", filter] => Some((vec!["--lib"], filter)),
        ["--test", target, filter] => Some((vec!["--test", target], filter)),
        _ => None,
    }
}

#[test]
#[ignore = "takes long"]
fn every_filter_of_the_documents_selects_a_test() {
    let units = units();
    let commands = units.iter().flat_map(|unit| &unit.lines);
    let filters: BTreeSet<_> = commands.filter_map(|command| filter(command)).collect();
    assert!(filters.len() > 30, "{} filters", filters.len());
    let targets: BTreeSet<_> = filters.iter().map(|(target, _)| target.clone()).collect();
    for target in targets {
        let output = Command::new(env!("CARGO"))
            .args(["test", "--release", "--locked", "--quiet"])
            .args(&target)
            .args(["--", "--list"])
            .current_dir(CHECKOUT)
            .output()
            .unwrap();
        let said = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success(), "{target:?}: {said}");
        let tests = String::from_utf8_lossy(&output.stdout);
        for (of, filter) in &filters {
            let reader = CIRCUITS_OF_THE_READER.contains(filter);
            let selects = tests.lines().any(|test| test.contains(filter));
            assert!(
                *of != target || reader || selects,
                "{of:?} {filter}: selects no test"
            );
        }
    }
}
