//! The same run as VCD and as FST, as an independent reader sees them.

use super::reader::{self, Dump};
use super::zoo::{Part, PartIn, Zoo, inputs};
use super::{SEED, clock, options};
use motion_rtl::files::AtomicFile;
use motion_rtl::hdl::Simulator;
use motion_rtl::trace::{Clock, Fst, Options, Vcd};
use std::fs::{self, File};
use std::io::{self, Cursor};
use wellen::VarType;

/// Several sections of the file, none of which ends with a repetition of the inputs.
pub const TICKS: u64 = 20_000;

pub fn both(ticks: u64, clock: Clock, options: &Options) -> [Vec<u8>; 2] {
    let mut vcd = Vcd::new(Vec::new(), &Zoo, clock, options).unwrap();
    let mut fst = Fst::new(Cursor::new(Vec::new()), &Zoo, clock, options).unwrap();
    let mut inputs = inputs(SEED);
    Simulator::new(&Zoo)
        .unwrap()
        .run(ticks, |_, _| inputs.next().unwrap(), (&mut vcd, &mut fst))
        .unwrap();
    [vcd.finish().unwrap(), fst.finish().unwrap().into_inner()]
}

fn equal(vcd: &Dump, fst: &Dump) {
    assert_eq!(vcd.timescale, fst.timescale);
    assert!(vcd.times == fst.times, "times");
    let names = |dump: &Dump| dump.variables.keys().cloned().collect::<Vec<_>>();
    assert_eq!(names(vcd), names(fst));
    for (name, wanted) in &vcd.variables {
        let found = &fst.variables[name];
        assert_eq!(found.kind, wanted.kind, "{name}");
        assert_eq!(found.range, wanted.range, "{name}");
        if wanted.kind != VarType::String {
            assert_eq!(found.width, wanted.width, "{name}");
        }
        let at = wanted
            .changes
            .iter()
            .zip(&found.changes)
            .position(|(a, b)| a != b);
        assert_eq!(
            at.map(|at| (&wanted.changes[at], &found.changes[at])),
            None,
            "{name}"
        );
        assert_eq!(found.changes.len(), wanted.changes.len(), "{name}");
    }
}

/// The number of sections of values in a file.
fn sections(bytes: &[u8]) -> u64 {
    u64::from_be_bytes(bytes[65..73].try_into().unwrap())
}

#[test]
fn every_signal_is_as_in_the_vcd_at_every_time() {
    let [vcd, fst] = both(TICKS, clock(), &Options::default());
    assert!(sections(&fst) >= 3, "{} sections", sections(&fst));
    assert!(fst.len() * 4 < vcd.len(), "{} of {}", fst.len(), vcd.len());
    let (vcd, fst) = (reader::read(&vcd), reader::read(&fst));
    assert!(vcd.variables["zoo.left.phase_name"].changes.len() > 100);
    assert!(vcd.variables["zoo.store.word3"].changes.len() > 100);
    equal(&vcd, &fst);
}

#[test]
fn windows_selections_and_clocks_are_as_in_the_vcd() {
    let cases = [
        (100..140, vec![], 50_000_000),
        (0..1, vec![], 1),
        (7..60, vec!["zoo.right", "zoo.delay.stage2"], 3_000_000),
        (3..1_000_000, vec!["zoo.held"], 1_000),
    ];
    for (ticks, only, hz) in cases {
        let options = options(ticks, &only);
        let [vcd, fst] = both(200, Clock::from_hz(hz).unwrap(), &options);
        equal(&reader::read(&vcd), &reader::read(&fst));
    }
}

/// A section ends with its ticks, too, where hardly anything changes.
#[test]
fn a_quiet_run_has_sections_of_its_own() {
    let i = || PartIn { step: 0, up: true };
    let options = Options::default();
    let mut fst = Fst::new(Cursor::new(Vec::new()), &Part, clock(), &options).unwrap();
    let ticks = 100_000;
    Simulator::new(&Part)
        .unwrap()
        .run(ticks, |_, _| i(), &mut fst)
        .unwrap();
    let bytes = fst.finish().unwrap().into_inner();
    assert!(sections(&bytes) >= 3);
    let dump = reader::read(&bytes);
    assert_eq!(dump.variables["part.clk"].changes.len() as u64, 2 * ticks);
    assert_eq!(dump.times.last(), Some(&(2 * ticks)));
}

#[test]
fn the_same_run_gives_the_same_bytes() {
    let [first, second] = [0, 1].map(|_| both(300, clock(), &Options::default())[1].clone());
    assert!(first == second);
}

#[test]
fn what_cannot_be_laid_out_or_comes_twice_is_an_error() {
    let wrong = options(0..10, &["zoo.lef"]);
    let error = Fst::new(Cursor::new(Vec::new()), &Zoo, clock(), &wrong).unwrap_err();
    assert!(
        error
            .to_string()
            .starts_with("no scope or signal is called zoo.lef"),
        "{error}"
    );
}

#[test]
fn dropped_it_leaves_nothing() {
    let directory = tempfile::tempdir().unwrap();
    let file = AtomicFile::create(directory.path().join("zoo.fst")).unwrap();
    let mut fst = Fst::new(file, &Zoo, clock(), &Options::default()).unwrap();
    let mut inputs = inputs(SEED);
    Simulator::new(&Zoo)
        .unwrap()
        .run(50, |_, _| inputs.next().unwrap(), &mut fst)
        .unwrap();
    drop(fst);
    assert_eq!(fs::read_dir(directory.path()).unwrap().count(), 0);
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_an_error() {
    let full = || File::options().write(true).open("/dev/full").unwrap();
    let error = Fst::new(full(), &Zoo, clock(), &Options::default()).unwrap_err();
    assert_eq!(error.kind(), io::ErrorKind::StorageFull);
}
