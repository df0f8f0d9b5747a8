//! Modules of the library use only modules of the floors below them. The floors are the table in
//! the documentation of the crate.

mod source;

use source::{Code, Named};
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

/// Order of the modules: those of a floor share a number.
struct Floors(BTreeMap<String, usize>);

impl Floors {
    /// Reads the table of floors, lowest first.
    fn read(lib: &str) -> (Self, Vec<String>) {
        let rows = lib.lines().skip_while(|line| *line != "//! # Floors");
        let rows = rows.take_while(|line| line.starts_with("//!"));
        let rows = rows.filter_map(|line| line.strip_prefix("//! | [`"));
        let (mut floors, mut order) = (BTreeMap::new(), Vec::new());
        for (floor, row) in rows.enumerate() {
            let (names, _) = row.split_once(" | ").expect("a row has two columns");
            for name in names.trim_end_matches("`]").split("`], [`") {
                floors.insert(name.to_owned(), floor);
                order.push(name.to_owned());
            }
        }
        (Floors(floors), order)
    }

    /// Returns what is wrong with the paths of a file, one line for each.
    fn wrong(&self, file: &str, code: &Code, macros: &BTreeMap<String, String>) -> Vec<String> {
        let paths = code.paths(&source::module_of(file));
        let wrong = paths.into_iter().filter_map(|Named { line, from, to }| {
            let to = macros.get(&to).unwrap_or(&to);
            let at = |what: &str| Some(format!("{file}:{line}: {from} -> {to}: {what}"));
            let [lower, own] = [to, &from].map(|name| self.0.get(name));
            match (lower, own) {
                _ if *to == from => None,
                (Some(lower), Some(own)) if lower < own => None,
                (Some(lower), Some(own)) if lower == own => at("on the same floor"),
                (Some(_), Some(_)) => at("on a floor above"),
                _ => at("on no floor"),
            }
        });
        wrong.collect()
    }
}

/// Returns all Rust files of a folder with their paths, except those of the program.
fn files(folder: &str) -> Vec<(String, String)> {
    let mut files = Vec::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(&folder).expect("it is a folder") {
            let path = entry.expect("it can be listed").path();
            let name = path.to_str().expect("it is UTF-8").to_owned();
            match path.is_dir() {
                true if name == "src/cli" => {}
                true => folders.push(name),
                false
                    if name.ends_with(".rs")
                        && !["src/lib.rs", "src/main.rs"].contains(&&*name) =>
                {
                    let text = fs::read_to_string(&path).expect("it is UTF-8");
                    files.push((name, text));
                }
                false => {}
            }
        }
    }
    files.sort();
    files
}

#[test]
fn no_module_uses_one_above_it() {
    assert!(
        Path::new("src/lib.rs").exists(),
        "tests run in the package's folder"
    );
    let lib = fs::read_to_string("src/lib.rs").expect("it is UTF-8");
    let (floors, order) = Floors::read(&lib);
    let declared = lib.lines().filter_map(|line| line.strip_prefix("pub mod "));
    let declared: Vec<_> = declared.filter_map(|line| line.strip_suffix(';')).collect();
    assert_eq!(declared, order, "modules stand in the order of the floors");

    let files = files("src");
    let codes: Vec<_> = files
        .iter()
        .map(|(name, text)| (name, Code::of(text)))
        .collect();
    let mut macros = BTreeMap::new();
    for (name, code) in &codes {
        for exported in code.exported_macros() {
            macros.insert(exported, source::module_of(name)[0].clone());
        }
    }
    let wrong: Vec<_> = codes
        .iter()
        .flat_map(|(name, code)| floors.wrong(name, code, &macros))
        .collect();
    assert!(codes.len() > 300, "{} files", codes.len());
    assert!(
        wrong.is_empty(),
        "{} paths:\n{}",
        wrong.len(),
        wrong.join("\n")
    );
}

/// One style: a module with modules inside is `mod.rs` in their folder.
#[test]
fn a_folder_has_its_module_inside() {
    let mut folders = vec!["src/cli".to_owned()];
    folders.extend(files("src").into_iter().map(|(name, _)| {
        let (folder, _) = name.rsplit_once('/').expect("a path");
        folder.to_owned()
    }));
    folders.retain(|folder| folder != "src");
    let without: Vec<_> = folders
        .iter()
        .filter(|folder| !Path::new(&format!("{folder}/mod.rs")).exists())
        .collect();
    assert!(without.is_empty(), "no mod.rs: {without:?}");
}

#[test]
fn paths_upwards_are_found() {
    let lib = "//! # Floors\n//!\n//! | [`low`] | a |\n//! | [`left`], [`right`] | b |\n\
               //! | [`high`] | c |\n#![deny(unsafe_code)]\n//! | [`none`] | d |\n";
    let (floors, order) = Floors::read(lib);
    assert_eq!(order, ["low", "left", "right", "high"]);
    let macros = BTreeMap::from([("high_made".to_owned(), "high".to_owned())]);
    let wrong = |file: &str, text: &str| floors.wrong(file, &Code::of(text), &macros);

    assert_eq!(
        wrong("src/high.rs", "use crate::low::A;\nuse crate::high::B;"),
        [""; 0]
    );
    assert_eq!(
        wrong("src/low/a.rs", "use std::fmt;\n\nuse crate::high::A;"),
        ["src/low/a.rs:3: low -> high: on a floor above"]
    );
    assert_eq!(
        wrong("src/left/mod.rs", "fn f() { crate::right::f() }"),
        ["src/left/mod.rs:1: left -> right: on the same floor"]
    );
    assert_eq!(
        wrong(
            "src/low.rs",
            "use crate::{\n    high::{A, B},\n    low::C,\n    nowhere,\n};"
        ),
        [
            "src/low.rs:2: low -> high: on a floor above",
            "src/low.rs:4: low -> nowhere: on no floor"
        ]
    );
    // Macros are at the root of the crate, wherever they are written.
    assert_eq!(
        wrong("src/low.rs", "($crate::high_made!(), $crate::low::A)"),
        ["src/low.rs:1: low -> high: on a floor above"]
    );
    // Folders are left upwards, also out of a module within a file.
    for (file, text) in [
        ("src/low.rs", "use super::high::A;"),
        ("src/low/mod.rs", "use super::{high::A};"),
        ("src/low/a.rs", "use super::super::high::A;"),
        (
            "src/low/a/b.rs",
            "mod tests { use super::super::super::super::high::A; }",
        ),
        (
            "src/low.rs",
            "mod tests { fn f() { super::super::high::f() } }",
        ),
    ] {
        assert_eq!(
            wrong(file, text),
            [format!("{file}:1: low -> high: on a floor above")]
        );
    }
    for (file, text) in [
        ("src/low/a.rs", "use super::high::A;"),
        ("src/low.rs", "mod tests { use super::high::A; }"),
        (
            "src/low/a.rs",
            "mod tests {} mod more { use super::super::high::A; }",
        ),
    ] {
        assert_eq!(wrong(file, text), [""; 0], "{file}: {text}");
    }
    // Comments, strings and characters are no code.
    let quiet = "// crate::high\n/* a /* crate::high */ crate::high */\n/// [`A`](crate::high::A)\n\
                 const A: &str = \"\\\" crate::high::A\";\nconst B: &str = r#\"\" crate::high \"#;\n\
                 const C: [char; 2] = ['\"', '\\''];\nfn f<'a>(_: &'a str) {}\n";
    assert_eq!(wrong("src/low.rs", quiet), [""; 0]);
    let loud = format!("{quiet}use crate::high::A;");
    assert_eq!(
        wrong("src/low.rs", &loud),
        ["src/low.rs:8: low -> high: on a floor above"]
    );
}
