//! A drawing compiled for the pulse interpolator.

use crate::cli::source::{Source, drawing_fault, plan_fault};
use crate::cli::{Failure, progress};
use motion_rtl::input::{DRAWINGS, Drawing, Fault};
use motion_rtl::jobs::pulse_interpolator::motors::Motors;
use motion_rtl::jobs::pulse_interpolator::{
    Report, Settings, Table, TableError, compile, compile_unfollowed,
};
use motion_rtl::scenario::pulse_interpolator::{ConventionalMoves, VariantName};
use motion_rtl::scenario::{Loaded, Scenario};

/// An input ready to be run on the pulse interpolator.
#[derive(Debug)]
pub struct Job {
    /// The scenario it came from.
    pub loaded: Loaded,
    /// Stem of the names of its files.
    pub stem: String,
    /// The input.
    pub drawing: Drawing,
    /// Reset variant: the state that RST clears.
    pub variant: VariantName,
    /// Moves of the conventional device.
    pub conventional_moves: ConventionalMoves,
    /// Its settings.
    pub settings: Settings,
    /// The pattern memory's contents.
    pub table: Table,
    /// Report of the compilation.
    pub report: Report,
    /// Motors on its axes, if any.
    pub motors: Option<Motors>,
}

impl Job {
    /// Compiles an input, for its table or for a run; one of another circuit has no table.
    pub fn prepare(source: Source, is_for_run: bool) -> Result<Self, Failure> {
        let scenario = match &source.loaded.scenario {
            Scenario::PulseInterpolator(keys) => Ok(&keys.settings),
            Scenario::LinearInterpolator(_) => Err("linear interpolator"),
            Scenario::LeadAngle(_) => Err("lead-angle compensator"),
            Scenario::ArcGenerator(_) => Err("arc generator"),
            Scenario::TrajectoryController(_) => Err("trajectory controller"),
            Scenario::Machine(_) => Err("machine"),
        };
        let scenario = scenario.map_err(|circuit| match source.chose_circuit() {
            Some(path) => {
                let problem = format!("is for the {circuit}, which has no table");
                let allowed = format!("{DRAWINGS}; or the command run");
                Fault::new(&path.display().to_string(), 0, "file", problem, allowed)
            }
            None => {
                let problem = format!("the {circuit} has no table");
                let allowed = "pulse_interpolator, or the command run".to_owned();
                source.loaded.fault("circuit", problem, allowed)
            }
        })?;
        for (key, given) in [
            ("pattern", !scenario.pattern.is_empty()),
            ("play", scenario.play.is_some()),
            ("group", !scenario.group.is_empty()),
            ("rewrite", !scenario.rewrite.is_empty()),
            ("standalone", scenario.standalone),
        ] {
            if given {
                let problem = match key {
                    "pattern" => "a memory of patterns is not compiled",
                    _ => "without [[pattern]]",
                };
                let allowed = "the command run, with [[pattern]] and no input";
                let fault = source
                    .loaded
                    .fault(key, problem.to_owned(), allowed.to_owned());
                return Err(fault.into());
            }
        }
        let drawing = source.drawing()?;
        let variant = scenario.variant;
        let conventional_moves = scenario.conventional_moves;
        let settings = scenario.settings(&drawing);
        progress::stage("planning the path");
        let compiled = match is_for_run {
            true => compile_unfollowed(&drawing, &settings),
            false => compile(&drawing, &settings),
        };
        let (table, report) =
            compiled.map_err(|error| table_fault(&source.loaded, &drawing, &settings, error))?;
        let motors = scenario
            .motors(table.axes())
            .map_err(|error| source.loaded.refuse(error))?;
        let Source { loaded, stem, .. } = source;
        Ok(Job {
            loaded,
            stem,
            drawing,
            variant,
            conventional_moves,
            settings,
            table,
            report,
            motors,
        })
    }
}

impl Job {
    /// Unit times of the path, without those appended.
    pub fn path_units(&self) -> usize {
        self.report.units - self.report.appended_units
    }
}

/// Returns a compile error with its file and line.
pub fn table_fault(
    loaded: &Loaded,
    drawing: &Drawing,
    settings: &Settings,
    error: TableError,
) -> Fault {
    let in_drawing = |line, field: String, problem, allowed| {
        drawing_fault(drawing, line, &field, problem, allowed)
    };
    match error {
        TableError::Setting(error) => loaded.refuse(error),
        TableError::Position { line, axis, steps } => {
            let per_mm = &settings.steps_per_mm;
            let problem = format!("is {steps} steps at {per_mm:?} steps/mm");
            let allowed = format!("{} to {} steps", i32::MIN, i32::MAX);
            in_drawing(line, axis.to_owned(), problem, allowed)
        }
        TableError::TooLong { units, most } => {
            let problem = format!("the path takes {units} unit times");
            let allowed = format!("{most}: fewer moves, a higher feed or longer unit times");
            in_drawing(0, "path".into(), problem, allowed)
        }
        TableError::Plan(error) => plan_fault(loaded, drawing, error),
        error @ TableError::ScaledHalfPeriod { .. } => {
            let allowed = "a smaller ratio".to_owned();
            in_drawing(0, "--scale".into(), error.to_string(), allowed)
        }
    }
}
