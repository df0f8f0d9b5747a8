//! Scenarios that ship with the crate, with their inputs; the first runs where none is named.

use motion_rtl::input::scenario::Loaded;
use motion_rtl::input::{Drawing, Fault, read_text};
use std::path::Path;

/// A scenario and its input, by the names they have in the crate.
#[derive(Debug)]
pub struct Shipped {
    /// The scenario file.
    pub file: &'static str,
    /// What it is, in one line.
    pub about: &'static str,
    text: &'static str,
    input: &'static str,
    input_text: &'static str,
}

macro_rules! shipped {
    ($file:literal, $input:literal, $about:literal) => {
        Shipped {
            file: $file,
            about: $about,
            text: include_str!(concat!("../../", $file)),
            input: $input,
            input_text: include_str!(concat!("../../", $input)),
        }
    };
}

/// All of them.
pub const SHIPPED: [Shipped; 3] = [
    shipped!(
        "waves/bracket.toml",
        "waves/bracket.ngc",
        "a bracket in G-code: lines at T2, arcs at T1; runs by default"
    ),
    shipped!(
        "waves/rosette.toml",
        "waves/rosette.hpgl",
        "a rosette of pen strokes in HPGL, with scaled units and pen-up moves"
    ),
    shipped!(
        "waves/plotter.toml",
        "waves/plotter.hpgl",
        "pen strokes of many slopes in HPGL, on the linear interpolator"
    ),
];

/// The one of that name; a file that is there goes before it.
pub fn find(path: &Path) -> Option<&'static Shipped> {
    let mut named = SHIPPED
        .iter()
        .filter(|shipped| Path::new(shipped.file) == path);
    named.next().filter(|_| !path.exists())
}

impl Shipped {
    /// The scenario with overrides.
    pub fn load(&self, sets: &[String]) -> Result<Loaded, Fault> {
        Loaded::parse(self.file, self.text, sets)
    }

    /// Its input.
    pub fn drawing(&self) -> Result<Drawing, Fault> {
        read_text(self.input, self.input_text.as_bytes())
    }
}
