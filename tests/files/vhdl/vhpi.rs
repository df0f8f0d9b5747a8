//! Checkers in VHDL.

use super::names::{lines, names};
use expect_test::expect_file;
use motion_rtl::Model;
use motion_rtl::registry::CATALOGUE;
use motion_rtl::vhdl::VhpiChecker;
use rayon::prelude::*;

fn checker(circuit: &str, settings: &str) -> VhpiChecker {
    let pairs: Vec<_> = settings.lines().map(|pair| pair.parse().unwrap()).collect();
    let model = Model::new(circuit, &pairs).unwrap();
    VhpiChecker::new(&model, settings, "lib/libmotion_rtl.so".parse().unwrap())
}

#[test]
fn a_package_and_a_checker() {
    let [package, checker] = checker("enable_counter", "width=4").sources();
    let names = [package.name, checker.name];
    assert_eq!(names, ["motion_rtl_pkg.vhd", "enable_counter_checker.vhd"]);
    expect_file!["motion_rtl_pkg.vhd"].assert_eq(&package.text);
    expect_file!["enable_counter_checker.vhd"].assert_eq(&checker.text);
}

/// Ports of an entity with their types, without modes.
fn ports(text: &str) -> Vec<(String, String)> {
    let entity = text.split("\nentity ").nth(1).unwrap();
    let entity = entity.split("\nend entity").next().unwrap();
    let ports = entity
        .split("    port (\n")
        .nth(1)
        .unwrap_or_default()
        .lines();
    let ports = ports.filter_map(|line| {
        let line = line.split("--").next()?.trim().trim_end_matches(';');
        let (name, kind) = line.split_once(':')?;
        let kind = kind.trim().split_once(' ')?.1;
        Some((name.trim().to_owned(), kind.trim().to_owned()))
    });
    ports.collect()
}

/// A port map of the exported entity is one of its checker.
#[test]
fn checkers_have_the_ports_of_the_exported_entities() {
    let checked: usize = CATALOGUE
        .par_iter()
        .with_max_len(1)
        .map(|entry| {
            let [package, checker] = checker(entry.name, "").sources();
            [&package, &checker].into_iter().for_each(lines);
            names(&checker);
            let mut expected = ports(&entry.full().vhdl().unwrap().top().text);
            let clock = ("clk".to_owned(), "std_logic".to_owned());
            if !expected.contains(&clock) {
                expected.push(clock);
            }
            let mut found = ports(&checker.text);
            found.sort();
            expected.sort();
            assert_eq!(found, expected, "{}", entry.name);
            found.len()
        })
        .sum();
    assert!(checked > 1_000, "{checked}");
}

#[test]
fn settings_and_quotes_are_passed_in_literals() {
    let [_, checker] = checker("unit_law", "width=16\nvariant=safe").sources();
    let literal = "            \"width=16\"\n            & LF & \"variant=safe\",\n";
    assert!(checker.text.contains(literal), "{}", checker.text);
    assert!(
        checker
            .text
            .starts_with("-- Checker of unit_law with width=16, variant=safe, made by")
    );
}
