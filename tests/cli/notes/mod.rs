//! The notes in rtl_notes: their charts run, their tables are those of the code.

mod axes;
mod blends;
mod catalogue;
mod charts;
mod connections;
mod figures;
mod full_width;
mod generated;
mod glossary;
mod links;
mod miscounts;
mod rotations;
mod small;
mod states;

use std::fs;
use std::path::{Path, PathBuf};

/// A note.
struct Note {
    /// Its path from the root of the crate.
    name: String,
    path: PathBuf,
    text: String,
}

/// Every note, in the order of their names.
fn notes() -> Vec<Note> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut folders = vec![root.join("rtl_notes")];
    let mut notes = Vec::new();
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(&folder).expect("rtl_notes can be read") {
            let path = entry.expect("rtl_notes can be read").path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|extension| extension == "md") {
                let name = path.strip_prefix(root).unwrap_or(&path);
                notes.push(Note {
                    name: name.display().to_string(),
                    text: fs::read_to_string(&path).expect("a note is text"),
                    path,
                });
            }
        }
    }
    notes.sort_by(|a, b| a.name.cmp(&b.name));
    assert!(!notes.is_empty(), "there is no note in rtl_notes");
    notes
}

/// Fails with one line for each thing that is wrong.
fn expect_none(wrong: &[String]) {
    assert!(wrong.is_empty(), "\n{}\n", wrong.join("\n"));
}

/// The doc tests of the library compile what stands in a note as Rust.
#[test]
fn every_example_in_rust_is_compiled() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let library = fs::read_to_string(root.join("src/lib.rs")).expect("the library is text");
    let is_rust =
        |line: &str| line.trim_start_matches('`').starts_with("rust") && line.starts_with("```");
    let with_rust = notes()
        .into_iter()
        .filter(|note| note.text.lines().any(is_rust));
    let names: Vec<_> = with_rust.map(|note| note.name).collect();
    assert!(
        names.contains(&"rtl_notes/conventions/README.md".to_owned()),
        "{names:?}"
    );
    for name in names.iter().map(String::as_str).chain(["README.md"]) {
        let included = library.contains(&format!("include_str!(\"../{name}\")"));
        assert!(
            included,
            "{name} has Rust in it; src/lib.rs does not include it as a doc test"
        );
    }
}
