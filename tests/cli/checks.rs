//! `check` and `list`.

use super::support::{Bench, keys, list};
use motion_rtl::registry::CATALOGUE;
use predicates::prelude::*;
use serde_json::json;

#[test]
fn a_proof_names_states_and_invariants() {
    let text = Bench::new().succeed(&["check", "sync_stage"]);
    let rows = text
        .lines()
        .map(|line| line.split_whitespace().collect::<Vec<_>>());
    let rows: Vec<_> = rows
        .filter(|row| row.first() == Some(&"sync_stage"))
        .collect();
    let [[_, "2", "8", "1", seconds, "s", "proved"]] =
        rows.iter().map(Vec::as_slice).collect::<Vec<_>>()[..]
    else {
        panic!("{text}")
    };
    assert!(seconds.parse::<f64>().is_ok(), "{text}");
    assert!(text.contains("step is low in the tick after RST"), "{text}");
}

#[test]
fn a_width_is_taken_up() {
    let bench = Bench::new();
    let text = bench.succeed(&["check", "enable_counter", "--width", "2"]);
    assert!(text.contains("enable_counter             2 "), "{text}");
    assert!(bench.names().is_empty(), "a proof writes nothing");
}

#[test]
fn all_widths_go_up_from_one_until_the_time_is_over() {
    let text = Bench::new().succeed(&["check", "enable_counter", "--all-widths=0.3"]);
    let rows = text.lines().filter(|row| row.starts_with("enable_counter"));
    let mut widths = 0;
    for (width, row) in (1..).zip(rows) {
        let cells: Vec<_> = row.split_whitespace().collect();
        assert_eq!(cells[1], width.to_string(), "{text}");
        match *cells.last().unwrap() {
            "proved" => assert_eq!(cells[2], ((1_u64 << width) - 1).to_string(), "{text}"),
            "decided" => assert!(width > 3, "{text}"),
            other => panic!("{other}: {text}"),
        }
        widths = width;
    }
    assert!(widths > 3, "{text}");
    let bench = Bench::new();
    bench
        .command(&["check", "enable_counter", "--all-widths", "3"])
        .assert()
        .code(2)
        .stderr("error: --all-widths: 3 stands for a circuit here; allowed: --all-widths=3\n");
    bench
        .command(&["check", "integrator", "--all-widths"])
        .assert()
        .code(2)
        .stderr(
            "error: --all-widths: integrator: swept, not proved; allowed: circuits that are \
             proved\n",
        );
}

#[test]
fn a_proof_that_is_given_up_fails() {
    Bench::new()
        .command(&["check", "unit_law", "--limit", "10"])
        .assert()
        .code(2)
        .stdout(
            predicate::str::contains("not decided")
                .and(predicate::str::contains("\n  not proved: ")),
        )
        .stderr("error: unit_law: not decided within 10 states; allowed: a larger --limit\n");
}

#[test]
fn the_literal_variant_breaks_and_shows_how() {
    let bench = Bench::new();
    let arguments = [
        "check",
        "unit_law",
        "--set",
        "variant=literal",
        "--out",
        "found/here",
    ];
    bench
        .command(&arguments)
        .assert()
        .code(1)
        .stdout(predicate::str::contains("BROKEN"))
        .stderr(predicate::str::starts_with(
            "error: unit_law: tick 2: count, toggle and step depend only",
        ))
        .stderr(predicate::str::contains(
            "found/here/unit_law_count__toggle_and_step_depend_only",
        ));
    let mut endings: Vec<_> = std::fs::read_dir(bench.path("found/here"))
        .unwrap()
        .filter_map(|file| file.unwrap().path().extension().map(ToOwned::to_owned))
        .collect();
    endings.sort();
    assert_eq!(endings, ["gtkw", "vcd"]);
}

#[test]
fn only_the_properties_that_contain_a_text_are_proved() {
    let bench = Bench::new();
    let circuit = &bench.json(&["list", "unit_law"])["circuits"][0];
    let all = list(circuit, "properties");
    assert!(all.len() > 2, "{circuit}");
    let proved = |property: &str| {
        let report = bench.json(&["check", "unit_law", "--property", property]);
        list(&report, "rows")[0]["invariants"].clone()
    };
    assert_eq!(proved(""), json!(all));
    for property in all {
        assert_eq!(proved(property.as_str().unwrap()), json!([property]));
    }
    let depend = "COUNT, toggle and step depend only";
    let one = proved(depend);
    assert_eq!(one.as_array().map(Vec::len), Some(1), "{one}");
    // The literal variant violates this property, and not all others.
    let literal = ["check", "unit_law", "--set", "variant=literal"];
    let with = |property: &str| bench.run(&[&literal[..], &["--property", property]].concat());
    assert_eq!(with(depend).code, 1);
    let mut held = 0;
    for property in all.iter().filter(|property| **property != one[0]) {
        held += usize::from(with(property.as_str().unwrap()).code == 0);
    }
    assert!(held > 0);
}

#[test]
fn a_text_that_no_property_contains_is_refused() {
    let bench = Bench::new();
    bench
        .command(&["check", "sync_stage", "--property", "nonsense"])
        .assert()
        .code(2)
        .stderr(predicate::str::starts_with(
            "error: --property: no property of sync_stage contains nonsense; allowed: step is low",
        ));
    let text = "--property: no property of any circuit contains nonsense; allowed: a part of a \
                property's text; `motion-rtl list NAME` shows them";
    bench.refuse(&["check", "--property", "nonsense"], text);
    let done = bench.run(&["check", "sync_stage", "--full", "--property", "step"]);
    assert_eq!(done.code, 2);
    assert!(
        done.stderr.contains("cannot be used with '--property"),
        "{}",
        done.stderr
    );
    // A circuit that is named has to have it; without names, the others are left out.
    let low = "step is low in the tick after RST";
    let done = bench.run(&["check", "sync_stage", "enable_counter", "--property", low]);
    assert_eq!(done.code, 2, "{}", done.stdout);
    let report = bench.json(&["check", "--property", low]);
    let rows = list(&report, "rows").iter();
    assert!(rows.clone().any(|row| row["circuit"] == "sync_stage"));
    for row in rows {
        assert_eq!(row["invariants"], json!([low]));
    }
}

#[test]
fn a_counterexample_is_told_where_its_waves_cannot_be_written() {
    Bench::with("taken", "")
        .command(&[
            "check",
            "unit_law",
            "--set",
            "variant=literal",
            "--out",
            "taken",
        ])
        .assert()
        .code(1)
        .stdout(predicate::str::contains("BROKEN"))
        .stderr(predicate::str::starts_with("error: unit_law: tick 2: "))
        .stderr(predicate::str::contains(
            "\nwaves: none: the waves could not be written: taken",
        ))
        .stderr(predicate::str::ends_with(
            "; allowed: another --out, a directory\n",
        ));
}

#[test]
fn the_table_tells_what_a_circuit_is_made_with() {
    let rule = "integrator.rule=centred";
    let run = Bench::new().run(&["check", "line_law", "--set", rule]);
    assert_eq!(run.code, 0, "{}", run.stderr);
    let row = run.stdout.lines().nth(1).expect("a row");
    let words: Vec<_> = row.split_whitespace().take(2).collect();
    assert_eq!(words, ["line_law", "3"]);
    assert!(
        row.ends_with("proved --set integrator.rule=centred"),
        "{row}"
    );
    // The least and the greatest of several widths.
    let text = Bench::new().succeed(&["check", "command_join"]);
    assert!(text.contains("command_join             2-3 "), "{text}");
}

#[test]
fn one_circuit_that_is_too_wide_does_not_hide_the_others() {
    let text = "error: pulse_interpolator: ";
    let wide = ["--set", "widths.half_period=4", "--set", "widths.period=4"];
    Bench::new()
        .command(&[&["check", "pulse_interpolator"], &wide[..]].concat())
        .assert()
        .code(2)
        .stdout(predicate::str::contains("too wide"))
        .stderr(predicate::str::starts_with(text));
}

/// A circuit without a proof among others, and a law that is not swept at this width.
#[test]
fn what_is_too_wide_does_not_stop_the_others() {
    let bench = Bench::new();
    let done = bench.run(&["check", "machine", "sync_stage", "compensator"]);
    let rows: Vec<_> = done
        .stdout
        .lines()
        .filter(|line| line.ends_with("proved"))
        .collect();
    assert!(
        matches!(rows[..], [row] if row.starts_with("sync_stage ")),
        "{}",
        done.stdout
    );
    assert!(
        done.stdout
            .ends_with("too wide for exhaustion: machine, compensator\n")
    );
    let told = |name: &str| {
        format!(
            "{name} is too wide for a proof by exhaustion; allowed: its blocks, or --full for what \
             it and its parts state; what is tested of it stands in its note\n"
        )
    };
    assert_eq!(
        done.stderr,
        format!("error: {}{}", told("machine"), told("compensator"))
    );
    assert_eq!(done.code, 2);
}

#[test]
fn what_cannot_be_proved_is_refused() {
    let bench = Bench::new();
    bench.refuse(
        &["check", "nonsense"],
        "CIRCUIT: there is no nonsense; allowed: a name of a circuit; `motion-rtl list` shows all",
    );
    let none = "CIRCUIT: missing beside --width 3; allowed: the circuit whose key it is, as in `check \
                comparator --set comparing=equal`";
    bench.refuse(&["check", "--width", "3"], none);
    let set = |circuit: &str, pair: &str, text: &str| {
        bench.refuse(
            &["check", circuit, "--set", pair],
            &format!("--set {pair}: {text}"),
        );
    };
    set(
        "unit_law",
        "variant=literel",
        "unknown variant `literel`; did you mean literal?; allowed: `safe` or `literal`",
    );
    set(
        "integrator",
        "rule=9",
        "is 9; allowed: `floor`, `truncating` or `centred`",
    );
    set(
        "sync_stage",
        "x=1",
        "no key of sync_stage; allowed: none: it has no keys",
    );
    let values = bench.run(&["check", "unit_time_register", "--set", "period=8"]);
    assert_eq!(values.code, 2);
    assert!(
        values.stderr.contains("8 does not fit 3 bits"),
        "{}",
        values.stderr
    );
    // The former spelling says the one that counts.
    bench.refuse(
        &["check", "comparator", "--with", "0", "1"],
        "--with: takes no numbers; allowed: values by their keys, --set comparing=crossing; see \
         `list comparator`",
    );
    for arguments in [["check", "--width", "wide"], ["check", "--limit", "-1"]] {
        assert_eq!(bench.run(&arguments).code, 2);
    }
}

#[test]
fn the_list_has_every_circuit_with_ports_and_widths() {
    let bench = Bench::new();
    let list = bench.json(&["list"]);
    assert_eq!(keys(&list), ["circuits", "scenarios", "version"]);
    let circuits = list["circuits"].as_array().unwrap();
    let names: Vec<_> = circuits
        .iter()
        .map(|circuit| circuit["name"].as_str().unwrap())
        .collect();
    let expected: Vec<_> = CATALOGUE.iter().map(|entry| entry.name).collect();
    assert_eq!(names, expected);
    let find = |name: &str| &circuits[names.iter().position(|other| *other == name).unwrap()];
    let port = |port: &serde_json::Value| {
        let name = port["name"].as_str().unwrap().to_owned();
        (name, port["width"].as_u64().unwrap())
    };
    let ports = |circuit: &serde_json::Value, way: &str| -> Vec<_> {
        circuit[way].as_array().unwrap().iter().map(port).collect()
    };
    let generator = find("pulse_generator");
    assert_eq!(
        generator["keys"]["width"],
        json!({"full": "16", "small": "3"})
    );
    assert_eq!(generator["keys"]["variant"]["full"], "safe");
    let half_period = ("half_period".to_owned(), 16);
    assert!(
        ports(generator, "inputs").contains(&half_period),
        "{generator}"
    );
    let group = find("pulse_interpolator");
    assert!(ports(group, "inputs").contains(&("period".to_owned(), 24)));
    assert!(ports(group, "outputs").contains(&("step_x".to_owned(), 1)));
    for circuit in circuits {
        assert!(!ports(circuit, "inputs").is_empty(), "{circuit}");
        assert!(!ports(circuit, "outputs").is_empty(), "{circuit}");
        assert!(!circuit["about"].as_str().unwrap().is_empty());
    }
    // Signed words, and ports out that stand in a bundle.
    let interpolator = &find("circular_interpolator")["outputs"];
    let order: Vec<_> = interpolator.as_array().unwrap().iter().collect();
    let order = order.iter().filter_map(|port| {
        let name = port["name"].as_str().unwrap().strip_prefix("next_order.")?;
        Some((
            name,
            port["width"].as_u64().unwrap(),
            port["signed"] == true,
        ))
    });
    assert_eq!(
        order.collect::<Vec<_>>(),
        [
            ("command", 1, false),
            ("delta_x", 17, true),
            ("delta_y", 17, true),
            ("units", 16, false),
            ("period", 24, false),
        ]
    );
    let text = bench.succeed(&["list"]);
    assert!(text.contains("next_order.delta_x[17, signed], "), "{text}");
    for circuit in circuits {
        let ports = ["inputs", "outputs"].map(|way| circuit[way].to_string());
        assert!(!ports.concat().contains("[`"), "{circuit}");
    }
    for name in names {
        assert!(text.contains(&format!("\n  {name} (")), "{name}");
    }
    assert!(bench.names().is_empty());
}

#[test]
fn a_circuit_is_listed_with_what_drives_its_parts() {
    let bench = Bench::new();
    let list = bench.json(&["list", "axis"]);
    assert_eq!(keys(&list), ["circuits", "version"]);
    let connections = &list["circuits"][0]["connections"];
    let memory = &connections["parts"][0];
    assert_eq!(memory["name"], "memory");
    assert_eq!(memory["circuit"], "pattern_memory");
    assert_eq!(memory["source"], "JP3640909B2 10");
    assert_eq!(memory["parameters"]["AXIS"], 0);
    let half_period = &connections["parts"][1]["inputs"][0];
    let expected = serde_json::json!({
        "name": "half_period", "width": 16, "signed": false, "driver": "memory.half_period"
    });
    assert_eq!(*half_period, expected);
    assert_eq!(connections["outputs"][0]["driver"], "sync.step");
    let properties = keys(&list["circuits"][0]);
    assert!(properties.contains(&"properties"), "{properties:?}");
    let text = bench.succeed(&["list", "axis"]);
    let part = "    generator: pulse_generator\n      half_period[16] = memory.half_period\n";
    assert!(text.contains(part), "{text}");
    assert!(!text.contains("scenarios"), "{text}");
    // One without parts.
    let list = bench.json(&["list", "sync_stage"]);
    let connections = &list["circuits"][0]["connections"];
    assert_eq!(connections["parts"], serde_json::json!([]));
    assert_eq!(connections["registers"][0]["name"], "step");
    let text = bench.succeed(&["list", "sync_stage"]);
    assert!(
        text.contains("    out     step\n    checked step is low"),
        "{text}"
    );
    let refused = bench.run(&["list", "sync"]);
    assert_eq!(refused.code, 2);
    assert!(
        refused.stderr.contains("there is no sync; allowed: "),
        "{}",
        refused.stderr
    );
}
