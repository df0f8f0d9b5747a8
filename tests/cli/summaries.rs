//! The JSON of summaries against the schema that is checked in.

use super::json_schema::violations;
use super::support::Bench;
use serde_json::{Value, json};
use std::fs;
use std::path::Path;

/// Scenarios that ship and run in less than a second.
const SHORT: [&str; 10] = [
    "arc", "corner", "groups", "joint", "machine", "patterns", "plotter", "rewrite", "rosette",
    "weld",
];

fn file(name: &str) -> String {
    fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join(name)).unwrap()
}

pub fn schema() -> Value {
    serde_json::from_str(&file("rtl_notes/summary.schema.json")).unwrap()
}

/// Returns what of a summary the schema of its circuit does not allow.
fn judge(schema: &Value, summary: &Value) -> Vec<String> {
    let circuit = &summary["circuit"];
    let kinds = schema["$defs"].as_object().unwrap().values();
    let kinds = kinds.filter(|kind| &kind["properties"]["circuit"]["const"] == circuit);
    let found = kinds.map(|kind| violations(schema, kind, summary, "summary"));
    let found = found.min_by_key(Vec::len);
    found.unwrap_or_else(|| panic!("no summary is of {circuit}"))
}

/// Runs scenarios that ship, whose summaries must be those of the schema.
fn run(long: bool) {
    let (bench, schema) = (Bench::new(), schema());
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("waves");
    let (mut judged, mut all) = (0, Vec::new());
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let stem = path.file_stem().unwrap().to_str().unwrap();
        if path.extension().is_none_or(|extension| extension != "toml")
            || SHORT.contains(&stem) == long
        {
            continue;
        }
        let scenario = path.to_str().unwrap();
        let summary = bench.json(&["run", scenario, "--no-vcd", "--out", "out"]);
        let found = judge(&schema, &summary).into_iter();
        all.extend(found.map(|found| format!("{stem}: {found}")));
        judged += 1;
    }
    assert_eq!(all, [""; 0]);
    assert!(judged >= SHORT.len(), "{judged}");
}

#[test]
fn summaries_of_scenarios_that_ship_are_those_of_the_schema() {
    run(false);
}

#[test]
#[ignore = "takes long"]
fn summaries_of_long_scenarios_are_those_of_the_schema() {
    run(true);
}

/// Every change of a summary's keys or types is a violation.
#[test]
fn another_summary_is_not_that_of_the_schema() {
    let bench = Bench::with("waves/joint.toml", file("waves/joint.toml"));
    let schema = schema();
    let good = bench.json(&["run", "waves/joint.toml", "--no-vcd"]);
    assert_eq!(judge(&schema, &good), [""; 0]);
    type Change = fn(&mut Value);
    let cases: [(Change, &str); 11] = [
        (
            |summary| {
                let samples = summary["samples"].take();
                summary.as_object_mut().unwrap().remove("samples");
                summary["sample_count"] = samples;
            },
            "summary: \"samples\" is missing, summary: there is no key sample_count",
        ),
        (
            |summary| {
                drop(
                    summary["arcs"][0]
                        .as_object_mut()
                        .unwrap()
                        .remove("bound_um"),
                )
            },
            "summary.arcs[0]: \"bound_um\" is missing",
        ),
        (
            |summary| summary["arcs"][0]["ends"][1]["rest_s"] = json!(1.5),
            "summary.arcs[0].ends[1]: there is no key rest_s",
        ),
        (
            |summary| summary["blend_samples"] = json!("20"),
            "summary.blend_samples: \"20\" is not of type \"integer\"",
        ),
        (
            |summary| summary["blends"][0]["corner_distance_um"] = json!(1),
            "summary.blends[0].corner_distance_um: 1 is not of type \"object\"",
        ),
        (
            |summary| summary["lines"][0]["line"] = json!(-1),
            "summary.lines[0].line: -1 is not from 0",
        ),
        (
            |summary| summary["end_position"] = json!([1, 2]),
            "summary.end_position: [1,2] is not a list of its length",
        ),
        (
            |summary| summary["version"] = json!(2),
            "summary.version: 2 is not 1",
        ),
        (
            |summary| drop(summary["settings"].as_object_mut().unwrap().remove("arm")),
            "summary.settings: \"arm\" is missing",
        ),
        (
            |summary| summary["settings"]["piece"][0]["to_mm"] = json!(null),
            "summary.settings.piece[0].to_mm: null is not of type \"array\"",
        ),
        (
            |summary| summary["settings"]["rounding"] = json!("up"),
            "summary.settings.rounding: \"up\" is not one of [\"nearest\",\"floor\"]",
        ),
    ];
    for (change, expected) in cases {
        let mut other = good.clone();
        change(&mut other);
        assert_eq!(judge(&schema, &other).join(", "), expected);
    }
}

/// Returns what of a value a kind of the schema does not allow.
fn judge_as(schema: &Value, kind: &str, value: &Value) -> Vec<String> {
    violations(schema, &schema["$defs"][kind], value, kind)
}

#[test]
fn errors_are_those_of_the_schema() {
    let bench = Bench::with("s.toml", "circuit = \"lead_angle\"\nstep = []\nwhat = 1\n");
    let schema = schema();
    let cases: [(&[&str], &str); 6] = [
        (&["run", "s.toml"], "input"),
        (&["list", "unit_lav"], "argument"),
        (
            &["list", "unit_law", "--set", "a=1", "--set", "b=1"],
            "argument",
        ),
        (&["run", "--nonsense"], "usage"),
        (&["check", "unit_law", "--merge", "none"], "usage"),
        (&["check", "--merge", "none"], "input"),
    ];
    for (arguments, kind) in cases {
        let done = bench.run(&[arguments, &["--json"]].concat());
        let mut error: Value = serde_json::from_str(&done.stdout).expect("one value");
        assert_eq!(error["error"]["kind"], kind, "{arguments:?}");
        assert_eq!(judge_as(&schema, "error", &error), [""; 0], "{arguments:?}");
        error["error"]["kind"] = json!("other");
        error["version"] = json!("1");
        assert_eq!(judge_as(&schema, "error", &error).len(), 2, "{arguments:?}");
    }
}

#[test]
fn the_report_of_a_check_is_that_of_the_schema() {
    let (bench, schema) = (Bench::new(), schema());
    let proof = ["check", "sync_stage"];
    let literal = ["check", "unit_law", "--set", "variant=literal"];
    for arguments in [&proof[..], &literal] {
        let done = bench.run(&[arguments, &["--json"]].concat());
        let mut report: Value = serde_json::from_str(&done.stdout).expect("one value");
        assert_eq!(
            judge_as(&schema, "check", &report),
            [""; 0],
            "{arguments:?}"
        );
        report["rows"][0]["ended"] = json!("proved");
        assert_eq!(
            judge_as(&schema, "check", &report).len(),
            1,
            "{arguments:?}"
        );
    }
}

#[test]
fn the_report_of_proofs_at_full_width_is_that_of_the_schema() {
    let (bench, schema) = (Bench::new(), schema());
    let proof = ["check", "enable_counter", "--full"];
    let literal = [
        "check",
        "pulse_generator",
        "--full",
        "--set",
        "variant=literal",
        "--limit-seconds",
        "1",
    ];
    for arguments in [&proof[..], &literal] {
        let done = bench.run(&[arguments, &["--json"]].concat());
        let mut report: Value = serde_json::from_str(&done.stdout).expect("one value");
        let judged = judge_as(&schema, "check_full", &report);
        assert_eq!(judged, [""; 0], "{arguments:?}");
        report["rows"][0]["full_width_by"] = json!("proved");
        let judged = judge_as(&schema, "check_full", &report);
        assert_eq!(judged.len(), 1, "{arguments:?}");
    }
}

/// Whatever is printed as JSON has the same version.
#[test]
fn every_json_has_the_version() {
    let bench = Bench::with("line.hpgl", "PD400,0;");
    let run = ["line.hpgl", "--to", "9", "--set", "clock_hz=100000"];
    bench.succeed(&[&run[..], &["--set", "line_unit_ticks=500"]].concat());
    let dump = "waves/line.vcd";
    let commands: [&[&str]; 8] = [
        &[
            "line.hpgl",
            "--no-vcd",
            "--set",
            "clock_hz=100000",
            "--set",
            "line_unit_ticks=500",
        ],
        &["table", "line.hpgl"],
        &["check", "sync_stage"],
        &["mutate", "sync_stage", "--runs", "1", "--ticks", "20"],
        &["compare", dump, dump],
        &["list", "sync_stage"],
        &["keys"],
        &["keys", "machine"],
    ];
    for command in commands {
        assert_eq!(bench.json(command)["version"], 1, "{command:?}");
    }
}

#[test]
fn every_property_has_a_type_and_a_description() {
    let schema = schema();
    let (mut count, mut bare) = (0, Vec::new());
    look(&schema, "", &mut |place, property| {
        count += 1;
        let typed = ["type", "$ref", "anyOf", "oneOf", "enum", "const"];
        let typed = typed.iter().any(|key| property.get(key).is_some());
        let described = property["description"]
            .as_str()
            .is_some_and(|text| text.len() > 3);
        if !typed || !described {
            bare.push(place.to_owned());
        }
    });
    assert!(count > 150, "{count}");
    assert_eq!(bare, [""; 0]);
    look_at_tables(&schema, "", &mut |place, table| {
        assert_eq!(table["additionalProperties"], false, "{place}");
        assert!(table["required"].is_array(), "{place}");
    });
}

/// Visits every table of a schema that has properties.
fn look_at_tables(schema: &Value, place: &str, visit: &mut dyn FnMut(&str, &Value)) {
    if schema["properties"].is_object() && schema["type"] == "object" {
        visit(place, schema);
    }
    let children = schema.as_object().into_iter().flatten();
    for (key, child) in children {
        look_at_tables(child, &format!("{place}/{key}"), visit);
    }
}

/// Visits every property of a schema.
fn look(schema: &Value, place: &str, visit: &mut dyn FnMut(&str, &Value)) {
    look_at_tables(schema, place, &mut |place, table| {
        for (key, property) in table["properties"].as_object().into_iter().flatten() {
            visit(&format!("{place}/{key}"), property);
        }
    });
}
