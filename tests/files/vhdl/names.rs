//! Names and lines of every circuit's VHDL.

use crate::verilog::models;
use motion_rtl::compare::Map;
use motion_rtl::printed::SourceFile;
use motion_rtl::registry::{AnyModel, CATALOGUE};
use motion_rtl::trace::Clock;
use rayon::prelude::*;
use std::collections::HashSet;

/// A declaration with a long name is not broken.
const LONGEST: usize = 110;

/// Names that are declared in a file, in their order.
fn declared(text: &str) -> Vec<&str> {
    let lines = text.lines().filter_map(|line| line.split("--").next());
    let mut names = Vec::new();
    for line in lines {
        let words: Vec<&str> = line.split_whitespace().collect();
        match words[..] {
            ["signal" | "constant", name, ":", ..] | ["type", name, "is", ..] => names.push(name),
            [name, ":", "in" | "out" | "entity" | "natural", ..] => names.push(name),
            _ => {}
        }
    }
    names
}

/// Names are legal and differ in more than the case of letters; returns their number.
pub fn names(source: &SourceFile) -> usize {
    let mut seen = HashSet::new();
    for name in declared(&source.text) {
        let legal = name.starts_with(|first: char| first.is_ascii_alphabetic())
            && !name.ends_with('_')
            && !name.contains("__");
        let fresh = seen.insert(name.to_ascii_lowercase());
        assert!(legal && fresh, "{}: {name}", source.name);
    }
    seen.len()
}

/// Lines are short, in ASCII, and end in something visible.
pub fn lines(source: &SourceFile) {
    for line in source.text.lines() {
        assert!(line.len() <= LONGEST, "{}: {line}", source.name);
        assert_eq!(line, line.trim_end(), "{}", source.name);
        let plain = line.is_ascii() && !line.contains("U+") && !line.contains('\t');
        assert!(plain, "{}: {line}", source.name);
    }
    assert!(!source.text.contains("\n\n\n"), "{}", source.name);
}

/// The map can be read, and names signals of the circuit.
fn map(circuit: &dyn AnyModel, names: &SourceFile) {
    let map = Map::parse(&names.name, &names.text);
    assert!(map.is_ok(), "{}: {}", circuit.name(), map.unwrap_err());
    let outline = circuit.outline();
    let paths: HashSet<String> = outline.leaves.iter().map(|leaf| leaf.path()).collect();
    let pairs = names.text.lines();
    for line in pairs.filter(|line| line.contains("\" = \"")) {
        let golden = line.trim_start_matches('"').split('"').next().unwrap();
        assert!(paths.contains(golden), "{line}");
    }
}

#[test]
fn every_text_is_legal_and_the_same_every_time() {
    let entries = CATALOGUE.par_iter().rev().with_max_len(1);
    let count: usize = entries
        .map(|entry| {
            let narrow = models(entry).next().unwrap();
            let counts = [narrow, entry.full()].map(|circuit| {
                let vhdl = circuit.vhdl().unwrap();
                let print = || {
                    let bench = vhdl.testbench(Clock::default());
                    let sources: Vec<SourceFile> =
                        vhdl.sources().into_iter().chain(bench).collect();
                    (sources, vhdl.names())
                };
                let (sources, map_of) = print();
                assert_eq!((&sources, &map_of), (&print().0, &print().1));
                sources.iter().for_each(lines);
                map(&*circuit, &map_of);
                sources.iter().map(names).sum::<usize>()
            });
            counts.into_iter().sum::<usize>()
        })
        .sum();
    assert!(count > 10_000, "{count}");
}
