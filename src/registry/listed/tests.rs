//! Meanings are the doc comments of the circuits' fields, and every key has one.

use super::MEANINGS;
use crate::registry::CATALOGUE;
use std::fs;
use std::path::{Path, PathBuf};

/// Returns the Rust files in a directory and below it, by path.
fn sources(directory: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in fs::read_dir(directory).expect("sources are there") {
        let path = entry.expect("readable").path();
        match path.is_dir() {
            true => found.extend(sources(&path)),
            false if path.extension().is_some_and(|end| end == "rs") => found.push(path),
            false => {}
        }
    }
    found.sort();
    found
}

/// Returns text without links: of `[text](place)` and `[text]` the text.
fn plain(doc: &str) -> String {
    let mut text = String::new();
    let mut rest = doc;
    while let Some((before, link)) = rest.split_once('[') {
        let (inner, after) = link.split_once(']').expect("a link ends");
        text += before;
        text += inner;
        rest = match after.strip_prefix('(') {
            Some(place) => place.split_once(')').expect("a place ends").1,
            None => after,
        };
    }
    text + rest
}

/// A struct, or a variant of an enum, with the names and documentation of its fields.
#[derive(Default)]
struct Fields {
    names: Vec<String>,
    docs: Vec<String>,
}

impl Fields {
    /// Takes a line of a struct; `doc` is the documentation before it.
    fn line(&mut self, line: &str, doc: &mut String) {
        if let Some(more) = line.strip_prefix("///") {
            *doc = format!("{doc} {}", more.trim()).trim().to_owned();
        } else if let Some((name, _)) = line.split_once(": ") {
            let name = name.rsplit(' ').next().unwrap_or(name);
            self.names.push(name.to_owned());
            self.docs.push(plain(&std::mem::take(doc)));
        }
    }

    fn text(&self, of: &str) -> String {
        let docs: String = self.docs.iter().map(|doc| format!("\t{doc}\n")).collect();
        match self.names.is_empty() {
            true => String::new(),
            false => format!("{of} {}\n{docs}", self.names.join(" ")),
        }
    }
}

/// Returns the meanings of all types of a source that serde reads.
fn meanings(source: &str) -> Vec<String> {
    let mut found = Vec::new();
    let mut lines = source.lines();
    while let Some(line) = lines.next() {
        if !(line.starts_with("#[derive(") && line.contains("Deserialize")) {
            continue;
        }
        let mut heads = lines
            .by_ref()
            .skip_while(|line| line.starts_with("#[") || line.starts_with("///"));
        let head = heads.next().unwrap_or_default();
        let is_enum = head.starts_with("pub enum ");
        let name = head.split(' ').nth(2).unwrap_or_default();
        if !head.ends_with(" {") {
            continue;
        }
        let (mut fields, mut doc) = (Fields::default(), String::new());
        for line in lines.by_ref().take_while(|line| *line != "}") {
            let line = line.trim();
            // A variant begins or ends.
            if is_enum && (line.ends_with('{') || line == "},") {
                found.push(std::mem::take(&mut fields).text(name));
                doc.clear();
            } else {
                fields.line(line, &mut doc);
            }
        }
        found.push(fields.text(name));
    }
    found.retain(|text| !text.is_empty());
    found
}

#[test]
fn meanings_are_those_of_the_source() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut all: Vec<_> = sources(&root.join("src/circuits"))
        .iter()
        .flat_map(|path| meanings(&fs::read_to_string(path).expect("a source")))
        .collect();
    all.sort();
    let heads: Vec<_> = all.iter().map(|text| text.lines().next()).collect();
    let twice = heads.windows(2).find(|pair| pair[0] == pair[1]);
    assert_eq!(twice, None, "two structs have one name and the same fields");
    let fresh = all.concat();
    if fresh != MEANINGS && std::env::var_os("UPDATE_NOTES").is_some_and(|value| value == "1") {
        fs::write(root.join("src/registry/listed/meanings.txt"), &fresh).expect("written");
        return;
    }
    assert!(
        fresh == MEANINGS,
        "UPDATE_NOTES=1 cargo test --release --lib meanings_are_those writes it anew"
    );
}

#[test]
fn every_key_has_a_meaning() {
    for entry in CATALOGUE {
        for key in entry.keys() {
            assert!(!key.about.is_empty(), "{}: {}", entry.name, key.name);
        }
    }
}

#[test]
fn links_are_left_out() {
    assert_eq!(plain("a [b](c) and [`d`], e"), "a b and `d`, e");
}

#[test]
fn variants_of_enums_and_lists_in_lists_are_listed() {
    let keys = |name: &str| crate::registry::find(name).expect("it is there").keys();
    let found = |name: &str, key: &str| {
        let keys = keys(name);
        let found = keys.into_iter().find(|own| own.name == key);
        found.unwrap_or_else(|| panic!("{name}: {key}"))
    };
    let leads = found("compensator", "lead_from.table.leads");
    assert_eq!(
        (leads.full, leads.kind.as_str()),
        (None, "list of whole numbers")
    );
    let name = found("compensator", "lead_from");
    assert_eq!(name.range, "time, speed, table");
    let base = found("pulse_interpolator", "free_running.base");
    assert_eq!((base.full, base.kind.as_str()), (None, "whole number"));
    let memories = found("pulse_interpolator_groups", "memories");
    assert_eq!(
        memories.kind,
        "list of lists of tables: half_periods, directions"
    );
}
