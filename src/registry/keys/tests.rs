//! Values of keys: tables that keep what is not given, names, two values of one key.

use super::{Refused, sizes};
use crate::registry::entry::Base;
use crate::registry::{Entry, Pair, find};

fn compensator() -> &'static Entry {
    find("compensator").expect("it is there")
}

fn pairs<const N: usize>(texts: [&str; N]) -> Vec<Pair> {
    let pairs = texts.map(|text| text.parse().expect("a pair"));
    pairs.to_vec()
}

/// The first refusal of some pairs.
fn refusal<const N: usize>(texts: [&str; N]) -> String {
    match compensator().made(Base::Full, &pairs(texts)) {
        Err(Refused::Pairs(wrong)) => wrong[0].to_string(),
        Err(other) => panic!("{other}"),
        Ok(_) => panic!("{texts:?} are taken"),
    }
}

fn size<const N: usize>(texts: [&str; N], key: &str) -> u64 {
    let sizes = sizes(compensator(), Base::Full, &pairs(texts));
    let found = sizes.into_iter().find(|(name, _)| name == key);
    found.expect("a size").1
}

#[test]
fn a_table_keeps_the_keys_that_are_not_given() {
    let set = ["widths={position=20,cks=12}"];
    assert_eq!(size(set, "widths.position"), 20);
    assert_eq!(size(set, "widths.cks"), 12);
    assert_eq!(size(set, "widths.stages"), 199);
    assert!(compensator().made(Base::Full, &pairs(set)).is_ok());
}

#[test]
fn a_name_has_keys_of_its_own() {
    for set in [
        "lead_from=speed",
        "lead_from=time",
        "lead_from.time.form=products",
        "lead_from={time={form=\"products\"}}",
    ] {
        let made = compensator().made(Base::Full, &pairs([set]));
        assert!(made.is_ok(), "{set}: {:?}", made.err());
    }
    let table = "lead_from={table={fraction=1,leads=[0,1],increments=[1,-1]}}";
    let other = compensator().made(Base::Full, &pairs([table])).err();
    // The table has its own size, but all of its keys are taken.
    let other = other.map(|error| error.to_string()).unwrap_or_default();
    assert!(
        !other.contains("unknown") && !other.contains("missing"),
        "{other}"
    );
}

#[test]
fn of_two_values_the_later_counts_and_the_earlier_is_checked() {
    let twice = ["widths.position=30", "widths.position=20"];
    assert_eq!(size(twice, "widths.position"), 20);
    assert!(compensator().made(Base::Full, &pairs(twice)).is_ok());
    assert_eq!(
        refusal(["widths.position=wide", "widths.position=20"]),
        "widths.position: invalid type: string \"wide\"; allowed: a whole number from 0"
    );
}

#[test]
fn sizes_out_of_range_are_refused_with_the_range() {
    for (set, said) in [
        (
            "widths.position=65",
            "widths.position: is 65; allowed: 2 to 53",
        ),
        (
            "widths.stages=820",
            "widths.stages: is 820; allowed: 1 to 819",
        ),
        (
            "widths.stages=5000",
            "widths.stages: is 5000; allowed: 1 to 819",
        ),
        ("widths.cks=0", "widths.cks: is 0; allowed: 1 to 64"),
    ] {
        assert_eq!(refusal([set]), said);
    }
}
