//! Memory of a run: with waves it does not depend on the length, without them hardly.

use super::support::{Bench, PROGRAM};
use std::fs;
use std::process::{Command, Stdio};
use std::thread::sleep;
use std::time::Duration;

/// In kilobytes: what every run with waves keeps to, and what a longer one may take more.
const MOST: u64 = 64 * 1024;
const MORE: u64 = 4 * 1024;
/// In kilobytes: what an hour of machine time takes more, without waves.
const MORE_IN_AN_HOUR: u64 = 16 * 1024;

/// Draws a line of so many millimetres; returns the most memory it had, in kilobytes, and the
/// bytes of its waves.
fn peak(millimetres: u32, format: &str) -> (u64, u64) {
    let bench = Bench::with("l.hpgl", format!("PD{},0;", 40 * millimetres));
    let settings = [
        "clock_hz=20000",
        "line_unit_ticks=200",
        "feed_mm_per_min=600",
    ];
    let settings = settings.iter().flat_map(|setting| ["--set", setting]);
    let window = ["--to", "100000000", "--format", format];
    let arguments: Vec<_> = ["run", "l.hpgl", "--out", "o"]
        .into_iter()
        .chain(window)
        .chain(settings)
        .collect();
    let most = most_of(&bench, &arguments);
    let waves = fs::metadata(bench.path(&format!("o/l.{format}"))).unwrap();
    (most, waves.len())
}

/// The most memory that the program had, in kilobytes.
fn most_of(bench: &Bench, arguments: &[&str]) -> u64 {
    let mut child = Command::new(PROGRAM)
        .current_dir(bench.path(""))
        .args(arguments)
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    let status = format!("/proc/{}/status", child.id());
    let mut most = 0;
    while child.try_wait().unwrap().is_none() {
        let status = fs::read_to_string(&status).unwrap_or_default();
        let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
        let number = line.and_then(|line| line.trim().split(' ').next());
        most = most.max(number.map_or(0, |number| number.parse().unwrap()));
        sleep(Duration::from_millis(2));
    }
    assert!(child.wait().unwrap().success());
    most
}

/// A millimetre a minute: 6000 s, which are as many unit times of a millisecond.
#[test]
#[ignore = "takes long"]
fn the_slowest_feed_keeps_to_little() {
    let bench = Bench::with("f.ngc", "G21\nG1 X100 F1\nM2\n");
    let most = most_of(&bench, &["run", "f.ngc", "--no-vcd"]);
    assert!((1024..MOST).contains(&most), "{most} kB");
}

/// An hour on the pulse interpolator and the arc generator, and five minutes on circuits whose motors are stepped in every
/// tick: 300,000 scans or periods, of which a record each would be more.
#[test]
#[ignore = "takes long"]
fn an_hour_of_machine_time_takes_little_more() {
    let circuits: [(&[&str], [u32; 2]); 5] = [
        (&["clock_hz=20000", "line_unit_ticks=20"], [600, 4200]),
        (&["circuit=arc_generator"], [600, 4200]),
        (
            &[
                "circuit=linear_interpolator",
                "clock_hz=200000",
                "scan_ticks=200",
            ],
            [120, 420],
        ),
        (
            &["circuit=trajectory_controller", "clock_hz=400000"],
            [120, 420],
        ),
        (&["circuit=machine", "clock_hz=400000"], [120, 420]),
    ];
    for (settings, seconds) in circuits {
        let settings: Vec<_> = settings.iter().flat_map(|set| ["--set", set]).collect();
        let [short, long] = seconds.map(|seconds| {
            // Lines of ten minutes, as many as a segment of the arc generator has samples for.
            let ends = (1..=seconds.div_ceil(600)).map(|k| seconds.min(600 * k));
            let lines = ends.map(|end| format!("G1 X{end} F60\n"));
            let bench = Bench::with("l.ngc", lines.collect::<String>());
            most_of(
                &bench,
                &[&["run", "l.ngc", "--no-vcd"], &settings[..]].concat(),
            )
        });
        assert!(
            long.saturating_sub(short) < MORE_IN_AN_HOUR,
            "{settings:?}: {short} and {long} kB"
        );
    }
}

#[test]
#[ignore = "takes long"]
fn a_run_eight_times_as_long_takes_no_more() {
    for format in ["vcd", "fst"] {
        let (short, long) = (peak(80, format), peak(640, format));
        assert!(
            long.1 > 2 * short.1,
            "{format}: {} and {} bytes",
            short.1,
            long.1
        );
        assert!(short.0 > 1024, "{format}: {} kB cannot be", short.0);
        assert!(long.0 < MOST, "{format}: {} kB", long.0);
        assert!(
            long.0 < short.0 + MORE,
            "{format}: {} and {} kB",
            short.0,
            long.0
        );
    }
}
