//! Input of a run of the machine: a prepared job for all circuits.

use crate::cli::pieces::{SpeedKeys, fault};
use crate::cli::pulse::table_fault;
use crate::cli::source::Source;
use crate::cli::{Failure, progress};
use motion_rtl::input::{Drawing, Fault};
use motion_rtl::jobs::machine::program::ProgramError;
use motion_rtl::jobs::machine::{Program, Settings};
use motion_rtl::jobs::pulse_interpolator::TableError;
use motion_rtl::jobs::trajectory_controller::program::ProgramError as TrajectoryError;
use motion_rtl::path::pieces::Speeds;
use motion_rtl::scenario::Loaded;
use motion_rtl::settings::{Place, SettingError};
use std::iter;

/// An input ready to be run.
#[derive(Debug)]
pub struct Job {
    /// Stem of the names of its files.
    pub stem: String,
    /// The input.
    pub drawing: Drawing,
    /// Its settings.
    pub settings: Settings,
    /// Program of every circuit.
    pub program: Program,
    /// The scenario it came from.
    pub loaded: Loaded,
}

impl Job {
    /// Prepares an input for all circuits.
    pub fn prepare(source: Source, settings: Settings) -> Result<Self, Failure> {
        let drawing = source.drawing()?;
        progress::stage("planning the path");
        let program = Program::of(&drawing, &settings)
            .map_err(|error| refuse(&source.loaded, &drawing, &settings, error))?;
        let Source { stem, loaded, .. } = source;
        Ok(Job {
            stem,
            drawing,
            settings,
            program,
            loaded,
        })
    }

    /// Approximate ticks of the run, for the progress bar: those of the steppers, or those of the
    /// servos, which settle after each move and wait for the lift.
    pub fn ticks_at_least(&self) -> u64 {
        let (program, settings) = (&self.program, &self.settings);
        let pens = iter::once(true).chain(program.moves.iter().map(|step| step.rapid));
        let pens: Vec<_> = pens.collect();
        let liftings = pens.windows(2).filter(|pair| pair[0] != pair[1]).count();
        let (lift, speed) = (settings.lift(), f64::from(settings.lift_counts_per_s));
        let way = settings.pen_down_counts.unsigned_abs() as f64;
        let lift_s = way / speed + speed / settings.lift.acceleration_counts_per_s2;
        let lift_s = lift_s + (lift.rest_ms + lift.standstill_ms) / 1e3;
        // The loads follow the commands by 1/k1, and approach the ends exponentially.
        let speed = settings.motion.feed_mm_per_min / 60.0 * settings.counts_per_mm;
        let behind = speed / settings.k1_per_s / f64::from(settings.in_position_counts);
        let settling_s = behind.ln().max(0.0) / settings.k1_per_s;
        let servos_s =
            program.moving_s + liftings as f64 * lift_s + program.moves.len() as f64 * settling_s;
        let servos = (servos_s * settings.clock_hz as f64) as u64;
        program.table.total_ticks().max(servos)
    }
}

/// Returns a program error with its file and line.
fn refuse(loaded: &Loaded, drawing: &Drawing, settings: &Settings, error: ProgramError) -> Fault {
    let motion = &settings.motion;
    let keys = SpeedKeys {
        speeds: Speeds {
            wanted: Some(motion.feed_mm_per_min / 60.0),
            rapid: motion.rapid_mm_per_min / 60.0,
        },
        key: "feed_mm_per_min",
        rapid: "rapid_mm_per_min",
    };
    match error {
        ProgramError::Setting(error)
        | ProgramError::Table(TableError::Setting(error))
        | ProgramError::Trajectory(TrajectoryError::Setting(error)) => setting_fault(loaded, error),
        ProgramError::Path(error) | ProgramError::Trajectory(TrajectoryError::Path(error)) => {
            fault(loaded, Some(drawing), keys, &error)
        }
        ProgramError::Lift(error) => lift_fault(loaded, error),
        ProgramError::Table(error) => table_fault(loaded, drawing, &settings.pulse(), error),
    }
}

/// A setting of the machine, or of one of its circuits, as the machine has it.
fn setting_fault(loaded: &Loaded, error: SettingError) -> Fault {
    loaded.refuse(match error.place {
        // Both axes are as the one table.
        Some(Place::Row(..)) => error.at(Place::Table("machine")),
        _ => SettingError {
            field: key(error.field),
            ..error
        },
    })
}

/// The machine's key for a field of one of its circuits.
fn key(field: &'static str) -> &'static str {
    match field {
        "line_unit_ticks" | "arc_unit_ticks" => "unit_ticks",
        "sample_period_ms" | "period_ms" => "sample_ticks",
        "normal_acceleration_mm_per_s2" => "acceleration_mm_per_s2",
        field => field,
    }
}

/// A setting of the lift's compensator.
fn lift_fault(loaded: &Loaded, error: SettingError) -> Fault {
    let SettingError {
        field,
        problem,
        allowed,
        ..
    } = error;
    let key = match field {
        "target" => "pen_down_counts",
        "speed_counts_per_s" => "lift_counts_per_s",
        "lead_ms" => "lift_lead_ms",
        // Times that the machine has no keys for, in CKs that do not fit them.
        field => {
            let problem = format!("{field} of the lift {problem} ms");
            let allowed = format!("CKs by which it can be: {allowed}");
            return loaded.fault("ck_ticks", problem, allowed);
        }
    };
    loaded.fault(key, problem, allowed)
}
