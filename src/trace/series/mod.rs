//! Time series of a run: commanded and actual positions of axes, a row a sampling period.

mod npy;
mod sources;

pub use sources::{Position, SeriesPlan};

use super::record::{NEAR, RecordError};
use crate::hdl::{Circuit, Declaration};
use crate::nearest::nearest_paths;
use crate::sim::{Described, LeafView as View, Needs, Observer, RunError, Sample};
use npy::Header;
use sources::{Plan, Source};
use std::fmt::Write as _;
use std::io::{self, BufWriter, Seek, SeekFrom, Write};
use std::ops::{ControlFlow, Range};

/// File format of a series.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SeriesFormat {
    /// Text with one line per row and a header line.
    Csv,
    /// Structured array of NumPy, format 1.0: `tick` as `<u8`, all others as `<f8`.
    Npy,
}

/// Axis of a series. Its columns are `NAME_commanded_UNIT`, `NAME_actual_UNIT` and
/// `NAME_error_UNIT`, which is commanded minus actual.
#[derive(Debug, Clone, PartialEq)]
pub struct SeriesAxis {
    /// Name of the axis.
    pub name: String,
    /// Unit of the positions, as `counts`.
    pub unit: &'static str,
    /// Commanded position.
    pub commanded: Position,
    /// Actual position.
    pub actual: Position,
}

/// Ticks of the rows.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Rows {
    /// Ticks in which this signal is high.
    Strobe {
        /// Path of the signal below the circuit.
        path: String,
        /// Least number of ticks between two strobes.
        period: u64,
    },
    /// The first tick and every `n`th from there on.
    Every(u64),
}

/// Rows and columns of a series.
#[derive(Debug)]
pub struct SeriesLayout<'a> {
    /// Ticks of the rows.
    pub rows: Rows,
    /// Planned positions that the axes refer to.
    pub plans: Vec<SeriesPlan<'a>>,
    /// Axes in the order of the columns.
    pub axes: Vec<SeriesAxis>,
}

/// Writes the time series of a run. As an observer it adds the rows. Call
/// [`finish`](SeriesFile::finish) after the run; without it the file is incomplete.
#[derive(Debug)]
#[must_use]
pub struct SeriesFile<'a, W: Write> {
    out: BufWriter<W>,
    header: Option<Header>,
    clock_hz: f64,
    /// Ticks that may have rows.
    ticks: Range<u64>,
    /// Leaf of the strobe.
    strobe: Option<usize>,
    /// Ticks from a row to the earliest next one.
    period: u64,
    /// Earliest tick of the next row.
    due: u64,
    plans: Vec<Plan<'a>>,
    axes: Vec<[Source; 2]>,
    /// Tick that was looked at last; until the next, watched signals are as they were in it.
    last: Option<u64>,
    /// True if the strobe was high in it.
    was_high: bool,
    rows: u64,
    text: String,
}

impl<'a, W: Write + Seek> SeriesFile<'a, W> {
    /// Begins the series of a run of `circuit`, with rows in `ticks`.
    ///
    /// # Errors
    /// Returns a [`RecordError`] inside if a signal does not exist, or the error of the writer.
    pub fn new(
        out: W,
        format: SeriesFormat,
        circuit: &impl Described,
        clock_hz: u64,
        ticks: Range<u64>,
        layout: SeriesLayout<'a>,
    ) -> io::Result<Self> {
        let (name, declarations) = circuit.outlined();
        let signals = Signals {
            top: name,
            leaves: &declarations.leaves,
        };
        let (strobe, period) = match layout.rows {
            Rows::Strobe { path, period } => (Some(signals.find(&path)?), period),
            Rows::Every(period) => (None, period),
        };
        let plans = layout.plans.into_iter();
        let plans = plans.map(|plan| Plan::new(plan, &signals));
        let plans = plans.collect::<io::Result<Vec<_>>>()?;
        let columns: Vec<_> = columns(&layout.axes).collect();
        let axes = layout.axes.into_iter();
        let axes = axes.map(|axis| {
            let commanded = Source::new(axis.commanded, &signals)?;
            Ok([commanded, Source::new(axis.actual, &signals)?])
        });
        let axes = axes.collect::<io::Result<Vec<_>>>()?;
        let mut series = SeriesFile {
            out: BufWriter::new(out),
            header: None,
            clock_hz: clock_hz as f64,
            due: match strobe {
                Some(_) => 0,
                None => ticks.start,
            },
            ticks,
            strobe,
            period: period.max(1),
            last: None,
            was_high: false,
            plans,
            axes,
            rows: 0,
            text: String::new(),
        };
        match format {
            SeriesFormat::Csv => writeln!(series.out, "tick,time_s,{}", columns.join(","))?,
            SeriesFormat::Npy => {
                let header = Header::new(columns);
                series.out.write_all(&header.bytes(0))?;
                series.header = Some(header);
            }
        }
        Ok(series)
    }

    /// Completes the file and returns it.
    ///
    /// # Errors
    /// Returns the error of the writer.
    pub fn finish(mut self) -> io::Result<W> {
        if let Some(header) = &self.header {
            self.out.seek(SeekFrom::Start(0))?;
            self.out.write_all(&header.bytes(self.rows))?;
        }
        self.out.into_inner().map_err(|error| error.into_error())
    }
}

/// Returns the names of the axes' columns.
fn columns(axes: &[SeriesAxis]) -> impl Iterator<Item = String> {
    axes.iter().flat_map(|SeriesAxis { name, unit, .. }| {
        ["commanded", "actual", "error"].map(|of| format!("{name}_{of}_{unit}"))
    })
}

impl<W: Write> SeriesFile<'_, W> {
    fn tick(&mut self, tick: u64, view: View<'_>) -> io::Result<()> {
        for source in self.axes.iter_mut().flatten() {
            source.count(view);
        }
        let skipped = self.last.map_or(0, |last| tick - last - 1);
        for plan in &mut self.plans {
            plan.count(skipped, view);
        }
        self.last = Some(tick);
        self.was_high = self.strobe.is_some_and(|leaf| view.leaf(leaf) & 1 == 1);
        let is_due = tick >= self.due && (self.strobe.is_none() || self.was_high);
        if is_due {
            self.due = tick.saturating_add(self.period);
        }
        match is_due && self.ticks.contains(&tick) {
            true => self.row(tick, view),
            false => Ok(()),
        }
    }

    fn row(&mut self, tick: u64, view: View<'_>) -> io::Result<()> {
        for plan in &mut self.plans {
            if !plan.evaluate() {
                return Ok(());
            }
        }
        self.rows += 1;
        let time_s = tick as f64 / self.clock_hz;
        let is_text = self.header.is_none();
        self.text.clear();
        match is_text {
            // Writing to a string does not fail.
            true => drop(write!(self.text, "{tick},{time_s}")),
            false => {
                self.out.write_all(&tick.to_le_bytes())?;
                self.out.write_all(&time_s.to_le_bytes())?;
            }
        }
        for [commanded, actual] in &self.axes {
            let actual = actual.value(view, &self.plans, 0.0);
            let commanded = commanded.value(view, &self.plans, actual);
            for value in [commanded, actual, commanded - actual] {
                match is_text {
                    true => drop(write!(self.text, ",{value}")),
                    false => self.out.write_all(&value.to_le_bytes())?,
                }
            }
        }
        match is_text {
            true => writeln!(self.out, "{}", self.text),
            false => Ok(()),
        }
    }
}

impl<C: Circuit, W: Write> Observer<C> for SeriesFile<'_, W> {
    fn next_look(&self, tick: u64) -> u64 {
        match tick < self.ticks.end {
            false => u64::MAX,
            true if self.last.is_none() => tick,
            // A row comes with the next change of the strobe, at which runs stop.
            true if self.strobe.is_some() && !self.was_high => u64::MAX,
            true => tick.max(self.due),
        }
    }

    fn looks(&self, tick: u64) -> bool {
        tick < self.ticks.end
    }

    fn needs(&self) -> Needs {
        let sources = self.axes.iter().flatten().flat_map(Source::watched);
        let clocks = self.plans.iter().map(Plan::clock);
        let leaves = self.strobe.into_iter().chain(clocks).chain(sources);
        leaves.collect::<Vec<_>>().into()
    }

    fn next_whole(&self, _: u64) -> u64 {
        u64::MAX
    }

    fn sample(&mut self, now: &Sample<'_, C>) -> Result<ControlFlow<()>, RunError> {
        let row = self.tick(now.tick, now.view());
        row.map_err(RunError::of_file("time series"))?;
        Ok(ControlFlow::Continue(()))
    }
}

/// Signals of a circuit by their paths below it.
struct Signals<'a> {
    top: &'a str,
    leaves: &'a [Declaration],
}

impl Signals<'_> {
    /// Returns the leaf of a signal.
    fn find(&self, below: &str) -> io::Result<usize> {
        let path = format!("{}.{below}", self.top);
        let found = self.leaves.iter().position(|leaf| leaf.path() == path);
        found.ok_or_else(|| {
            let paths: Vec<_> = self.leaves.iter().map(Declaration::path).collect();
            let near = nearest_paths(&path, paths.iter().map(String::as_str), NEAR);
            io::Error::new(
                io::ErrorKind::InvalidInput,
                RecordError::Unknown { path, near },
            )
        })
    }
}
