//! What `run` and `table` begin with: scenario, input, settings, table.

use super::Failure;
use super::shipped::{self, SHIPPED};
use clap::Args;
use indicatif::{ProgressBar, ProgressFinish};
use motion_rtl::input::scenario::{BARE, Loaded, Scenario, VariantName};
use motion_rtl::input::{Drawing, Fault, read_path};
use motion_rtl::plan::{FEED_RANGE, MotionLimits, PlanError};
use motion_rtl::pulse_interpolator::{
    Report, Settings, StepTiming, Table, TableError, Variant, compile,
};
use std::path::{Path, PathBuf};
use std::time::Duration;

/// What to run.
#[derive(Debug, Default, Args)]
pub struct Input {
    /// Scenario (.toml), HPGL drawing or G-code program; without it the scenario that ships with
    /// the crate.
    pub input: Option<PathBuf>,
    /// Overrides a key of the scenario.
    #[arg(long = "set", value_name = "KEY=VALUE")]
    pub sets: Vec<String>,
}

/// An input ready to be run.
#[derive(Debug)]
pub struct Job {
    /// The scenario it came from.
    pub loaded: Loaded,
    /// What its files are called.
    pub stem: String,
    /// The input.
    pub drawing: Drawing,
    /// Its settings.
    pub settings: Settings,
    /// The pattern memory's contents.
    pub table: Table,
    /// What came of the compilation.
    pub report: Report,
}

impl Job {
    /// Reads the input and compiles it.
    pub fn prepare(input: &Input) -> Result<Self, Failure> {
        let (loaded, drawing, name) = read(input)?;
        let settings = settings(&loaded.scenario, &drawing);
        let spinner = ProgressBar::new_spinner()
            .with_message("compiling")
            .with_finish(ProgressFinish::AndClear);
        spinner.enable_steady_tick(Duration::from_millis(100));
        let (table, report) = compile(&drawing, &settings)
            .map_err(|error| fault(&loaded, &drawing, &settings, error))?;
        spinner.finish_and_clear();
        let stem = name.file_stem().map_or_else(
            || "run".to_owned(),
            |stem| stem.to_string_lossy().into_owned(),
        );
        Ok(Job {
            loaded,
            stem,
            drawing,
            settings,
            table,
            report,
        })
    }

    /// The scenario.
    pub fn scenario(&self) -> &Scenario {
        &self.loaded.scenario
    }

    /// What RST clears.
    pub fn variant(&self) -> Variant {
        match self.scenario().variant {
            VariantName::Safe => Variant::Safe,
            VariantName::Literal => Variant::Literal,
        }
    }
}

fn read(input: &Input) -> Result<(Loaded, Drawing, PathBuf), Fault> {
    let path = match &input.input {
        None => Path::new(SHIPPED[0].file),
        Some(path) => path,
    };
    let shipped = match &input.input {
        None => SHIPPED.first(),
        Some(path) => shipped::find(path),
    };
    let is_scenario = path
        .extension()
        .is_some_and(|extension| extension.eq_ignore_ascii_case("toml"));
    let (loaded, drawing) = if let Some(shipped) = shipped {
        let loaded = shipped.load(&input.sets)?;
        let drawing = match &loaded.scenario.input {
            Some(other) if loaded.overrides("input") => read_path(other),
            _ => shipped.drawing(),
        };
        (loaded, drawing?)
    } else if is_scenario {
        let loaded = Loaded::read(path, &input.sets)?;
        let Some(drawing) = &loaded.scenario.input else {
            let allowed = "the path of an HPGL drawing or a G-code program".to_owned();
            return Err(loaded.fault("input", "missing".to_owned(), allowed));
        };
        let drawing = read_path(drawing)?;
        (loaded, drawing)
    } else {
        let loaded = Loaded::parse("defaults", BARE, &input.sets)?;
        if loaded.overrides("input") {
            let problem = format!("{} is the input", path.display());
            return Err(loaded.fault("input", problem, "input with a scenario only".to_owned()));
        }
        (loaded, read_path(path)?)
    };
    if loaded.scenario.vcd_ticks == 0 {
        let allowed = "1 to 9223372036854775807; --no-vcd for none".to_owned();
        return Err(loaded.fault("vcd_ticks", "is 0".to_owned(), allowed));
    }
    Ok((loaded, drawing, path.to_owned()))
}

fn settings(scenario: &Scenario, drawing: &Drawing) -> Settings {
    let moves_in_z = drawing
        .moves
        .iter()
        .any(|step| step.to[2] != drawing.start[2]);
    let axes = if moves_in_z { 3 } else { 2 };
    let steps_per_mm = scenario.steps_per_mm.clone();
    Settings {
        clock_hz: scenario.clock_hz,
        steps_per_mm: steps_per_mm.unwrap_or_else(|| vec![80.0; axes]),
        motion: MotionLimits {
            feed_mm_per_min: scenario.feed_mm_per_min,
            rapid_mm_per_min: scenario.rapid_mm_per_min,
            corner_mm_per_min: scenario.corner_mm_per_min,
            acceleration_mm_per_s2: scenario.acceleration_mm_per_s2,
        },
        line_unit_ticks: scenario.line_unit_ticks,
        arc_unit_ticks: scenario.arc_unit_ticks.unwrap_or(scenario.line_unit_ticks),
        timing: StepTiming {
            min_high: scenario.step_high_ticks,
            min_low: scenario.step_low_ticks,
            dir_setup: scenario.dir_setup_ticks,
            dir_hold: scenario.dir_hold_ticks,
        },
        ..Settings::default()
    }
}

/// What the compiler objects to, with the file and line it stands in.
fn fault(loaded: &Loaded, drawing: &Drawing, settings: &Settings, error: TableError) -> Fault {
    let in_drawing = |line, field: String, problem, allowed| Fault {
        file: drawing.file.clone(),
        line,
        field,
        problem,
        allowed,
    };
    match error {
        TableError::Setting {
            field,
            value,
            allowed,
        } => loaded.fault(field, format!("is {value}"), allowed),
        TableError::Plan(PlanError::Limit {
            field,
            value,
            least,
            most,
        }) => loaded.fault(field, format!("is {value}"), format!("{least} to {most}")),
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
        TableError::Plan(error) => {
            let (line, field, problem, allowed) = plan_fault(&error);
            in_drawing(line, field, problem, allowed)
        }
        error @ TableError::ScaledHalfPeriod { .. } => {
            let allowed = "a smaller ratio".to_owned();
            in_drawing(0, "--scale".into(), error.to_string(), allowed)
        }
    }
}

fn plan_fault(error: &PlanError) -> (usize, String, String, String) {
    match error {
        PlanError::Limit {
            field,
            value,
            least,
            most,
        } => {
            let allowed = format!("{least} to {most}");
            (0, (*field).to_owned(), format!("is {value}"), allowed)
        }
        PlanError::Feed { line, value } => {
            let (least, most) = (FEED_RANGE.start(), FEED_RANGE.end());
            let allowed = format!("{least} to {most} mm/min");
            (*line, "F".to_owned(), format!("is {value} mm/min"), allowed)
        }
        PlanError::Coordinate {
            line,
            coordinate,
            value,
            reach,
        } => {
            let allowed = format!("-{reach} to {reach} mm");
            (
                *line,
                (*coordinate).to_owned(),
                format!("is {value} mm"),
                allowed,
            )
        }
        PlanError::Radius { line, radius_mm } => {
            let allowed = "a radius above 0".to_owned();
            (
                *line,
                "arc".to_owned(),
                format!("has a radius of {radius_mm} mm"),
                allowed,
            )
        }
    }
}
