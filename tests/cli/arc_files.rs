//! The files of a run of the arc generator, and windows of its waves.

use super::arc::{SEAM, with};
use super::support::{list, whole, without_sizes};
use serde_json::json;

#[test]
fn files_windows_and_scopes() {
    let bench = with(SEAM);
    let text = bench.succeed(&["run", "s.toml", "--out", "a/b"]);
    assert!(
        without_sizes(&text).ends_with("wrote a/b/s.vcd\nwrote a/b/s.gtkw\nwrote a/b/s.svg\n"),
        "{text}"
    );
    let files = [
        "a/",
        "a/b/",
        "a/b/s.gtkw",
        "a/b/s.svg",
        "a/b/s.vcd",
        "s.toml",
    ];
    assert_eq!(bench.names(), files);
    let svg = bench.read("a/b/s.svg");
    for words in [
        "s: arc generator",
        "speed",
        "acceleration",
        "radius error on the arcs",
        "distance of the blend from the arc",
        "A+: the direction jumps by ",
    ] {
        assert!(svg.contains(words), "{words}");
    }
    // Flat: seen from above, with scales.
    assert!(svg.contains("x in mm") && !svg.contains("isometric"));
    let again = with(SEAM);
    again.succeed(&["run", "s.toml", "--out", "a/b"]);
    for name in ["a/b/s.svg", "a/b/s.vcd", "a/b/s.gtkw"] {
        assert!(bench.read(name) == again.read(name), "{name} differs");
    }

    let window = ["run", "s.toml", "--from", "2000", "--to", "2600"];
    let only = [
        "--only",
        "arc_generator.rotation",
        "--only",
        "arc_generator.x",
    ];
    let summary = bench.json(&[&window[..], &only].concat());
    assert_eq!(summary["vcd_window"], json!([2000, 2600]));
    let save = bench.read("waves/s.gtkw");
    assert!(save.contains("arc_generator.rotation.") && !save.contains("arc_generator.engine_x."));
    let text = bench.succeed(&window);
    let ticks = whole(&summary, "/ticks");
    let shown =
        format!("the waves show ticks 2000 to 2600 of {ticks}: --from and --to choose others\n");
    assert!(text.contains(&shown), "{text}");

    let beyond = ticks.to_string();
    let last = ticks - 1;
    bench.refuse(
        &["run", "s.toml", "--from", &beyond, "--out", "new"],
        &format!("--from: is {beyond}; allowed: 0 to {last}, the last tick of the run"),
    );
    let done = bench.run(&["run", "s.toml", "--only", "arc_generator.pen"]);
    assert_eq!(done.code, 2);
    let start = "error: --only: there is no arc_generator.pen; allowed: a signal, or a scope: \
         arc_generator, arc_generator.sample_counter, arc_generator.memory, ";
    assert!(done.stderr.starts_with(start), "{}", done.stderr);
}

#[test]
fn the_save_file_shows_the_change_into_the_rotation() {
    let bench = with(SEAM);
    bench.succeed(&["run", "s.toml"]);
    let save = bench.read("waves/s.gtkw");
    let start = save
        .lines()
        .find_map(|line| line.strip_prefix("[timestart] "));
    // The first command stands in tick 200, the twentieth sample in tick 2200, six samples before
    // which the window begins; a tick is 100 us.
    assert_eq!(start, Some("160000"));
}

#[test]
fn the_job_is_written_as_verilog_too() {
    let bench = with(SEAM);
    let summary = bench.json(&["run", "s.toml", "--no-vcd", "--verilog", "--out", "v"]);
    let files: Vec<_> = list(&summary, "files")
        .iter()
        .map(|file| file["path"].as_str().unwrap())
        .collect();
    for name in ["v/arc_generator.v", "v/arc_generator.stimulus", "v/s.svg"] {
        assert!(files.contains(&name), "{name}: {files:?}");
    }
    let lines = bench.read("v/arc_generator.stimulus").lines().count() as i64;
    assert!(lines >= whole(&summary, "/ticks"), "{lines}");
}
