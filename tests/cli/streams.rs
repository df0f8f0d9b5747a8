//! Standard output and standard error: what goes where, and where they end early.

use super::support::{Bench, LINE, PROGRAM, SHORT};
use std::process::{Command, Stdio};

const COMMANDS: [&[&str]; 4] = [
    &["run", "l.hpgl", "--no-vcd"],
    &["run", "l.hpgl", "--no-vcd", "--json"],
    &["table", "l.hpgl"],
    &["list", "--json"],
];

#[test]
fn json_stands_alone_on_standard_output() {
    let bench = Bench::with("l.hpgl", LINE);
    for arguments in [&["run", "l.hpgl", "--no-vcd"][..], &["table", "l.hpgl"]] {
        // `json` takes nothing but one value, and nothing on standard error.
        assert!(bench.json(&[arguments, &SHORT[..]].concat()).is_object());
    }
}

#[test]
fn a_reader_that_has_gone_is_no_failure() {
    let bench = Bench::with("l.hpgl", LINE);
    for arguments in COMMANDS {
        let (reader, writer) = std::io::pipe().unwrap();
        drop(reader);
        let output = Command::new(PROGRAM)
            .args(arguments)
            .current_dir(bench.path(""))
            .stdout(writer)
            .stderr(Stdio::piped())
            .output()
            .unwrap();
        let stderr = String::from_utf8(output.stderr).unwrap();
        assert_eq!(
            (output.status.code(), stderr.as_str()),
            (Some(0), ""),
            "{arguments:?}"
        );
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_standard_output_is_a_failure_without_panic() {
    let bench = Bench::with("l.hpgl", LINE);
    let full = || {
        std::fs::OpenOptions::new()
            .write(true)
            .open("/dev/full")
            .unwrap()
    };
    for arguments in COMMANDS {
        let mut command = Command::new(PROGRAM);
        command
            .args(arguments)
            .current_dir(bench.path(""))
            .stdout(full());
        let output = command.stderr(Stdio::piped()).output().unwrap();
        let stderr = String::from_utf8(output.stderr).unwrap();
        let text = "error: standard output: No space left on device (os error 28)\n";
        assert_eq!(
            (output.status.code(), stderr.as_str()),
            (Some(2), text),
            "{arguments:?}"
        );
        let code = command.stderr(full()).status().unwrap().code();
        assert_eq!(code, Some(2), "{arguments:?} with standard error full, too");
    }
}

#[test]
fn help_and_version_go_to_standard_output() {
    let bench = Bench::new();
    let help = bench.succeed(&["--help"]);
    for command in ["run", "table", "check", "list"] {
        assert!(help.contains(&format!("\n  {command} ")), "{help}");
    }
    let flags = bench.succeed(&["run", "--help"]);
    for flag in [
        "--out", "--no-vcd", "--from", "--to", "--only", "--set", "--json",
    ] {
        assert!(flags.contains(flag), "{flag}: {flags}");
    }
    let version = concat!("motion-rtl ", env!("CARGO_PKG_VERSION"), "\n");
    assert!(bench.succeed(&["-V"]).starts_with(version));
}

#[cfg(target_os = "linux")]
#[test]
fn a_closed_standard_output_is_told() {
    let bench = Bench::with("l.hpgl", LINE);
    for arguments in COMMANDS {
        for (to, told) in [(">&-", true), (">/dev/null", false)] {
            let script = format!("exec \"$0\" \"$@\" {to}");
            let mut command = Command::new("sh");
            command.args(["-c", &script, PROGRAM]).args(arguments);
            let output = command.current_dir(bench.path("")).output().unwrap();
            let stderr = String::from_utf8(output.stderr).unwrap();
            let text = "warning: standard output is closed, ";
            assert_eq!(stderr.starts_with(text), told, "{arguments:?}: {stderr}");
            assert_eq!(stderr.lines().count(), usize::from(told), "{stderr}");
        }
    }
}
