//! What a path came to by each correction.

use motion_rtl::circuits::trajectory_controller::path_point::AXES;
use motion_rtl::jobs::trajectory_controller::closed::{ClosedForms, Steady};
use motion_rtl::jobs::trajectory_controller::job::Played;
use motion_rtl::jobs::trajectory_controller::measure::{Measured, apart};
use motion_rtl::jobs::trajectory_controller::program::Program;
use motion_rtl::jobs::trajectory_controller::settings::Correction;
use std::array::from_fn;

/// What the run at full feed is called.
const FULL_FEED: &str = "vector, full feed";

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

/// The run by one correction.
#[derive(Debug)]
pub struct Run {
    /// The correction.
    pub correction: Correction,
    /// It is at full feed, where the others are slower for a contour tolerance.
    pub full_feed: bool,
    /// Time that the path is planned in, in s.
    pub planned_s: f64,
    /// Ticks of the run.
    pub ticks: u64,
    /// The tick in which the path began; before it was written.
    pub start: u64,
    /// Interpolation periods.
    pub periods: usize,
    /// The tick in which positions were taken, of each.
    pub taken: Vec<u64>,
    /// Largest distance of a command from the path's exact point, in mm.
    pub command_error_mm: f64,
    /// Distance of the last command from the path's end, in mm.
    pub end_mm: f64,
    /// Where the motors ended, in counts from where the path begins.
    pub end_counts: Vec<i64>,
    /// Measured.
    pub measured: Measured,
    /// On a circle at constant speed.
    pub circle: Option<CircleError>,
    /// A period began before the one before was over.
    pub late: bool,
    /// The profile ended in motion.
    pub starved: bool,
    /// An encoder was too fast.
    pub lost: bool,
    /// Models and motors came to rest.
    pub settled: bool,
}

/// Contour error on a circle, inwards positive, in mm: means of the steady part.
#[derive(Debug, Clone, Copy)]
pub struct CircleError {
    /// Closed forms.
    pub forms: ClosedForms,
    /// Periods of the steady part.
    pub periods: usize,
    /// Of the models.
    pub model_mm: f64,
    /// Of the loads.
    pub load_mm: f64,
}

impl Run {
    /// Of what was played; none where there is no period.
    pub fn of(program: &Program, correction: Correction, played: &Played) -> Option<Self> {
        let measured = Measured::of(program, played)?;
        let last = played.periods.last()?;
        let circle = Steady::of(program, played).map(|steady| CircleError {
            forms: steady.forms,
            periods: steady.periods.len(),
            model_mm: steady.mean_mm(&measured.model),
            load_mm: steady.mean_mm(&measured.load),
        });
        // Commands are from where the path begins.
        let off = |command: [i64; AXES], length: f64| {
            let at = from_fn(|axis| program.origin[axis] as f64 + command[axis] as f64);
            apart(at, program.path.place(length)) / program.motion.units_per_mm
        };
        let commands = played.periods.iter();
        let errors = commands.map(|period| off(period.command, period.length as f64));
        Some(Run {
            correction,
            full_feed: false,
            planned_s: program.profile.duration,
            ticks: played.ticks,
            start: played.start,
            periods: played.periods.len(),
            taken: played.periods.iter().map(|period| period.tick).collect(),
            command_error_mm: errors.fold(0.0, f64::max),
            end_mm: off(last.command, program.path.length as f64),
            end_counts: last.motor[..played.axes].to_vec(),
            measured,
            circle,
            late: played.late,
            starved: played.starved,
            lost: played.lost,
            settled: played.settled,
        })
    }

    /// What it is called.
    pub fn name(&self) -> &'static str {
        match self.full_feed {
            false => self.correction.name(),
            true => FULL_FEED,
        }
    }
}
