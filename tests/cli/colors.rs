//! `--color`: help and errors of all commands.

use super::support::Bench;

/// Value of `--color`, and true if help and errors are coloured when they go to a pipe.
const COLORS: [(&str, bool); 3] = [("auto", false), ("never", false), ("always", true)];

/// Command lines that are refused, each in another place of the program.
const REFUSED: [&[&str]; 14] = [
    &["run", "s.toml"],
    &["run", "none.hpgl"],
    &["run", "line.hpgl", "--from", "5", "--to", "5"],
    &["run", "line.hpgl", "--nonsense"],
    &["none"],
    &["keys", "nofoo"],
    &["list", "nofoo"],
    &["clean", "nonexist"],
    &["check", "nofoo"],
    &["check", "unit_law", "--limit", "10"],
    &["mutate", "nofoo"],
    &[
        "verilog",
        "sync_stage",
        "--set",
        "a=1",
        "--set",
        "b=1",
        "--out",
        "o",
    ],
    &["plan", "nofoo"],
    &["compare", "a.vcd", "b.vcd"],
];

/// Beginnings of coloured messages: those of the program, of command lines that cannot be parsed, of
/// faults with their lines.
const HEADS: [&str; 3] = [
    "\x1b[1;31merror:\x1b[0m ",
    "\x1b[1m\x1b[31merror:\x1b[0m ",
    "\x1b[1m\x1b[91merror\x1b[0m",
];

fn bench() -> Bench {
    let bench = Bench::with("s.toml", "circuit = \"lead_angle\"\nwhat = 1\n");
    bench.write("line.hpgl", "PD400,0;");
    bench
}

#[test]
fn every_error_is_coloured_as_asked_for() {
    let bench = bench();
    for (color, coloured) in COLORS {
        for words in REFUSED {
            let done = bench.run(&[words, &["--color", color]].concat());
            assert_ne!(done.code, 0, "{words:?}");
            let heads = HEADS.iter().map(|head| done.stderr.matches(head).count());
            let heads: usize = heads.sum();
            let has = done.stderr.contains("\x1b[");
            assert_eq!(has, coloured, "{color} {words:?}: {}", done.stderr);
            assert_eq!(heads > 0, coloured, "{color} {words:?}: {}", done.stderr);
        }
    }
    // Each line of a message that has several errors.
    let words = [
        "--color=always",
        "list",
        "sync_stage",
        "--set",
        "a=1",
        "--set",
        "b=1",
    ];
    let done = bench.run(&words);
    assert_eq!(done.stderr.matches(HEADS[0]).count(), 2, "{}", done.stderr);
}

#[test]
fn every_help_is_coloured_as_asked_for() {
    let bench = bench();
    for (color, coloured) in COLORS {
        let color = ["--color", color];
        let mut lines = vec![
            [&["--help"], &color[..]].concat(),
            [&color[..], &["-h"]].concat(),
            [&["help"], &color[..]].concat(),
            [&color[..], &["help"]].concat(),
        ];
        for command in ["run", "check", "keys", "clean"] {
            lines.extend([
                [&[command, "--help"], &color[..]].concat(),
                [&color[..], &[command, "-h"]].concat(),
                [&["help", command], &color[..]].concat(),
                [&["help"], &color[..], &[command]].concat(),
                [&color[..], &["help", command]].concat(),
            ]);
        }
        for words in lines {
            let help = bench.succeed(&words);
            assert_eq!(help.contains("\x1b["), coloured, "{words:?}: {help}");
        }
    }
}

#[test]
fn a_warning_is_coloured_as_asked_for() {
    let bench = Bench::with("line.hpgl", "QQ;PD400,0;");
    let run = [
        &["line.hpgl", "--lenient", "--no-vcd"],
        &super::support::SHORT[..],
    ]
    .concat();
    for (color, coloured) in COLORS {
        let done = bench.run(&[&run[..], &["--color", color]].concat());
        assert_eq!(done.code, 0, "{}", done.stderr);
        let head = if coloured {
            "\x1b[1;33mwarning:\x1b[0m "
        } else {
            "warning: "
        };
        assert!(done.stderr.starts_with(head), "{color}: {}", done.stderr);
    }
}
