//! Results of a drawing by each system.

use super::Job;
use crate::cli::thinned::Thinned;
use motion_rtl::jobs::linear_interpolator::measure::{
    Measuring, Played, ScanRecord, Seen, Segment,
};

/// The systems that play a job.
#[derive(Debug)]
pub struct Runs {
    /// Run of the linear interpolator.
    pub interpolator: Run,
    /// Run with another master axis, if the job allows one.
    pub other: Option<Run>,
    /// The conventional system of Fig. 3, in each of its ways, where the scenario asks for it.
    pub conventional: Option<[Run; 2]>,
}

/// The run of one system.
#[derive(Debug)]
pub struct Run {
    /// Observations, without the scans.
    pub played: Played,
    /// The measures of every cycle.
    pub segments: Vec<Segment>,
    /// The last command, in counts.
    pub end_position: [i64; 2],
    /// The tick of the first command.
    pub begun: u64,
    /// Largest distance of a command or a motor from a line that is drawn, in mm.
    pub largest_drawn_mm: f64,
    /// The scans, thinned for the picture.
    pub shown: Thinned<Shown, 6>,
}

/// A scan as the picture shows it.
#[derive(Debug, Clone, Copy)]
pub struct Shown {
    pub record: ScanRecord,
    pub cycle: Option<usize>,
    /// Contour error of the motors, in mm, to the left of the line positive.
    pub contour_mm: f64,
    /// Speed of the motors since the scan before, in mm/s.
    pub speed: f64,
}

impl Shown {
    /// The numbers whose extremes a picture shows.
    fn numbers(&self) -> [f64; 6] {
        let ([mx, my], [cx, cy]) = (self.record.motor, self.record.command);
        [mx, my, cx as f64, cy as f64, self.contour_mm, self.speed]
    }
}

/// A run while it goes on.
#[derive(Debug)]
pub struct UnderWay<'j> {
    job: &'j Job,
    measuring: Measuring,
    last: Option<ScanRecord>,
    begun: Option<u64>,
    largest_drawn_mm: f64,
    shown: Thinned<Shown, 6>,
}

impl<'j> UnderWay<'j> {
    /// Starts the measurements of a run.
    pub fn new(job: &'j Job) -> Self {
        UnderWay {
            job,
            measuring: Measuring::new(job.settings.counts_per_mm),
            last: None,
            begun: None,
            largest_drawn_mm: 0.0,
            shown: Thinned::by(Shown::numbers),
        }
    }

    /// Takes the next scan.
    pub fn take(&mut self, seen: &Seen<'_>) {
        let (settings, record) = (&self.job.settings, seen.record);
        let scale = settings.counts_per_mm;
        let cycle = self.measuring.take(seen);
        let mut contour_mm = f64::NAN;
        if let Some(number) = cycle {
            let of = &seen.cycles[number];
            self.begun.get_or_insert(record.tick);
            contour_mm = of.contour_error(record.motor, scale);
            let targets = &self.job.compiled.targets;
            if targets.get(number).is_some_and(|target| !target.rapid) {
                let command = record.command.map(|counts| counts as f64);
                let off = of.contour_error(command, scale).abs();
                let all = [contour_mm.abs(), off];
                self.largest_drawn_mm = all.into_iter().fold(self.largest_drawn_mm, f64::max);
            }
        }
        let speed = self.last.map_or(f64::NAN, |before| {
            let [x, y] = [0, 1].map(|axis| (record.motor[axis] - before.motor[axis]) / scale[axis]);
            x.hypot(y) / settings.scan_s()
        });
        self.shown.push(Shown {
            record,
            cycle,
            contour_mm,
            speed,
        });
        self.last = Some(record);
    }

    /// Result of the run.
    pub fn finish(self, played: Played) -> Run {
        Run {
            segments: self.measuring.finish(&played.cycles),
            end_position: self.last.map_or([0; 2], |record| record.command),
            begun: self.begun.unwrap_or(0),
            largest_drawn_mm: self.largest_drawn_mm,
            shown: self.shown,
            played,
        }
    }
}
