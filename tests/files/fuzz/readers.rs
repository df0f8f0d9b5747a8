//! Readers of outside data, fed with arbitrary bytes. The targets of `fuzz/` use them too.

use motion_rtl::compare::{Map, Settings, compare, template};
use motion_rtl::input::position_log::{self, Columns};
use motion_rtl::input::{Drawing, Fault, gcode, hpgl};
use motion_rtl::scenario::Loaded;
use std::fs;
use std::path::PathBuf;
use std::process;
use std::sync::atomic::{AtomicU64, Ordering};

/// A reader under test, given the bytes.
pub type Reader = fn(&[u8]);

/// All of them, by the names of their corpora.
pub const READERS: [(&str, Reader); 7] = [
    ("gcode", gcode),
    ("hpgl", hpgl),
    ("position_log", position_log),
    ("scenario", scenario),
    ("names", names),
    ("vcd", vcd),
    ("fst", fst),
];

/// A refusal is a line of limited length that says where.
fn refused(fault: &Fault) {
    let text = fault.to_string();
    assert!(text.starts_with("input"), "{text}");
    assert!(!text.contains(char::is_control), "{text:?}");
    assert!(text.len() < 100_000, "{}", text.len());
}

/// An accepted drawing is not empty, and has only finite numbers.
fn drawn(read: Result<Drawing, Fault>) {
    match read {
        Ok(drawing) => {
            assert!(!drawing.moves.is_empty());
            let points = drawing.moves.iter().flat_map(|one| one.to);
            assert!(points.chain(drawing.start).all(f64::is_finite));
        }
        Err(fault) => refused(&fault),
    }
}

pub fn gcode(bytes: &[u8]) {
    drawn(gcode::read("input.ngc", bytes));
}

pub fn hpgl(bytes: &[u8]) {
    drawn(hpgl::read("input.hpgl", bytes));
}

pub fn position_log(bytes: &[u8]) {
    match position_log::read("input.csv", bytes, &Columns::default()) {
        Ok(log) => assert!(log.samples.len() >= 2 && log.seconds() > 0.0),
        Err(fault) => refused(&fault),
    }
}

pub fn scenario(bytes: &[u8]) {
    if let Ok(text) = str::from_utf8(bytes)
        && let Err(fault) = Loaded::parse("input.toml", text, &[])
    {
        refused(&fault);
    }
}

/// The names file of a comparison.
pub fn names(bytes: &[u8]) {
    if let Ok(text) = str::from_utf8(bytes)
        && let Err(fault) = Map::parse("input.toml", text)
    {
        refused(&fault);
    }
}

pub fn vcd(bytes: &[u8]) {
    waves(bytes, "vcd");
}

pub fn fst(bytes: &[u8]) {
    waves(bytes, "fst");
}

/// Held against itself it is equal, if it is a dump.
fn waves(bytes: &[u8], extension: &str) {
    let file = Scratch::new(bytes, extension);
    let mut settings = Settings::default();
    let mut held = compare(&file.0, &file.0, &settings);
    // Ports out of the files that do not tell them.
    for port in ["n", "step"] {
        if held.as_ref().is_err_and(|fault| fault.field == "ports out") {
            settings.ports_out = vec![port.to_owned()];
            held = compare(&file.0, &file.0, &settings);
        }
    }
    match held {
        Ok(report) => assert!(report.differences.is_empty(), "{report}"),
        Err(fault) => assert!(!fault.problem.is_empty() && !fault.allowed.is_empty()),
    }
    // A map to fill in is a map.
    if let Ok(text) = template(&file.0, &file.0, &settings) {
        Map::parse("input.toml", &text).unwrap_or_else(|fault| panic!("{fault}\n{text}"));
    }
}

/// A file of its own for each call and thread.
struct Scratch(PathBuf);

impl Scratch {
    fn new(bytes: &[u8], extension: &str) -> Self {
        static NUMBER: AtomicU64 = AtomicU64::new(0);
        let number = NUMBER.fetch_add(1, Ordering::Relaxed);
        let name = format!("motion-rtl-fuzz-{}-{number}.{extension}", process::id());
        let path = std::env::temp_dir().join(name);
        fs::write(&path, bytes).expect("a temporary file can be written");
        Scratch(path)
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        let _ = fs::remove_file(&self.0);
    }
}
