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

#[test]
fn an_option_without_its_language_is_refused() {
    let bench = Bench::with("l.hpgl", "PD40,0;");
    bench.write("l.ngc", "G1 X1 F600\n");
    bench.write("log.csv", "t_ms,counts\n0,0\n1,1\n");
    bench.write("drawn.toml", "circuit = \"machine\"\ninput = \"l.ngc\"\n");
    bench.write("bare.toml", "circuit = \"pulse_interpolator\"\n");
    let hpgl = [&["--lenient"][..]];
    let gcode = [
        &["--strict"][..],
        &["--most-lines", "9"],
        &["--subroutines", "."],
    ];
    let inputs = [
        (&["l.hpgl"][..], "an HPGL drawing"),
        (&["l.ngc"], "a G-code program"),
        (&["drawn.toml"], "a G-code program"),
        (&["l.hpgl", "--input-format", "gcode"], "a G-code program"),
        (&["log.csv"], "a position log"),
        (&["bare.toml"], "no drawing"),
        (&["waves/turntable.toml"], "no drawing"),
        (&["waves/rosette.toml"], "an HPGL drawing"),
        (&[], "a G-code program"),
    ];
    for (input, found) in inputs {
        for (options, of) in [
            (&hpgl[..], "an HPGL drawing"),
            (&gcode[..], "a G-code program"),
        ] {
            for option in options.iter().filter(|_| of != found) {
                let name = option[0];
                let text = format!(
                    "{name}: is for {of}; the input is {found}; allowed: {of}, or a run without \
                     {name}"
                );
                bench.refuse(&[&["run", "--no-vcd"], input, option].concat(), &text);
            }
        }
    }
    for value in ["0", "-1"] {
        bench.refuse_with(&["run", "l.ngc", "--most-lines", value], |said| {
            let text = format!("error: invalid value '{value}' for '--most-lines <LINES>'");
            assert!(said.starts_with(&text), "{said}");
        });
    }
}
