//! `check --full`: properties at the widths of the full circuits.

use super::support::{Bench, keys, list};
use predicates::prelude::*;
use serde_json::json;

#[test]
fn properties_are_proved_at_full_width() {
    let bench = Bench::new();
    let text = bench.succeed(&["check", "sync_stage", "pulse_generator", "--full"]);
    let row = |property: &str| {
        let row = text.lines().find(|row| row.ends_with(property));
        row.unwrap_or_else(|| panic!("{text}")).to_owned()
    };
    let [first, second] = ["step is low in the tick after RST", "and only there"].map(row);
    assert!(
        first.starts_with("sync_stage") && first.contains("every state"),
        "{text}"
    );
    assert!(
        second.starts_with("pulse_generator           16 induction 1"),
        "{text}"
    );
    assert!(bench.names().is_empty(), "a proof writes nothing");
}

#[test]
fn what_is_refuted_fails_and_what_is_open_is_said() {
    let bench = Bench::new();
    let arguments = [
        "check",
        "pulse_generator",
        "--full",
        "--set",
        "variant=literal",
        "--limit-seconds",
        "1",
        "--out",
        "found",
    ];
    let open = "is not inductive: from count = 65534";
    let narrow = "open; REFUTED at 2";
    let command = "  refuted by: motion-rtl check pulse_generator --full --set variant=literal \
                   --set width=2\n2 proved, 1 open, 3 REFUTED; ";
    let has = predicate::str::contains;
    bench
        .command(&arguments)
        .assert()
        .code(1)
        .stdout(has(open).and(has(narrow)).and(has(command)))
        .stderr(predicate::str::starts_with("error: pulse_generator: tick "));
    let names: Vec<_> = std::fs::read_dir(bench.path("found"))
        .expect("it is there")
        .map(|entry| {
            entry
                .expect("a file")
                .file_name()
                .into_string()
                .expect("a name")
        })
        .collect();
    let has = |name: &str| names.iter().any(|other| other == name);
    assert!(
        has("pulse_generator_RST_clears_count_and_toggle.vcd"),
        "{names:?}"
    );
    let open = "pulse_generator_count_never_reaches_its_greatest_value_induction";
    assert!(
        has(&format!("{open}.vcd")) && has(&format!("{open}.gtkw")),
        "{names:?}"
    );
}

#[test]
fn results_at_full_width_are_printed_as_json() {
    let report = Bench::new().json(&["check", "enable_counter", "--full"]);
    let expected = [
        "asked",
        "program_version",
        "rows",
        "seconds",
        "version",
        "without_properties",
    ];
    assert_eq!(keys(&report), expected);
    assert_eq!(report["asked"]["limit_seconds"], 10);
    assert_eq!(report["asked"]["require_proofs"], false);
    let rows = list(&report, "rows");
    assert!(rows.len() >= 4, "{report}");
    for row in rows {
        assert_eq!(row["widths"], json!({"width": 24}));
        let by = row["full_width_by"].as_str().expect("a text");
        assert!(["every_state", "induction"].contains(&by), "{row}");
        assert_eq!(
            row["ticks"],
            if by == "induction" {
                json!(1)
            } else {
                json!(null)
            }
        );
    }
}

#[test]
fn what_parts_assume_is_listed_with_their_paths() {
    let bench = Bench::new();
    let text = bench.succeed(&["check", "reference_model", "--full"]);
    let value = "scaler: the value is below half of the range when start is high";
    let mut rows = text
        .lines()
        .filter(|row| row.starts_with("reference_model"));
    let row = rows.find(|row| row.ends_with(value));
    let row = row.unwrap_or_else(|| panic!("{text}"));
    assert!(
        row.starts_with("reference_model        16-47 induction"),
        "{row}"
    );
    let lemma = "  relies on: scaler: while busy is high, the partial product is at most the value";
    assert!(text.lines().any(|row| row == lemma), "{text}");
    let text = bench.succeed(&["check", "scaler", "--full"]);
    let given = "the value is below half of the range when start is high";
    let row = text.lines().find(|row| row.ends_with(given));
    let row = row.unwrap_or_else(|| panic!("{text}"));
    assert!(row.contains(" assumed "), "{row}");
}

#[test]
fn what_parts_assume_is_in_the_json() {
    let bench = Bench::new();
    let report = bench.json(&["check", "integrator", "--full"]);
    let rows = list(&report, "rows");
    let parts: Vec<_> = rows.iter().map(|row| &row["part"]).collect();
    assert_eq!(parts, [&json!("mul_div"); 2]);
    assert!(rows.iter().all(|row| row["full_width_by"] == "every_state"));
    let report = bench.json(&["check", "scaler", "--full"]);
    let rows = list(&report, "rows");
    assert!(rows.iter().all(|row| row["part"].is_null()));
    let assumed = rows.iter().filter(|row| row["full_width_by"] == "assumed");
    assert_eq!(assumed.count(), 1);
}

#[test]
fn proofs_may_be_required() {
    let bench = Bench::new();
    let proved = ["check", "enable_counter", "--full", "--require-proofs"];
    bench.succeed(&proved);
    let open = [
        "check",
        "tracking_converter",
        "--full",
        "--limit-seconds",
        "1",
    ];
    let text = bench.succeed(&open);
    let end = "\na property without a result may need more than 1 s of processor time: \
               --limit-seconds\n";
    assert!(text.ends_with(end), "{text}");
    let property = "tracking: the magnitudes of quadrature and in_phase add up to less than \
                    2^(angle + 1) is open; allowed: a larger --limit-seconds, or no \
                    --require-proofs";
    bench
        .command(&[&open[..], &["--require-proofs"]].concat())
        .assert()
        .code(2)
        .stderr(predicate::str::contains(property));
}

/// The narrowest refutation has the command that shows it.
#[test]
fn the_command_below_an_open_property_refutes_it() {
    let bench = Bench::new();
    let narrow = "check pulse_generator --full --set variant=literal --set width=2";
    let arguments: Vec<_> = narrow.split(' ').collect();
    let is_refuted = predicate::function(|text: &str| {
        let property = "  count never reaches its greatest value --set variant=literal";
        let mut rows = text.lines().filter(|row| row.contains(property));
        rows.any(|row| row.contains(" REFUTED "))
    });
    bench
        .command(&arguments)
        .assert()
        .code(1)
        .stdout(is_refuted);
}

#[test]
fn a_width_may_be_set() {
    let text = Bench::new().succeed(&["check", "enable_counter", "--full", "--width", "64"]);
    assert!(
        text.contains("enable_counter            64 induction 1"),
        "{text}"
    );
}

#[test]
fn what_full_width_does_not_go_with_is_refused() {
    let bench = Bench::new();
    for (arguments, text) in [
        (
            &["check", "arc_angle", "--full"][..],
            "arc_angle has no properties",
        ),
        (
            &["check", "sync_stage", "--full", "--shard", "1/2"],
            "cannot be used with",
        ),
        (
            &["check", "sync_stage", "--full", "--limit", "5"],
            "cannot be used with",
        ),
        (&["check", "sync_stage", "--limit-seconds", "5"], "--full"),
        (
            &["check", "sync_stage", "--full", "--limit-seconds", "0"],
            "0",
        ),
    ] {
        bench
            .command(arguments)
            .assert()
            .code(2)
            .stderr(predicate::str::contains(text));
    }
}
