//! Files that are cut off or have wrong bytes in them: an error or a report, never a panic.

use super::wrapped::{self, wrapped};
use motion_rtl::circuits::blocks::EnableCounter;
use motion_rtl::compare::{Settings, compare};
use motion_rtl::trace::{Clock, replay};
use std::env;
use std::fs;
use std::path::Path;
use std::process::Command;

/// A dump of 20 ticks.
pub fn counter(directory: &Path) -> Vec<u8> {
    // `period`.
    let inputs = (0..20).map(|_| vec![3]);
    let circuit = EnableCounter { width: 8 };
    let paths = replay(&circuit, inputs, Clock::default(), directory, "golden").unwrap();
    fs::read(&paths[0]).unwrap()
}

#[test]
fn a_dump_that_is_cut_off_is_an_error_or_has_fewer_ticks() {
    let directory = tempfile::tempdir().unwrap();
    let bytes = counter(directory.path());
    let [golden, other] = ["golden.vcd", "other.vcd"].map(|name| directory.path().join(name));
    let settings = Settings::default();
    assert!(compare(&golden, &golden, &settings).unwrap().is_equal());
    let mut reports = 0;
    for length in 0..bytes.len() {
        fs::write(&other, &bytes[..length]).unwrap();
        match compare(&golden, &other, &settings) {
            Ok(report) => {
                assert!(bytes[..length].ends_with(b"\n"), "{length}");
                assert!(report.ticks < 20, "{report}");
                reports += 1;
            }
            Err(fault) => assert!(!fault.problem.is_empty()),
        }
    }
    // Only a dump that is cut off behind a time looks complete.
    assert!((20..45).contains(&reports), "{reports}");
}

#[test]
fn wrong_bytes_are_an_error_or_a_report() {
    let directory = tempfile::tempdir().unwrap();
    let bytes = counter(directory.path());
    let [golden, other] = ["golden.vcd", "other.vcd"].map(|name| directory.path().join(name));
    for place in 0..bytes.len() {
        for wrong in [b'\n', b'0', 0xff] {
            let mut bytes = bytes.clone();
            bytes[place] = wrong;
            fs::write(&other, &bytes).unwrap();
            // Either will do: that it returns is the test.
            let _ = compare(&golden, &other, &Settings::default());
        }
    }
}

/// Address space in KiB and time of a processor in seconds of the program that compares.
const MEMORY: u64 = 256 * 1024;
const SECONDS: u64 = 120;
/// Tells this test that it is that program.
const CHILD: &str = "MOTION_RTL_COMPARES_DAMAGED_FST";

/// One byte of a small FST is another: each byte, and each other value. What ends the program or takes
/// more than it has is found by the number of the damage that was printed last.
#[cfg(target_os = "linux")]
#[test]
#[ignore = "takes long"]
fn every_value_of_every_byte_of_an_fst_needs_little_memory() {
    let plain = wrapped::counter(6);
    let files = [wrapped(&plain), plain];
    let size: usize = files.iter().map(Vec::len).sum();
    let damages = 255 * size;
    if env::var_os(CHILD).is_some() {
        return compare_damaged(&files);
    }
    let name = "compare::damage::every_value_of_every_byte_of_an_fst_needs_little_memory";
    let limit = MEMORY + size.div_ceil(1024) as u64;
    let script = format!("ulimit -c 0; ulimit -v {limit}; ulimit -t {SECONDS}; exec \"$0\" \"$@\"");
    let mut child = Command::new("sh");
    child.args(["-c", &script]).arg(env::current_exe().unwrap());
    child.args([
        "--exact",
        name,
        "--ignored",
        "--nocapture",
        "--test-threads=1",
    ]);
    // A pool of memory for each thread would take the limit by itself.
    child.envs([
        (CHILD, "1"),
        ("RAYON_NUM_THREADS", "1"),
        ("MALLOC_ARENA_MAX", "1"),
    ]);
    let output = child.output().unwrap();
    let said = String::from_utf8_lossy(&output.stdout);
    let mut numbers = said.lines().filter_map(|line| line.strip_prefix("damage "));
    let last = numbers.next_back().unwrap_or("none").to_owned();
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(
        output.status.success(),
        "damage {last} of {damages}: {}\n{errors}",
        output.status
    );
    assert_eq!(last, (damages - 1).to_string());
}

#[cfg(target_os = "linux")]
fn compare_damaged(files: &[Vec<u8>; 2]) {
    use std::os::unix::fs::FileExt as _;

    let directory = tempfile::tempdir().unwrap();
    let [golden, other] = ["golden.fst", "other.fst"].map(|name| directory.path().join(name));
    let (mut damage, mut reports) = (0, 0);
    for bytes in files {
        fs::write(&golden, bytes).unwrap();
        fs::write(&other, bytes).unwrap();
        // A file that is written anew each time would take most of the time.
        let file = fs::File::options().write(true).open(&other).unwrap();
        let put = |place: usize, byte: u8| file.write_all_at(&[byte], place as u64).unwrap();
        for (place, &byte) in bytes.iter().enumerate() {
            for change in 1..=255 {
                println!("damage {damage}");
                damage += 1;
                put(place, byte ^ change);
                reports += u32::from(compare(&golden, &other, &Settings::default()).is_ok());
            }
            put(place, byte);
        }
    }
    assert!(reports > 1000, "only {reports} files were compared");
}
