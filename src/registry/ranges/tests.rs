//! Listed ranges are those that the circuits elaborate with.

use super::{OTHERS, WIDTHS, of};
use crate::registry::entry::{Base, Entry};
use crate::registry::keys::{MOST, changed, elaborate, is_width, read, table};
use crate::registry::{CATALOGUE, Pair};
use std::fs;
use std::path::Path;

/// Words that a memory has at most, as a power of two.
const ADDRESS: u32 = 24;

/// Address bits of a memory that elaborates in a moment.
const SMALLER: i64 = 18;

/// Sizes of the full circuit, and those that only the small one has.
fn sizes(entry: &Entry) -> Vec<(Base, String, i64)> {
    let of = |base| {
        let sizes = entry.sizes(base, &[]).into_iter();
        sizes.map(move |(key, size)| (base, key, size as i64))
    };
    let mut all: Vec<_> = of(Base::Full).collect();
    for size in of(Base::Small) {
        if !all.iter().any(|(_, key, _)| *key == size.1) {
            all.push(size);
        }
    }
    all
}

/// Elaborates a circuit with another size.
fn elaborates(entry: &Entry, base: Base, key: &str, size: i64) -> Result<(), String> {
    let changed = changed(entry, table(entry, base), &Pair::new(key, size));
    let made = read(entry, &changed).map_err(|error| error.to_string())?;
    elaborate(&made)
        .map(drop)
        .map_err(|error| error.to_string())
}

/// Returns by how many address bits a refused memory is too large.
fn too_many_bits(refusal: &str) -> Option<i64> {
    let bits = refusal.split("; ").filter_map(|mistake| {
        let (_, words) = mistake.split_once("` has ")?;
        let (words, _) = words.split_once(" words of ")?;
        let words: u64 = words.parse().ok()?;
        Some(i64::from(words.ilog2()) - i64::from(ADDRESS))
    });
    bits.max().filter(|bits| *bits > 0)
}

/// Finds the range about a size that elaborates.
fn range(entry: &Entry, base: Base, key: &str, own: i64) -> (i64, i64) {
    let judge = |size| elaborates(entry, base, key, size);
    let cap = match is_width(key) {
        true => WIDTHS.1,
        false => MOST,
    };
    let (mut least, mut below) = (own, -1);
    while least - below > 1 {
        let size = (least + below) / 2;
        match judge(size) {
            Ok(()) => least = size,
            Err(_) => below = size,
        }
    }
    let (mut most, mut above) = (own, cap + 1);
    while above - most > 1 {
        let size = match above > cap {
            true => cap,
            false => (most + above) / 2,
        };
        match judge(size) {
            Ok(()) => most = size,
            Err(refusal) => match too_many_bits(&refusal).map(|bits| size - bits) {
                // A memory with that many words takes minutes: a smaller one has to do.
                Some(end) if end > most => match judge(end.min(SMALLER)) {
                    Ok(()) => return (least, end),
                    Err(_) => above = end.min(SMALLER),
                },
                _ => above = size,
            },
        }
    }
    (least, most)
}

#[test]
#[ignore = "takes long"]
fn ranges_are_those_that_elaborate() {
    let mut fresh = String::new();
    for entry in CATALOGUE {
        for (base, key, own) in sizes(entry) {
            let (least, most) = range(entry, base, &key, own);
            if (least, most) != WIDTHS || !is_width(&key) {
                fresh += &format!("{} {key} {least} {most}\n", entry.name);
            }
        }
    }
    if fresh != OTHERS && std::env::var_os("UPDATE_NOTES").is_some_and(|value| value == "1") {
        let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/registry/ranges.txt");
        fs::write(file, &fresh).expect("written");
        return;
    }
    assert!(
        fresh == OTHERS,
        "UPDATE_NOTES=1 cargo test --release --lib ranges_are_those -- --ignored writes it anew"
    );
}

/// Ends and neighbours of one circuit, which has widths, stages and addresses.
#[test]
fn ends_elaborate_and_their_neighbours_do_not() {
    let entry = crate::registry::find("compensator").expect("it is there");
    for (base, key, _) in sizes(entry) {
        let (least, most) = of(entry.name, &key).expect("a size has a range");
        let judge = |size| elaborates(entry, base, &key, size).is_ok();
        assert!(judge(least), "{key}: {least}");
        // A memory with that many words takes minutes.
        if most < i64::from(ADDRESS) - 8 || most > i64::from(ADDRESS) {
            assert!(judge(most), "{key}: {most}");
        }
        assert!(!judge(least - 1), "{key}: {least} - 1");
        assert!(!judge(most + 1), "{key}: {most} + 1");
    }
}

#[test]
fn every_number_of_things_has_a_range_of_its_own() {
    for entry in CATALOGUE {
        for (_, key, _) in sizes(entry) {
            assert!(of(entry.name, &key).is_some(), "{}: {key}", entry.name);
        }
    }
}

#[test]
fn address_bits_are_counted() {
    let memory = "a: memory `m` has 33554432 words of 16 bits; there are 1 to 16777216 words";
    assert_eq!(too_many_bits(memory), Some(1));
    assert_eq!(
        too_many_bits("a: `b` has 65 bits; a word has 1 to 64"),
        None
    );
    let fits = "a: memory `m` has 16777216 words of 65 bits; there are 1 to 16777216 words";
    assert_eq!(too_many_bits(fits), None);
}
