//! `--open`: viewers that start, end at once, are not there.

use super::support::{Bench, LINE, SHORT};
use std::fs;
use std::os::unix::fs::PermissionsExt as _;
use std::process::Output;
use std::thread;
use std::time::{Duration, Instant};

/// A drawing, and a program of this name and text in a directory.
fn bench(program: &str, text: &str) -> Bench {
    let bench = Bench::with("line.hpgl", LINE);
    add(&bench, program, text);
    bench
}

fn add(bench: &Bench, program: &str, text: &str) {
    bench.write(program, text);
    let mode = fs::Permissions::from_mode(0o755);
    fs::set_permissions(bench.path(program), mode).unwrap();
}

/// Runs the drawing with `--open`, with programs of these directories alone.
fn open(bench: &Bench, directories: &[&str]) -> Output {
    let run = [&["line.hpgl", "--open", "--to", "100"], &SHORT[..]].concat();
    let paths = directories.iter().map(|name| bench.path(name));
    bench
        .command(&run)
        .env("PATH", std::env::join_paths(paths).unwrap())
        .env("DISPLAY", ":0")
        .output()
        .unwrap()
}

fn said(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).unwrap()
}

/// Waits for what a viewer notes of its arguments.
fn opened(bench: &Bench) -> String {
    let started = Instant::now();
    while !bench.path("opened").exists() && started.elapsed() < Duration::from_secs(10) {
        thread::sleep(Duration::from_millis(10));
    }
    bench.read("opened")
}

/// Notes its arguments, and goes on for two seconds.
const VIEWER: &str = "#!/bin/sh
echo \"$@\" >opened.part && /bin/mv opened.part opened && exec /bin/sleep 2
";

#[test]
fn a_viewer_shows_the_save_file_and_goes_on() {
    let bench = bench("bin/gtkwave", VIEWER);
    let started = Instant::now();
    let output = open(&bench, &["bin"]);
    assert_eq!(
        (output.status.code(), said(&output).as_str()),
        (Some(0), "")
    );
    assert!(
        started.elapsed() < Duration::from_millis(1900),
        "waits for its end"
    );
    assert_eq!(opened(&bench), "waves/line.gtkw\n");
}

#[test]
fn a_viewer_that_ends_at_once_is_told() {
    let refused = "#!/bin/sh\necho >&2\necho 'no display' >&2\necho more >&2\nexit ";
    for (code, status) in [("0", "exit status: 0"), ("3", "exit status: 3")] {
        let bench = bench("bin/gtkwave", &format!("{refused}{code}\n"));
        let output = open(&bench, &["bin"]);
        let program = bench.path("bin/gtkwave");
        let program = program.display();
        let text = format!("warning: {program} ended at once, {status}: no display\n");
        assert_eq!((output.status.code(), said(&output)), (Some(0), text));
    }
    let bench = bench("bin/gtkwave", "#!/bin/sh\nkill -9 $$\n");
    let text = said(&open(&bench, &["bin"]));
    assert!(
        text.ends_with("ended at once, signal: 9 (SIGKILL)\n"),
        "{text}"
    );
    let bench = self::bench("bin/gtkwave", "#!/nowhere/sh\n");
    let text = said(&open(&bench, &["bin"]));
    assert!(text.contains("bin/gtkwave does not start: "), "{text}");
}

#[test]
fn a_file_that_is_not_executable_is_no_viewer() {
    let bench = bench("later/gtkwave", VIEWER);
    bench.write("first/gtkwave", "a note on gtkwave\n");
    let output = open(&bench, &["first", "later"]);
    assert_eq!(
        (output.status.code(), said(&output).as_str()),
        (Some(0), "")
    );
    assert_eq!(opened(&bench), "waves/line.gtkw\n");
    // Another viewer is taken in its place.
    fs::remove_file(bench.path("opened")).unwrap();
    add(&bench, "first/surfer", VIEWER);
    assert_eq!(open(&bench, &["first"]).status.code(), Some(0));
    assert_eq!(opened(&bench), "waves/line.vcd\n");
}

#[test]
fn without_a_viewer_or_a_display_no_run_begins() {
    let bench = Bench::with("line.hpgl", LINE);
    bench.write("bin/gtkwave", "not a program");
    for directories in [&["none"][..], &["bin"]] {
        let output = open(&bench, directories);
        let text = "error: --open: no viewer of waves in PATH; allowed: gtkwave or surfer\n";
        assert_eq!(
            (output.status.code(), said(&output).as_str()),
            (Some(2), text)
        );
    }
    assert_eq!(bench.names(), ["bin/", "bin/gtkwave", "line.hpgl"]);

    #[cfg(target_os = "linux")]
    {
        let mut command = bench.command(&["line.hpgl", "--open"]);
        command.env_remove("DISPLAY").env_remove("WAYLAND_DISPLAY");
        let output = command.output().unwrap();
        let text = "error: --open: there is no display: neither ";
        assert!(said(&output).starts_with(text), "{}", said(&output));
        assert_eq!(output.status.code(), Some(2));
    }
}
