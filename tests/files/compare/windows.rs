//! A window of a run counts its ticks as the run did.

use motion_rtl::circuits::blocks::{EnableCounter, enable_counter::In};
use motion_rtl::compare::{Settings, compare};
use motion_rtl::sim::Simulator;
use motion_rtl::trace::{Clock, Options, Vcd};
use std::fs;
use std::ops::Range;

fn dump(ticks: Range<u64>) -> Vec<u8> {
    let circuit = EnableCounter { width: 8 };
    let options = Options { ticks, only: None };
    let mut vcd = Vcd::new(Vec::new(), &circuit, Clock::default(), &options).unwrap();
    Simulator::new(&circuit)
        .unwrap()
        .run(20, |_, _| In { period: 7 }, &mut vcd)
        .unwrap();
    vcd.finish().unwrap()
}

#[test]
fn windows_meet_in_the_ticks_they_share() {
    let directory = tempfile::tempdir().unwrap();
    let [one, two] = ["one.vcd", "two.vcd"].map(|name| directory.path().join(name));
    for (golden, other, from, ticks) in [
        (0..20, 5..9, 5, 4),
        (5..9, 0..20, 5, 4),
        (5..12, 9..20, 9, 3),
        (8..9, 3..20, 8, 1),
    ] {
        fs::write(&one, dump(golden)).unwrap();
        fs::write(&two, dump(other)).unwrap();
        let report = compare(&one, &two, &Settings::default()).unwrap();
        assert!(report.is_equal(), "{report}");
        assert_eq!((report.from_tick, report.ticks), (from, ticks), "{report}");
    }
}
