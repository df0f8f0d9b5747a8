//! Program of a run: the path, its profile over time, and the words of both and of the servos.

use super::axis_limits;
use super::job::controller;
use super::load_torque::{LoadStep, load_steps};
use super::planner::plan;
use super::profile::Profile;
use super::profile_record::records;
use super::segments::{FourthAxis, Path};
use super::servo_gains::ServoGains;
use super::settings::{Correction, FeedbackGains, Gains, Motion, Settings};
use super::speed_limits::spans;
use crate::circuits::trajectory_controller::path_point::AXES;
use crate::circuits::trajectory_controller::{Rounding, Widths};
use crate::input::{COORDINATES, Point, ZERO_MM};
use crate::path::error::{PathError, Reason};
use crate::path::pieces::Piece;
use crate::path::record::Record;
use crate::plant::TwoMassParameters;
use crate::settings::{Place, SettingError, tidy};

/// Greatest relative difference of the counts per millimetre on the path and at the encoder.
const SAME: f64 = 1e-9;

/// Path that is ready to run.
#[derive(Debug, Clone, PartialEq)]
pub struct Program {
    /// Path by its length.
    pub path: Path,
    /// Length over time, in guard units and seconds.
    pub profile: Profile,
    /// Words of the profile.
    pub records: Vec<Record>,
    /// Period Δt in ticks.
    pub period_ticks: u32,
    /// Limits used for planning.
    pub motion: Motion,
    /// Gains K1 and K2 of each axis.
    pub gains: Vec<Gains>,
    /// Gains of the tangential response: those of the slowest axis, for which no other has to
    /// wait.
    pub tangential: Gains,
    /// Gains of the error feedback.
    pub feedback: FeedbackGains,
    /// Gains of the servos, one for each machine parameter; others are 0.
    pub servo: [ServoGains; AXES],
    /// External torques on the loads.
    pub load_steps: Vec<LoadStep>,
    /// Start of the path in guard units, where the motors are at 0.
    pub origin: [i64; AXES],
}

/// Greatest number of periods of a path: the records of its profile then fit into memory.
pub const MOST_PERIODS: u64 = 1 << 32;

/// Reason why there is no program.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ProgramError {
    /// A piece of the path is at fault.
    #[error(transparent)]
    Path(#[from] PathError),
    /// A setting or a parameter of an axis is at fault.
    #[error(transparent)]
    Setting(#[from] SettingError),
}

impl Program {
    /// Plans the path of `pieces` from `start` on, for two or three axes, the number in `machine`.
    ///
    /// # Errors
    /// Returns the first setting, piece or axis at fault. Two axes stay in the plane of `start`.
    pub fn of(
        start: Point,
        pieces: &[Piece],
        settings: &Settings,
        machine: &[TwoMassParameters],
        widths: &Widths,
    ) -> Result<Self, ProgramError> {
        Self::with_fourth(start, pieces, None, settings, machine, widths)
    }

    /// Plans a path for four axes, if there is a fourth.
    ///
    /// # Errors
    /// Returns the errors of [`Program::of`], and an error for a period that is too short for a
    /// fourth axis.
    pub fn with_fourth(
        start: Point,
        pieces: &[Piece],
        fourth: Option<&FourthAxis>,
        settings: &Settings,
        machine: &[TwoMassParameters],
        widths: &Widths,
    ) -> Result<Self, ProgramError> {
        let mut motion = settings.motion(widths)?;
        let (axes, allowed) = match fourth {
            None => (2..=COORDINATES, "2 or 3"),
            Some(_) => (AXES..=AXES, "4"),
        };
        if !axes.contains(&machine.len()) {
            return Err(SettingError::value("axes", machine.len(), allowed).into());
        }
        let period_ticks = settings.period_ticks(widths)?;
        let least = controller(machine.len(), Correction::Vector, Rounding::Nearest).least_period();
        if u64::from(period_ticks) < least {
            let problem = format!("is {}: {period_ticks} ticks", settings.period_ms);
            let allowed = format!("{least} ticks or more for {} axes", machine.len());
            return Err(SettingError::new("period_ms", problem, allowed).into());
        }
        let gains = settings.gains(widths, machine.len())?;
        if let Some(told) = &settings.axis_acceleration_mm_per_s2 {
            told.check("axis_acceleration_mm_per_s2", machine.len())?;
        }
        motion.contour_acceleration = settings.contour_acceleration(widths, &gains)?;
        let feedback = settings.feedback_gains(widths)?;
        let slowest = gains.iter().min_by_key(|gains| (gains.k1, gains.k2));
        let tangential = slowest.copied().unwrap_or(gains[0]);
        settings
            .inertia_factor
            .check("inertia_factor", machine.len())?;
        let load_steps = load_steps(&settings.load_torque, machine.len(), settings.clock_hz)?;
        let mut servo = [ServoGains::default(); AXES];
        for (axis, parameters) in machine.iter().enumerate() {
            servo[axis] = ServoGains::of(settings, axis, parameters, widths)?;
            let (own, path) = (parameters.counts_per_mm(), settings.counts_per_mm);
            if (own / path - 1.0).abs() > SAME {
                let problem = format!(
                    "is {}, which gives {} counts per mm",
                    parameters.mm_per_rev,
                    tidy(own)
                );
                let allowed = format!(
                    "{}, for {path} counts per mm as in counts_per_mm",
                    tidy(parameters.counts_per_rev / path)
                );
                let error = SettingError::new("mm_per_rev", problem, allowed);
                return Err(error.at(Place::Row("axis", axis)).into());
            }
        }
        if machine.len() < COORDINATES {
            flat(start, pieces)?;
        }
        let per_mm = settings.counts_per_mm;
        let mut path = Path::with_fourth(start, pieces, fourth, per_mm, widths)?;
        let speeds = path.stretches.iter().map(|stretch| stretch.speed);
        let fastest = speeds.fold(0.0, f64::max);
        if let Some(acceleration) = settings.acceleration_to(fastest)? {
            motion.slope.acceleration = acceleration * motion.units_per_mm;
        }
        let along = axis_limits::along(&path, &motion.axis_acceleration);
        let most = along * motion.units_per_mm;
        motion.slope.acceleration = motion.slope.acceleration.min(most);
        let spans = spans(&path, &motion);
        path.widen(&spans, tangential.radial_s2(widths, motion.period));
        let profile = plan(&spans, motion.slope);
        let periods = profile.duration / motion.period;
        if periods > MOST_PERIODS as f64 {
            let ms = settings.period_ms;
            let problem = format!("the path takes {periods:.0} periods of {ms} ms");
            let allowed = format!("{MOST_PERIODS}: a faster or shorter path, or longer periods");
            return Err(SettingError::new("period_ms", problem, allowed).into());
        }
        let origin = path.place(0.0).map(|units| units.round() as i64);
        Ok(Program {
            records: records(&profile, motion.period, widths),
            path,
            profile,
            period_ticks,
            motion,
            gains,
            tangential,
            feedback,
            servo,
            load_steps,
            origin,
        })
    }
}

/// Checks that a path stays at its z.
fn flat(start: Point, pieces: &[Piece]) -> Result<(), PathError> {
    for (piece, of) in pieces.iter().enumerate() {
        let leaves = of.course.extremes(of.to)[2].map(|z| z - start[2]);
        if let Some(&off) = leaves.iter().find(|off| off.abs() > ZERO_MM) {
            return Err(PathError {
                piece,
                line: of.line,
                reason: Reason::Plane { off },
            });
        }
    }
    Ok(())
}
