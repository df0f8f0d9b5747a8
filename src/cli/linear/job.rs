//! Input of a run of the linear interpolator: settings and cycles.

use crate::cli::source::{Source, drawing_fault, plan_fault};
use crate::cli::{Failure, progress};
use motion_rtl::circuits::linear_interpolator::MasterAxis;
use motion_rtl::input::{Drawing, Fault};
use motion_rtl::jobs::linear_interpolator::settings::Settings;
use motion_rtl::jobs::linear_interpolator::targets::{
    MOST_TARGETS, REACH_COUNTS, TargetError, Targets, compile,
};
use motion_rtl::scenario::Loaded;
use motion_rtl::settings::tidy;

/// An input ready to be run.
#[derive(Debug)]
pub struct Job {
    /// Stem of the names of its files.
    pub stem: String,
    pub drawing: Drawing,
    /// Its settings.
    pub settings: Settings,
    pub compiled: Targets,
    /// Cycles with another master axis, or their compile error; `None` without a comparison.
    pub other: Option<Other>,
    /// The scenario it came from.
    pub loaded: Loaded,
}

/// The job with another master axis: X in place of the longer one, or the other way round.
#[derive(Debug)]
pub struct Other {
    /// Its settings.
    pub settings: Settings,
    pub compiled: Result<Targets, TargetError>,
}

impl Other {
    fn of(drawing: &Drawing, settings: &Settings) -> Self {
        let master = match settings.master {
            MasterAxis::Longer => MasterAxis::X,
            MasterAxis::X | MasterAxis::Y => MasterAxis::Longer,
        };
        let settings = Settings {
            master,
            ..settings.clone()
        };
        let compiled = compile(drawing, &settings);
        Other { settings, compiled }
    }
}

impl Job {
    /// The cycles with the longer axis as the master, of which the conventional systems are made. It
    /// goes at least as fast as a fixed one: where that can be had, so can this.
    pub fn longer(&self) -> &Targets {
        let other = self.other.as_ref();
        let other = other.and_then(|other| other.compiled.as_ref().ok());
        match (self.settings.master, other) {
            (MasterAxis::X | MasterAxis::Y, Some(longer)) => longer,
            _ => &self.compiled,
        }
    }

    /// Compiles an input.
    pub fn prepare(source: Source, settings: Settings) -> Result<Self, Failure> {
        let drawing = source.drawing()?;
        progress::stage("planning the path");
        let refused = |error| fault(&source.loaded, &drawing, &settings, error);
        let compiled = compile(&drawing, &settings).map_err(refused)?;
        let other = source.compares.then(|| Other::of(&drawing, &settings));
        let Source { stem, loaded, .. } = source;
        Ok(Job {
            stem,
            drawing,
            settings,
            compiled,
            other,
            loaded,
        })
    }

    /// Ticks that the cycles take without a wait between them, for the progress bar.
    pub fn ticks_at_least(&self) -> u64 {
        let (mut at, mut scans) = ([0, 0], 0u64);
        for target in &self.compiled.targets {
            let delta = [target.x - at[0], target.y - at[1]];
            let way = delta[self.settings.master.of(delta)].unsigned_abs();
            let [profile] = target.profiles;
            let ramps = (profile.acceleration_scans + profile.deceleration_scans) / 2;
            let steady = (way as f64 / profile.counts_per_scan()) as u64;
            scans = scans.saturating_add(steady.saturating_add(ramps));
            at = [target.x, target.y];
        }
        scans.saturating_mul(self.settings.scan_ticks.into())
    }
}

/// Returns a compile error with its file and line.
fn fault(loaded: &Loaded, drawing: &Drawing, settings: &Settings, error: TargetError) -> Fault {
    match error {
        TargetError::Setting(error) => loaded.refuse(error),
        TargetError::Drawing(error) => plan_fault(loaded, drawing, error),
        TargetError::Feed { line, value, most } => {
            let problem = format!("is {} mm/min", tidy(value));
            let most = tidy(most);
            let allowed = format!("up to {most} mm/min: 100 % speed (full_speed_mm_per_min)");
            drawing_fault(drawing, line, "F", problem, allowed)
        }
        TargetError::Slow { line, value, least } => {
            // A speed may come from the scenario: its key is at fault then, on account of this line.
            let step = drawing.moves.iter().find(|step| step.line == line);
            let field = match step {
                Some(step) if !step.rapid && step.feed_mm_per_min.is_some() => "F",
                Some(step) if !step.rapid => "feed_mm_per_min",
                _ => "rapid_mm_per_min",
            };
            let value = tidy(value);
            let problem =
                format!("at {value} mm/min the master axis goes too few counts in a scan");
            let allowed =
                format!("at least {least} mm/min on this way, or a longer scan (scan_ticks)");
            drawing_fault(drawing, line, field, problem, allowed)
        }
        TargetError::Position { line, axis, counts } => {
            let per_mm = settings.counts_per_mm;
            let problem = format!("is {counts} counts at {per_mm:?} counts/mm");
            let allowed = format!("-{REACH_COUNTS} to {REACH_COUNTS} counts");
            drawing_fault(drawing, line, axis, problem, allowed)
        }
        TargetError::TooMany { line } => {
            let problem = format!("more than {MOST_TARGETS} cycles up to here");
            let allowed = "fewer moves, or a larger chord_tolerance_mm".to_owned();
            drawing_fault(drawing, line, "path", problem, allowed)
        }
    }
}
