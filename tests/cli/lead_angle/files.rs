//! The files of a run, and windows of its waves.

use super::*;

#[test]
fn the_files_are_those_that_are_said_and_the_same_twice() {
    let once = || {
        let bench = small();
        let text = bench.succeed(&["run", "--beside", "s.toml", "--to", "3000", "--out", "a"]);
        assert_eq!(
            bench.names(),
            ["a/", "a/s.gtkw", "a/s.svg", "a/s.vcd", "s.toml"]
        );
        assert!(
            without_sizes(&text).ends_with("wrote a/s.vcd\nwrote a/s.gtkw\nwrote a/s.svg\n"),
            "{text}"
        );
        ["a/s.svg", "a/s.vcd", "a/s.gtkw"].map(|name| bench.read(name))
    };
    let [svg, vcd, save] = once();
    assert!([svg.clone(), vcd, save.clone()] == once());
    for text in [
        "s: lead-angle compensator",
        "stop error of learning, held at ±6",
        "lead time, learning",
        "lead time, literal sign",
        "load change",
    ] {
        assert!(svg.contains(text), "{text}");
    }
    // Position and prediction are curves; the history is a group with its stages in one.
    let after = |text: &str| &save[save.find(text).unwrap_or_else(|| panic!("no {text}"))..];
    assert!(after("@8420\n[color] 4\ncompensator.position[").contains("@20000"));
    assert!(save.contains("@8420\n[color] 4\ncompensator.predicted["));
    let history = after("-history\n");
    let end = history[1..].find("-history\n").unwrap();
    assert!(history[..end].contains("-stages\n"));
    let stages = history[..end].matches(".stages.").count();
    assert_eq!(stages, 199);
}

#[test]
fn waves_have_the_window_and_the_scopes_that_are_asked_for() {
    let bench = small();
    let only = "compensator.lead_source.history";
    let run = [
        "run", "--beside", "s.toml", "--from", "500", "--to", "3000", "--only",
    ];
    let summary = bench.json(&[&run[..], &[only]].concat());
    assert_eq!(summary["vcd_window"], json!([500, 3000]));
    let save = bench.read("waves/s.gtkw");
    assert!(save.contains(&format!("{only}.")) && !save.contains("compensator.comparator."));
    let done = bench.run(&[&run[..], &["compensator.pen"]].concat());
    let start = "error: --only: there is no compensator.pen; allowed: a signal, or a scope: ";
    assert!(done.stderr.starts_with(start), "{}", done.stderr);
    let ticks = whole(&summary, "/ticks");
    let most = format!("{ticks}");
    bench.refuse(
        &[
            "run", "--beside", "s.toml", "--from", &most, "--out", "new/deep",
        ],
        &format!(
            "--from: is {ticks}; allowed: 0 to {}, the last tick of the run",
            ticks - 1
        ),
    );
}

#[test]
fn files_that_cannot_be_written_leave_nothing() {
    const WRITABLE: &str = "allowed: a directory that can be written";
    for bench in [small(), log()] {
        let out = |out| ["run", "--beside", "s.toml", "--to", "3000", "--out", out];
        let text = format!("--out: s.toml: File exists (os error 17); {WRITABLE}");
        bench.refuse(&out("s.toml"), &text);
        bench.write("o/s.svg/inside", "");
        let text = format!("--out: o/s.svg: is a directory; {WRITABLE}");
        bench.refuse(&out("o"), &text);
    }
}
