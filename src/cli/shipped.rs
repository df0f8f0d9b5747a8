//! Scenarios that ship with the crate, with their inputs; the first is the default of `run`.

use motion_rtl::input::{Drawing, Fault, Language, Options, read_text_with};
use motion_rtl::jobs::pulse_interpolator::Table;
use motion_rtl::jobs::pulse_interpolator::table::read;
use motion_rtl::scenario::Loaded;
use std::path::Path;

/// A scenario and its input, by the names they have in the crate.
#[derive(Debug)]
pub struct Shipped {
    /// The scenario file.
    pub file: &'static str,
    /// Description in one line.
    pub about: &'static str,
    /// Its text.
    pub text: &'static str,
    input: Option<Input>,
    /// Tables of the pulse interpolator.
    tables: &'static [Input],
}

/// An input by its name in the crate.
#[derive(Debug)]
struct Input {
    file: &'static str,
    text: &'static str,
}

macro_rules! shipped {
    ($file:literal, $about:literal $(, input: $input:literal)? $(, tables: [$($table:literal),*])?) => {
        Shipped {
            file: $file,
            about: $about,
            text: include_str!(concat!("../../", $file)),
            input: input!($($input)?),
            tables: &[$($(embedded!($table)),*)?],
        }
    };
}

macro_rules! input {
    () => {
        None
    };
    ($file:literal) => {
        Some(embedded!($file))
    };
}

macro_rules! embedded {
    ($file:literal) => {
        Input {
            file: $file,
            text: include_str!(concat!("../../", $file)),
        }
    };
}

/// All shipped scenarios.
pub const SHIPPED: [Shipped; 20] = [
    shipped!(
        "waves/machine.toml",
        "a bracket in G-code on steppers, servos and a pen lift, by all five circuits; runs by default",
        input: "waves/bracket.ngc"
    ),
    shipped!(
        "waves/bracket.toml",
        "the bracket on the pulse interpolator: lines at T2, arcs at T1",
        input: "waves/bracket.ngc"
    ),
    shipped!(
        "waves/patterns.toml",
        "patterns in the memory, chosen by command and never rewritten, on the pulse interpolator",
        tables: ["waves/ring.csv", "waves/stroke.csv"]
    ),
    shipped!(
        "waves/rewrite.toml",
        "a pattern whose T is rewritten while it is played, on the pulse interpolator",
        tables: ["waves/stroke.csv"]
    ),
    shipped!(
        "waves/groups.toml",
        "two groups with unit times of their own, started one after the other, on the pulse interpolator",
        tables: ["waves/ring.csv", "waves/stroke.csv"]
    ),
    shipped!(
        "waves/arc.toml",
        "an X-Y table round an arc, also by the conventional device, which computes it",
        input: "waves/arc.ngc"
    ),
    shipped!(
        "waves/link.toml",
        "lines and arcs as moves of the conventional device, beside the pulse interpolator",
        input: "waves/link.ngc"
    ),
    shipped!(
        "waves/rosette.toml",
        "a rosette of pen strokes in HPGL, with scaled units and pen-up moves",
        input: "waves/rosette.hpgl"
    ),
    shipped!(
        "waves/plotter.toml",
        "pen strokes of many slopes in HPGL, on the linear interpolator",
        input: "waves/plotter.hpgl"
    ),
    shipped!(
        "waves/turntable.toml",
        "positionings of a rotary table whose load changes, on the lead-angle compensator"
    ),
    shipped!(
        "waves/weld.toml",
        "a weld seam taught by three points in space, from rest to rest, on the arc generator"
    ),
    shipped!(
        "waves/joint.toml",
        "line, arc and line in space without a stop, on the arc generator"
    ),
    shipped!(
        "waves/flange.toml",
        "a gas-cut flange in G-code, arcs joined to arcs, on the arc generator",
        input: "waves/flange.ngc"
    ),
    shipped!(
        "waves/circle.toml",
        "a circle of 10 mm at 100 mm/s, on the trajectory controller"
    ),
    shipped!(
        "waves/feed.toml",
        "two turns of a circle whose feed changes, on the trajectory controller"
    ),
    shipped!(
        "waves/corner.toml",
        "a corner of 90 degrees, on the trajectory controller"
    ),
    shipped!(
        "waves/cam.toml",
        "a cam of 3600 short chords in G-code, run at feed, on the trajectory controller",
        input: "waves/cam.ngc"
    ),
    shipped!(
        "waves/face.toml",
        "a face in space of short chords in G-code, run at feed, on the trajectory controller",
        input: "waves/face.ngc"
    ),
    shipped!(
        "waves/saddle.toml",
        "a seam taught by points in space, as one spline, on the trajectory controller"
    ),
    shipped!(
        "waves/pocket.toml",
        "a pocket in G-code with lines, arcs and ramps, on the trajectory controller of three axes",
        input: "waves/pocket.ngc"
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
        let loaded = Loaded::parse(self.file, self.text, sets)?;
        Ok(loaded.with_tables_beside(Path::new(self.file)))
    }

    /// One of its tables.
    pub fn table(&self, path: &Path, clock_hz: u64) -> Result<Table, Fault> {
        let named = |table: &&Input| Path::new(table.file) == path;
        match self.tables.iter().find(named) {
            Some(table) => read::read(table.file, table.text, clock_hz),
            None => read::read_path(path, clock_hz),
        }
    }

    /// Returns the language of its drawing.
    pub fn language(&self) -> Option<Language> {
        Language::of(Path::new(self.input.as_ref()?.file))
    }

    /// Returns its drawing; `None` if the scenario needs no input.
    pub fn drawing(&self, options: &Options) -> Option<Result<Drawing, Fault>> {
        let input = self.input.as_ref()?;
        Some(read_text_with(input.file, input.text.as_bytes(), options))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_has_the_input_that_its_scenario_names() {
        for shipped in SHIPPED {
            let loaded = shipped.load(&[]).expect(shipped.file);
            let input = shipped.input.as_ref();
            let input = input.map(|input| Path::new(input.file).file_name().expect("a name"));
            let named = loaded.scenario.input().map(|path| path.as_os_str());
            assert_eq!(named, input, "{}", shipped.file);
        }
    }
}
