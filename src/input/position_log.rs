//! Position logs in CSV: what an encoder counted, and when.
//!
//! ```text
//! time,   leftEncoder,   rightEncoder        a header is optional
//! 7170,   0,             0
//! 7175,   12,            11                  times rise, counts are whole
//! ```
//!
//! Fields stand between commas. Blank lines and lines that begin with `#` are skipped. What column
//! has what [`Columns`] says, or else the log itself: see there.

mod columns;

pub use columns::{Columns, Place};

use super::{Fault, Faults, LARGEST_FILE, read_bytes};
use columns::Survey;
use csv::{ByteRecord, Reader, ReaderBuilder, Trim};
use std::iter;
use std::ops::RangeInclusive;
use std::path::Path;

/// Counts that are accepted.
pub const COUNTS_RANGE: RangeInclusive<i64> = -(1 << 31)..=1 << 31;

/// The most samples of a log.
pub const MOST_SAMPLES: usize = 4_000_000;

/// A sample of a log.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sample {
    /// Time since the first sample, in seconds.
    pub seconds: f64,
    /// Position in counts.
    pub counts: i64,
    /// Line of the file it stands in, from 1.
    pub line: usize,
}

/// A position in time.
#[derive(Debug, Clone, PartialEq)]
pub struct PositionLog {
    /// The file's name as the user gave it.
    pub file: String,
    /// The column that the times are from.
    pub time: Place,
    /// The column that the counts are from.
    pub counts: Place,
    /// The samples, two or more, in the order of time.
    pub samples: Vec<Sample>,
}

impl PositionLog {
    /// The position in counts at a time since the first sample, on straight lines between samples;
    /// before the first and after the last it rests.
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

    /// Time from the first to the last sample, in seconds.
    #[must_use]
    pub fn seconds(&self) -> f64 {
        self.samples.last().map_or(0.0, |sample| sample.seconds)
    }

    /// The greatest speed between two samples in counts a second, and the line of the second.
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
/// A path that is neither a regular file nor a pipe, cannot be read or is larger than
/// [`LARGEST_FILE`]; and whatever [`read`] objects to.
pub fn read_path(path: &Path, columns: &Columns) -> Result<PositionLog, Fault> {
    let name = path.display().to_string();
    read(&name, &read_bytes(path, LARGEST_FILE)?, columns)
}

/// Reads the contents of a log that is called `name` in faults.
///
/// # Errors
///
/// A text that is not UTF-8, a column that is not there or cannot be what it is to be, a field that
/// is no number, a count outside [`COUNTS_RANGE`], a time that does not rise, fewer than two samples
/// or more than [`MOST_SAMPLES`].
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
        let at = log.number(line, &time, fields)?;
        let seconds = (at - *first.get_or_insert(at)) * columns.time_unit_s;
        let counts = log.counts(line, &counts, fields)?;
        if let Some(before) = samples.last()
            && !(seconds > before.seconds && seconds.is_finite())
        {
            let problem = format!("{at} does not rise above line {}", before.line);
            return Err(log.fault_at(line, &time, problem, "times that rise"));
        }
        if samples.len() == MOST_SAMPLES {
            let problem = format!("more than {MOST_SAMPLES} samples");
            let allowed = format!("at most {MOST_SAMPLES}");
            return Err(log.fault(line, "file", problem, &allowed));
        }
        samples.push(Sample {
            seconds,
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
        Ok(PositionLog {
            file: name.to_owned(),
            time,
            counts,
            samples,
        })
    })
}

/// A log being read.
struct Log<'a> {
    file: &'a str,
    text: &'a [u8],
}

impl Log<'_> {
    fn fault(&self, line: usize, field: &str, problem: impl Into<String>, allowed: &str) -> Fault {
        Fault::new(self.file, line, field, problem, allowed)
    }

    /// A fault of a field, with its line.
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
        // Within quotes there may be commas, and the line may lack the field.
        let field = fields.nth(place.index).filter(|_| !written.contains(&b'"'));
        let marked = field.unwrap_or(begin..begin + written.len());
        self.fault(line, &place.name, problem, allowed)
            .marked(self.text, &marked)
    }

    fn too_short(&self, samples: usize) -> Fault {
        let problem = format!("{samples} samples in it");
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

    /// Hands over the records with their lines, the header among them, as long as they are wanted.
    fn each(&self, mut take: impl FnMut(usize, &[&str]) -> bool) -> Result<(), Fault> {
        let mut reader: Reader<&[u8]> = ReaderBuilder::new()
            .has_headers(false)
            .flexible(true)
            .trim(Trim::All)
            .comment(Some(b'#'))
            .from_reader(self.text);
        let mut record = ByteRecord::new();
        loop {
            let more = reader.read_byte_record(&mut record);
            let more = more.map_err(|error| self.fault(0, "file", error.to_string(), "CSV"))?;
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

    fn field<'a>(&self, line: usize, place: &Place, fields: &[&'a str]) -> Result<&'a str, Fault> {
        fields.get(place.index).copied().ok_or_else(|| {
            let problem = format!("the line has only {} of its fields", fields.len());
            self.fault_at(line, place, problem, "a number")
        })
    }

    fn number(&self, line: usize, place: &Place, fields: &[&str]) -> Result<f64, Fault> {
        let field = self.field(line, place, fields)?;
        let number = field.parse().ok().filter(|number: &f64| number.is_finite());
        number.ok_or_else(|| self.fault_at(line, place, format!("is '{field}'"), "a number"))
    }

    fn counts(&self, line: usize, place: &Place, fields: &[&str]) -> Result<i64, Fault> {
        let field = self.field(line, place, fields)?;
        let number = field.parse().ok();
        let counts = number.filter(|number| COUNTS_RANGE.contains(number));
        counts.ok_or_else(|| {
            let (least, most) = (COUNTS_RANGE.start(), COUNTS_RANGE.end());
            let allowed = format!("a whole number, {least} to {most}");
            self.fault_at(line, place, format!("is '{field}'"), &allowed)
        })
    }
}

/// The line a record begins in. What it was read from begins with what was skipped before it.
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
mod tests {
    use super::*;

    fn accept(text: &str) -> PositionLog {
        read("l.csv", text.as_bytes(), &Columns::default()).unwrap()
    }

    fn refuse(text: &str, columns: &Columns) -> String {
        read("l.csv", text.as_bytes(), columns)
            .unwrap_err()
            .to_string()
    }

    /// Counts and lines of the samples.
    fn samples(log: &PositionLog) -> Vec<(i64, usize)> {
        let of = |sample: &Sample| (sample.counts, sample.line);
        log.samples.iter().map(of).collect()
    }

    #[test]
    fn a_log_is_read_with_header_and_without() {
        let plain = accept("7170,0\n7175,12\n7180,-30\n");
        assert_eq!(samples(&plain), [(0, 1), (12, 2), (-30, 3)]);
        let seconds: Vec<f64> = plain.samples.iter().map(|s| s.seconds).collect();
        assert_eq!(seconds, [0.0, 0.005, 0.01]);
        assert_eq!(plain.seconds(), 0.01);

        let text = "\u{feff}time,   left\r\n# rest\r\n\r\n 7170,   0 \r\n\n7175,\t12,9\r\n  \n\
                    #\n7180,\"-30\"";
        let log = accept(text);
        assert_eq!(samples(&log), [(0, 4), (12, 6), (-30, 9)]);
        let bare = |log: &PositionLog| log.samples.iter().map(|s| s.seconds).collect::<Vec<_>>();
        assert_eq!(bare(&log), bare(&plain));
    }

    #[test]
    fn positions_are_interpolated() {
        let log = accept("0,0\n10,40\n20,-60\n");
        for (ms, position) in [
            (-5.0, 0.0),
            (0.0, 0.0),
            (2.5, 10.0),
            (10.0, 40.0),
            (15.0, -10.0),
            (20.0, -60.0),
            (99.0, -60.0),
        ] {
            let seen = log.position_at(ms * 1e-3);
            assert!((seen - position).abs() < 1e-9, "{ms}: {seen}");
        }
        let (speed, line) = log.fastest();
        assert!((speed - 1e4).abs() < 1e-6);
        assert_eq!(line, 3);
    }

    #[test]
    fn what_cannot_be_used_is_refused_with_its_line() {
        let none = Columns::default();
        let cases = [
            (
                "",
                "l.csv: file: 0 samples in it; allowed: a log of 2 samples or more",
            ),
            (
                "t,c\n1,2\n",
                "l.csv: file: 1 samples in it; allowed: a log of 2 samples or more",
            ),
            (
                "7\n8\n",
                "l.csv:1: file: only one column; allowed: a column of times and one of \
              counts, with a comma between them",
            ),
            (
                "1,x\n",
                "l.csv:1: counts (column 2): is 'x'; allowed: a whole number, -2147483648 to 2147483648",
            ),
            (
                "t,c\n1,2\n\n2,3.5\n",
                "l.csv:4: c: is '3.5'; allowed: a whole number, -2147483648 to \
              2147483648",
            ),
            (
                "1,2\n2,2147483649\n",
                "l.csv:2: counts (column 2): is '2147483649'; allowed: a whole number, \
              -2147483648 to 2147483648",
            ),
            (
                "t,c\n1,2\n#\nnan,3\n",
                "l.csv:4: t: is 'nan'; allowed: a number",
            ),
            (
                "1,2\n2\n",
                "l.csv:2: counts (column 2): the line has only 1 of its fields; allowed: a number",
            ),
            (
                "1,2\n2,3\n2,4\n",
                "l.csv:3: time (column 1): 2 does not rise above line 2; allowed: times that \
              rise",
            ),
        ];
        for (text, message) in cases {
            assert_eq!(refuse(text, &none), message, "{text:?}");
        }
        let fault = read("l.csv", b"1,2\n2,\xff\n", &none).unwrap_err();
        assert_eq!(
            fault.to_string(),
            "l.csv:2: file: not UTF-8; allowed: a position log in CSV"
        );
        let fault = read_path(Path::new("/nowhere/l.csv"), &none).unwrap_err();
        assert_eq!(fault.allowed, "a readable file");
    }

    #[test]
    fn there_is_a_most_of_samples() {
        let mut text = String::new();
        for k in 0..=MOST_SAMPLES {
            text.push_str(&format!("{k},1\n"));
        }
        assert_eq!(
            refuse(&text, &Columns::default()),
            "l.csv:4000001: file: more than 4000000 samples; allowed: at most 4000000"
        );
    }
}
