//! Time series of runs, against their waves and summaries.

mod circuits;
mod files;

use super::support::{Bench, LINE, SHORT, number, paths, whole, words};
use serde_json::Value;

/// A diagonal, with the pen down.
const DIAGONAL: &str = "PD400,300;";
/// Unit of a plant's position in the waves.
const FINE: f64 = 1.0 / 256.0;

/// A series by the names of its columns.
#[derive(Debug, PartialEq)]
struct Series {
    names: Vec<String>,
    rows: Vec<Vec<f64>>,
}

impl Series {
    fn csv(text: &str) -> Self {
        let mut lines = text.lines();
        let names = lines.next().unwrap().split(',').map(str::to_owned);
        let rows = lines.map(|line| line.split(',').map(|cell| cell.parse().unwrap()).collect());
        Series {
            names: names.collect(),
            rows: rows.collect(),
        }
    }

    /// Reads what `numpy.load` reads: format 1.0, little endian, one dimension.
    fn npy(bytes: &[u8]) -> Self {
        assert_eq!(bytes[..8], *b"\x93NUMPY\x01\x00");
        let length = 10 + usize::from(u16::from_le_bytes([bytes[8], bytes[9]]));
        assert_eq!(length % 64, 0);
        let header = std::str::from_utf8(&bytes[10..length]).unwrap();
        let header = header.strip_suffix('\n').unwrap().trim_end();
        let fields = header.strip_prefix("{'descr': [('").unwrap();
        let (fields, shape) = fields
            .split_once("')], 'fortran_order': False, 'shape': (")
            .unwrap();
        let count: usize = shape.strip_suffix(",), }").unwrap().parse().unwrap();
        let fields = fields
            .split("'), ('")
            .map(|field| field.split_once("', '").unwrap());
        let (names, kinds): (Vec<_>, Vec<_>) = fields.unzip();
        assert_eq!(kinds[0], "<u8");
        assert!(kinds[1..].iter().all(|kind| *kind == "<f8"), "{kinds:?}");
        let words: Vec<[u8; 8]> = bytes[length..].as_chunks().0.to_vec();
        assert_eq!(bytes.len(), length + 8 * names.len() * count);
        let rows = words.chunks(names.len()).map(|row| {
            let tick = u64::from_le_bytes(row[0]) as f64;
            let numbers = row[1..].iter().map(|word| f64::from_le_bytes(*word));
            [tick].into_iter().chain(numbers).collect()
        });
        Series {
            names: names.into_iter().map(str::to_owned).collect(),
            rows: rows.collect(),
        }
    }

    #[track_caller]
    fn column(&self, name: &str) -> Vec<f64> {
        let place = self.names.iter().position(|other| other == name);
        let place = place.unwrap_or_else(|| panic!("no {name} in {:?}", self.names));
        self.rows.iter().map(|row| row[place]).collect()
    }

    fn ticks(&self) -> Vec<u64> {
        self.column("tick")
            .into_iter()
            .map(|tick| tick as u64)
            .collect()
    }

    /// The largest error in a row, over axes of these names.
    fn largest_error(&self, axes: &[&str], unit: &str) -> f64 {
        let columns = axes
            .iter()
            .map(|axis| self.column(&format!("{axis}_error_{unit}")));
        let columns: Vec<_> = columns.collect();
        let error = |row: usize| {
            columns
                .iter()
                .map(|all| all[row].powi(2))
                .sum::<f64>()
                .sqrt()
        };
        (0..self.rows.len()).map(error).fold(0.0, f64::max)
    }
}

/// Runs with a series, and gives it with the summary.
fn series(bench: &Bench, arguments: &[&str]) -> (Series, Value) {
    let summary = bench.json(&[&["run"], arguments, &["--series", "out/s.csv"]].concat());
    (Series::csv(&bench.read("out/s.csv")), summary)
}

/// A column, the signal that it is of, and the signal's unit.
type Column<'a> = (&'a str, &'a str, f64);

/// Holds each row of a series against the waves of the same run: a row in each tick of the strobe,
/// with these positions.
#[track_caller]
fn agree(bench: &Bench, arguments: &[&str], strobe: &str, columns: &[Column<'_>]) -> Series {
    let (series, summary) = series(bench, arguments);
    let dump = paths(&summary)[0].as_str().unwrap().to_owned();
    let signals = columns.iter().map(|(_, path, _)| *path);
    let signals: Vec<_> = [strobe].into_iter().chain(signals).collect();
    let waves = words(&bench.read(&dump), &signals);
    let strobes = waves.iter().enumerate().filter(|(_, now)| now[0] == 1);
    let strobes: Vec<_> = strobes.map(|(tick, _)| tick as u64).collect();
    assert!(strobes.len() > 5, "{strobes:?}");
    assert_eq!(series.ticks(), strobes);
    let clock_hz = number(&summary, "/clock_hz");
    let times = strobes.iter().map(|tick| *tick as f64 / clock_hz);
    assert_eq!(series.column("time_s"), times.collect::<Vec<_>>());
    for (place, (name, path, scale)) in columns.iter().enumerate() {
        let due = strobes
            .iter()
            .map(|tick| waves[*tick as usize][place + 1] as f64 * scale);
        assert_eq!(
            series.column(name),
            due.collect::<Vec<_>>(),
            "{name} of {path}"
        );
    }
    errors_are_differences(&series);
    series
}

#[track_caller]
fn errors_are_differences(series: &Series) {
    let errors: Vec<_> = series
        .names
        .iter()
        .filter(|name| name.contains("_error_"))
        .collect();
    assert!(!errors.is_empty(), "{:?}", series.names);
    for error in errors {
        let [commanded, actual] =
            ["_commanded_", "_actual_"].map(|of| series.column(&error.replace("_error_", of)));
        let due = commanded
            .iter()
            .zip(&actual)
            .map(|(commanded, actual)| commanded - actual);
        assert_eq!(series.column(error), due.collect::<Vec<_>>(), "{error}");
    }
}

#[test]
fn both_formats_have_the_same_numbers() {
    let bench = Bench::with("d.hpgl", DIAGONAL);
    let run = [&["run", "d.hpgl", "--no-vcd"], &SHORT[..], &["--series"]].concat();
    bench.succeed(&[&run[..], &["s.csv"]].concat());
    bench.succeed(&[&run[..], &["s.npy"]].concat());
    let csv = Series::csv(&bench.read("s.csv"));
    assert!(csv.rows.len() > 50);
    assert_eq!(
        Series::npy(&std::fs::read(bench.path("s.npy")).unwrap()),
        csv
    );
}

#[test]
fn a_window_and_a_distance_choose_the_rows() {
    let bench = Bench::with("l.hpgl", LINE);
    let run = [&["l.hpgl", "--no-vcd"], &SHORT[..]].concat();
    let rows = |more: &[&str]| series(&bench, &[&run[..], more].concat());
    let (some, _) = rows(&["--from", "1003", "--to", "1100", "--series-every", "25"]);
    assert_eq!(some.ticks(), [1003, 1028, 1053, 1078]);
    let (unit, _) = rows(&["--from", "1000", "--to", "2500"]);
    assert_eq!(unit.ticks(), [1499, 1999, 2499]);
    // Without an end all rows are there, however few ticks the waves have.
    let (all, summary) = rows(&["--set", "vcd_ticks=10", "--series-every", "1"]);
    assert_eq!(all.rows.len() as i64, whole(&summary, "/ticks"));
    let run = [
        "l.hpgl",
        "--set",
        "circuit=linear_interpolator",
        "--no-vcd",
        "--series-every",
        "7",
    ];
    let (linear, summary) = series(&bench, &run);
    let ticks: Vec<_> = (0..whole(&summary, "/ticks") as u64).step_by(7).collect();
    assert_eq!(linear.ticks(), ticks);
}
