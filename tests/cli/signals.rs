//! Runs that something ends: signals, limits, other runs. However the tests are started, what they
//! start has all signals as they are by default.

use super::support::{Bench, LINE, PROGRAM, SHORT};
use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
use signal_hook::flag::register_conditional_default;
use std::path::Path;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::sync::Arc;
use std::sync::Once;
use std::sync::atomic::AtomicBool;
use std::time::{Duration, Instant};

/// Beyond it a test has failed.
const DEADLINE: Duration = Duration::from_secs(120);

/// A run of some seconds.
const LONG: [&str; 4] = ["run", "waves/turntable.toml", "--out", "new/deep"];

/// A command whose signals do what they do by default: those that were ignored when the tests were
/// started are caught here, and what is caught is no more in a program that is started. Here they do
/// the default, too.
fn command(program: &str) -> Command {
    static CAUGHT: Once = Once::new();
    CAUGHT.call_once(|| {
        for signal in [SIGHUP, SIGINT, SIGTERM] {
            register_conditional_default(signal, Arc::new(AtomicBool::new(true))).unwrap();
        }
    });
    let mut command = Command::new(program);
    command.stdout(Stdio::null()).stderr(Stdio::null());
    command
}

/// A program that is ended with the test.
struct Running(Child);

impl Running {
    fn start(mut command: Command, directory: &Path) -> Self {
        Running(command.current_dir(directory).spawn().unwrap())
    }

    fn send(&self, signal: &str) {
        let pid = self.0.id().to_string();
        let sent = Command::new("kill").args([signal, &pid]).status().unwrap();
        assert!(sent.success());
    }

    #[track_caller]
    fn ended(&mut self) -> ExitStatus {
        let begun = Instant::now();
        loop {
            if let Some(status) = self.0.try_wait().unwrap() {
                return status;
            }
            assert!(begun.elapsed() < DEADLINE, "it does not end");
            std::thread::sleep(Duration::from_millis(2));
        }
    }

    /// Waits until it has begun to write.
    #[track_caller]
    fn writes(&mut self, bench: &Bench) {
        let begun = Instant::now();
        while !bench.names().iter().any(|name| name.ends_with(".part")) {
            assert_eq!(self.0.try_wait().unwrap(), None, "it is over");
            assert!(begun.elapsed() < DEADLINE, "it does not begin");
            std::thread::sleep(Duration::from_millis(1));
        }
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

fn long() -> Command {
    let mut command = command(PROGRAM);
    command.args(LONG);
    command
}

/// With these signals ignored, as a shell begins it.
fn ignoring(signals: &str, arguments: &[&str]) -> Command {
    let mut command = command("sh");
    let script = format!("trap '' {signals}; exec \"$0\" \"$@\"");
    command.args(["-c", &script, PROGRAM]).args(arguments);
    command
}

#[test]
fn an_interrupted_run_leaves_nothing() {
    for (signal, code) in [("-INT", 130), ("-TERM", 143), ("-HUP", 129)] {
        let bench = Bench::new();
        let mut run = Running::start(long(), &bench.path(""));
        run.writes(&bench);
        run.send(signal);
        assert_eq!(run.ended().code(), Some(code), "{signal}");
        assert!(bench.names().is_empty(), "{signal}: {:?}", bench.names());
    }
}

/// As `nohup` and `&` in a script begin it: each signal for itself.
#[cfg(target_os = "linux")]
#[test]
fn what_is_ignored_stays_so_and_costs_no_other_signal() {
    for (ignored, sent) in [
        ("HUP", ["-HUP"].as_slice()),
        ("INT", &["-INT"]),
        ("HUP INT", &["-INT", "-HUP"]),
    ] {
        let bench = Bench::new();
        let mut run = Running::start(ignoring(ignored, &LONG), &bench.path(""));
        run.writes(&bench);
        for signal in sent {
            run.send(signal);
        }
        std::thread::sleep(Duration::from_millis(50));
        assert_eq!(run.0.try_wait().unwrap(), None, "{ignored}");
        run.send("-TERM");
        assert_eq!(run.ended().code(), Some(143), "{ignored}");
        assert!(bench.names().is_empty(), "{ignored}: {:?}", bench.names());
    }
}

/// What a run has left that was ended at once, the next one removes, and says so.
#[test]
fn what_a_killed_run_has_left_goes_with_the_next() {
    let bench = Bench::with("l.hpgl", LINE);
    bench.write("new/deep/old.txt", "old");
    let mut run = Running::start(long(), &bench.path(""));
    run.writes(&bench);
    run.send("-KILL");
    assert_eq!(run.ended().code(), None);
    let left = bench.names();
    let left: Vec<_> = left
        .iter()
        .filter(|name| name.contains(".motion-rtl-"))
        .collect();
    assert!(left.len() >= 2, "{left:?}");
    let next = [
        &["run", "l.hpgl", "--to", "2000", "--out", "new/deep"],
        &SHORT[..],
    ]
    .concat();
    let done = bench.run(&next);
    // A lock holds nothing.
    let files = left.iter().filter(|name| name.ends_with(".part"));
    let said: Vec<_> = files.map(|name| name.as_str()).collect();
    assert_eq!(
        done.stderr,
        format!(
            "warning: removed what a run that did not end by itself has left: {}\n",
            said.join(", ")
        )
    );
    assert_eq!(done.code, 0);
    let there = [
        "new/deep/l.gtkw",
        "new/deep/l.svg",
        "new/deep/l.vcd",
        "new/deep/old.txt",
    ];
    let names = bench.names();
    let files = names
        .iter()
        .filter(|name| name.starts_with("new/deep/") && name.len() > 9);
    assert_eq!(files.collect::<Vec<_>>(), there);
    // Of one that still writes, nothing goes.
    let mut run = Running::start(long(), &bench.path(""));
    run.writes(&bench);
    bench.succeed(&next);
    assert!(bench.names().iter().any(|name| name.ends_with(".part")));
    run.send("-TERM");
    assert_eq!(run.ended().code(), Some(143));
    let table = ["table", "l.hpgl", "--out", "new/deep/t.csv"];
    bench.write("new/deep/.motion-rtl-x.part", "");
    let done = bench.run(&table);
    assert!(
        done.stderr
            .ends_with("has left: new/deep/.motion-rtl-x.part\n"),
        "{}",
        done.stderr
    );
}

#[test]
fn a_second_run_into_the_same_files_is_refused() {
    let bench = Bench::new();
    let mut run = Running::start(long(), &bench.path(""));
    run.writes(&bench);
    bench.refuse(
        &LONG,
        "--out: new/deep/turntable: is being written by another run; allowed: another directory, or \
         to wait until that run is over",
    );
    run.send("-TERM");
    assert_eq!(run.ended().code(), Some(143));
    assert!(bench.names().is_empty(), "{:?}", bench.names());
}

/// Threads whose stacks find no room.
#[cfg(target_os = "linux")]
#[test]
fn that_no_thread_is_to_be_had_is_an_error() {
    let bench = Bench::with("l.hpgl", LINE);
    bench.write("g.ngc", "G21 G90 F600\nG1 X10\nG1 Y10\n");
    let limited = |arguments: &[&str]| {
        let mut command = command("sh");
        let script = "ulimit -c 0; ulimit -v 3000000; exec \"$0\" \"$@\"";
        command.args(["-c", script, PROGRAM]).args(arguments);
        // Far more than there is.
        command.env("RUST_MIN_STACK", (8u64 << 30).to_string());
        command.current_dir(bench.path("")).stderr(Stdio::piped());
        let child = Running(command.spawn().unwrap());
        child.output()
    };
    for arguments in [
        &["run", "l.hpgl", "--out", "o"][..],
        &["run", "waves/circle.toml", "--no-vcd", "--out", "o"],
        &["check", "unit_law", "--width", "3"],
    ] {
        let (status, text) = limited(arguments);
        assert!(
            text.contains("could not be started: "),
            "{arguments:?}: {text}"
        );
        assert_eq!(status.code(), Some(2), "{arguments:?}: {text}");
        assert!(bench.names().iter().all(|name| !name.starts_with('o')));
    }
    // What needs none does without.
    let (status, text) = limited(&["run", "l.hpgl", "--no-vcd", "--out", "o"]);
    assert_eq!((status.code(), text.as_str()), (Some(0), ""));
}

impl Running {
    /// How it ends, and what it says on standard error.
    fn output(mut self) -> (ExitStatus, String) {
        let mut said = String::new();
        let error = self.0.stderr.take().unwrap();
        std::io::Read::read_to_string(&mut { error }, &mut said).unwrap();
        (self.ended(), said)
    }
}

#[test]
fn a_million_threads_are_as_many_as_help() {
    let bench = Bench::new();
    let mut command = bench.command(&["check", "unit_law", "--width", "3"]);
    command
        .env("RAYON_NUM_THREADS", "1000000")
        .timeout(DEADLINE);
    let output = command.output().unwrap();
    assert_eq!(output.status.code(), Some(0), "{output:?}");
}

/// A stack that there is no room for is as good as a limit on processes, which does not hold for
/// whoever runs tests as root.
#[test]
fn no_thread_to_be_had_is_an_error_and_leaves_nothing() {
    let bench = Bench::with("l.hpgl", LINE);
    let before = bench.names();
    for (arguments, said) in [
        (
            &["check", "unit_law", "--width", "3"][..],
            "error: threads: one could not be started: ",
        ),
        (
            &["run", "l.hpgl"],
            "error: a thread for the waves could not be started: ",
        ),
    ] {
        let mut command = bench.command(arguments);
        command.env("RUST_MIN_STACK", (1_u64 << 46).to_string());
        let output = command.output().unwrap();
        let text = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {text}");
        assert!(
            text.starts_with(said) && text.lines().count() == 1,
            "{text}"
        );
        assert_eq!(bench.names(), before, "{arguments:?}");
    }
}

/// Into a device that is full.
#[cfg(target_os = "linux")]
#[test]
fn help_that_cannot_be_printed_is_an_error() {
    for arguments in [
        &["--help"][..],
        &["run", "--help"],
        &["--version"],
        &["list"],
    ] {
        let full = std::fs::OpenOptions::new()
            .write(true)
            .open("/dev/full")
            .unwrap();
        let mut command = Command::new(PROGRAM);
        let output = command.args(arguments).stdout(full).output().unwrap();
        let text = String::from_utf8(output.stderr).unwrap();
        assert_eq!(
            text,
            "error: standard output: No space left on device (os error 28)\n"
        );
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
    }
}
