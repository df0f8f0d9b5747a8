//! The keys of scenarios stand in the notes, with their defaults.

use motion_rtl::scenario::Loaded;
use std::collections::BTreeSet;

const CIRCUITS: [&str; 6] = [
    "pulse_interpolator",
    "linear_interpolator",
    "lead_angle",
    "arc_generator",
    "trajectory_controller",
    "machine",
];

/// What a circuit cannot do without.
fn scenario(circuit: &str) -> String {
    let steps = match circuit {
        "lead_angle" => "step = [{target = 1, speed_counts_per_s = 10, lead_ms = 5}]\n",
        _ => "",
    };
    format!("circuit = \"{circuit}\"\n{steps}")
}

/// All keys that a circuit takes: those that its refusal of another one names.
fn keys(circuit: &str) -> BTreeSet<String> {
    let text = scenario(circuit) + "no_key = 1\n";
    let refusal = Loaded::parse("a", &text, &[]).unwrap_err();
    let quoted = refusal.allowed.split('`').skip(1).step_by(2);
    let keys: BTreeSet<_> = quoted.map(str::to_owned).collect();
    assert!(keys.len() > 10, "{refusal}");
    keys
}

/// Keys and defaults of the table in a circuit's note.
fn table(circuit: &str) -> Vec<(Vec<String>, String)> {
    let note = format!(
        "{}/rtl_notes/{circuit}/settings.md",
        env!("CARGO_MANIFEST_DIR")
    );
    let note = std::fs::read_to_string(note).unwrap();
    let rows = note
        .lines()
        .skip_while(|line| !line.starts_with("| key | default |"))
        .skip(2)
        .take_while(|line| line.starts_with('|'));
    let row = |row: &str| {
        let mut cells = row.trim_matches('|').split(" | ").map(str::trim);
        let (keys, default) = (cells.next().unwrap(), cells.next().unwrap());
        let keys = keys.split('`').skip(1).step_by(2);
        let plain = |key: &str| key.trim_matches(['[', ']']).to_owned();
        (keys.map(plain).collect(), default.to_owned())
    };
    rows.map(row).collect()
}

#[test]
fn every_key_stands_in_its_note() {
    for circuit in CIRCUITS {
        let listed = table(circuit).into_iter().flat_map(|(keys, _)| keys);
        assert_eq!(listed.collect::<BTreeSet<_>>(), keys(circuit), "{circuit}");
    }
}

/// A default that is a value can be given: nothing is other than without it.
#[test]
fn defaults_are_those_of_the_notes() {
    let mut checked = 0;
    for circuit in CIRCUITS {
        let text = scenario(circuit);
        let without = Loaded::parse("a", &text, &[]).unwrap().scenario;
        for (keys, default) in table(circuit) {
            let default = default.replace(",000", "000").replace('`', "");
            let values: Vec<_> = match keys.len() {
                1 => vec![default.as_str()],
                _ => default.split(", ").collect(),
            };
            if values.len() != keys.len() {
                continue;
            }
            for (key, value) in keys.iter().zip(values) {
                let is_value = |value: &str| format!("a = {value}").parse::<toml::Table>().is_ok();
                if !is_value(value) || key == "circuit" {
                    continue;
                }
                let given = Loaded::parse("a", &format!("{text}{key} = {value}\n"), &[]);
                let given = given
                    .unwrap_or_else(|fault| panic!("{circuit}: {fault}"))
                    .scenario;
                assert_eq!(given, without, "{circuit}: {key} = {value}");
                checked += 1;
            }
        }
    }
    assert!(checked > 90, "{checked}");
}
