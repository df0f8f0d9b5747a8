//! Drawings that are not wholly understood, and `--lenient`.

use crate::support::{Bench, SHORT};

const UNKNOWN: &str = "PD40,0;\nQQ9,9;\nPD40,40,7;\n";

fn run<'a>(flags: &[&'a str]) -> Vec<&'a str> {
    [&["run", "l.hpgl", "--no-vcd"], flags, &SHORT].concat()
}

#[test]
fn what_may_move_the_pen_is_refused_unless_lenient() {
    let bench = Bench::with("l.hpgl", UNKNOWN);
    bench.refuse(
        &run(&[]),
        "l.hpgl:2: QQ: is not known and may move the pen; allowed: instructions of HPGL and \
         HPGL/2; with --lenient it is skipped",
    );
    let summary = bench.json(&run(&["--lenient"]));
    let said: Vec<&str> = summary["warnings"]
        .as_array()
        .unwrap()
        .iter()
        .flat_map(|warning| warning.as_str())
        .collect();
    assert_eq!(
        said,
        [
            "l.hpgl:2: QQ: not known, skipped; what it draws or moves is missing",
            "l.hpgl:3: PD: an X without its Y: an odd count of coordinates; the X is skipped",
        ]
    );
    // So in a scenario, and for a table.
    bench.write(
        "s.toml",
        "circuit = \"pulse_interpolator\"\ninput = \"l.hpgl\"\n",
    );
    for command in ["run", "table"] {
        let arguments = [&[command, "s.toml", "--lenient"], &SHORT[..]].concat();
        bench.succeed(&arguments);
    }
}

#[test]
fn arcs_and_labels_are_run() {
    let bench = Bench::with(
        "l.hpgl",
        "IN;PU400,200;PD;AA200,200,90;PR80,0;PU;CI40;LBAb\x03",
    );
    let summary = bench.json(&run(&[]));
    assert_eq!(summary["warnings"], serde_json::json!([]));
}
