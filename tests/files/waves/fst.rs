//! One run as VCD and as FST, as an independent reader sees them.

use super::reader::{self, Dump};
use super::zoo::{Part, PartIn, Zoo, inputs};
use super::{SEED, clock, options};
use motion_rtl::files::AtomicFile;
use motion_rtl::sim::Simulator;
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
fn states_have_a_table_of_their_names() {
    let [vcd, fst] = both(1, clock(), &Options::default());
    let (vcd, fst) = (reader::read(&vcd), reader::read(&fst));
    for (name, variable) in &fst.variables {
        let states: Vec<_> = variable.states.iter().collect();
        let expected = [("00", "IDLE"), ("01", "RUN"), ("10", "STOP")];
        let expected = expected.map(|(code, name)| (code.to_owned(), name.to_owned()));
        match name.ends_with(".phase") {
            true => assert_eq!(states, expected.iter().collect::<Vec<_>>(), "{name}"),
            false => assert!(states.is_empty(), "{name}"),
        }
        assert!(vcd.variables[name].states.is_empty(), "{name}");
    }
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

/// A number of seven bits a byte, the lowest first.
fn varint(bytes: &mut &[u8]) -> u64 {
    let mut value = 0;
    for place in 0.. {
        let (&byte, rest) = bytes.split_first().unwrap();
        *bytes = rest;
        value |= u64::from(byte & 0x7f) << (7 * place);
        if byte & 0x80 == 0 {
            break;
        }
    }
    value
}

/// When each section of values begins, and the values that stand then as characters of all signals
/// in a row.
fn frames(bytes: &[u8]) -> Vec<(u64, Vec<u8>)> {
    let mut rest = bytes;
    let mut frames = Vec::new();
    while let Some((&kind, after)) = rest.split_first() {
        let number = |place: usize| u64::from_be_bytes(after[place..place + 8].try_into().unwrap());
        let length = number(0) as usize;
        if kind == 8 {
            let mut section = &after[32..length];
            let [unpacked, packed, _] = [(); 3].map(|()| varint(&mut section) as usize);
            let frame = &section[..packed];
            let frame = match packed == unpacked {
                true => frame.to_vec(),
                false => miniz_oxide::inflate::decompress_to_vec_zlib(frame).unwrap(),
            };
            assert_eq!(frame.len(), unpacked);
            frames.push((number(8), frame));
        }
        rest = &after[length..];
    }
    frames
}

/// A viewer that goes to a time in the middle of the file begins with the frame of its section: it
/// has what stands at the end of the section before, of every signal.
#[test]
fn each_section_begins_with_the_values_that_stand_there() {
    let [vcd, fst] = both(TICKS, clock(), &Options::default());
    let mut wave = wellen::simple::read_from_reader(Cursor::new(fst.clone())).unwrap();
    let order: Vec<_> = wave.hierarchy().all_vars().collect();
    wave.load_signals(&[]);
    let hierarchy = wave.hierarchy();
    let dump = reader::read(&vcd);
    let frames = frames(&fst);
    assert!(frames.len() >= 3, "{} sections", frames.len());
    let mut moved = 0;
    for (at, (time, frame)) in frames.iter().enumerate() {
        let mut frame = &frame[..];
        for &var in &order {
            let var = &hierarchy[var];
            let Some(width) = var.length(hierarchy) else {
                continue;
            };
            let (found, rest) = frame.split_at(width as usize);
            frame = rest;
            let name = var.full_name(hierarchy);
            let wanted = dump.variables[&name].at(*time).unwrap();
            let width = width as usize;
            let wanted = format!("{wanted:0>width$}");
            let found = str::from_utf8(found).unwrap();
            assert_eq!(found, wanted, "{name} in section {at} at {time}");
            let first = dump.variables[&name].at(frames[0].0).unwrap();
            moved += u32::from(!wanted.ends_with(first));
        }
        assert!(frame.is_empty(), "{} characters are left", frame.len());
    }
    assert!(moved > 10, "{moved} values are not those of the start");
}

/// Ports out of the outermost circuit, in either format.
#[test]
fn both_formats_tell_the_ports_out() {
    for (only, wanted) in [
        (vec![], &["zoo.count", "zoo.read", "zoo.busy"][..]),
        (
            vec!["zoo.left"],
            &["zoo.left.level", "zoo.left.phase", "zoo.left.wrapped"],
        ),
    ] {
        let [vcd, fst] = both(10, clock(), &options(0..10, &only));
        let text = String::from_utf8(vcd).unwrap();
        let comment = text.split("ports out:").nth(1).unwrap();
        let named = comment.split("$end").next().unwrap();
        let named: Vec<&str> = named.split_whitespace().collect();
        let wave = wellen::simple::read_from_reader(Cursor::new(fst)).unwrap();
        let hierarchy = wave.hierarchy();
        let outputs = hierarchy.all_vars().map(|var| &hierarchy[var]);
        let outputs = outputs.filter(|var| var.direction() == wellen::VarDirection::Output);
        let outputs: Vec<String> = outputs.map(|var| var.full_name(hierarchy)).collect();
        let mut sorted = named.clone();
        sorted.sort_unstable();
        let mut found: Vec<&str> = outputs.iter().map(String::as_str).collect();
        found.sort_unstable();
        assert_eq!(sorted, found);
        assert_eq!(named, wanted);
    }
}
