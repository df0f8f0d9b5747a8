//! Input of a run of the trajectory controller: a planned path and its machine.

use crate::cli::pieces::{SpeedKeys, fault, pieces};
use crate::cli::source::Source;
use crate::cli::{Failure, progress};
use motion_rtl::circuits::trajectory_controller::Widths;
use motion_rtl::input::Drawing;
use motion_rtl::jobs::trajectory_controller::job::controller;
use motion_rtl::jobs::trajectory_controller::program::{Program, ProgramError};
use motion_rtl::jobs::trajectory_controller::segments::FourthAxis;
use motion_rtl::jobs::trajectory_controller::settings::{Correction, LEAST_PERIOD_TICKS, Settings};
use motion_rtl::path::error::PathError;
use motion_rtl::path::pieces::Speeds;
use motion_rtl::plant::TwoMassParameters;
use motion_rtl::scenario::Loaded;
use motion_rtl::settings::{Place, SettingError};

/// A path ready to be run.
#[derive(Debug)]
pub struct Job {
    /// Stem of the names of its files.
    pub stem: String,
    /// The input; `None` if the scenario has the path.
    pub drawing: Option<Drawing>,
    /// Its settings.
    pub settings: Settings,
    /// The path and the words.
    pub program: Program,
    /// Path at full feed, where a contour tolerance limits it and it is compared.
    pub full_feed: Option<Program>,
    /// Motor and load of each axis.
    pub machines: Vec<TwoMassParameters>,
    /// The pieces that are rapid moves.
    rapid: Vec<bool>,
    /// The scenario it came from.
    pub loaded: Loaded,
}

impl Job {
    /// Plans a path.
    pub fn prepare(source: Source, settings: Settings) -> Result<Self, Failure> {
        let loaded = &source.loaded;
        let refuse = |error: SettingError| match error.place {
            // All axes are as the one table.
            Some(Place::Row("axis", _)) if settings.axis.is_empty() => {
                loaded.refuse(error.at(Place::Table("machine")))
            }
            _ => loaded.refuse(error),
        };
        let taught = settings.taught(loaded.scenario.input()).map_err(refuse)?;
        let keys = SpeedKeys {
            speeds: Speeds::from(&settings),
            key: "feed_mm_per_min",
            rapid: "rapid_mm_per_min",
        };
        let from = settings.start_mm.unwrap_or_default();
        let (drawing, start, pieces) = pieces(&source, from.point, &taught, keys)?;
        let fourth = match &drawing {
            Some(_) if from.w.is_some_and(|w| w != 0.0) => {
                let allowed = "where the drawing begins: no start_mm";
                let error = SettingError::new("start_mm", "has W beside an input", allowed);
                return Err(refuse(error).into());
            }
            Some(drawing) => FourthAxis {
                from_mm: 0.0,
                to_mm: drawing.fourth.clone(),
            },
            None => settings.taught_w(),
        };
        let fourth = settings.has_fourth().then_some(fourth);
        let refuse_path = |error: PathError| fault(loaded, drawing.as_ref(), keys, &error);
        let in_z = pieces.iter().any(|piece| piece.to[2] != start[2]);
        let axes = settings.axes(in_z).map_err(refuse)?;
        let machines = settings.machines(axes).map_err(refuse)?;
        progress::stage("planning the path");
        let plan = |settings: &Settings| {
            let (of, full) = (fourth.as_ref(), &Widths::FULL);
            let program = Program::with_fourth(start, &pieces, of, settings, &machines, full);
            program.map_err(|error| match error {
                ProgramError::Path(error) => refuse_path(error),
                ProgramError::Setting(error) => refuse(error),
            })
        };
        let program = plan(&settings)?;
        let limited = source.compares && settings.contour_tolerance_mm.is_some();
        let full_feed = limited.then(|| Settings {
            contour_tolerance_mm: None,
            ..settings.clone()
        });
        let full_feed = full_feed.as_ref().map(plan).transpose()?;
        let moves = drawing.iter().flat_map(|drawing| &drawing.moves);
        let rapid = moves.map(|step| step.rapid).collect();
        let Source { stem, loaded, .. } = source;
        Ok(Job {
            stem,
            drawing,
            settings,
            program,
            full_feed,
            machines,
            rapid,
            loaded,
        })
    }

    /// Returns the count of axes.
    pub fn axes(&self) -> usize {
        self.machines.len()
    }

    /// Ticks of a period that its circuit needs, whatever corrects it.
    pub fn period_ticks_needed(&self) -> u64 {
        let circuit = controller(self.axes(), Correction::Vector, self.settings.rounding);
        circuit.least_period().max(LEAST_PERIOD_TICKS)
    }

    /// Δt in seconds.
    pub fn period_s(&self) -> f64 {
        self.program.motion.period
    }

    /// Returns true if a piece is a rapid move.
    pub fn is_rapid(&self, piece: usize) -> bool {
        self.rapid.get(piece).copied().unwrap_or(false)
    }

    /// Ticks that the path takes, and about those until the models are at rest, for the progress.
    pub fn ticks_at_least(&self) -> u64 {
        let periods = self.program.profile.duration / self.period_s() + self.settling_periods();
        let ticks = u64::from(self.program.period_ticks);
        (periods.ceil() as u64).saturating_mul(ticks)
    }

    /// Periods in which the slowest decay of the models brings them from where they are behind to
    /// within half a count.
    fn settling_periods(&self) -> f64 {
        let program = &self.program;
        let unit = program.motion.units_per_mm;
        let fastest = program.profile.pieces.iter().map(|piece| piece.v);
        let speed = fastest.fold(0.0, f64::max) / unit;
        let settling = program.gains.iter().map(|gains| {
            let [k1, k2] = gains.parts(&Widths::FULL);
            let root = (k2 * k2 - 4.0 * k1 * k2).max(0.0).sqrt();
            let decay = (k2 - root) / 2.0;
            let behind_mm = speed * self.period_s() / decay;
            let behind_mm = behind_mm.min(program.path.length as f64 / unit);
            let counts = behind_mm * self.settings.counts_per_mm;
            (2.0 * counts).max(1.0).ln() / decay
        });
        settling.fold(0.0, f64::max)
    }
}
