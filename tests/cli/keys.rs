//! `keys`: what it prints, and that its schemas are those of the scenarios that ship.

use super::json_schema::violations;
use super::support::Bench;
use serde_json::{Value, json};
use std::fs;
use std::path::Path;

/// Circuits that schemas are made of.
const CIRCUITS: [&str; 6] = [
    "pulse_interpolator",
    "linear_interpolator",
    "lead_angle",
    "arc_generator",
    "trajectory_controller",
    "machine",
];

/// What of a scenario in TOML its circuit's schema does not allow.
fn judge(schemas: &[(&str, Value)], scenario: &str) -> Vec<String> {
    let scenario: toml::Table = scenario.parse().expect("TOML");
    let scenario = serde_json::to_value(scenario).expect("JSON");
    let circuit = scenario["circuit"].as_str().expect("a circuit");
    let schema = schemas.iter().find(|(name, _)| *name == circuit);
    let mut found = Vec::new();
    if let Some((name, schema)) = schema {
        found = violations(schema, schema, &scenario, name);
    }
    found
}

fn schemas() -> Vec<(&'static str, Value)> {
    let bench = Bench::new();
    let schema = |name| {
        let text = bench.succeed(&["keys", name, "--json-schema"]);
        (name, serde_json::from_str(&text).unwrap())
    };
    CIRCUITS.map(schema).to_vec()
}

#[test]
fn scenarios_that_ship_are_those_of_their_schemas() {
    let schemas = schemas();
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("waves");
    let mut judged = 0;
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path
            .extension()
            .is_some_and(|extension| extension == "toml")
        {
            let found = judge(&schemas, &fs::read_to_string(&path).unwrap());
            assert!(found.is_empty(), "{}: {found:#?}", path.display());
            judged += 1;
        }
    }
    assert!(judged >= 20, "{judged}");
}

#[test]
fn schemas_refuse_what_a_run_refuses() {
    let schemas = schemas();
    let cases = [
        ("clock_mhz = 1", "machine: there is no key clock_mhz"),
        ("beside = true", "machine: there is no key beside"),
        ("clock_hz = 0", "machine.clock_hz: 0 is not from 1"),
        (
            "clock_hz = 1.5",
            "machine.clock_hz: 1.5 is not of type \"integer\"",
        ),
        (
            "scan_ticks = 185",
            "machine.scan_ticks: 185 is not from 186",
        ),
        (
            "steps_per_mm = [40]",
            "machine.steps_per_mm: [40] is not a list of its length",
        ),
        (
            "correction = \"wild\"",
            "machine.correction: \"wild\" is not one of ",
        ),
        ("lift_history = 3", "machine.lift_history: 3 is not one of "),
        (
            "[lift]\nbrake_fade = 0.6",
            "machine.lift: \"counts_per_rev\" is missing",
        ),
        (
            "[program]\ng54_mm = [0, 0, 2e6]",
            "machine.program.g54_mm[2]: 2000000.0 is not up to ",
        ),
    ];
    for (keys, expected) in cases {
        let text = format!("circuit = \"machine\"\n{keys}\n");
        let found = judge(&schemas, &text);
        assert!(
            found
                .first()
                .is_some_and(|first| first.starts_with(expected)),
            "{keys}: {found:?}"
        );
        let refused = motion_rtl::scenario::Loaded::parse("s.toml", &text, &[]);
        // Ranges are checked by the job, types and names by the reader.
        assert_eq!(
            refused.is_err(),
            !expected.contains(" from ") && !expected.contains("up to"),
            "{keys}"
        );
    }
    assert_eq!(judge(&schemas, "circuit = \"machine\"\n"), [""; 0]);
}

#[test]
fn keys_are_printed_with_type_unit_default_range_and_meaning() {
    let bench = Bench::new();
    let names = bench.run(&["keys"]);
    assert_eq!(names.code, 0);
    assert!(
        names.stdout.lines().any(|name| name == "  machine"),
        "{}",
        names.stdout
    );
    let text = bench.run(&["keys", "machine"]).stdout;
    for lines in [
        "circuit (required): name, \"pulse_interpolator\", ",
        "scan_ticks = 400: whole number, ticks, 186 to 16777215\n    Scan of the linear interpolator.\n",
        "lift_history = \"shift_register\": name, \"shift_register\", \"ram\"\n",
        "machine.max_torque_nm (required): number, N·m, ",
        "feed_mm_per_min = 1200.0: number, mm/min, 0.001 to 10000000\n    Feed of the moves that set none.\n",
        "input = none: path\n",
    ] {
        assert!(text.contains(lines), "{lines}\n{text}");
    }
    let rows = bench.json(&["keys", "machine"]);
    assert_eq!(rows["version"], 1);
    let row = rows["scenario"]
        .as_array()
        .unwrap()
        .iter()
        .find(|row| row["key"] == "ck_ticks");
    assert_eq!(
        *row.expect("a row"),
        json!({
            "key": "ck_ticks",
            "kind": "whole number",
            "unit": "ticks",
            "default": "40",
            "range": "4 to 16777215",
            "about": "CK of the lead-angle compensator.",
        })
    );
    let refused = |arguments: &[&str], problem: &str| {
        bench.refuse_with(arguments, |said| assert!(said.contains(problem), "{said}"));
    };
    refused(
        &["keys", "machin"],
        "NAME: no job or circuit is called machin; did you mean machine?; allowed: a name of a job or a circuit; `motion-rtl keys` lists all",
    );
    refused(
        &["keys", "compensator", "--json-schema"],
        "NAME: compensator is a circuit, whose keys stand in no file; allowed: a job, for a schema of its scenarios: pulse_interpolator, linear_interpolator, ",
    );
}

/// Names of circuits, and those that a job has too.
#[test]
fn circuits_have_their_keys_listed() {
    let bench = Bench::new();
    let text = bench.succeed(&["keys", "compensator"]);
    for line in [
        "widths.position = 24, small: 4: whole number, bits, 2 to 53",
        "variant.detector = incremental: name, incremental, absolute, phase_shift, resolver",
    ] {
        assert!(text.lines().any(|own| own == line), "{line}: {text}");
    }
    let json = bench.json(&["keys", "compensator"]);
    let position = json!({
        "key": "widths.position", "full": "24", "small": "4",
        "type": "whole number", "unit": "bits", "range": "2 to 53",
        "about": "Width of a position.",
    });
    assert!(
        json["circuit"].as_array().unwrap().contains(&position),
        "{json}"
    );
    assert_eq!(json["scenario"], Value::Null);
    let both = bench.json(&["keys", "machine"]);
    assert!(both["scenario"].is_array() && both["circuit"].is_array());
    let text = bench.succeed(&["keys", "machine"]);
    assert!(
        text.starts_with("keys of a scenario\n\ncircuit (required)"),
        "{text}"
    );
    assert!(text.contains("\nkeys of the circuit\n\n"), "{text}");
    let names = bench.json(&["keys"]);
    assert_eq!(names["jobs"].as_array().unwrap().len(), 6);
    let list = bench.json(&["list"]);
    let count = list["circuits"].as_array().unwrap().len();
    assert_eq!(names["circuits"].as_array().unwrap().len(), count);
}

/// Every key of every circuit has a type, and the values that stand beside it are in its range.
#[test]
fn keys_of_circuits_have_a_type_and_a_range_that_their_values_are_in() {
    let bench = Bench::new();
    let names = bench.json(&["keys"]);
    let mut types = std::collections::BTreeSet::new();
    for name in names["circuits"].as_array().unwrap() {
        let name = name.as_str().unwrap();
        let keys = bench.json(&["keys", name]);
        for key in keys["circuit"].as_array().unwrap() {
            let word = |field: &str| key[field].as_str();
            let (kind, range) = (word("type").unwrap(), word("range").unwrap());
            if !kind.starts_with("list of ") {
                types.insert(kind.to_owned());
            }
            assert!(
                word("about").is_some_and(|about| !about.is_empty()),
                "{key}"
            );
            // The ranges hold while the other keys are those of the full circuit.
            let own = word("full").or_else(|| word("small"));
            let values = own.into_iter();
            for value in values {
                let fits = match kind {
                    "whole number" => value.parse().is_ok_and(|value: i64| {
                        let (least, most) = range.split_once(" to ").unwrap_or(("0", "0"));
                        range.is_empty() || range == "from 0" && value >= 0 || {
                            let [least, most] =
                                [least, most].map(|end| end.parse::<i64>().unwrap());
                            (least..=most).contains(&value)
                        }
                    }),
                    "name" => range.split(", ").any(|name| name == value),
                    "true or false" => value.parse::<bool>().is_ok(),
                    list if list.starts_with("list of ") => value.starts_with('['),
                    // A table that is not set in both stands for all of its keys.
                    "table" => false,
                    other => panic!("{name}: {key}: there is no type {other}"),
                };
                assert!(fits, "{name}: {key}");
            }
        }
    }
    assert!(
        types
            .into_iter()
            .eq(["name", "table", "true or false", "whole number"].map(str::to_owned))
    );
}

/// Keys of a scenario that moves to another circuit.
#[test]
fn keys_that_do_not_apply_to_another_circuit_are_reported_together() {
    let bench = Bench::with("line.hpgl", super::support::LINE);
    let text = "circuit = \"lead_angle\"\nck_ticks = 40\nrest_ms = 10\nlift_histori = \"ram\"\n\
                [[step]]\ntarget = 1\nspeed_counts_per_s = 10\n";
    bench.write("s.toml", text);
    let done = bench.run(&["run", "s.toml", "--set", "circuit=machine"]);
    let errors: Vec<_> = done
        .stderr
        .lines()
        .filter(|line| line.starts_with("error: "))
        .collect();
    assert_eq!(
        (done.code, errors),
        (
            2,
            vec![
                "error: s.toml:3: rest_ms: is not a key of machine, but of lead_angle; allowed: `motion-rtl keys machine` lists all",
                "error: s.toml:4: lift_histori: unknown key; did you mean lift_history?; allowed: `motion-rtl keys machine` lists all",
                "error: s.toml:5: [[step]]: is not a key of machine, but of lead_angle; did you mean steps_per_mm?; allowed: `motion-rtl keys machine` lists all",
            ]
        )
    );
}

#[test]
fn all_keys_that_do_not_apply_are_reported_in_the_order_of_the_lines() {
    let keys: Vec<_> = (0..30)
        .map(|number| format!("key_{}", 29 - number))
        .collect();
    let lines: Vec<_> = keys.iter().map(|key| format!("{key} = 1\n")).collect();
    let text = format!("circuit = \"machine\"\n{}", lines.concat());
    let bench = Bench::new();
    bench.write("s.toml", &text);
    let done = bench.run(&["run", "s.toml"]);
    let errors = done
        .stderr
        .lines()
        .filter(|line| line.starts_with("error: "));
    let fields = errors.filter_map(|line| line.split(": ").nth(2).map(str::to_owned));
    let fields: Vec<_> = fields.collect();
    assert_eq!((done.code, fields), (2, keys), "{}", done.stderr);
}
