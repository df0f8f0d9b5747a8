//! Files that are cut off or have wrong bytes in them: an error or a report, never a panic.

use motion_rtl::circuits::blocks::EnableCounter;
use motion_rtl::compare::{Settings, compare};
use motion_rtl::trace::{Clock, replay};
use std::fs;
use std::path::Path;

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
