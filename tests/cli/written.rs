//! Files of runs beside those of others: save files that stay, the list by which `clean` knows what
//! runs have written.

use super::support::{Bench, LINE, SHORT, list, paths};
use rayon::prelude::*;
use serde_json::{Value, json};
use std::fs;

/// Runs the drawing, with the waves of a few ticks.
fn run(bench: &Bench, more: &[&str]) -> Value {
    bench.json(&[&["line.hpgl", "--to", "100"], more, &SHORT[..]].concat())
}

/// The warnings of a run that had to give its save file a number.
fn kept(files: &str, written: &str) -> Value {
    json!([format!(
        "{files} stays, as no run wrote it or it was changed since: the save file of this run is \
         {written}"
    )])
}

#[test]
fn a_save_file_of_somebody_stays() {
    let bench = Bench::with("line.hpgl", LINE);
    bench.write("waves/line.gtkw", "[*] arranged\n");
    let kept = kept("waves/line.gtkw", "waves/line.2.gtkw");
    for _ in 0..2 {
        let summary = run(&bench, &[]);
        assert_eq!(summary["warnings"], kept);
        let files = ["waves/line.vcd", "waves/line.2.gtkw", "waves/line.svg"];
        assert_eq!(paths(&summary), json!(files));
    }
    assert_eq!(bench.read("waves/line.gtkw"), "[*] arranged\n");
    let save = bench.read("waves/line.2.gtkw");
    assert!(
        save.contains("[dumpfile] \"line.vcd\"\n[savefile] \"line.2.gtkw\"\n"),
        "{save}"
    );
    // Arranged as well.
    bench.write("waves/line.2.gtkw", "[*] arranged too\n");
    let summary = run(&bench, &[]);
    assert_eq!(
        summary["warnings"],
        self::kept("waves/line.gtkw, waves/line.2.gtkw", "waves/line.3.gtkw")
    );
    assert_eq!(bench.read("waves/line.2.gtkw"), "[*] arranged too\n");
    bench.succeed(&["clean", "--yes"]);
    let left = [
        "line.hpgl",
        "waves/",
        "waves/line.2.gtkw",
        "waves/line.gtkw",
    ];
    assert_eq!(bench.names(), left);
}

#[test]
fn a_save_file_of_a_run_is_replaced() {
    let bench = Bench::with("line.hpgl", LINE);
    run(&bench, &[]);
    let first = bench.read("waves/line.gtkw");
    let summary = run(&bench, &["--only", "pulse_interpolator.x"]);
    assert_eq!(summary["warnings"], json!([]));
    assert_ne!(bench.read("waves/line.gtkw"), first);
    // One with the same text may be of anybody.
    let other = Bench::with("line.hpgl", LINE);
    other.write("waves/line.gtkw", &first);
    let summary = run(&other, &[]);
    assert_eq!(summary["warnings"], json!([]));
    assert_eq!(other.read("waves/line.gtkw"), first);
    other.succeed(&["clean", "--yes"]);
    assert_eq!(other.names(), ["line.hpgl", "waves/", "waves/line.gtkw"]);
    // Another text is not put in its place.
    let summary = run(&other, &["--format", "fst"]);
    assert_eq!(list(&summary, "warnings").len(), 1);
    assert_eq!(other.read("waves/line.gtkw"), first);
}

/// The lines of a directory's list, without size and time.
fn listed(bench: &Bench, directory: &str) -> Vec<String> {
    let text = bench.read(&format!("{directory}/.motion-rtl-written"));
    let names = text.lines().map(|line| line.splitn(3, ' ').nth(2).unwrap());
    names.map(str::to_owned).collect()
}

#[test]
fn a_file_is_listed_once() {
    let bench = Bench::with("line.hpgl", LINE);
    for _ in 0..3 {
        run(&bench, &[]);
    }
    assert_eq!(
        listed(&bench, "waves"),
        ["line.gtkw", "line.svg", "line.vcd"]
    );
    // A file that is gone is not listed any longer.
    fs::remove_file(bench.path("waves/line.svg")).unwrap();
    bench.write("table.hpgl", LINE);
    bench.succeed(&["table", "table.hpgl", "--out", "waves/table.csv"]);
    assert_eq!(
        listed(&bench, "waves"),
        ["line.gtkw", "line.vcd", "table.csv"]
    );
}

#[test]
fn runs_side_by_side_are_all_listed() {
    let bench = Bench::new();
    (0..12).into_par_iter().for_each(|k| {
        let name = format!("t{k}.hpgl");
        bench.write(&name, LINE);
        bench.succeed(&["table", &name, "--out", &format!("o/t{k}.csv")]);
    });
    assert_eq!(listed(&bench, "o").len(), 12);
    bench.succeed(&["clean", "o", "--yes"]);
    assert!(bench.names().iter().all(|name| !name.ends_with(".csv")));
}

#[test]
fn the_waves_of_a_counterexample_are_listed() {
    let check = [
        "check",
        "unit_law",
        "--set",
        "variant=literal",
        "--out",
        "o",
    ];
    let bench = Bench::new();
    assert_eq!(bench.run(&check).code, 1);
    let waves = bench.names();
    assert_eq!(waves.len(), 3, "{waves:?}");
    assert_eq!(bench.run(&check).code, 1);
    bench.succeed(&["clean", "o", "--yes"]);
    assert_eq!(bench.names(), ["o/"]);
    // A file that was there before is somebody else's.
    let dump = waves.iter().find(|name| name.ends_with(".vcd")).unwrap();
    bench.write(dump, "old");
    assert_eq!(bench.run(&check).code, 1);
    bench.succeed(&["clean", "o", "--yes"]);
    assert_eq!(bench.names(), ["o/", dump]);
}
