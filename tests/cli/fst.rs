//! Waves as FST.

use super::support::{Bench, LINE, PROGRAM, SHORT};
use std::fs;

fn run(arguments: &[&'static str]) -> Vec<&'static str> {
    [&["run"], arguments, &SHORT[..]].concat()
}

/// The same run in both formats; returns what the comparison says.
#[track_caller]
fn equal(bench: &Bench, arguments: &[&'static str], stem: &str) -> String {
    bench.succeed(&[arguments, &["--out", "o"]].concat());
    let said = bench.succeed(&[arguments, &["--out", "o", "--format", "fst"]].concat());
    let [vcd, fst] = ["vcd", "fst"].map(|extension| format!("o/{stem}.{extension}"));
    assert!(said.contains(&format!("wrote {fst} (")), "{said}");
    let save = bench.read(&format!("o/{stem}.gtkw"));
    assert!(
        save.contains(&format!("[dumpfile] \"{stem}.fst\"\n")),
        "{save}"
    );
    assert!(
        save.contains(&format!("[savefile] \"{stem}.gtkw\"\n")),
        "{save}"
    );
    // Which of them is golden does not matter.
    bench.succeed(&["compare", &fst, &vcd]);
    bench.succeed(&["compare", &vcd, &fst])
}

/// With memories of 4096 words and states by name.
#[test]
fn the_fst_of_a_run_equals_its_vcd() {
    let bench = Bench::with("l.hpgl", LINE);
    let said = equal(&bench, &run(&["l.hpgl"]), "l");
    assert!(said.starts_with("equal"), "{said}");
    let [vcd, fst] = ["o/l.vcd", "o/l.fst"].map(|name| fs::metadata(bench.path(name)).unwrap());
    assert!(fst.len() * 10 < vcd.len());
}

#[test]
fn a_window_of_it_too() {
    let bench = Bench::with("l.hpgl", LINE);
    let window = [
        "l.hpgl",
        "--from",
        "700",
        "--to",
        "3000",
        "--only",
        "pulse_interpolator.x",
    ];
    equal(&bench, &run(&window), "l");
}

#[test]
fn other_formats_are_refused() {
    let bench = Bench::with("l.hpgl", LINE);
    let done = bench.run(&run(&["l.hpgl", "--format", "lxt"]));
    assert_eq!((done.code, done.stdout.as_str()), (2, ""));
    assert!(
        done.stderr.contains("[possible values: vcd, fst]"),
        "{}",
        done.stderr
    );
    let done = bench.run(&run(&["l.hpgl", "--format", "fst", "--no-vcd"]));
    assert_eq!(done.code, 2);
    let only = ["l.hpgl", "--only", "nothing", "--format", "fst"];
    let done = bench.run(&run(&only));
    let text = "error: --only: there is no nothing; allowed: a signal, or a scope: pulse";
    assert!(done.stderr.starts_with(text), "{}", done.stderr);
    assert_eq!(done.code, 2);
    assert_eq!(bench.names(), ["l.hpgl"]);
}

/// A limit on the size of files stands for a disk that is full.
#[cfg(target_os = "linux")]
#[test]
fn a_disk_that_is_full_leaves_nothing() {
    let bench = Bench::with("l.hpgl", LINE);
    let script = "trap '' XFSZ; ulimit -f 8; exec \"$0\" \"$@\"";
    let arguments = [
        &["-c", script, PROGRAM][..],
        &run(&["l.hpgl", "--format", "fst", "--out", "o"]),
    ]
    .concat();
    let output = std::process::Command::new("bash")
        .current_dir(bench.path(""))
        .args(arguments)
        .output()
        .unwrap();
    let stderr = String::from_utf8(output.stderr).unwrap();
    assert!(stderr.contains("o/l.fst: File too large"), "{stderr}");
    assert_eq!(output.status.code(), Some(2), "{stderr}");
    assert_eq!(bench.names(), ["l.hpgl"]);
}
