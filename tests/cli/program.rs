//! The program as a whole: its options for all commands, standard input, errors as JSON, `clean`.

use super::support::{Bench, LINE, PROGRAM, SHORT, paths};
use rayon::prelude::*;
use serde_json::{Value, json};
use std::fs;
use std::io::Write as _;
use std::process::{Command, Stdio};

/// Runs the program with a text on standard input.
fn fed(bench: &Bench, arguments: &[&str], text: &str) -> (i32, String, String) {
    let mut child = Command::new(PROGRAM)
        .args(arguments)
        .current_dir(bench.path(""))
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    // A program that refuses its arguments does not read.
    let _ = child.stdin.take().unwrap().write_all(text.as_bytes());
    let output = child.wait_with_output().unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    let code = output.status.code().expect("ended by a signal");
    (code, text(output.stdout), text(output.stderr))
}

#[test]
fn a_file_alone_is_run() {
    let bench = Bench::with("line.hpgl", LINE);
    let with = bench.json(&[&["run", "line.hpgl", "--no-vcd"], &SHORT[..]].concat());
    let without = bench.json(&[&["line.hpgl", "--no-vcd"], &SHORT[..]].concat());
    assert_eq!(with, without);
    let behind = bench.json(&[&["--color", "never", "line.hpgl", "--no-vcd"], &SHORT[..]].concat());
    assert_eq!(with, behind);
}

#[test]
fn the_name_of_a_command_is_the_command() {
    let bench = Bench::with("list", LINE);
    assert!(
        bench
            .succeed(&["list", "sync_stage"])
            .starts_with("circuits\n")
    );
    let arguments = [
        &["./list", "--input-format", "hpgl", "--no-vcd"],
        &SHORT[..],
    ]
    .concat();
    assert_eq!(paths(&bench.json(&arguments)), json!(["waves/list.svg"]));
}

#[test]
fn a_mistyped_command_or_scenario_is_named() {
    let bench = Bench::new();
    let commands = "run, table, check, mutate, verilog, vhdl, compare, equal, plan, list, keys, serve, page, clean";
    let done = bench.run(&["chek"]);
    assert_eq!((done.code, done.stdout.as_str()), (2, ""));
    let text = format!(
        "error: COMMAND: there is no command chek, and no file of that name; did you mean check?; \
         allowed: a file, or a command: {commands}"
    );
    assert!(done.stderr.starts_with(&text), "{}", done.stderr);
    for (wanted, near) in [
        ("waves/circel.toml", Some("waves/circle.toml")),
        ("turn_table.toml", Some("waves/turntable.toml")),
        ("nothing.toml", None),
    ] {
        let done = bench.run(&[wanted]);
        let meant = done.stderr.split("did you mean ").nth(1);
        let meant = meant.map(|text| text.trim_end().trim_end_matches('?'));
        assert_eq!((done.code, meant), (2, near), "{}", done.stderr);
    }
}

#[test]
fn standard_input_is_read_as_its_format_says() {
    let bench = Bench::with("line.hpgl", LINE);
    let files = |end: &'static str| [&[end, "--no-vcd", "--json"], &SHORT[..]].concat();
    let (code, own, _) = fed(&bench, &files("line.hpgl"), "");
    assert_eq!(code, 0);
    let arguments = [&["--input-format", "hpgl"], &files("-")[..]].concat();
    // Options come first here: the file follows them.
    let arguments = [&["run"], &arguments[..]].concat();
    let (code, text, _) = fed(&bench, &arguments, LINE);
    assert_eq!(code, 0);
    let mut own: Value = serde_json::from_str(&own).unwrap();
    let mut given: Value = serde_json::from_str(&text).unwrap();
    assert_eq!(given["input"], "<stdin>");
    assert_eq!(paths(&given), json!(["waves/stdin.svg"]));
    for summary in [&mut own, &mut given] {
        summary["input"].take();
        summary["files"].take();
    }
    assert_eq!(own, given);

    let scenario =
        "circuit = \"lead_angle\"\nstep = [{target = 100, speed_counts_per_s = \"x\"}]\n";
    let (code, text, said) = fed(&bench, &["-", "--input-format", "toml"], scenario);
    assert_eq!((code, text.as_str()), (2, ""));
    assert!(said.starts_with("error: <stdin>:2: "), "{said}");
    let (code, _, said) = fed(
        &bench,
        &["-", "--input-format", "gcode", "--no-vcd"],
        "G1 X1\nG99.7\n",
    );
    assert_eq!(code, 2);
    assert!(said.starts_with("error: <stdin>:"), "{said}");
    let mut odd = b"circuit = \"machine\"\n# ".to_vec();
    odd.extend([0xff, b'\n']);
    bench.write("odd", odd);
    let done = bench.run(&["odd", "--input-format", "toml"]);
    let text = "error: odd:2: file: not UTF-8; allowed: a scenario in TOML\n";
    assert_eq!((done.code, done.stderr.as_str()), (2, text));
    let (code, _, said) = fed(&bench, &["-"], LINE);
    let text = "error: <stdin>: file: has no extension; allowed: --input-format with one of toml, \
                hpgl, gcode, csv\n";
    assert_eq!((code, said.as_str()), (2, text));
    let (code, _, said) = fed(
        &bench,
        &["-", "--input-format", "csv", "--set", "circuit=machine"],
        "",
    );
    assert_eq!(code, 2);
    assert!(said.contains("machine does not take <stdin>"), "{said}");
}

#[test]
fn quiet_prints_errors_and_json_alone() {
    let bench = Bench::with("line.hpgl", LINE);
    let run = [&["run", "line.hpgl", "--no-vcd", "-q"], &SHORT[..]].concat();
    let done = bench.run(&run);
    assert_eq!(
        (done.code, done.stdout.as_str(), done.stderr.as_str()),
        (0, "", "")
    );
    assert!(bench.json(&run).is_object());
    let done = bench.run(&["run", "none.hpgl", "--quiet"]);
    assert_eq!(done.code, 2);
    assert!(
        done.stderr.starts_with("error: none.hpgl: "),
        "{}",
        done.stderr
    );
}

#[test]
fn verbose_tells_the_stages_on_standard_error() {
    let bench = Bench::with("line.hpgl", LINE);
    let run = [&["-v", "run", "line.hpgl", "--no-vcd"], &SHORT[..]].concat();
    let done = bench.run(&run);
    assert_eq!(done.code, 0);
    for stage in [
        " s: reading\n",
        " s: running, about ",
        " s: summary and picture\n",
    ] {
        assert!(done.stderr.contains(stage), "{stage}: {}", done.stderr);
    }
    assert!(!done.stdout.contains(" s: "));
}

#[test]
fn an_error_is_json_too_where_json_is_asked_for() {
    let scenario = "circuit = \"lead_angle\"\nstep = []\nwhat = 1\n";
    let bench = Bench::with("s.toml", scenario);
    let error = |arguments: &[&str]| -> Value {
        let done = bench.run(arguments);
        assert_eq!(done.code, 2, "{arguments:?}");
        assert!(done.stderr.starts_with("error: "), "{}", done.stderr);
        serde_json::from_str(&done.stdout).unwrap()
    };
    let of_file = error(&["run", "s.toml", "--json"]);
    assert_eq!(of_file["version"], 1);
    let of_file = &of_file["error"];
    assert_eq!(of_file["kind"], "input");
    assert_eq!(of_file["faults"][0]["file"], "s.toml");
    assert_eq!(of_file["faults"][0]["line"], 3);
    assert_eq!(of_file["faults"][0]["field"], "what");
    let of_argument = &error(&["list", "unit_lav", "--json"])["error"];
    assert_eq!(of_argument["kind"], "argument");
    assert_eq!(of_argument["faults"][0]["field"], "CIRCUIT");
    let of_words = &error(&["run", "--nonsense", "--json"])["error"];
    assert_eq!(of_words["kind"], "usage");
    let message = of_words["message"].as_str().unwrap();
    assert!(
        message.contains("--nonsense") && !message.contains("error:"),
        "{message}"
    );
    // A comparison that finds a difference has printed its report, which has it.
    bench.write("line.hpgl", LINE);
    for (directory, to) in [("a", "100"), ("b", "50")] {
        bench.succeed(&[&["line.hpgl", "--out", directory, "--to", to], &SHORT[..]].concat());
    }
    let done = bench.run(&["compare", "a/line.vcd", "b/line.vcd", "--json"]);
    assert_eq!(done.code, 1);
    let _: Value = serde_json::from_str(&done.stdout).expect("one value");
}

#[test]
fn the_version_has_features_and_platform() {
    let bench = Bench::new();
    let long = bench.succeed(&["--version"]);
    assert!(long.starts_with(concat!("motion-rtl ", env!("CARGO_PKG_VERSION"))));
    assert_eq!(bench.succeed(&["-V"]), long);
    assert_eq!(bench.succeed(&["--color", "never", "-V"]), long);
    for part in ["\ncommit: ", "\nfeatures: cli", "\nplatform: "] {
        assert!(long.contains(part), "{long}");
    }
    for feature in ["cli", "jit", "schema", "shell"] {
        assert!(long.contains(feature), "{long}");
    }
}

#[test]
fn quiet_prints_what_is_asked_for() {
    let bench = Bench::with("line.hpgl", LINE);
    for asked in [
        &["list"][..],
        &["list", "comparator"],
        &["keys"],
        &["keys", "machine"],
        &["plan", "comparator", "--ticks", "10"],
    ] {
        let quiet = bench.succeed(&[asked, &["-q"]].concat());
        assert!(quiet.lines().count() > 3, "{asked:?}: {quiet}");
        assert_eq!(quiet, bench.succeed(asked), "{asked:?}");
    }
    bench.succeed(&[&["run", "line.hpgl", "--no-vcd", "--out", "o"], &SHORT[..]].concat());
    let named = bench.succeed(&["clean", "o", "--dry-run", "-q"]);
    assert!(named.starts_with("o/line.svg ("), "{named}");
}

#[test]
fn commands_that_are_left_out_name_their_feature() {
    let bench = Bench::new();
    let commands = [
        ("completions", "shell", cfg!(feature = "shell")),
        ("man", "shell", cfg!(feature = "shell")),
        ("schema", "schema", cfg!(feature = "schema")),
    ];
    for (command, feature, _) in commands.iter().filter(|(.., is_built)| !is_built) {
        let text = format!(
            "COMMAND: {command} is left out of this program; allowed: a program built with `cargo \
             build --release --features {feature}`"
        );
        bench.refuse(&[command, "bash"], &text);
        bench.refuse(&["-q", command], &text);
    }
    // A file of this name is run.
    bench.write("man", LINE);
    bench.refuse_with(&["man"], |said| {
        assert!(said.starts_with("error: man: file: no extension"), "{said}");
    });
}

#[test]
fn a_name_that_is_empty_is_quoted() {
    let bench = Bench::new();
    for (words, start) in [
        (&["list", ""][..], "CIRCUIT: there is no \"\"; allowed: "),
        (&["check", ""], "CIRCUIT: there is no \"\"; allowed: "),
        (&["keys", ""], "NAME: no job or circuit is called \"\"; "),
        (&["run", "--set", ""], "--set: \"\": no '='; "),
        (&["run", "--only", ""], "--only: there is no \"\"; "),
        (
            &["run", "--waves-of", ""],
            "--waves-of: machine has no system \"\"; ",
        ),
        (
            &[""],
            "COMMAND: there is no command \"\", and no file of that name",
        ),
    ] {
        bench.refuse_with(words, |said| {
            let said = said.strip_prefix("error: ").unwrap();
            assert!(said.starts_with(start), "{words:?}: {said}");
        });
    }
}

#[test]
fn the_help_of_run_lists_every_shipped_scenario() {
    let bench = Bench::new();
    let help = bench.succeed(&["run", "--help"]);
    let list = bench.json(&["list"]);
    let scenarios = list["scenarios"].as_array().unwrap();
    assert_eq!(scenarios.len(), 20);
    for scenario in scenarios {
        let file = scenario["file"].as_str().unwrap();
        assert!(help.contains(&format!("\n  {file}\n")), "{file}: {help}");
    }
}

/// Each example is a command that this program understands; those that need no file of the reader's
/// are run in the gate.
fn examples() -> Vec<Vec<String>> {
    let bench = Bench::new();
    let help = bench.succeed(&["--help"]);
    let listed = help.split("\nCommands:\n").nth(1).unwrap();
    let listed = listed.split("\n\n").next().unwrap().lines();
    let commands = listed.filter_map(|line| {
        line.split_whitespace()
            .next()
            .filter(|_| !line.starts_with("   "))
    });
    let mut texts = vec![help.clone()];
    for command in commands.filter(|name| *name != "help") {
        let text = bench.succeed(&[command, "--help"]);
        assert!(
            text.contains("\nExamples:\n  motion-rtl"),
            "{command}: {text}"
        );
        texts.push(text);
    }
    assert!(texts.len() > 9, "{help}");
    let lines = texts.iter().flat_map(|text| text.lines());
    let lines = lines.filter_map(|line| line.strip_prefix("  motion-rtl"));
    let commands = lines.map(|line| {
        line.strip_prefix(' ')
            .unwrap_or(line)
            .split("  ")
            .next()
            .unwrap_or_default()
    });
    let words = |line: &str| line.split_whitespace().map(str::to_owned).collect();
    commands.map(words).collect()
}

#[test]
fn every_example_is_understood() {
    for mut words in examples() {
        words.retain(|word| !word.starts_with(['<', '>']));
        words.push("--help".to_owned());
        let words: Vec<_> = words.iter().map(String::as_str).collect();
        Bench::new().succeed(&words);
    }
}

#[test]
#[ignore = "takes long"]
fn every_example_runs() {
    let waves = concat!(env!("CARGO_MANIFEST_DIR"), "/waves");
    examples().par_iter().for_each(|words| {
        let line = words.join(" ");
        // What needs a viewer, a file of the reader's, or minutes; what ends only with a signal.
        if [
            "--open",
            "my_",
            "golden.vcd",
            "inputs.csv",
            "clean",
            "mutate",
            "completions",
            "serve",
        ]
        .iter()
        .any(|word| line.contains(word))
        {
            return;
        }
        let bench = Bench::new();
        std::os::unix::fs::symlink(waves, bench.path("shipped")).unwrap();
        let line = line.replace("waves/", "shipped/");
        let arguments = line
            .split_whitespace()
            .take_while(|word| !word.starts_with(['<', '>']))
            .map(|word| word.trim_matches('\''));
        let arguments: Vec<_> = arguments.collect();
        let input = line.split_once('<').map(|(_, file)| bench.read(file));
        let (code, _, said) = fed(&bench, &arguments, &input.unwrap_or_default());
        // The circuit of the patent's text is there to be refuted.
        let wanted = i32::from(line.contains("variant=literal"));
        assert_eq!(code, wanted, "{line}: {said}");
    });
}

#[test]
fn clean_removes_what_runs_have_made_and_nothing_else() {
    let bench = Bench::with("line.hpgl", LINE);
    // Somebody's own file, which a run then replaces, and one that no run has touched.
    bench.write("o/line.svg", "mine");
    bench.write("o/other.vcd", "mine");
    let run = [&["line.hpgl", "--out", "o", "--to", "100"], &SHORT[..]].concat();
    bench.succeed(&run);
    bench.succeed(&run);
    let named = bench.succeed(&["clean", "o", "--dry-run"]);
    assert!(
        named.starts_with("o/line.gtkw (") && named.contains("\no/line.vcd ("),
        "{named}"
    );
    assert_eq!(named.lines().count(), 2, "{named}");
    let done = bench.run(&["clean", "o"]);
    assert_eq!(done.code, 2, "nobody can be asked");
    assert_eq!(bench.run(&["clean", "o", "-q"]).code, 2);
    let all = [
        "line.hpgl",
        "o/",
        "o/line.gtkw",
        "o/line.svg",
        "o/line.vcd",
        "o/other.vcd",
    ];
    assert_eq!(bench.names(), all);

    // Changed by its owner since.
    bench.write("o/line.gtkw", "changed");
    let done = bench.run(&["clean", "o", "--yes"]);
    assert_eq!(done.code, 0);
    assert_eq!(
        done.stderr,
        "warning: o/line.gtkw has changed since it was written, and stays\n"
    );
    assert!(done.stdout.ends_with("removed 1 file\n"), "{}", done.stdout);
    assert_eq!(
        bench.names(),
        [
            "line.hpgl",
            "o/",
            "o/line.gtkw",
            "o/line.svg",
            "o/other.vcd"
        ]
    );
    fs::remove_file(bench.path("o/line.gtkw")).unwrap();
    assert_eq!(
        bench.succeed(&["clean", "o", "--yes"]),
        "o has no files of this program\n"
    );
    bench.refuse(
        &["clean", "nowhere"],
        "DIR: nowhere is not a directory; allowed: the --out of a command",
    );
}

/// The list of what runs have written may come from anywhere.
#[cfg(unix)]
#[test]
fn a_list_names_files_of_its_directory_alone() {
    use std::os::unix::fs::{MetadataExt as _, symlink};
    let bench = Bench::with("o/line.hpgl", LINE);
    bench.write("victim/w.vcd", "mine");
    let there = bench.path("victim/w.vcd").metadata().unwrap();
    let changed = i128::from(there.mtime()) * 1_000_000_000 + i128::from(there.mtime_nsec());
    let size = there.len();
    let absolute = bench.path("victim/w.vcd").display().to_string();
    let lines = ["../victim/w.vcd", &absolute, "..", "a/b", "."];
    let lines = lines.map(|name| format!("{size} {changed} {name}\n"));
    bench.write("o/.motion-rtl-written", lines.concat());
    assert_eq!(
        bench.succeed(&["clean", "o", "--yes"]),
        "o has no files of this program\n"
    );
    assert_eq!(bench.read("victim/w.vcd"), "mine");

    // Neither a link nor a pipe is a list.
    let list = bench.path("o/.motion-rtl-written");
    let run = [
        &["o/line.hpgl", "--out", "o", "--to", "100", "-q"],
        &SHORT[..],
    ]
    .concat();
    bench.write("victim/notes", "precious");
    fs::remove_file(&list).unwrap();
    symlink(bench.path("victim/notes"), &list).unwrap();
    bench.succeed(&run);
    assert_eq!(bench.read("victim/notes"), "precious");
    fs::remove_file(&list).unwrap();
    assert!(
        Command::new("mkfifo")
            .arg(&list)
            .status()
            .unwrap()
            .success()
    );
    bench.succeed(&run);
    assert_eq!(
        bench.succeed(&["clean", "o", "--yes"]),
        "o has no files of this program\n"
    );
}
