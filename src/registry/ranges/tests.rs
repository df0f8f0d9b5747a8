//! Listed ranges are those that the circuits elaborate with.

use super::of;
use crate::registry::entry::{Base, Entry};
use crate::registry::keys::{MOST, changed, elaborate, read, table};
use crate::registry::{CATALOGUE, Pair};

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

/// Sizes above this take long to elaborate with, unless they are refused.
const QUICK: i64 = 256;

/// The ends of a size's range that do not elaborate, and neighbours outside of it that do.
fn faults(entry: &Entry, base: Base, key: &str) -> Vec<String> {
    let (least, most) = of(entry.name, key).expect("a size has a range");
    // Thousands of parts take minutes.
    let is_slow = most > QUICK;
    let ends = [
        (least - 1, false),
        (least, true),
        (most, true),
        (most + 1, false),
    ];
    let mut faults = Vec::new();
    for (size, expected) in ends {
        // A number above MOST is refused before the circuit is made.
        if size == most && is_slow || size > MOST {
            continue;
        }
        let made = elaborates(entry, base, key, size);
        if made.is_ok() != expected {
            faults.push(format!("{} {key} {size}: {made:?}", entry.name));
        }
    }
    faults
}

/// A circuit that has widths, stages and addresses.
#[test]
fn ends_elaborate_and_their_neighbours_do_not() {
    let entry = crate::registry::find("compensator").expect("it is there");
    for (base, key, _) in sizes(entry) {
        assert_eq!(faults(entry, base, &key), [""; 0]);
    }
}

#[test]
#[ignore = "takes long"]
fn ranges_of_all_circuits_are_those_that_elaborate() {
    let mut wrong = Vec::new();
    for entry in CATALOGUE {
        for (base, key, _) in sizes(entry) {
            wrong.extend(faults(entry, base, &key));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn every_number_of_things_has_a_range_of_its_own() {
    for entry in CATALOGUE {
        for (_, key, _) in sizes(entry) {
            assert!(of(entry.name, &key).is_some(), "{}: {key}", entry.name);
        }
    }
}

/// Every word of a memory is a signal with a name. Of the circuits with the largest memories, all
/// addresses and numbers of axes are at their most.
#[test]
fn memories_hold_131072_words() {
    const TOTAL: usize = (16 * 2) << 17;
    for (name, words) in [
        ("pattern_memory", 2 << 17),
        ("compensator", 3 << 17),
        ("pulse_interpolator", (8 * 2) << 17),
        ("pulse_interpolator_groups", TOTAL),
        ("machine", 8 << 17),
    ] {
        let entry = crate::registry::find(name).expect("it is there");
        let ends = ["address", "axes", "records", "segment", "step"];
        let sizes = sizes(entry).into_iter();
        let sizes = sizes.filter(|(_, key, _)| ends.iter().any(|end| key.ends_with(end)));
        let largest = sizes.fold(table(entry, Base::Full), |table, (_, key, _)| {
            let (_, most) = of(name, &key).expect("a size has a range");
            changed(entry, table, &Pair::new(key, most))
        });
        let made = read(entry, &largest).expect("sizes of its own");
        elaborate(&made).expect("within their ranges");
        let memories = made.model.outline().memories;
        assert!(memories.iter().all(|memory| memory.words <= 1 << 17));
        let all: usize = memories.iter().map(|memory| memory.words).sum();
        assert!((words..=TOTAL).contains(&all), "{name}: {all}");
    }
    let memory = crate::registry::find("pattern_memory").expect("it is there");
    let refused = elaborates(memory, Base::Full, "address", 18).unwrap_err();
    assert!(
        refused
            .contains("has 262144 words of 16 bits; there are 1 to 131072 words of 1 to 64 bits"),
        "{refused}"
    );
}
