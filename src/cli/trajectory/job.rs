//! What a run of the trajectory controller begins with: a path, planned, and its machine.

use crate::cli::Failure;
use crate::cli::job::{Source, drawing_fault};
use motion_rtl::arc_generator::error::{PathError, Reason};
use motion_rtl::arc_generator::path::{Piece, from_drawing, from_points};
use motion_rtl::input::scenario::Loaded;
use motion_rtl::input::scenario::trajectory_controller::Scenario;
use motion_rtl::input::{Drawing, Fault, Point};
use motion_rtl::plant::TwoMassParameters;
use motion_rtl::trajectory_controller::program::{Program, ProgramError};
use motion_rtl::trajectory_controller::settings::{SettingError, Settings};
use motion_rtl::trajectory_controller::widths::Widths;

/// Where the path begins if nothing says so.
const ORIGIN: Point = [0.0; 3];

/// Keys of a machine: theirs are the faults that are not the scenario's own.
const MACHINE: [&str; 14] = [
    "max_torque_nm",
    "motor_inertia_kg_m2",
    "load_inertia_kg_m2",
    "stiffness_nm_per_rad",
    "counts_per_rev",
    "mm_per_rev",
    "damping_nm_s_per_rad",
    "backlash_rad",
    "motor_viscous_nm_s_per_rad",
    "load_viscous_nm_s_per_rad",
    "motor_friction_nm",
    "load_friction_nm",
    "motor_stiction_nm",
    "load_stiction_nm",
];

/// A path ready to be run.
#[derive(Debug)]
pub struct Job {
    /// What its files are called.
    pub stem: String,
    /// The input; none where the scenario has the path.
    pub drawing: Option<Drawing>,
    /// Its settings.
    pub settings: Settings,
    /// The path and the words.
    pub program: Program,
    /// Motor and load of each axis.
    pub machines: Vec<TwoMassParameters>,
    /// The pieces that are rapid moves.
    rapid: Vec<bool>,
    /// The scenario it came from.
    pub loaded: Loaded,
}

impl Job {
    /// Plans a path.
    pub fn prepare(source: Source, scenario: &Scenario) -> Result<Self, Failure> {
        let (settings, loaded) = (scenario.settings(), &source.loaded);
        let refuse = |error: SettingError| loaded.fault(error.field, error.problem, error.allowed);
        let taught = scenario.taught().map_err(refuse)?;
        let drawing = match (source.drawing_if_any(), taught.is_empty()) {
            (Some(_), false) => return Err(not_both(loaded).into()),
            (Some(drawing), true) => Some(drawing?),
            (None, false) => None,
            (None, true) => return Err(no_path(loaded).into()),
        };
        let refuse_path = |error: PathError| fault(loaded, drawing.as_ref(), &settings, &error);
        let (start, pieces): (Point, Vec<Piece>) = match &drawing {
            Some(_) if scenario.start_mm != ORIGIN => {
                let problem = format!("is {:?} beside an input", scenario.start_mm);
                let allowed = "where the drawing begins: no start_mm".to_owned();
                return Err(loaded.fault("start_mm", problem, allowed).into());
            }
            Some(drawing) => {
                let pieces = from_drawing(drawing, &settings);
                (drawing.start, pieces.map_err(refuse_path)?)
            }
            None => {
                let pieces = from_points(scenario.start_mm, &taught, &settings);
                (scenario.start_mm, pieces.map_err(refuse_path)?)
            }
        };
        let in_z = pieces.iter().any(|piece| piece.to[2] != start[2]);
        let axes = scenario.axes(in_z).map_err(refuse)?;
        let machines = scenario.machines(axes).map_err(refuse)?;
        let program = Program::of(start, &pieces, &settings, &machines, &Widths::FULL);
        let program = program.map_err(|error| match error {
            ProgramError::Path(error) => refuse_path(error),
            ProgramError::Setting { axis, error } => machine_fault(loaded, scenario, axis, error),
        })?;
        let moves = drawing.iter().flat_map(|drawing| &drawing.moves);
        let rapid = moves.map(|step| step.rapid).collect();
        let Source { stem, loaded, .. } = source;
        Ok(Job {
            stem,
            drawing,
            settings,
            program,
            machines,
            rapid,
            loaded,
        })
    }

    /// How many axes there are.
    pub fn axes(&self) -> usize {
        self.machines.len()
    }

    /// Δt in seconds.
    pub fn period_s(&self) -> f64 {
        self.program.motion.period
    }

    /// Whether a piece is a rapid move.
    pub fn is_rapid(&self, piece: usize) -> bool {
        self.rapid.get(piece).copied().unwrap_or(false)
    }

    /// Ticks that the path takes, for the progress bar.
    pub fn ticks_at_least(&self) -> u64 {
        let periods = (self.program.profile.duration / self.period_s()).ceil() as u64;
        periods.saturating_mul(u64::from(self.program.period_ticks))
    }
}

fn no_path(loaded: &Loaded) -> Fault {
    let allowed = "tables [[piece]], or an input: an HPGL drawing or a G-code program".to_owned();
    loaded.fault("piece", "missing".to_owned(), allowed)
}

fn not_both(loaded: &Loaded) -> Fault {
    let allowed = "a drawing or pieces, not both".to_owned();
    loaded.fault("piece", "given beside an input".to_owned(), allowed)
}

/// A setting, or a parameter of an axis, with the line it stands in.
fn machine_fault(
    loaded: &Loaded,
    scenario: &Scenario,
    axis: Option<usize>,
    error: SettingError,
) -> Fault {
    let SettingError {
        field,
        problem,
        allowed,
    } = error;
    match axis.filter(|_| MACHINE.contains(&field)) {
        None => loaded.fault(field, problem, allowed),
        Some(axis) if !scenario.axis.is_empty() => {
            loaded.table_fault(("axis", axis), field, problem, allowed)
        }
        Some(_) => loaded.part_fault("machine", field, problem, allowed),
    }
}

/// What cannot be run, with the file and line it stands in.
fn fault(
    loaded: &Loaded,
    drawing: Option<&Drawing>,
    settings: &Settings,
    error: &PathError,
) -> Fault {
    let PathError {
        piece,
        line,
        reason,
    } = error;
    let (problem, allowed) = (reason.to_string(), reason.allowed());
    if let Reason::Empty = reason {
        return loaded.fault(reason.field(), problem, allowed);
    }
    let Some(drawing) = drawing else {
        return match reason {
            Reason::Segments { .. } => loaded.fault(reason.field(), problem, allowed),
            _ => loaded.table_fault(("piece", *piece), reason.field(), problem, allowed),
        };
    };
    let step = drawing.moves.get(*piece);
    // A speed may come from the scenario: its key is at fault then, on account of this line.
    let field = match (reason.word(), step) {
        ("F", Some(step)) if step.rapid => "rapid_mm_per_s",
        ("F", Some(step)) if step.feed_mm_per_min.is_none() && settings.feed_mm_per_s.is_some() => {
            "feed_mm_per_s"
        }
        (word, _) => word,
    };
    let allowed = match reason {
        Reason::NoSpeed => "a feed, or feed_mm_per_s for all".to_owned(),
        _ => allowed,
    };
    drawing_fault(drawing, line.unwrap_or(0), field, problem, allowed)
}
