//! `--series`: the file and its rows.

use motion_rtl::trace::{Position, Rows, SeriesAxis, SeriesFormat, SeriesLayout};
use std::path::{Path, PathBuf};
use std::str::FromStr;

/// File of a time series; its extension decides the format.
#[derive(Debug, Clone)]
pub struct SeriesPath {
    pub path: PathBuf,
    pub format: SeriesFormat,
}

impl FromStr for SeriesPath {
    type Err = &'static str;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let path = PathBuf::from(text);
        let extension = path.extension().unwrap_or_default().to_ascii_lowercase();
        let format = match extension.to_str() {
            Some("csv") => SeriesFormat::Csv,
            Some("npy") => SeriesFormat::Npy,
            _ => return Err("allowed: a file with the extension .csv or .npy"),
        };
        Ok(SeriesPath { path, format })
    }
}

impl AsRef<Path> for SeriesPath {
    fn as_ref(&self) -> &Path {
        &self.path
    }
}

/// Units of a position in the waves of a plant in a unit of its axis.
const PLANT_SCALE: f64 = 1.0 / 256.0;

/// Returns a row in each tick in which this signal is high, at most every `period` ticks.
pub fn at(path: &str, period: u64) -> Rows {
    Rows::Strobe {
        path: path.to_owned(),
        period,
    }
}

/// Returns a position that is a signal in whole units.
pub fn word(path: impl Into<String>) -> Position {
    scaled(path, 1.0)
}

/// Returns a position that is a signal in these units.
pub fn scaled(path: impl Into<String>, scale: f64) -> Position {
    Position::Signal {
        path: path.into(),
        scale,
    }
}

/// Returns the true position of a plant, by its path among the plants.
pub fn plant(path: &str) -> Position {
    scaled(format!("plant.{path}"), PLANT_SCALE)
}

/// Returns an axis.
pub fn axis(name: &str, unit: &'static str, commanded: Position, actual: Position) -> SeriesAxis {
    SeriesAxis {
        name: name.to_owned(),
        unit,
        commanded,
        actual,
    }
}

/// Returns the layout of axes without plans.
pub fn layout<'a>(rows: Rows, axes: impl IntoIterator<Item = SeriesAxis>) -> SeriesLayout<'a> {
    SeriesLayout {
        rows,
        plans: Vec::new(),
        axes: axes.into_iter().collect(),
    }
}
