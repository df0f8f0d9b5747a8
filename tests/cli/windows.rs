//! Waves of a window of the ticks: outside of it, the circuit runs with fewer signals watched.

use super::support::{Bench, whole};
use serde_json::Value;
use std::path::Path;

/// Files of shipped jobs, options, and the stem of the waves: one of each kind of job that watches
/// fewer signals outside of the window.
const RUNS: &[(&str, &[&str], &str)] = &[
    ("machine.toml", &[], "machine"),
    ("corner.toml", &[], "corner"),
    ("weld.toml", &[], "weld"),
    ("joint.toml", &[], "joint"),
    ("plotter.toml", &[], "plotter"),
    (
        "turntable.toml",
        &["--set", "positionings=4", "--set", "load_change_after=2"],
        "turntable",
    ),
    (
        "arc.toml",
        &["--waves-of", "conventional_pulse_interpolator"],
        "arc_conventional_pulse_interpolator",
    ),
];

#[test]
fn a_window_shows_what_longer_waves_show_there() {
    for (file, options, stem) in RUNS {
        let bench = Bench::new();
        let path = Path::new(env!("CARGO_MANIFEST_DIR"))
            .join("waves")
            .join(file);
        let run = [&["run", path.to_str().expect("a path")], *options].concat();
        let of = |out: &str, more: &[&str]| bench.json(&[&run, more, &["--out", out]].concat());
        let fst = |out: &str, window: &[&str]| of(out, &[&["--format", "fst"], window].concat());
        let long = fst("long", &["--to", "30000"]);
        let short = fst("short", &["--from", "24000", "--to", "26000"]);
        assert!(whole(&long, "/ticks") > 30_000, "{file}");
        let [long, short] = [long, short].map(without_files);
        assert_eq!(long, short, "{file}");
        let waves = |out: &str| format!("{out}/{stem}.fst");
        let compared = ["compare", "--any-length", &waves("long"), &waves("short")];
        let report = bench.succeed(&compared);
        let equal = "is equal: 2000 ticks (24000 to 25999)";
        assert!(report.contains(equal), "{file}: {report}");
        if !options.contains(&"--waves-of") {
            let none = without_files(of("none", &["--no-vcd"]));
            assert_eq!(none, short, "{file}");
        }
    }
}

/// Returns what a summary says of the run itself.
fn without_files(mut summary: Value) -> Value {
    let keys = summary.as_object_mut().expect("a summary");
    for key in ["files", "vcd_window"] {
        keys.remove(key);
    }
    summary
}
