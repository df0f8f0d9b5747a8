//! What a run of the lead-angle compensator begins with: settings, and perhaps a position log.

use crate::cli::Failure;
use crate::cli::job::Source;
use motion_rtl::input::Fault;
use motion_rtl::input::position_log::{Columns, PositionLog};
use motion_rtl::input::scenario::Loaded;
use motion_rtl::lead_angle::settings::{SettingError, Settings};

/// Units of time that a log may have, in seconds.
const TIME_UNITS_S: std::ops::RangeInclusive<f64> = 1e-12..=1e4;

/// A scenario ready to be run.
#[derive(Debug)]
#[expect(dead_code, reason = "the run that reads them is still to come")]
pub struct Job {
    /// What its files are called.
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
    pub fn prepare(source: Source, settings: Settings, columns: &Columns) -> Result<Self, Failure> {
        let loaded = &source.loaded;
        settings
            .validate()
            .map_err(|error| setting_fault(loaded, error))?;
        check_columns(loaded, columns)?;
        let log = source.log(columns)?;
        if let Some(log) = &log {
            check_log(log, &settings)?;
        }
        let Source { stem, loaded, .. } = source;
        Ok(Job {
            stem,
            settings,
            log,
            loaded,
        })
    }
}

fn setting_fault(loaded: &Loaded, error: SettingError) -> Fault {
    let SettingError {
        field,
        step,
        value,
        allowed,
    } = error;
    let problem = format!("is {value}");
    match step {
        Some(step) => loaded.table_fault(("step", step), field, problem, allowed),
        None => loaded.fault(field, problem, allowed),
    }
}

fn check_columns(loaded: &Loaded, columns: &Columns) -> Result<(), Fault> {
    let names = [
        ("log_column", &columns.counts),
        ("log_time_column", &columns.time),
    ];
    for (key, name) in names {
        if let Some(name) = name
            && loaded.scenario.input().is_none()
        {
            let allowed = "it with an input, a position log in CSV, only".to_owned();
            return Err(loaded.fault(key, format!("is {name}"), allowed));
        }
    }
    if TIME_UNITS_S.contains(&columns.time_unit_s) {
        return Ok(());
    }
    let (least, most) = (TIME_UNITS_S.start() * 1e3, TIME_UNITS_S.end() * 1e3);
    let problem = format!("is {}", columns.time_unit_s * 1e3);
    Err(loaded.fault("log_time_unit_ms", problem, format!("{least} to {most}")))
}

/// An encoder is counted at one count per tick.
fn check_log(log: &PositionLog, settings: &Settings) -> Result<(), Fault> {
    let (speed, line) = log.fastest();
    if speed <= settings.clock_hz as f64 {
        return Ok(());
    }
    Err(Fault {
        file: log.file.clone(),
        line,
        field: "counts".to_owned(),
        problem: format!("{speed:.0} counts/s since the sample before"),
        allowed: format!("up to {}, one count per tick", settings.clock_hz),
    })
}
