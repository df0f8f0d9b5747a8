//! Directories and files that cannot be written.

use super::support::{Bench, LINE, SHORT};

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
    let text = format!("--out: /proc/l.vcd: No such file or directory (os error 2); {WRITABLE}");
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
        let text = format!("--out: locked/l.vcd: Permission denied (os error 13); {WRITABLE}");
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
    let series = ["--no-vcd", "--series", "s.csv", "--series-every", "1"];
    let text = "error: the time series could not be written: s.csv: File too large (os error 27)\n";
    full("bash").args(series).assert().code(2).stderr(text);
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

/// A pipe that nobody reads, or a link, in the place of the lock: no run waits for it.
#[cfg(unix)]
#[test]
fn what_is_no_regular_file_is_no_lock() {
    let bench = Bench::with("l.hpgl", LINE);
    let name = "o/.motion-rtl-l.lock";
    let text = format!(
        "--out: {name}: is not a regular file, and locks need one of this name; allowed: another \
         directory, or to remove it"
    );
    let lock = bench.path(name);
    let pipe = |path: &std::path::Path| {
        let made = std::process::Command::new("mkfifo").arg(path).status();
        assert!(made.unwrap().success());
    };
    bench.write("o/left", "");
    pipe(&lock);
    bench.refuse(&run(&["--out", "o"]), &text);
    // Nor does it follow a link, to a pipe or to nothing.
    for target in ["pipe", "nowhere"] {
        std::fs::remove_file(&lock).unwrap();
        std::os::unix::fs::symlink(target, &lock).unwrap();
        if target == "pipe" {
            pipe(&bench.path("o/pipe"));
        }
        bench.refuse(&run(&["--out", "o"]), &text);
    }
    assert!(!bench.path("o/nowhere").exists());
    // What only has such a name is not touched, and not waited for.
    for name in [
        "o/.motion-rtl-x.part",
        "o/.motion-rtl-x.new",
        "o/.motion-rtl-.lock",
    ] {
        pipe(&bench.path(name));
    }
    std::fs::remove_file(&lock).unwrap();
    bench.succeed(&run(&["--out", "o"]));
    assert!(bench.path("o/.motion-rtl-x.part").exists());
}

/// Runs side by side into one directory, each of another circuit.
#[test]
#[ignore = "takes long"]
fn runs_into_one_directory_do_not_disturb_each_other() {
    let bench = Bench::new();
    let circuits = ["axis", "servo", "cordic", "correction"];
    std::thread::scope(|scope| {
        for circuit in circuits {
            let bench = &bench;
            scope.spawn(move || {
                for k in 0..125 {
                    let done = bench.run(&["verilog", circuit, "--out", "o"]);
                    let said = (done.code, done.stderr.as_str());
                    assert_eq!(said, (0, ""), "{circuit}, run {k}");
                }
            });
        }
    });
    let hidden = |name: &&String| name.contains(".motion-rtl-");
    assert_eq!(bench.names().iter().find(hidden), None);
}

#[cfg(unix)]
#[test]
fn a_link_is_followed() {
    let bench = Bench::with("l.hpgl", LINE);
    bench.write("far/left", "");
    bench.write("o/left", "");
    std::os::unix::fs::symlink("../far/l.vcd", bench.path("o/l.vcd")).unwrap();
    let said = bench.succeed(&run(&["--out", "o"]));
    assert!(said.contains("wrote o/l.vcd ("), "{said}");
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

#[cfg(unix)]
#[test]
fn links_to_nothing_say_so() {
    let bench = Bench::with("l.hpgl", LINE);
    for link in ["o", "d.hpgl", "d.toml"] {
        std::os::unix::fs::symlink("nowhere", bench.path(link)).unwrap();
    }
    let text = format!("--out: o: is a link to what is not there; {WRITABLE}");
    bench.refuse(&run(&["--out", "o"]), &text);
    for link in ["d.hpgl", "d.toml"] {
        let text = "is a link to nowhere, which is not there; allowed: a readable file";
        bench.refuse(&["run", link], &format!("{link}: file: {text}"));
    }
}

/// A limit on open files: too low for those of the run, high enough to begin.
#[cfg(target_os = "linux")]
#[test]
fn too_many_open_files_are_called_so() {
    let bench = Bench::with("l.hpgl", LINE);
    let mut said = Vec::new();
    for limit in 3..40 {
        let script = format!("ulimit -n {limit}; exec \"$0\" \"$@\"");
        let arguments = [
            &["-c", script.as_str(), super::support::PROGRAM],
            &run(&["--out", "o"])[..],
        ];
        let mut command = assert_cmd::Command::new("sh");
        let output = command.current_dir(bench.path("")).args(arguments.concat());
        let output = output
            .timeout(std::time::Duration::from_secs(60))
            .output()
            .unwrap();
        let text = String::from_utf8(output.stderr).unwrap();
        match output.status.code() {
            Some(0) => break,
            // The system's loader.
            Some(127) => {}
            code => {
                assert_eq!(code, Some(2), "{limit}: {text}");
                said.push(text);
            }
        }
    }
    assert!(
        said.iter()
            .any(|text| text.contains("o/l.vcd: Too many open files")),
        "{said:?}"
    );
    for text in &said {
        assert!(
            text.contains("Too many open files")
                && text.ends_with("; allowed: a higher limit on open files (ulimit -n)\n")
                && !text.contains("motion-rtl-"),
            "{text}"
        );
    }
}

/// What comes from a file is shown as far as it helps, and as nothing that a terminal obeys.
#[test]
fn messages_are_cut_and_plain() {
    let long = "k".repeat(3_000_000);
    let bench = Bench::with("long.toml", format!("circuit = \"machine\"\n{long} = 1\n"));
    bench.write("long.csv", format!("0,0\n1,{}\n2,2\n", &long[..1_000_000]));
    bench.write("odd.csv", "0,0\n1,\u{1b}[31m\u{7}\n2,2\n");
    bench.write("odd.toml", "circuit = \"machine\"\n\"\\u001b[31m\" = 1\n");
    for (name, shown) in [
        ("long.toml", "kkkk"),
        ("long.csv", "kkkk"),
        ("odd.csv", "\\u{1b}[31m\\u{7}"),
        ("odd.toml", "\\u001b[31m"),
    ] {
        let done = bench.run(&["run", name, "--no-vcd"]);
        let text = done.stderr.trim_end_matches('\n');
        assert_eq!(done.code, 2, "{name}");
        assert!(
            text.len() < 12_000 && text.contains(shown),
            "{name}: {text}"
        );
        let plain = |line: &str| !line.contains(char::is_control);
        assert!(text.lines().all(plain), "{name}: {text:?}");
        assert_eq!(
            text.contains(" bytes more)"),
            name.starts_with("long"),
            "{name}: {text}"
        );
    }
}

/// Two names that differ in bytes that are no text would give one name of results.
#[cfg(target_os = "linux")]
#[test]
fn names_that_are_no_text_are_refused() {
    use std::os::unix::ffi::OsStrExt;
    let bench = Bench::new();
    for name in [&b"\xff.hpgl"[..], b"\xfe.toml"] {
        let name = std::ffi::OsStr::from_bytes(name);
        let text = match name.as_bytes().ends_with(b"toml") {
            true => "circuit = \"pulse_interpolator\"\ninput = \"l.hpgl\"\n",
            false => LINE,
        };
        std::fs::write(bench.path("").join(name), text).unwrap();
        let output = bench.command(&["run"]).arg(name).output().unwrap();
        let said = String::from_utf8(output.stderr).unwrap();
        assert!(
            said.ends_with(": file: has a name that is not UTF-8; allowed: a name in UTF-8\n"),
            "{said}"
        );
        assert_eq!(output.status.code(), Some(2));
        std::fs::remove_file(bench.path("").join(name)).unwrap();
    }
    assert!(bench.names().is_empty());
}

/// A name of a file may have what a terminal obeys.
#[cfg(unix)]
#[test]
fn names_reach_the_terminal_as_plain_text() {
    let odd = "\u{1b}[31m";
    let bench = Bench::with(&format!("{odd}.hpgl"), LINE);
    let [file, missing, directory] = [".hpgl", ".ngc", "d"].map(|end| format!("{odd}{end}"));
    bench.write(&format!("{directory}/.motion-rtl-x.part"), "");
    bench.write("a/.motion-rtl-a.lock/x", "");
    let plain = |text: &str| !text.contains(|c: char| c.is_control() && c != '\n');
    for (code, arguments) in [
        (0, &["run", &file, "--no-vcd", "--out", &directory][..]),
        (0, &["table", &file]),
        (2, &["run", &missing]),
        (2, &["run", &file, "--out", &file]),
        (2, &["check", odd]),
        (2, &["check", "--width", odd]),
        (2, &["verilog", "axis", "--out", &file]),
        (2, &["compare", &file, &missing]),
        (2, &["mutate", "sync_stage", "--charts", &directory]),
    ] {
        let done = bench.run(arguments);
        assert_eq!(done.code, code, "{arguments:?}: {}", done.stderr);
        for text in [&done.stdout, &done.stderr] {
            assert!(plain(text), "{arguments:?}: {text:?}");
        }
        let shown = "\\u{1b}[31m";
        // Words that are no arguments at all are cut.
        let said = done.stdout + &done.stderr;
        let cut = arguments.contains(&"--width");
        assert!(cut || said.contains(shown), "{arguments:?}: {said:?}");
    }
}

/// A limit on the address space with which threads and allocations fail anywhere.
#[cfg(target_os = "linux")]
#[test]
fn too_little_memory_is_called_so() {
    let bench = Bench::with("l.hpgl", LINE);
    for arguments in [&run(&["--out", "o"])[..], &["list"]] {
        let script = "ulimit -v 49152; exec \"$0\" \"$@\"";
        let mut command = assert_cmd::Command::new("sh");
        command.args(["-c", script, super::support::PROGRAM]);
        let done = command.args(arguments).current_dir(bench.path(""));
        done.assert().code(2).stdout("").stderr(
            "error: ulimit -v: the address space is limited to 49152 KiB; allowed: 65536 KiB or more\n",
        );
    }
    assert_eq!(bench.names(), ["l.hpgl"]);
}

/// A file without an end of line, as large as is read at all, takes little more than its bytes.
#[cfg(target_os = "linux")]
#[test]
fn a_log_of_zeros_takes_little_memory() {
    let bench = Bench::new();
    let file = std::fs::File::create(bench.path("z.csv")).unwrap();
    file.set_len(250_000_000).unwrap();
    let script = "ulimit -v 700000; exec \"$0\" \"$@\"";
    let mut command = assert_cmd::Command::new("sh");
    command.args(["-c", script, super::support::PROGRAM, "run", "z.csv"]);
    let done = command.current_dir(bench.path("")).assert();
    done.code(2).stdout("").stderr(
        "error: z.csv:1: file: a record without an end; allowed: records of at most 1048576 bytes\n",
    );
}
