//! Position detectors: an absolute encoder of a turn, a phase-shift transducer, and a resolver.

use super::refusals::{refusal, refused};
use super::*;

#[test]
#[ignore = "takes long"]
fn an_absolute_encoder_has_an_incremental_one_beside_it() {
    let bench = small();
    let run = [
        "run",
        "--beside",
        "s.toml",
        "--to",
        "3000",
        "--set",
        "detector=absolute",
    ];
    let summary = bench.json(&run);
    assert_eq!(summary["settings"]["detector"], "absolute");
    assert_eq!(list(&summary, "systems").len(), 11);
    let [learning, counted] = ["learning", "incremental"].map(|name| system(&summary, name));
    assert_eq!(counted, 10);
    let other = small().json(&["run", "--beside", "s.toml", "--no-vcd"]);
    assert_eq!(other["settings"]["detector"], "incremental");
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

/// A log too is seen by them: other paths to the same predictions. At 10 counts a millisecond a CK is a
/// count.
#[test]
fn a_log_is_seen_by_the_detectors_of_places() {
    for (detector, most) in [("absolute", 4.0), ("phase_shift", 6.0), ("resolver", 6.0)] {
        let set = format!("detector={detector}");
        let run = ["run", "--beside", "s.toml", "--no-vcd", "--set", &set];
        let [places, counted] = [&run[..], &run[..3]].map(|run| log().json(run));
        let signals = |summary: &Value| list(summary, "signals").to_vec();
        assert_eq!(signals(&places).len(), 2);
        for (one, other) in signals(&places).iter().zip(signals(&counted)) {
            let apart = number(one, "/error_counts") - number(&other, "/error_counts");
            assert!(apart.abs() <= most, "{one} {other}");
        }
    }
}

/// The small job with pitches of 50 counts.
const PHASE_SHIFT: [&str; 6] = [
    "--set",
    "detector=phase_shift",
    "--set",
    "clock_hz=500000",
    "--set",
    "ck_ticks=50",
];

#[test]
#[ignore = "takes long"]
fn a_phase_shift_transducer_has_an_incremental_encoder_beside_it() {
    let bench = small();
    let run = [
        &["run", "--beside", "s.toml", "--to", "3000"][..],
        &PHASE_SHIFT,
    ]
    .concat();
    let summary = bench.json(&run);
    assert_eq!(summary["settings"]["detector"], "phase_shift");
    let [learning, counted] = ["learning", "incremental"].map(|name| system(&summary, name));
    for row in list(&summary, "positionings") {
        let error = |system: usize| row["error_counts"][system].as_i64().unwrap();
        // At 40000 counts/s a CK is 4 counts, of which the position is late by up to one.
        let apart = error(learning) - error(counted);
        assert!(apart.abs() <= 30, "{row}");
    }
    let vcd = bench.read("waves/s.vcd");
    for signal in [" sync_secondary ", " carrier ", " seen_phase "] {
        assert!(vcd.contains(signal), "no{signal}");
    }
    let text = bench.succeed(&run);
    assert!(
        text.contains("\nphase-shift detector, history shift_register"),
        "{text}"
    );
}

#[test]
fn a_pitch_that_no_transducer_has_is_refused() {
    for (lines, complaint) in [
        (
            "ck_ticks = 15\n",
            "ck_ticks: is 15; allowed: 16 to 131072 with detector = \"phase_shift\", counts of its \
             pitch",
        ),
        (
            "ck_ticks = 131_073\n",
            "ck_ticks: is 131073; allowed: 16 to 131072 with detector = \"phase_shift\", counts of its \
             pitch",
        ),
        (
            "counts_per_rev = 90_050\n",
            "counts_per_rev: is 90050; allowed: a multiple of 100 with detector = \"phase_shift\", \
             whose pitch is ck_ticks",
        ),
        (
            "sampling_clock_ppm = 50\n",
            "sampling_clock_ppm: is 50; allowed: 0 with detector = \"phase_shift\", whose carrier is \
             ck_ticks",
        ),
    ] {
        assert_eq!(
            refused(&format!("detector = \"phase_shift\"\n{lines}")),
            format!("error: s.toml:3: {complaint}\n")
        );
    }
    // (20 - 4)/(7·20 + 4) of 200,000.
    let set = ["s.toml", "--set", "detector=phase_shift"];
    assert_eq!(
        refusal(&small(), &set),
        "error: s.toml:13: step 1: speed_counts_per_s: is 40000; allowed: 10 to 22222, a multiple of \
         10\n"
    );
}

#[test]
fn a_resolver_has_an_incremental_encoder_beside_it() {
    let bench = small();
    let run = [
        "run",
        "--beside",
        "s.toml",
        "--to",
        "9000",
        "--set",
        "detector=resolver",
    ];
    let summary = bench.json(&run);
    assert_eq!(summary["settings"]["detector"], "resolver");
    let [learning, counted] = ["learning", "incremental"].map(|name| system(&summary, name));
    for row in list(&summary, "positionings") {
        let error = |system: usize| row["error_counts"][system].as_i64().unwrap();
        // At 40000 counts/s a CK is 4 counts.
        assert!((error(learning) - error(counted)).abs() <= 24, "{row}");
        assert!(number(row, &format!("/position_error_counts/{learning}")).abs() <= 3.0);
    }
    let vcd = bench.read("waves/s.vcd");
    for signal in [" sine ", " quadrature ", " scaled "] {
        assert!(vcd.contains(signal), "no{signal}");
    }
    let text = bench.succeed(&run);
    assert!(
        text.contains("\nresolver, history shift_register"),
        "{text}"
    );
    // 22500 counts a pitch by 2π: 35.8 for an offset of 0.01, at the angle of 0.
    let off = [&run[..], &["--set", "sine_offset=0.01"]].concat();
    let summary = bench.json(&off);
    let largest = number(&summary["systems"][learning], "/position_error_max_counts");
    assert!((25.0..40.0).contains(&largest), "{largest}");
}

#[test]
fn a_resolver_that_is_none_is_refused() {
    for (lines, complaint) in [
        (
            "ck_ticks = 18\n",
            "ck_ticks: is 18; allowed: 19 or more with detector = \"resolver\": a conversion",
        ),
        ("pole_pairs = 65\n", "pole_pairs: is 65; allowed: 1 to 64"),
        (
            "sine_offset = 0.2\n",
            "sine_offset: is 0.2; allowed: -0.1 to 0.1",
        ),
        (
            "gain_mismatch = nan\n",
            "gain_mismatch: is NaN; allowed: -0.1 to 0.1",
        ),
        (
            "counts_per_rev = 90_001\n",
            "counts_per_rev: is 90001; allowed: a multiple of 4 from 64 to 524288 with detector = \
             \"resolver\", whose pitch is a pole pair",
        ),
        (
            "sampling_clock_ppm = 50\n",
            "sampling_clock_ppm: is 50; allowed: 0 with detector = \"resolver\", whose strobe is \
             ck_ticks",
        ),
    ] {
        assert_eq!(
            refused(&format!("detector = \"resolver\"\n{lines}")),
            format!("error: s.toml:3: {complaint}\n")
        );
    }
    for (line, allowed) in [
        ("pole_pairs = 8", 4),
        ("sine_offset = 0.01", 0),
        ("gain_mismatch = -0.01", 0),
    ] {
        let (field, value) = line.split_once(" = ").unwrap();
        assert_eq!(
            refused(&format!("{line}\n")),
            format!(
                "error: s.toml:2: {field}: is {value}; allowed: {allowed} without detector = \
                 \"resolver\"\n"
            )
        );
    }
    // An eighth of 20 counts in a CK of 0.1 ms.
    let set = "detector=resolver counts_per_rev=1280 pole_pairs=64";
    let set: Vec<&str> = set.split(' ').flat_map(|set| ["--set", set]).collect();
    assert_eq!(
        refusal(&small(), &[&["s.toml"][..], &set].concat()),
        "error: s.toml:13: step 1: speed_counts_per_s: is 40000; allowed: 10 to 25000, a multiple of \
         10\n"
    );
}

#[test]
fn a_turn_that_no_encoder_has_is_refused() {
    assert_eq!(
        refused("detector = \"tachometer\"\n"),
        "error: s.toml:2: detector: unknown variant `tachometer`; allowed: one of \
         `incremental`, `absolute`, `phase_shift`, `resolver`\n"
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
