//! The catalogue with every key changed, alone and together: what cannot be made is refused in words.

use motion_rtl::registry::{AnyModel, Base, CATALOGUE, Entry, Pair, Refused};
use rayon::prelude::*;

const BASES: [Base; 2] = [Base::Full, Base::Small];

/// How a circuit with these keys ends: made, or refused for its values.
fn made(entry: &Entry, base: Base, pairs: &[Pair]) -> Result<bool, String> {
    let told = |text: &dyn std::fmt::Display| format!("{} with {pairs:?}: {text}", entry.name);
    match entry.made(base, pairs) {
        Ok(circuit) => circuit
            .layout()
            .map(|()| true)
            .map_err(|error| told(&error)),
        Err(refused) => match refused.to_string() {
            text if text.contains("its code panics") || text.trim().is_empty() => Err(told(&text)),
            _ => Ok(false),
        },
    }
}

/// The names in back quotes behind "allowed".
fn variants(entry: &Entry, base: Base, key: &str) -> Vec<String> {
    let refused = entry.made(base, &[Pair::new(key, "?")]).err();
    let Some(Refused::Pairs(wrong)) = refused else {
        return Vec::new();
    };
    let allowed = wrong[0].allowed.split('`').skip(1).step_by(2);
    allowed.map(str::to_owned).collect()
}

/// Values around that of a key: neighbours of a number, every other variant.
fn around(entry: &Entry, base: Base, key: &str, value: &str) -> Vec<String> {
    if let Ok(number) = value.parse::<u64>() {
        let near = [0, 1, number.saturating_sub(1), number, number + 1, 64, 65];
        return near.iter().map(u64::to_string).collect();
    }
    let mut values = variants(entry, base, key);
    values.extend(["true", "false", "[]", "[0]", "[1, 2, 3]", "-1", "1.5"].map(str::to_owned));
    values
}

/// Every key of a circuit with a value around its own.
fn neighbours(entry: &'static Entry) -> Vec<(Base, Pair)> {
    let mut all = Vec::new();
    for key in entry.keys() {
        for (base, value) in BASES.into_iter().zip([key.full, key.small]) {
            // The keys of the machine are those of its circuits.
            let value = value.filter(|_| entry.name != "machine");
            let values = value.map(|value| around(entry, base, &key.name, &value));
            let pairs = values.into_iter().flatten();
            all.extend(pairs.map(|value| (base, Pair::new(key.name.clone(), value))));
        }
    }
    all
}

fn none(faults: impl ParallelIterator<Item = String>) {
    let faults: Vec<String> = faults.collect();
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
#[ignore = "takes long"]
fn every_key_takes_its_neighbours_or_refuses_them_in_words() {
    let pairs = CATALOGUE.par_iter().flat_map_iter(|entry| {
        neighbours(entry)
            .into_iter()
            .map(move |(base, pair)| (entry, base, pair))
    });
    none(pairs.filter_map(|(entry, base, pair)| made(entry, base, &[pair]).err()));
}

/// Some are made of the full circuit alone; a RAM is read behind the difference.
#[test]
fn every_variant_is_made() {
    let refused = CATALOGUE.par_iter().flat_map_iter(|entry| {
        let all: Vec<String> = entry.keys().into_iter().map(|key| key.name).collect();
        let keys = entry.keys().into_iter();
        let keys = keys.filter(|key| entry.name != "machine" && key.full.is_some());
        keys.flat_map(move |key| {
            // One with keys of its own needs these too.
            let is_plain = |variant: &String| {
                let inside = format!("{}.{variant}.", key.name);
                !all.iter().any(|other| other.starts_with(&inside))
            };
            let variants = variants(entry, Base::Small, &key.name);
            let variants: Vec<_> = variants.into_iter().filter(is_plain).collect();
            let variants = variants.into_iter();
            let pairs = variants.map(move |variant| [Pair::new(key.name.clone(), variant)]);
            pairs.filter_map(move |pair| {
                let ends = BASES.map(|base| made(entry, base, &pair));
                let is_made = ends.contains(&Ok(true));
                (!is_made).then(|| format!("{}: {}: {ends:?}", entry.name, pair[0]))
            })
        })
    });
    let refused: Vec<String> = refused.collect();
    assert_eq!(
        refused,
        [
            "ram_time_lead: form=early_difference: [Ok(false), Ok(false)]",
            "ram_compensator: lead_from.time.form=early_difference: [Ok(false), Ok(false)]",
        ]
    );
}

#[test]
#[ignore = "takes long"]
fn every_circuit_is_elaborated_at_every_width() {
    // The machine has no small value; its circuits are made one by one.
    let entries = CATALOGUE.par_iter().filter(|entry| entry.name != "machine");
    none(entries.flat_map_iter(|entry| {
        (0..=64).filter_map(move |bits| {
            let ways = entry.scaled_pairs(bits).into_iter();
            let ends = ways.map(|pairs| made(entry, Base::Small, &pairs));
            match ends.collect::<Result<Vec<bool>, String>>() {
                Ok(ends) if (4..=12).contains(&bits) && !ends.contains(&true) => {
                    Some(format!("{} is not there at width {bits}", entry.name))
                }
                Ok(_) => None,
                Err(fault) => Some(fault),
            }
        })
    }));
}

/// Keys and values of a circuit make it again, each written and read.
#[test]
fn what_is_written_of_a_circuit_makes_it_again() {
    let text = |circuit: &dyn AnyModel| -> Vec<(String, String)> {
        let sources = circuit.verilog().unwrap().sources();
        sources
            .into_iter()
            .map(|source| (source.name, source.text))
            .collect()
    };
    none(CATALOGUE.par_iter().flat_map_iter(|entry| {
        BASES.into_iter().filter_map(move |base| {
            let keys = entry.keys().into_iter();
            let pairs = keys.filter_map(|key| {
                let value = if base == Base::Full {
                    key.full
                } else {
                    key.small
                };
                Some(Pair::new(key.name, value?))
            });
            let pairs: Vec<Pair> = pairs.collect();
            let made = entry.made(base, &pairs).map_err(|error| error.to_string());
            let own = if base == Base::Full {
                entry.full()
            } else {
                entry.small()
            };
            match made {
                Ok(made) if text(&*made) == text(&*own) => None,
                Ok(_) => Some(format!("{}, {base:?}: another netlist", entry.name)),
                Err(error) => Some(format!("{}, {base:?}: {error}", entry.name)),
            }
        })
    }));
}

/// A key that changes nothing is no key.
#[test]
fn every_size_counts() {
    let sources = |circuit: &dyn AnyModel| -> String {
        let sources = circuit.verilog().unwrap().sources().into_iter();
        sources.map(|source| source.text).collect()
    };
    none(CATALOGUE.par_iter().flat_map_iter(|entry| {
        let own = sources(&*entry.small());
        let sizes = entry.sizes(Base::Small, &[]).into_iter();
        let sizes = sizes.filter(|_| entry.name != "machine");
        sizes.filter_map(move |(key, size)| {
            let near = [
                size + 1,
                size.saturating_sub(1),
                size + 2,
                size + 8,
                2 * size,
            ];
            let near = near.into_iter().filter(|near| *near != size);
            let near = near.filter_map(|size| {
                let pairs = [Pair::new(key.clone(), size)];
                entry.made(Base::Small, &pairs).ok()
            });
            let made: Vec<bool> = near.map(|circuit| sources(&*circuit) == own).collect();
            // One that goes with another size alone is refused.
            let idle = !made.is_empty() && !made.contains(&false);
            idle.then(|| format!("{}: {key} changes nothing", entry.name))
        })
    }));
}

#[test]
fn absurd_values_are_refused() {
    for entry in CATALOGUE {
        for (key, _) in entry.sizes(Base::Full, &[]) {
            for value in ["65537", "18446744073709551615", "-1", "wide", "1.5"] {
                let refused = entry
                    .made(Base::Full, &[Pair::new(key.clone(), value)])
                    .err();
                let by_key = matches!(refused, Some(Refused::Pairs(wrong)) if wrong.len() == 1);
                assert!(by_key, "{}: {key}={value}", entry.name);
            }
        }
        let wrong = [Pair::new("no_such", 4), Pair::new("widths.nor_this", 4)];
        let Some(Refused::Pairs(refused)) = entry.made(Base::Small, &wrong).err() else {
            panic!("{} takes {wrong:?}", entry.name);
        };
        assert_eq!(refused.len(), 2, "{}: {refused:?}", entry.name);
    }
}
