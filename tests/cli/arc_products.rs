//! Blends by products: a run of them, beside differences, and what is refused.

use super::arc::{SEAM, with};
use super::support::{list, number};
use serde_json::Value;

const PRODUCTS: [&str; 5] = ["run", "s.toml", "--no-vcd", "--set", "blend=products"];

fn run(set: &[&str]) -> Value {
    let mut arguments = PRODUCTS.to_vec();
    for set in set {
        arguments.extend(["--set", set]);
    }
    with(SEAM).json(&arguments)
}

#[test]
fn blends_by_products_are_those_by_differences() {
    let summary = run(&["clock_hz=20000"]);
    assert_eq!(
        (&summary["settings"]["blend"], &summary["exact"]),
        (&"products".into(), &true.into())
    );
    assert_eq!(summary["sample_ticks_needed"], 171);
    let beside = &summary["products"];
    assert_eq!(beside["difference_samples_most"], 1024);
    let row = &beside["differences"];
    assert_eq!(
        (&row["samples_differing"], &row["counts_most"]),
        (&0.into(), &0.into())
    );
    let own = &list(&summary, "circuits")[0];
    assert_eq!(
        (&own["ticks_straight"], &own["ticks_change"]),
        (&136.into(), &171.into())
    );
    let cost = list(&summary, "operations").last().unwrap();
    assert_eq!(
        (&cost["multiplications"], &cost["ticks"]),
        (&8.into(), &133.into())
    );
    // Without a command that differs the path is as far off.
    let differences = with(SEAM).json(&["run", "s.toml", "--no-vcd", "--set", "clock_hz=20000"]);
    assert_eq!(differences["products"], Value::Null);
    assert_eq!(differences["settings"]["blend"], "differences");
    let [own, other] = [&summary, &differences].map(|of| number(of, "/error_max_um"));
    assert_eq!(own, other);
    assert!(
        summary["circuits"][0]["adder_bits"].as_u64()
            < differences["circuits"][0]["adder_bits"].as_u64()
    );
}

#[test]
fn a_blend_may_have_more_samples_than_differences_hold() {
    let summary = run(&[
        "clock_hz=400000",
        "sample_period_ms=0.5",
        "acceleration_ms=600",
    ]);
    assert_eq!(
        (&summary["blend_samples"], &summary["exact"]),
        (&1200.into(), &true.into())
    );
    assert_eq!(summary["products"]["differences"], Value::Null);
    let text = with(SEAM).run(&[
        "run",
        "s.toml",
        "--no-vcd",
        "--set",
        "blend=products",
        "--set",
        "clock_hz=400000",
        "--set",
        "sample_period_ms=0.5",
        "--set",
        "acceleration_ms=600",
    ]);
    let line = "blends by products: by differences a blend has 1024 samples at most\n";
    assert!(text.stdout.contains(line), "{}", text.stdout);
}

#[test]
fn what_products_do_not_take_is_refused() {
    let bench = with(SEAM);
    let refused = |arguments: &[&str]| {
        let done = bench.run(arguments);
        assert_eq!((done.code, done.stdout.as_str()), (2, ""));
        done.stderr
    };
    let said = refused(&PRODUCTS);
    let ticks = "sample_period_ms: is 10; allowed: 17.1 to 1677721.5 ms: 171 to 16777215 ticks\n";
    assert!(
        said.contains(ticks) && said.starts_with("error: s.toml:"),
        "{said}"
    );
    let most = "20 to 10485740 ms: 2 to 1048574 samples\n";
    let [set, value] = ["clock_hz=20000", "acceleration_ms=1e9"];
    let said = refused(&[&PRODUCTS[..], &["--set", set, "--set", value]].concat());
    assert!(said.ends_with(most), "{said}");
}
