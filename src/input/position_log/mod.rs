//! Position logs in CSV: encoder counts over time.
//!
//! ```text
//! time,   leftEncoder,   rightEncoder        a header is optional
//! 7170,   0,             0
//! 7175,   12,            11                  times do not fall, counts are whole
//! ```
//!
//! Commas separate fields. Blank lines and lines that begin with `#` are skipped. [`Columns`]
//! selects the columns or describes how they are found. The time unit is [`Columns::time_unit_s`],
//! else the one in the header, as in `Time [s]` or `time_ms`, else the one of s, ms, us and ns in
//! which the median step between two times is between 10 us and 1 s. Among equal times the last
//! count is valid.

mod columns;
mod times;

pub use columns::{Columns, Place};
pub use times::{Unit, UnitFrom};

use super::{Fault, Faults, LARGEST_FILE, read_bytes};
use columns::Survey;
use csv::{ByteRecord, Reader, ReaderBuilder, Trim};
use std::cell::Cell;
use std::io;
use std::iter;
use std::ops::RangeInclusive;
use std::path::Path;
use times::{Time, unit_by_steps, unit_of};

/// Allowed range of counts.
pub const COUNTS_RANGE: RangeInclusive<i64> = -(1 << 31)..=1 << 31;

/// Greatest number of samples of a log.
pub const MOST_SAMPLES: usize = 4_000_000;

/// Greatest length of a record in bytes: if the file is not a log, a record may be the whole file.
const LONGEST_RECORD: usize = 1 << 20;

/// Sample of a log.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sample {
    /// Time since the first sample, in seconds.
    pub seconds: f64,
    /// Position in counts.
    pub counts: i64,
    /// Line of the file, from 1.
    pub line: usize,
}

/// Position over time.
#[derive(Debug, Clone, PartialEq)]
pub struct PositionLog {
    /// Name of the file as given by the user.
    pub file: String,
    /// Column of the times.
    pub time: Place,
    /// Unit of the times.
    pub unit: Unit,
    /// Column of the counts.
    pub counts: Place,
    /// Samples, two or more, at rising times.
    pub samples: Vec<Sample>,
}

impl PositionLog {
    /// Returns the position in counts at a time since the first sample, interpolated linearly
    /// between samples; constant before the first and after the last.
    #[must_use]
    pub fn position_at(&self, seconds: f64) -> f64 {
        let later = self
            .samples
            .partition_point(|sample| sample.seconds <= seconds);
        let before = self.samples[..later].last();
        match (before, self.samples.get(later)) {
            (Some(a), Some(b)) => {
                let part = (seconds - a.seconds) / (b.seconds - a.seconds);
                a.counts as f64 + part * (b.counts - a.counts) as f64
            }
            (Some(rest), None) | (None, Some(rest)) => rest.counts as f64,
            (None, None) => 0.0,
        }
    }

    /// Returns the time from the first to the last sample, in seconds.
    #[must_use]
    pub fn seconds(&self) -> f64 {
        self.samples.last().map_or(0.0, |sample| sample.seconds)
    }

    /// Returns the greatest speed between two samples in counts per second, and the line of the
    /// second sample.
    #[must_use]
    pub fn fastest(&self) -> (f64, usize) {
        let speed = |pair: &[Sample]| {
            let counts = pair[0].counts.abs_diff(pair[1].counts) as f64;
            (counts / (pair[1].seconds - pair[0].seconds), pair[1].line)
        };
        let speeds = self.samples.windows(2).map(speed);
        speeds.fold(
            (0.0, 0),
            |most, one| if one.0 > most.0 { one } else { most },
        )
    }
}

/// Reads a log from disk.
///
/// # Errors
///
/// Returns an error for a path that is neither a regular file nor a pipe, cannot be read or is
/// larger than [`LARGEST_FILE`]; and the errors of [`read`].
pub fn read_path(path: &Path, columns: &Columns) -> Result<PositionLog, Fault> {
    let name = path.display().to_string();
    read(&name, &read_bytes(path, LARGEST_FILE)?, columns)
}

/// Parses a log; faults name the file `name`.
///
/// # Errors
///
/// Returns an error for text that is not UTF-8, a missing or unsuitable column, a field that is
/// not a number, a count outside [`COUNTS_RANGE`], a falling time, times of unknown unit, fewer
/// than two samples at different times or more than [`MOST_SAMPLES`].
pub fn read(name: &str, text: &[u8], columns: &Columns) -> Result<PositionLog, Fault> {
    let log = Log { file: name, text };
    log.check_text()?;
    let mut survey = None;
    log.each(|line, fields| {
        match &mut survey {
            None => survey = Some(Survey::begin(line, fields)),
            Some(survey) => survey.add(fields),
        }
        true
    })?;
    let Some(survey) = survey else {
        return Err(log.too_short(0));
    };
    let (time, counts) = columns.choose(&log, &survey)?;
    let mut first = None;
    let mut samples: Vec<Sample> = Vec::new();
    let mut faults = Faults::default();
    let mut sample = |line, fields: &[&str], samples: &mut Vec<Sample>| {
        let at = log.time(line, &time, fields)?;
        // In the unit of the log, which its steps may determine.
        let since = at.since(*first.get_or_insert(at));
        let counts = log.counts(line, &counts, fields)?;
        if let Some(before) = samples.last_mut() {
            if since < before.seconds || !since.is_finite() {
                let written = log.field(line, &time, fields)?;
                let problem = format!("{written} falls below line {}", before.line);
                return Err(log.fault_at(line, &time, problem, "times that do not fall"));
            }
            if since == before.seconds {
                (before.counts, before.line) = (counts, line);
                return Ok(());
            }
        }
        if samples.len() == MOST_SAMPLES {
            let problem = format!("more than {MOST_SAMPLES} samples");
            let allowed = format!("at most {MOST_SAMPLES}");
            return Err(log.fault(line, "file", problem, &allowed));
        }
        samples.push(Sample {
            seconds: since,
            counts,
            line,
        });
        Ok(())
    };
    log.each(|line, fields| {
        if survey.is_header(line) {
            return true;
        }
        match sample(line, fields, &mut samples) {
            Ok(()) => true,
            Err(fault) => faults.add(fault) && samples.len() < MOST_SAMPLES,
        }
    })?;
    faults.or(|| {
        if samples.len() < 2 {
            return Err(log.too_short(samples.len()));
        }
        let unit = log.unit(columns, &survey, &time, &samples)?;
        for sample in &mut samples {
            sample.seconds = unit.seconds_of(sample.seconds);
        }
        Ok(PositionLog {
            file: name.to_owned(),
            time,
            unit,
            counts,
            samples,
        })
    })
}

/// Text that is read line by line, as long as the current record fits its limit. Comments and
/// blank lines do not count.
struct Lines<'a>(&'a [u8], &'a Cell<usize>);

impl io::Read for Lines<'_> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let Lines(text, room) = self;
        let end = text
            .iter()
            .take(buffer.len())
            .position(|&byte| byte == b'\n');
        let length = end.map_or(text.len().min(buffer.len()), |end| end + 1);
        let (line, rest) = text.split_at(length);
        if !matches!(line, [] | [b'#' | b'\n' | b'\r', ..]) {
            let left = room.get().checked_sub(length);
            room.set(left.ok_or_else(|| io::Error::other("a record without an end"))?);
        }
        buffer[..length].copy_from_slice(line);
        *text = rest;
        Ok(length)
    }
}

/// Log being read.
struct Log<'a> {
    file: &'a str,
    text: &'a [u8],
}

impl Log<'_> {
    fn fault(&self, line: usize, field: &str, problem: impl Into<String>, allowed: &str) -> Fault {
        Fault::new(self.file, line, field, problem, allowed)
    }

    /// Returns a fault of a field, with its line.
    fn fault_at(
        &self,
        line: usize,
        place: &Place,
        problem: impl Into<String>,
        allowed: &str,
    ) -> Fault {
        let ends = self.text.iter().enumerate();
        let ends = ends.filter(|(_, byte)| **byte == b'\n');
        let mut begins = iter::once(0).chain(ends.map(|(at, _)| at + 1));
        let begin = begins.nth(line - 1).unwrap_or(0);
        let rest = self.text.get(begin..).unwrap_or_default();
        let written = rest.split(|byte| matches!(byte, b'\n' | b'\r')).next();
        let written = written.unwrap_or_default();
        let mut at = begin;
        let mut fields = written.split(|byte| *byte == b',').map(|field| {
            let begin = at + field.len() - field.trim_ascii_start().len();
            at += field.len() + 1;
            begin..begin + field.trim_ascii().len()
        });
        // Quotes may contain commas, and the line may lack the field.
        let field = fields.nth(place.index).filter(|_| !written.contains(&b'"'));
        let marked = field.unwrap_or(begin..begin + written.len());
        self.fault(line, &place.name, problem, allowed)
            .marked(self.text, &marked)
    }

    fn too_short(&self, samples: usize) -> Fault {
        let plural = if samples == 1 { "" } else { "s" };
        let problem = format!("{samples} sample{plural} in it");
        self.fault(0, "file", problem, "a log of 2 samples or more")
    }

    fn check_text(&self) -> Result<(), Fault> {
        let Err(error) = str::from_utf8(self.text) else {
            return Ok(());
        };
        let before = &self.text[..error.valid_up_to()];
        let line = before.iter().filter(|&&byte| byte == b'\n').count() + 1;
        Err(self.fault(line, "file", "not UTF-8", "a position log in CSV"))
    }

    /// Passes on the records with their lines, including the header, until `take` returns false.
    fn each(&self, mut take: impl FnMut(usize, &[&str]) -> bool) -> Result<(), Fault> {
        let room = Cell::new(0);
        let mut reader = ReaderBuilder::new()
            .has_headers(false)
            .flexible(true)
            .trim(Trim::All)
            .comment(Some(b'#'))
            .from_reader(Lines(self.text, &room));
        let mut record = ByteRecord::new();
        loop {
            room.set(LONGEST_RECORD);
            let more = reader.read_byte_record(&mut record);
            let more = more.map_err(|error| self.unreadable(&reader, &error))?;
            if !more {
                return Ok(());
            }
            let fields: Vec<&str> = record
                .iter()
                .map(|field| str::from_utf8(field).unwrap_or_default())
                .collect();
            if fields != [""] && !take(line_of(self.text, &record), &fields) {
                return Ok(());
            }
        }
    }

    /// Returns the only possible error: the text is in memory, and the number of fields is free.
    fn unreadable(&self, reader: &Reader<Lines<'_>>, error: &csv::Error) -> Fault {
        let line = reader.position().line() as usize;
        let allowed = format!("records of at most {LONGEST_RECORD} bytes");
        self.fault(line, "file", error.to_string(), &allowed)
    }

    fn field<'a>(&self, line: usize, place: &Place, fields: &[&'a str]) -> Result<&'a str, Fault> {
        fields.get(place.index).copied().ok_or_else(|| {
            let problem = format!("the line has only {} of its fields", fields.len());
            self.fault_at(line, place, problem, "a number")
        })
    }

    fn time(&self, line: usize, place: &Place, fields: &[&str]) -> Result<Time, Fault> {
        let field = self.field(line, place, fields)?;
        let time = Time::read(field);
        time.ok_or_else(|| self.fault_at(line, place, format!("is '{field}'"), "a number"))
    }

    /// Returns the unit of the times.
    fn unit(
        &self,
        columns: &Columns,
        survey: &Survey,
        time: &Place,
        samples: &[Sample],
    ) -> Result<Unit, Fault> {
        if let Some(seconds) = columns.time_unit_s {
            let from = UnitFrom::Given;
            return Ok(Unit { seconds, from });
        }
        let allowed = "a unit in the header, as in time_ms, or by log_time_unit_ms";
        let refuse = |problem: String| self.fault(survey.line(), &time.name, problem, allowed);
        match survey.name(time.index).map_or(Ok(None), unit_of) {
            Ok(Some(unit)) => return Ok(unit),
            Ok(None) => {}
            Err(unit) => return Err(refuse(format!("is in '{unit}', which is no unit of time"))),
        }
        let steps = samples.windows(2);
        let mut steps: Vec<f64> = steps.map(|two| two[1].seconds - two[0].seconds).collect();
        unit_by_steps(&mut steps).map_err(|(median, units)| {
            refuse(match units.is_empty() {
                true => format!("without a unit, and its median step, {median}, is of none"),
                false => format!(
                    "without a unit, and its median step may be {}",
                    units.join(" or ")
                ),
            })
        })
    }

    fn counts(&self, line: usize, place: &Place, fields: &[&str]) -> Result<i64, Fault> {
        let field = self.field(line, place, fields)?;
        whole(field).ok_or_else(|| {
            let (least, most) = (COUNTS_RANGE.start(), COUNTS_RANGE.end());
            let allowed = format!("a whole number, {least} to {most}");
            self.fault_at(line, place, format!("is '{field}'"), &allowed)
        })
    }
}

/// Parses a count: a whole number in range, which may be written as 12.0.
fn whole(field: &str) -> Option<i64> {
    let number: f64 = field.parse().ok()?;
    let whole = number.fract() == 0.0 && number.abs() <= i64::MAX as f64;
    let counts = whole.then_some(number as i64);
    counts.filter(|counts| COUNTS_RANGE.contains(counts))
}

/// Returns the line in which a record begins. Its text begins with the lines skipped before it.
fn line_of(text: &[u8], record: &ByteRecord) -> usize {
    let (byte, line) = record
        .position()
        .map_or((0, 1), |place| (place.byte() as usize, place.line()));
    let rest = text.get(byte..).unwrap_or_default();
    let lines = rest.split(|&byte| byte == b'\n');
    let skipped = lines.take_while(|line| matches!(line, [] | [b'\r'] | [b'#', ..]));
    line as usize + skipped.count()
}

#[cfg(test)]
mod tests;
