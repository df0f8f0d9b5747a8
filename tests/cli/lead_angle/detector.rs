//! Position detectors: an absolute encoder of a turn.

use super::refusals::{refusal, refused};
use super::*;

#[test]
fn an_absolute_encoder_has_an_incremental_one_beside_it() {
    let bench = small();
    let run = [
        "run",
        "s.toml",
        "--to",
        "3000",
        "--set",
        "detector=absolute",
    ];
    let summary = bench.json(&run);
    assert_eq!(summary["detector"], "absolute");
    assert_eq!(list(&summary, "systems").len(), 10);
    let [learning, counted] = ["learning", "incremental"].map(|name| system(&summary, name));
    assert_eq!(counted, 9);
    let other = small().json(&["run", "s.toml", "--no-vcd"]);
    assert_eq!(other["detector"], "incremental");
    let rows = list(&summary, "positionings").iter();
    for (row, other) in rows.zip(list(&other, "positionings")) {
        let error = |row: &Value, system: usize| row["error_counts"][system].as_i64().unwrap();
        // The same run as without the key; and at 40000 counts/s a CK is 4 counts.
        assert_eq!(error(row, counted), error(other, learning));
        let apart = error(row, learning) - error(row, counted);
        assert!(apart.abs() <= 24, "{row}");
    }
    let vcd = bench.read("waves/s.vcd");
    assert!(vcd.contains(" sync_code "), "no word");
    let text = bench.succeed(&run);
    assert!(
        text.contains("\nabsolute encoder, history shift_register"),
        "{text}"
    );
}

/// A log too is seen by it: another path to the same predictions.
#[test]
fn a_log_is_seen_by_an_absolute_encoder() {
    let run = ["run", "s.toml", "--no-vcd", "--set", "detector=absolute"];
    let [absolute, counted] = [&run[..], &run[..3]].map(|run| log().json(run));
    let signals = |summary: &Value| list(summary, "signals").to_vec();
    assert_eq!(signals(&absolute).len(), 2);
    for (one, other) in signals(&absolute).iter().zip(signals(&counted)) {
        let apart = number(one, "/error_counts") - number(&other, "/error_counts");
        assert!(apart.abs() <= 4.0, "{one} {other}");
    }
}

#[test]
fn a_turn_that_no_encoder_has_is_refused() {
    assert_eq!(
        refused("detector = \"resolver\"\n"),
        "error: s.toml:2: detector: unknown variant `resolver`; allowed: `incremental` or \
         `absolute`\n"
    );
    for counts in ["90_001", "131_074", "2", "1000.5"] {
        let shown = counts.replace('_', "");
        assert_eq!(
            refused(&format!(
                "detector = \"absolute\"\ncounts_per_rev = {counts}\n"
            )),
            format!(
                "error: s.toml:3: counts_per_rev: is {shown}; allowed: an even number from 4 to \
                 131072 with detector = \"absolute\"\n"
            )
        );
    }
    assert_eq!(
        refused("sampling_clock_ppm = 50\n"),
        "error: s.toml:2: sampling_clock_ppm: is 50; allowed: 0 with detector = \"incremental\", \
         whose CK is ck_ticks\n"
    );
    assert_eq!(
        refused("detector = \"absolute\"\nsampling_clock_ppm = 10_001\n"),
        "error: s.toml:3: sampling_clock_ppm: is 10001; allowed: -10000 to 10000\n"
    );
    // A quarter of 40 counts in a CK of 0.1 ms.
    let set = [
        "s.toml",
        "--set",
        "detector=absolute",
        "--set",
        "counts_per_rev=40",
    ];
    assert_eq!(
        refusal(&small(), &[&set[..], &["--set", "ck_ticks=100"]].concat()),
        "error: s.toml:13: step 1: speed_counts_per_s: is 40000; allowed: 10 to 20000, a multiple of \
         10\n"
    );
}
