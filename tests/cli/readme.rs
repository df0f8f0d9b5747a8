//! What the README and the pages beside it say of the crate: dependencies, commands, files.

use rayon::prelude::*;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;
use std::process::Command;

fn read(name: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(name);
    fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// The lines of every fenced block of that language.
fn blocks(text: &str, language: &str) -> Vec<Vec<String>> {
    let mut blocks = Vec::new();
    let mut lines = text.lines();
    while let Some(line) = lines.next() {
        if let Some(found) = line.strip_prefix("```") {
            let block = lines.by_ref().take_while(|line| !line.starts_with("```"));
            let block = block.map(str::to_owned).collect();
            if found == language {
                blocks.push(block);
            }
        }
    }
    blocks
}

/// The dependencies by name: whether the crate needs them only for its tests and benches.
fn dependencies() -> BTreeMap<String, bool> {
    let manifest: toml::Table = read("Cargo.toml").parse().expect("Cargo.toml is TOML");
    let mut all = BTreeMap::new();
    let systems = manifest["target"].as_table().expect("a table").values();
    let systems = systems.filter_map(toml::Value::as_table);
    for part in systems.chain([&manifest]) {
        for (key, only_tests) in [("dependencies", false), ("dev-dependencies", true)] {
            let names = part.get(key).and_then(toml::Value::as_table);
            let names = names.into_iter().flat_map(toml::Table::keys);
            for name in names {
                // An optional crate of the program may always be there in tests.
                *all.entry(name.clone()).or_insert(true) &= only_tests;
            }
        }
    }
    all
}

#[test]
fn the_table_of_dependencies_is_that_of_the_manifest() {
    let page = read("rtl_notes/dependencies.md");
    let rows = page
        .lines()
        .skip_while(|line| !line.starts_with("| dependency |"))
        .skip(2)
        .take_while(|line| line.starts_with('|'));
    let mut listed = BTreeMap::new();
    for row in rows {
        let cells: Vec<_> = row.trim_matches('|').split('|').map(str::trim).collect();
        let [name, place, reason] = cells[..] else {
            panic!("{row}: not three cells");
        };
        assert!(reason.len() > 3, "{row}: no reason");
        let only_tests = match place {
            "program" => false,
            "tests" => true,
            _ => panic!("{row}: neither program nor tests"),
        };
        let name = name.trim_matches('`').to_owned();
        assert_eq!(listed.insert(name, only_tests), None, "{row}: twice");
    }
    assert_eq!(listed, dependencies());
}

/// It is read on one or two screens, and shows a circuit on the first.
#[test]
fn the_readme_is_short() {
    let readme = read("README.md");
    let lines: Vec<_> = readme.lines().collect();
    assert!((150..=180).contains(&lines.len()), "{} lines", lines.len());
    let circuit = lines.iter().position(|line| *line == "```rust");
    assert!(circuit.is_some_and(|line| line < 70), "{circuit:?}");
    for (line, number) in lines.iter().zip(1..) {
        let letters = line.chars().count();
        assert!(letters <= 400, "line {number}: {letters} characters");
    }
}

#[test]
fn the_first_commands_are_those_that_are_promised() {
    let blocks = blocks(&read("README.md"), "sh");
    assert_eq!(blocks[0], ["cargo run --release", "cargo test --release"]);
}

/// A block of text behind a command is of what the command prints.
#[test]
#[ignore = "takes long"]
fn what_commands_print_is_shown_as_it_is() {
    let page = read("rtl_notes/scenarios.md");
    let mut lines = page.lines();
    let (mut command, mut shown) = (String::new(), Vec::new());
    while let Some(line) = lines.next() {
        let Some(language) = line.strip_prefix("```") else {
            continue;
        };
        let block = lines.by_ref().take_while(|line| !line.starts_with("```"));
        let block: Vec<_> = block.collect();
        match language {
            "sh" => command = block.join("\n"),
            "text" => {
                let arguments = command.strip_prefix("cargo run --release -- ");
                let arguments = arguments.expect("a command before the text");
                shown.push((arguments.to_owned(), block.join("\n")));
            }
            _ => {}
        }
    }
    assert_eq!(shown.len(), 4);
    shown.par_iter().for_each(|(arguments, block)| {
        let directory = tempfile::tempdir().expect("a directory");
        let output = Command::new(env!("CARGO_BIN_EXE_motion-rtl"))
            .args(arguments.split_whitespace())
            .arg("--no-vcd")
            .current_dir(&directory)
            .output()
            .expect("the program starts");
        let text = String::from_utf8_lossy(&output.stdout);
        assert!(text.contains(block), "{arguments} prints:\n{text}");
    });
}

/// Lets the program read the arguments of a command without doing what they ask for.
fn understands(arguments: &[&str]) {
    let output = Command::new(env!("CARGO_BIN_EXE_motion-rtl"))
        .args(arguments)
        .arg("--help")
        .output()
        .expect("the program starts");
    let text = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{arguments:?}: {text}");
}

fn is_input(argument: &str) -> bool {
    let extensions = [".toml", ".ngc", ".hpgl"];
    extensions.iter().any(|end| argument.ends_with(end))
}

#[test]
fn every_command_exists() {
    let manifest: toml::Table = read("Cargo.toml").parse().expect("Cargo.toml is TOML");
    let benches = manifest["bench"].as_array().expect("benches");
    let mut used = BTreeSet::new();
    let checkout = Path::new(env!("CARGO_MANIFEST_DIR"));
    let documents = [
        "README.md",
        "rtl_notes/commands.md",
        "rtl_notes/scenarios.md",
        "rtl_notes/speed.md",
    ];
    let blocks = documents.iter().flat_map(|name| blocks(&read(name), "sh"));
    for line in blocks.flatten() {
        let command = line.split('#').next().unwrap_or_default();
        let words: Vec<_> = command.split_whitespace().collect();
        match words[..] {
            ["cargo", "run", "--release"] => understands(&[]),
            ["cargo", "run", "--release", "--", ref arguments @ ..] => {
                understands(arguments);
                // A file alone is run.
                if !is_input(arguments[0]) {
                    used.insert(arguments[0].to_owned());
                }
                for file in arguments.iter().filter(|word| is_input(word)) {
                    assert!(checkout.join(file).exists(), "{line}: no {file}");
                }
            }
            [
                "/usr/bin/time",
                "-v",
                "target/release/motion-rtl",
                ref arguments @ ..,
            ] => {
                understands(arguments);
            }
            // A simulator runs a design.
            ["mkdir", "-p", _] | ["cp", "rtl_notes/golden_model/*.v", ..] | ["(cd", ..] => {}
            // Make inputs, and remove them.
            ["awk", .., ">", "spiral.hpgl"]
            | ["printf", .., ">", "slow.ngc"]
            | ["rm", "spiral.hpgl", "slow.ngc"] => {}
            ["cargo", "test", "--release"]
            | ["cargo", "test", "--release", "--tests", "--", "--ignored"] => {}
            ["cargo", "bench", "--bench", name] => {
                let named = |bench: &toml::Value| bench["name"].as_str() == Some(name);
                assert!(benches.iter().any(named), "{line}: no such bench");
            }
            ["gtkwave", file] => assert!(checkout.join(file).exists(), "{line}: no {file}"),
            // Not part of the package.
            [script] if script.starts_with(".ci/") => {
                let there = !checkout.join(".ci").exists() || checkout.join(script).exists();
                assert!(there, "{line}: no such script");
            }
            _ => panic!("{line}: not known to this test"),
        }
    }
    let all = [
        "check", "clean", "compare", "keys", "list", "mutate", "run", "table", "verilog", "vhdl",
    ]
    .map(str::to_owned);
    assert_eq!(used, BTreeSet::from(all), "the commands that are shown");
}

/// The map names every module of the library, and no other.
#[test]
fn the_map_of_the_source_is_complete() {
    let readme = read("README.md");
    let rows = readme.lines().filter(|line| line.starts_with("| `src/"));
    let cells = rows.filter_map(|row| row.split('|').nth(1));
    let names = cells.flat_map(|cell| cell.split('`').skip(1).step_by(2));
    let map = names.map(|name| {
        let name = name
            .strip_prefix("src/")
            .expect("a file or a folder of the source");
        name.trim_end_matches('/')
            .trim_end_matches(".rs")
            .to_owned()
    });
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let entries = fs::read_dir(source).expect("the source is there");
    let modules = entries.map(|entry| {
        let name = entry.expect("an entry").file_name();
        name.to_string_lossy().trim_end_matches(".rs").to_owned()
    });
    let modules: BTreeSet<_> = modules.filter(|name| name != "lib").collect();
    assert_eq!(map.collect::<BTreeSet<_>>(), modules);
}
