//! What a run with waves takes of memory does not depend on its length.

use super::support::{Bench, PROGRAM};
use std::fs;
use std::process::{Command, Stdio};
use std::thread::sleep;
use std::time::Duration;

/// In kilobytes: what every run with waves keeps to, and what a longer one may take more.
const MOST: u64 = 64 * 1024;
const MORE: u64 = 4 * 1024;

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
    let mut child = Command::new(PROGRAM)
        .current_dir(bench.path(""))
        .args([
            "run",
            "l.hpgl",
            "--out",
            "o",
            "--to",
            "100000000",
            "--format",
            format,
        ])
        .args(settings)
        .stdout(Stdio::null())
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
    let waves = fs::metadata(bench.path(&format!("o/l.{format}"))).unwrap();
    (most, waves.len())
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
