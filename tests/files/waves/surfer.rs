//! Mapping files, read by the rules of Surfer's parser.

use super::options;
use super::zoo::Zoo;
use motion_rtl::trace::surfer::{Mapping, mappings};
use motion_rtl::trace::{LayoutError, Options};

/// A mapping as Surfer reads it.
#[derive(Debug, PartialEq)]
struct Read {
    name: String,
    bits: u32,
    labels: Vec<(u64, String)>,
}

/// The value after a keyword, in any case, and an equals sign.
fn specifier(line: &str, keyword: &str) -> Option<String> {
    let (head, rest) = line.split_at_checked(keyword.len())?;
    let value = rest.trim_start().strip_prefix('=')?;
    head.eq_ignore_ascii_case(keyword)
        .then(|| value.trim().to_owned())
}

/// Reads a file: comments and empty lines are skipped, a name and a width appear once, each other
/// line is a decimal number that fits the width, white space, and a label.
fn read(Mapping { file, text }: &Mapping) -> Read {
    let (mut name, mut bits, mut labels) = (None, None, Vec::new());
    for line in text.lines().map(str::trim) {
        if line.is_empty() || line.starts_with('#') {
            continue;
        }
        if let Some(value) = specifier(line, "name") {
            assert_eq!(name.replace(value), None, "{file}: {line}");
        } else if let Some(value) = specifier(line, "bits") {
            assert_eq!(bits.replace(value.parse().unwrap()), None, "{file}: {line}");
        } else {
            let (number, label) = line.split_once(char::is_whitespace).unwrap();
            let number: u64 = number.parse().unwrap();
            labels.push((number, label.trim_start().to_owned()));
        }
    }
    let bits = bits.unwrap();
    for (number, label) in &labels {
        let needed = u64::BITS - number.leading_zeros();
        assert!(
            needed <= bits && !label.is_empty(),
            "{file}: {number} {label}"
        );
    }
    Read {
        name: name.unwrap(),
        bits,
        labels,
    }
}

#[test]
fn each_list_of_states_has_a_mapping() {
    let all = mappings(&Zoo, &Options::default()).unwrap();
    let [mapping] = &all[..] else {
        panic!("{all:?}")
    };
    let states = ["IDLE", "RUN", "STOP"].map(str::to_owned);
    let expected = Read {
        name: "zoo.left.phase".to_owned(),
        bits: 2,
        labels: (0..).zip(states).collect(),
    };
    assert_eq!(read(mapping), expected);
    assert_eq!(mapping.file, "zoo.left.phase.mapping");
    assert!(mapping.text.contains("# zoo.right.phase\n"));
}

#[test]
fn a_mapping_is_for_the_selected_signals() {
    let right = options(0..1, &["zoo.right"]);
    let names: Vec<_> = mappings(&Zoo, &right)
        .unwrap()
        .iter()
        .map(|mapping| read(mapping).name)
        .collect();
    assert_eq!(names, ["zoo.right.phase"]);
    let none = options(0..1, &["zoo.count"]);
    assert_eq!(mappings(&Zoo, &none), Ok(Vec::new()));
    let unknown = mappings(&Zoo, &options(0..1, &["zoo.nowhere"]));
    assert!(matches!(unknown, Err(LayoutError::Unknown { .. })));
}
