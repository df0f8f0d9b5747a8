//! Files of series, and refusals.

use super::super::support::{Bench, LINE, SHORT, paths, whole};
use serde_json::json;

#[test]
fn the_file_is_named_with_the_others_or_not_left() {
    let bench = Bench::with("l.hpgl", LINE);
    let run = [&["run", "l.hpgl", "--no-vcd"], &SHORT[..]].concat();
    let summary = bench.json(&[&run[..], &["--series", "deep/er/s.NPY"]].concat());
    assert_eq!(paths(&summary), json!(["deep/er/s.NPY", "waves/l.svg"]));
    let bytes = std::fs::metadata(bench.path("deep/er/s.NPY"))
        .unwrap()
        .len();
    assert_eq!(whole(&summary, "/files/0/bytes"), bytes as i64);
    // Each directory knows its own files, and `clean` of another leaves them.
    bench.succeed(&[&run[..], &["--series", "waves/s.csv"]].concat());
    std::fs::copy(bench.path("deep/er/s.NPY"), bench.path("waves/s.NPY")).unwrap();
    let times = std::fs::metadata(bench.path("deep/er/s.NPY")).unwrap();
    let copy = std::fs::File::options()
        .append(true)
        .open(bench.path("waves/s.NPY"))
        .unwrap();
    copy.set_modified(times.modified().unwrap()).unwrap();
    bench.succeed(&["clean", "waves", "--yes"]);
    let left = [
        "deep/",
        "deep/er/",
        "deep/er/s.NPY",
        "l.hpgl",
        "waves/",
        "waves/s.NPY",
    ];
    assert_eq!(bench.names(), left);
    bench.succeed(&["clean", "deep/er", "--yes"]);
    let left = ["deep/", "deep/er/", "l.hpgl", "waves/", "waves/s.NPY"];
    assert_eq!(bench.names(), left);
    // However the directory of the waves is spelled.
    bench.succeed(&[&run[..], &["--series", "./waves/t.csv"]].concat());
    bench.succeed(&["clean", "waves", "--yes"]);
    assert_eq!(bench.names(), left);
}

#[test]
fn series_that_cannot_be_had_are_refused() {
    let bench = Bench::with("l.hpgl", LINE);
    bench.write("log.csv", "time,counts\n0,0\n1,1\n");
    let run = ["run", "l.hpgl", "--no-vcd"];
    let refuse = |more: &[&str], text: &str| {
        bench.refuse_with(&[&run[..], more].concat(), |stderr| {
            assert_eq!(stderr.lines().next(), Some(&*format!("error: {text}")));
        });
    };
    for name in ["s.txt", "csv", "s"] {
        let text = format!(
            "invalid value '{name}' for '--series <FILE>': allowed: a file with the extension \
             .csv or .npy"
        );
        refuse(&["--series", name], &text);
    }
    refuse(
        &["--series", "s.csv", "--series-every", "0"],
        "invalid value '0' for '--series-every <TICKS>': 0 is not in 1..18446744073709551615",
    );
    refuse(
        &["--series-every", "5"],
        "the following required arguments were not provided:",
    );
    refuse(
        &["--series", "s.csv", "--from", "100000000"],
        "--from: is 100000000; allowed: 0 to 542000, the last tick of the run",
    );
    bench.refuse_with(
        &[
            "run",
            "l.hpgl",
            "--series",
            "s.csv",
            "--waves-of",
            "pulse_interpolator",
        ],
        |stderr| {
            let text = "error: the argument '--series <FILE>' cannot be used with '--waves-of";
            assert!(stderr.starts_with(text), "{stderr}");
        },
    );
    let log = bench.path("log.csv").canonicalize().unwrap();
    bench.refuse(
        &["run", "log.csv", "--series", "./log.csv"],
        &format!(
            "--series: {} is the input; allowed: another file",
            log.display()
        ),
    );
    std::fs::copy(bench.path("l.hpgl"), bench.path("l.svg")).unwrap();
    let drawing = bench.path("l.svg").canonicalize().unwrap();
    bench.refuse(
        &[
            "run",
            "l.svg",
            "--input-format",
            "hpgl",
            "--no-vcd",
            "--out",
            ".",
        ],
        &format!(
            "--out: {} is the input; allowed: another file",
            drawing.display()
        ),
    );
    bench.refuse(
        &["run", "l.hpgl", "--no-vcd", "--series", "l.hpgl/s.csv"],
        "--series: l.hpgl: File exists (os error 17); allowed: a file that can be written",
    );
}
