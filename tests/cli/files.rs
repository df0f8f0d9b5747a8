//! Directories and files that cannot be written.

use super::support::{Bench, LINE, PROGRAM, SHORT};

const WRITABLE: &str = "allowed: a directory that can be written";

fn run(arguments: &[&'static str]) -> Vec<&'static str> {
    [&["run", "l.hpgl", "--to", "2000"], &SHORT[..], arguments].concat()
}

#[test]
fn a_directory_is_made_with_those_around_it() {
    let bench = Bench::with("l.hpgl", LINE);
    bench.succeed(&run(&["--out", "a/b"]));
    let expected = [
        "a/",
        "a/b/",
        "a/b/l.gtkw",
        "a/b/l.svg",
        "a/b/l.vcd",
        "l.hpgl",
    ];
    assert_eq!(bench.names(), expected);
}

#[test]
fn a_file_is_no_directory() {
    let bench = Bench::with("l.hpgl", LINE);
    let text = format!("--out: l.hpgl: File exists (os error 17); {WRITABLE}");
    bench.refuse(&run(&["--out", "l.hpgl"]), &text);
    let text = format!("--out: l.hpgl/a: Not a directory (os error 20); {WRITABLE}");
    bench.refuse(&run(&["--out", "l.hpgl/a"]), &text);
}

#[test]
fn a_directory_in_the_place_of_a_file_stays_and_is_the_only_one() {
    for extension in ["vcd", "gtkw", "svg"] {
        let bench = Bench::with("l.hpgl", LINE);
        bench.write(&format!("o/l.{extension}/inside"), "");
        let text = format!("--out: o/l.{extension}: is a directory; {WRITABLE}");
        bench.refuse(&run(&["--out", "o"]), &text);
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_directory_that_takes_no_files_is_refused() {
    let bench = Bench::with("l.hpgl", LINE);
    let text = format!("--out: /proc/l.vcd: entity not found; {WRITABLE}");
    bench.refuse(&run(&["--out", "/proc"]), &text);
}

#[cfg(unix)]
#[test]
fn a_directory_without_permission_is_refused() {
    use std::os::unix::fs::PermissionsExt;
    let bench = Bench::with("l.hpgl", LINE);
    bench.write("locked/old", "");
    let locked = bench.path("locked");
    let permit = |mode| {
        let mode = std::fs::Permissions::from_mode(mode);
        std::fs::set_permissions(&locked, mode).unwrap();
    };
    permit(0o555);
    // To root nothing is locked.
    if std::fs::write(locked.join("probe"), "").is_err() {
        let text = format!("--out: locked/l.vcd: permission denied; {WRITABLE}");
        bench.refuse(&run(&["--out", "locked"]), &text);
    }
    permit(0o755);
}

/// A limit on the size of files stands for a disk that is full.
#[cfg(target_os = "linux")]
#[test]
fn a_disk_that_is_full_leaves_neither_files_nor_directories() {
    let bench = Bench::with("l.hpgl", LINE);
    let script = "trap '' XFSZ; ulimit -f 64; exec \"$0\" \"$@\"";
    let arguments = [
        &["-c", script, super::support::PROGRAM],
        &run(&["--out", "a/b"])[..],
    ];
    let full = |program: &str| {
        let mut command = assert_cmd::Command::new(program);
        command.current_dir(bench.path("")).args(arguments.concat());
        command
    };
    full("bash")
        .assert()
        .code(2)
        .stdout("")
        .stderr("error: the waves could not be written: a/b/l.vcd: File too large (os error 27)\n");
    assert_eq!(bench.names(), ["l.hpgl"]);
}

#[cfg(unix)]
#[test]
fn what_is_no_regular_file_is_not_replaced() {
    let problem = "is not a regular file, and only such a file is replaced";
    let bench = Bench::with("l.hpgl", LINE);
    bench.refuse(
        &["table", "l.hpgl", "--out", "/dev/null"],
        &format!("--out: /dev/null: {problem}; allowed: a file that can be written"),
    );
    bench.write("o/left", "");
    std::os::unix::fs::symlink("/dev/null", bench.path("o/l.vcd")).unwrap();
    let text = format!("--out: o/l.vcd: {problem}; {WRITABLE}");
    bench.refuse(&run(&["--out", "o"]), &text);
}

#[cfg(unix)]
#[test]
fn a_link_is_followed() {
    let bench = Bench::with("l.hpgl", LINE);
    bench.write("far/left", "");
    bench.write("o/left", "");
    std::os::unix::fs::symlink("../far/l.vcd", bench.path("o/l.vcd")).unwrap();
    let said = bench.succeed(&run(&["--out", "o"]));
    assert!(said.contains("wrote o/l.vcd\n"), "{said}");
    assert!(bench.path("o/l.vcd").is_symlink());
    assert!(bench.read("far/l.vcd").starts_with("$"), "no waves");
}

#[test]
fn a_table_cannot_replace_a_directory() {
    let bench = Bench::with("l.hpgl", LINE);
    bench.write("t.csv/inside", "");
    let allowed = "allowed: a file that can be written";
    bench.refuse(
        &["table", "l.hpgl", "--out", "t.csv"],
        &format!("--out: t.csv: is a directory; {allowed}"),
    );
    bench.refuse(
        &["table", "l.hpgl", "--out", "l.hpgl/t.csv"],
        &format!("--out: l.hpgl: File exists (os error 17); {allowed}"),
    );
}

/// Ctrl-C, and what asks a program to end.
#[cfg(unix)]
#[test]
fn an_interrupted_run_leaves_nothing() {
    use std::process::{Command, Stdio};
    use std::time::Duration;
    for signal in ["-INT", "-TERM"] {
        let bench = Bench::new();
        let mut run = Command::new(PROGRAM)
            .args(["run", "waves/turntable.toml", "--out", "new/deep"])
            .current_dir(bench.path(""))
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        // It has begun to write.
        while !bench.names().iter().any(|name| name.ends_with(".part")) {
            assert_eq!(run.try_wait().unwrap(), None, "it is over");
            std::thread::sleep(Duration::from_millis(1));
        }
        let pid = run.id().to_string();
        let sent = Command::new("kill").args([signal, &pid]).status().unwrap();
        assert!(sent.success());
        assert_eq!(run.wait().unwrap().code(), Some(130), "{signal}");
        assert!(bench.names().is_empty(), "{signal}: {:?}", bench.names());
    }
}

/// As `nohup` begins it.
#[cfg(unix)]
#[test]
fn a_run_that_is_to_ignore_the_end_of_its_terminal_goes_on() {
    use std::process::Command;
    let bench = Bench::new();
    let text = "trap '' HUP; \"$0\" run waves/turntable.toml --no-vcd & run=$!; \
                sleep 0.2; kill -HUP $run; wait $run";
    let done = Command::new("sh")
        .args(["-c", text, PROGRAM])
        .current_dir(bench.path(""))
        .output()
        .unwrap();
    assert_eq!(done.status.code(), Some(0), "{done:?}");
}
