//! Runs of a path by each correction.

use super::Job;
use crate::cli::thinned::Thinned;
use motion_rtl::circuits::trajectory_controller::path_point::AXES;
use motion_rtl::jobs::trajectory_controller::closed::{CircleMeasured, SteadySearch};
use motion_rtl::jobs::trajectory_controller::job::{Period, Played};
use motion_rtl::jobs::trajectory_controller::measure::{Deviation, Measured, Measuring, apart};
use motion_rtl::jobs::trajectory_controller::program::Program;
use motion_rtl::jobs::trajectory_controller::settings::Correction;
use motion_rtl::path::vector::distance;
use serde::Serialize;
use std::array::from_fn;

/// The period whose tick the save file's window begins with.
pub const IN_MOTION: usize = 200;

/// Name of the run at full feed.
pub const FULL_FEED: &str = "vector, full feed";

/// The runs of a path.
#[derive(Debug)]
pub struct Runs {
    /// By each correction; behind them the vector at full feed, where the others are slower.
    pub runs: Vec<Run>,
    /// The one with waves.
    pub traced: Correction,
}

impl Runs {
    /// The run with waves.
    pub fn traced(&self) -> &Run {
        let mut runs = self.runs.iter();
        runs.find(|run| run.correction == self.traced)
            .unwrap_or(&self.runs[0])
    }
}

/// The run by one correction, with its figures in the summary.
#[derive(Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Run {
    /// Correction of the commands.
    pub correction: Correction,
    /// True at full feed, beside runs that a contour tolerance limits.
    pub full_feed: bool,
    /// Planned duration of the path.
    pub planned_seconds: f64,
    /// True if its waves are written.
    pub in_waves: bool,
    /// Ticks of the run.
    pub ticks: u64,
    /// Interpolation periods until models and motors have settled.
    pub periods: usize,
    /// Errors of models, motors and loads, and measures of the axes.
    #[serde(flatten)]
    pub measured: Measured,
    /// Errors on a circle, if the path has one that is long enough.
    pub circle: Option<CircleMeasured>,
    /// Tick at which the path began; it was written before.
    #[serde(skip)]
    pub start: u64,
    /// The tick of a period in motion.
    #[serde(skip)]
    pub in_motion: u64,
    /// Largest distance of a command from the path's exact point, in mm.
    #[serde(skip)]
    pub command_error_mm: f64,
    /// Distance of the last command from the path's end, in mm.
    #[serde(skip)]
    pub end_mm: f64,
    /// Largest contour error of the loads on what is drawn, in mm.
    #[serde(skip)]
    pub largest_drawn_mm: f64,
    /// Largest contour error of the loads next to each segment, in um; without a period there none.
    #[serde(skip)]
    pub segments: Vec<Option<f64>>,
    /// The periods, thinned for the picture.
    #[serde(skip)]
    pub shown: Thinned<Shown, 5>,
    /// True if a period began before the previous one was over.
    #[serde(skip)]
    pub late: bool,
    /// True if the profile ended in motion.
    #[serde(skip)]
    pub starved: bool,
    /// True if an encoder was too fast.
    #[serde(skip)]
    pub lost: bool,
    /// True if models and motors came to rest.
    #[serde(skip)]
    pub settled: bool,
}

/// A period as the picture shows it: the loads.
#[derive(Debug, Clone, Copy)]
pub struct Shown {
    /// Deviation of the loads.
    pub load: Deviation,
    /// True on a rapid move.
    pub rapid: bool,
    /// Their speed since the period before, in mm/s, and the time in the middle of both, in s.
    pub speed: Option<(f64, f64)>,
}

impl Shown {
    /// The numbers whose extremes a picture shows.
    fn numbers(&self) -> [f64; 5] {
        let [x, y, _] = self.load.actual;
        let speed = self.speed.map_or(f64::NAN, |(_, speed)| speed);
        [x, y, self.load.contour_mm, self.load.following_mm, speed]
    }
}

/// A run while it goes on.
#[derive(Debug)]
pub struct UnderWay<'j> {
    job: &'j Job,
    program: &'j Program,
    correction: Correction,
    measuring: Measuring<'j>,
    steady: SteadySearch,
    last: Option<(Period, Deviation)>,
    in_motion: Option<u64>,
    command_error_mm: f64,
    largest_drawn_mm: f64,
    segments: Vec<Option<f64>>,
    shown: Thinned<Shown, 5>,
}

impl<'j> UnderWay<'j> {
    /// Starts the measurements of a run.
    pub fn new(job: &'j Job, program: &'j Program, correction: Correction) -> Self {
        UnderWay {
            job,
            program,
            correction,
            measuring: Measuring::new(program, &job.machines),
            steady: SteadySearch::new(program),
            last: None,
            in_motion: None,
            command_error_mm: 0.0,
            largest_drawn_mm: 0.0,
            segments: vec![None; program.path.stretches.len()],
            shown: Thinned::by(Shown::numbers),
        }
    }

    /// Takes the next period.
    pub fn take(&mut self, period: &Period) {
        let (path, unit) = (&self.program.path, self.program.motion.units_per_mm);
        let deviations = self.measuring.take(period);
        let contour_mm = deviations.map(|deviation| deviation.contour_mm);
        let [_, _, load] = deviations;
        self.steady.take(period.length, contour_mm);
        let off = self.off(period.command, period.length as f64);
        self.command_error_mm = self.command_error_mm.max(off);
        if self.shown.count() == IN_MOTION {
            self.in_motion = Some(period.tick);
        }
        let number = path.index(load.length_mm * unit);
        let of = &mut self.segments[number];
        *of = Some(of.unwrap_or(0.0f64).max(load.contour_mm * 1e3));
        let rapid = self.job.is_rapid(path.stretches[number].piece);
        if !rapid {
            self.largest_drawn_mm = self.largest_drawn_mm.max(load.contour_mm);
        }
        // Positions are taken when the lookups are done: on arcs later in the period than on lines.
        let speed = self.last.as_ref().map(|(before, was)| {
            let way = distance(load.actual, was.actual).hypot(load.w_mm - was.w_mm);
            let time = (period.tick - before.tick) as f64 / self.job.settings.clock_hz as f64;
            (f64::midpoint(was.time_s, load.time_s), way / time)
        });
        self.shown.push(Shown { load, rapid, speed });
        self.last = Some((*period, load));
    }

    /// Distance of a command from a place on the path, in mm; commands are from where the path begins.
    fn off(&self, command: [i64; AXES], length: f64) -> f64 {
        let program = self.program;
        let at = from_fn(|axis| program.origin[axis] as f64 + command[axis] as f64);
        apart(at, program.path.looked_up(length, self.correction)) / program.motion.units_per_mm
    }

    /// Result of the run; none if it had no period.
    pub fn finish(self, played: &Played) -> Option<Run> {
        let (last, _) = self.last?;
        let end_mm = self.off(last.command, self.program.path.length as f64);
        let circle = self.steady.finish();
        Some(Run {
            correction: self.correction,
            full_feed: false,
            planned_seconds: self.program.profile.duration,
            in_waves: self.correction == self.job.settings.correction,
            ticks: played.ticks,
            periods: self.shown.count(),
            measured: self.measuring.finish(played)?,
            circle: circle.map(|steady| steady.circle(self.correction)),
            start: played.start,
            in_motion: self.in_motion.unwrap_or(played.start),
            command_error_mm: self.command_error_mm,
            end_mm,
            largest_drawn_mm: self.largest_drawn_mm,
            segments: self.segments,
            shown: self.shown,
            late: played.late,
            starved: played.starved,
            lost: played.lost,
            settled: played.settled,
        })
    }
}

impl Run {
    /// Measures a finished run; `None` if it has no period.
    #[cfg(test)]
    pub fn of(job: &Job, correction: Correction, played: &Played) -> Option<Self> {
        let mut run = UnderWay::new(job, &job.program, correction);
        played.periods.iter().for_each(|period| run.take(period));
        run.finish(played)
    }

    /// Returns the name of the run.
    pub fn name(&self) -> &'static str {
        match self.full_feed {
            false => self.correction.name(),
            true => FULL_FEED,
        }
    }
}
