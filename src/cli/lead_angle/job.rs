//! Input of a run of the lead-angle compensator: settings and an optional position log.

use crate::cli::Failure;
use crate::cli::source::Source;
use motion_rtl::input::Fault;
use motion_rtl::input::position_log::{Columns, PositionLog, Sample};
use motion_rtl::jobs::lead_angle::replay::{settings_for, validate};
use motion_rtl::jobs::lead_angle::settings::{Detector, Settings, TARGET_RANGE_COUNTS};
use motion_rtl::scenario::Loaded;

/// Largest distance of a log from its first count: every way to a target stays below half the
/// counter's range.
const FARTHEST_COUNTS: u64 = TARGET_RANGE_COUNTS.end().unsigned_abs();

/// A scenario ready to be run.
#[derive(Debug)]
pub struct Job {
    /// Stem of the names of its files.
    pub stem: String,
    /// Its settings.
    pub settings: Settings,
    /// The log that stands in for body and encoder.
    pub log: Option<PositionLog>,
    /// The scenario it came from.
    pub loaded: Loaded,
}

impl Job {
    /// Checks the settings and reads the log.
    pub fn prepare(source: Source, settings: Settings) -> Result<Self, Failure> {
        let loaded = &source.loaded;
        let refuse = |error| loaded.refuse(error);
        settings.ranges().map_err(refuse)?;
        let columns = settings.columns();
        let log = source.log(&columns)?;
        if let Some(log) = &log {
            check_log(loaded, log, &settings)?;
        } else {
            refuse_columns(loaded, &columns)?;
            settings.validate().map_err(refuse)?;
        }
        let Source { stem, loaded, .. } = source;
        Ok(Job {
            stem,
            settings,
            log,
            loaded,
        })
    }

    /// Ticks that the positionings take at full speed, for the progress bar.
    pub fn ticks_at_least(&self) -> u64 {
        let settings = &self.settings;
        let ways = (0..settings.positionings as usize).map(|number| {
            let step = &settings.steps[number % settings.steps.len()];
            let way = settings.way(number).unsigned_abs();
            let seconds = way as f64 / f64::from(step.speed_counts_per_s);
            let pauses = (settings.rest_ms + settings.standstill_ms) / 1e3;
            ((seconds + pauses) * settings.clock_hz as f64) as u64
        });
        ways.fold(0, u64::saturating_add)
    }
}

/// Without a log there are no columns.
fn refuse_columns(loaded: &Loaded, columns: &Columns) -> Result<(), Fault> {
    let names = [
        ("log_column", &columns.counts),
        ("log_time_column", &columns.time),
    ];
    for (key, name) in names {
        if let Some(name) = name {
            let allowed = "it with an input, a position log in CSV, only".to_owned();
            return Err(loaded.fault(key, format!("is {name}"), allowed));
        }
    }
    Ok(())
}

/// Checks a log, and the settings that it is replayed with.
fn check_log(loaded: &Loaded, log: &PositionLog, settings: &Settings) -> Result<(), Fault> {
    let first = log.samples.first().map_or(0, |sample| sample.counts);
    validate(&settings_for(log, settings)).map_err(|mut error| {
        if error.field == "target" {
            error.problem += &format!(" from the log's first count, {first}");
        }
        loaded.refuse(error)
    })?;
    let fault = |line, problem: String, allowed: String| {
        Fault::new(&log.file, line, &log.counts.name, problem, allowed)
    };
    let far = |sample: &&Sample| sample.counts.abs_diff(first) > FARTHEST_COUNTS;
    if let Some(sample) = log.samples.iter().find(far) {
        let problem = format!("is {}", sample.counts);
        let allowed = format!("up to {FARTHEST_COUNTS} counts from the first, {first}");
        return Err(fault(sample.line, problem, allowed));
    }
    let (longest, seconds) = (u64::MAX as f64 / settings.clock_hz as f64, log.seconds());
    if let Some(last) = log.samples.last().filter(|_| seconds >= longest) {
        return Err(Fault {
            field: log.time.name.clone(),
            ..fault(
                last.line,
                format!("is {seconds} s after the first"),
                format!(
                    "less than {longest:.0} s, 2^64 ticks of {} Hz",
                    settings.clock_hz
                ),
            )
        });
    }
    let (speed, line) = log.fastest();
    let fastest = settings.followed_counts_per_s();
    if speed > fastest {
        let unit = &log.unit;
        let problem = format!(
            "{speed:.0} counts/s since the sample before, with times in {unit} \
             (log_time_unit_ms)"
        );
        let allowed = match settings.detector {
            Detector::Incremental => format!("up to {fastest}, one count per tick"),
            Detector::Absolute => format!("up to {fastest:.0}, a quarter of a turn per CK"),
            Detector::PhaseShift | Detector::Resolver => {
                format!("up to {fastest:.0}, an eighth of a pitch per CK")
            }
        };
        return Err(fault(line, problem, allowed));
    }
    Ok(())
}
