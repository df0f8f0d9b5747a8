//! `page`, `serve`, and `run --html`.

use super::support::{Bench, LINE, SHORT};
use std::net::TcpListener;

/// The least that is WebAssembly.
const WASM: &[u8] = b"\0asm\x01\0\0\0";

/// The data of a page.
#[track_caller]
fn start(page: &str) -> serde_json::Value {
    let (_, rest) = page.split_once("id=\"start\">").expect("data");
    let (data, _) = rest.split_once("</script>").expect("an end");
    serde_json::from_str(data).expect("JSON")
}

#[test]
fn a_page_is_written_with_the_program_inside_and_beside_it() {
    let bench = Bench::with("p.wasm", WASM);
    let said = bench.succeed(&["page", "p.wasm", "--out", "o"]);
    for file in [
        "o/motion-rtl.html",
        "o/index.html",
        "o/motion-rtl.wasm",
        "o/notes.json",
    ] {
        assert!(said.contains(&format!("{file} (")), "{said}");
    }
    let whole = start(&bench.read("o/motion-rtl.html"));
    assert!(whole["program"]["within"].as_str().is_some());
    let beside = start(&bench.read("o/index.html"));
    assert_eq!(beside["program"]["beside"], "motion-rtl.wasm");
    assert_eq!(beside["scenarios"][0]["file"], "waves/machine.toml");
    assert!(whole["notes"]["within"].as_str().is_some());
    assert_eq!(beside["notes"]["beside"], "notes.json");
    let notes: serde_json::Value = serde_json::from_str(&bench.read("o/notes.json")).unwrap();
    let name = "rtl_notes/pulse_interpolator/unit_time.md";
    let path = format!("{}/{name}", env!("CARGO_MANIFEST_DIR"));
    assert_eq!(
        notes[name].as_str(),
        std::fs::read_to_string(path).ok().as_deref()
    );
}

#[test]
fn a_page_of_no_program_is_refused() {
    let bench = Bench::with("p.wasm", "no program");
    let done = bench.run(&["page", "p.wasm", "--out", "o"]);
    assert_eq!(done.code, 2);
    assert!(
        done.stderr.contains("p.wasm is no WebAssembly"),
        "{}",
        done.stderr
    );
    assert!(!bench.path("o").exists());
    let done = bench.run(&["page", "none.wasm"]);
    assert_eq!(done.code, 2);
    assert!(done.stderr.contains("none.wasm: "), "{}", done.stderr);
}

#[test]
fn a_port_that_is_taken_is_refused() {
    let taken = TcpListener::bind("127.0.0.1:0").unwrap();
    let port = taken.local_addr().unwrap().port().to_string();
    let done = Bench::new().run(&["serve", "--port", &port]);
    assert_eq!(done.code, 2);
    let expected = format!("error: --port: {port}: ");
    assert!(done.stderr.starts_with(&expected), "{}", done.stderr);
    assert!(done.stderr.contains("allowed: a port that is free"));
}

#[test]
fn the_page_of_a_run_has_its_summary_and_its_files() {
    let bench = Bench::with("l.hpgl", LINE);
    let words = [
        &["run", "l.hpgl", "--html", "r.html", "--out", "o"],
        &SHORT[..],
    ]
    .concat();
    let said = bench.succeed(&words);
    for file in ["o/l.fst", "o/l.gtkw", "o/l.csv", "o/l.svg", "r.html"] {
        assert!(said.contains(&format!("wrote {file} (")), "{said}");
    }
    let start = start(&bench.read("r.html"));
    assert!(start["program"].is_null() && start["notes"].is_null());
    let run = &start["run"];
    assert_eq!(run["code"], 0);
    let json = bench.succeed(&[&words[..], &["--json"]].concat());
    let [shown, printed] = [run["out"].as_str().unwrap(), &json]
        .map(|text| serde_json::from_str::<serde_json::Value>(text).unwrap());
    assert_eq!(shown["ticks"], printed["ticks"]);
    assert_eq!(shown["axes"], printed["axes"]);
    let names = run["files"].as_array().unwrap().iter();
    let names: Vec<_> = names.map(|file| file[0].as_str().unwrap()).collect();
    assert_eq!(names, ["l.fst", "l.gtkw", "l.csv"]);
    let cleaned = bench.succeed(&["clean", "o", "--dry-run"]);
    assert!(cleaned.contains("l.csv"), "{cleaned}");
}

#[test]
fn a_page_needs_waves() {
    let bench = Bench::with("l.hpgl", LINE);
    let words = [
        &["run", "l.hpgl", "--html", "r.html", "--no-vcd"],
        &SHORT[..],
    ]
    .concat();
    assert_eq!(bench.run(&words).code, 2);
    assert!(!bench.path("r.html").exists());
    // A page takes the place of no other file of the run.
    for other in ["o/l.fst", "o/l.svg", "-", "page"] {
        let run = bench.run(
            &[
                &["run", "l.hpgl", "--out", "o", "--html", other],
                &SHORT[..],
            ]
            .concat(),
        );
        assert_eq!(run.code, 2, "{other}");
        let expected = format!(
            "--html: {other} is no name of a page; allowed: a file whose name ends in .html"
        );
        assert!(run.stderr.contains(&expected), "{}", run.stderr);
    }
    let bench = Bench::with("l.html", LINE);
    let over = [
        "run",
        "l.html",
        "--input-format",
        "hpgl",
        "--html",
        "l.html",
    ];
    let done = bench.run(&[&over[..], &SHORT[..]].concat());
    assert!(done.stderr.contains("is the input"), "{}", done.stderr);
}
