//! Program of a job for all circuits: a table for the steppers; moves for the servos, each from
//! rest to rest, with the words of its line or arc and of its length over time.

use super::settings::Settings;
use crate::circuits::arc_generator::Widths as ArcWidths;
use crate::circuits::trajectory_controller::Widths;
use crate::input::{Drawing, Point};
use crate::jobs::arc_generator::prepare::prepare;
use crate::jobs::arc_generator::record::records as arc_records;
use crate::jobs::linear_interpolator::profile::{SLOWEST, SPEED_ONE, speed_word};
use crate::jobs::pulse_interpolator::{Report, Table, TableError, compile};
use crate::jobs::trajectory_controller::planner::plan;
use crate::jobs::trajectory_controller::profile::Profile;
use crate::jobs::trajectory_controller::profile_record::records as profile_records;
use crate::jobs::trajectory_controller::program::{
    Program as Path, ProgramError as TrajectoryError,
};
use crate::jobs::trajectory_controller::ramp::Slope;
use crate::jobs::trajectory_controller::speed_limits::{Span, spans};
use crate::path::circle::Circle;
use crate::path::error::{PathError, Reason};
use crate::path::pieces::{Course, Piece, Speeds, from_drawing};
use crate::path::record::Record;
use crate::path::vector::{add, sub};
use crate::settings::SettingError;

/// Kind of a servo move.
#[derive(Debug, Clone, PartialEq)]
pub enum Way {
    /// Target for the linear interpolator.
    Line {
        /// Steady speed: counts of the master axis per scan, times [`SPEED_ONE`].
        speed: u64,
    },
    /// Records for the arc generator.
    Arc {
        /// Number of its records in [`Program::arcs`].
        records: usize,
    },
}

/// Move of the servos, from rest to rest.
#[derive(Debug, Clone, PartialEq)]
pub struct Move {
    /// Index of its piece of the job.
    pub piece: usize,
    /// Line of the input.
    pub line: usize,
    /// True if the pen is up.
    pub rapid: bool,
    /// Circuit that makes it.
    pub way: Way,
    /// End, in counts from the start of the job.
    pub to: [i64; 2],
    /// Number of the records of its length over time in [`Program::profile`].
    pub records: usize,
}

impl Move {
    /// Returns the number of its records for the arc generator.
    #[must_use]
    pub fn arcs(&self) -> usize {
        match self.way {
            Way::Line { .. } => 0,
            Way::Arc { records } => records,
        }
    }
}

/// Job that is ready to run.
#[derive(Debug, Clone)]
pub struct Program {
    /// Pattern memory of the steppers.
    pub table: Table,
    /// Report on its compilation.
    pub report: Report,
    /// Pieces of the job in mm.
    pub pieces: Vec<Piece>,
    /// Start in mm.
    pub start: Point,
    /// Path, and words of the servos' settings.
    pub path: Path,
    /// Moves of the servos, in order.
    pub moves: Vec<Move>,
    /// Records of arcs and their blends, move after move.
    pub arcs: Vec<Record>,
    /// Records of the length over time, move after move.
    pub profile: Vec<Record>,
    /// Acceleration time of lines in scans.
    pub ramp_scans: u64,
    /// Duration of all moves in s, without the time in which the motors settle.
    pub moving_s: f64,
}

/// Reason why there is no program.
#[derive(Debug, thiserror::Error)]
pub enum ProgramError {
    /// A setting is at fault.
    #[error(transparent)]
    Setting(#[from] SettingError),
    /// A setting of the pen lift's compensator is at fault.
    #[error(transparent)]
    Lift(SettingError),
    /// A piece of the path is at fault.
    #[error(transparent)]
    Path(#[from] PathError),
    /// A setting of the servos, or of one axis, is at fault.
    #[error(transparent)]
    Trajectory(#[from] TrajectoryError),
    /// The steppers' table cannot be made.
    #[error(transparent)]
    Table(#[from] TableError),
}

impl Program {
    /// Prepares a drawing or a part program in the X-Y plane.
    ///
    /// # Errors
    /// Returns the first setting or move at fault: a value that does not fit into its word, a move
    /// out of the plane, more segments than the trajectory controller holds.
    pub fn of(drawing: &Drawing, settings: &Settings) -> Result<Self, ProgramError> {
        settings.validate()?;
        settings.lift().validate().map_err(ProgramError::Lift)?;
        let speeds = Speeds {
            wanted: Some(settings.motion.feed_mm_per_min / 60.0),
            rapid: settings.motion.rapid_mm_per_min / 60.0,
        };
        let (table, report) = compile(drawing, &settings.pulse())?;
        let pieces = from_drawing(drawing, speeds)?;
        let widths = Widths {
            segment: 8,
            ..Widths::FULL
        };
        let axes = [settings.machine; 2];
        let path = Path::of(
            drawing.start,
            &pieces,
            &settings.trajectory(),
            &axes,
            &widths,
        )?;
        let mut program = Program {
            table,
            report,
            start: drawing.start,
            path,
            moves: Vec::with_capacity(pieces.len()),
            arcs: Vec::new(),
            profile: Vec::new(),
            ramp_scans: settings.ramps()[0].periods,
            moving_s: 0.0,
            pieces: Vec::new(),
        };
        program.add_moves(drawing, &pieces, settings, &widths)?;
        program.pieces = pieces;
        Ok(program)
    }

    fn add_moves(
        &mut self,
        drawing: &Drawing,
        pieces: &[Piece],
        settings: &Settings,
        widths: &Widths,
    ) -> Result<(), ProgramError> {
        let counts =
            |point: Point| [0, 1].map(|k: usize| (point[k] * settings.counts_per_mm).round());
        let origin = counts(drawing.start);
        let unit = self.path.motion.units_per_mm;
        let limits = spans(&self.path.path, &self.path.motion);
        // Position of the arc generator: it counts motion on arcs only.
        let mut arc_at = [0.0; 2];
        for (stretch, limit) in self.path.path.stretches.iter().zip(&limits) {
            let index = stretch.piece;
            let (Some(piece), Some(step)) = (pieces.get(index), drawing.moves.get(index)) else {
                continue;
            };
            let from = match index {
                0 => drawing.start,
                _ => pieces[index - 1].to,
            };
            let way = [0, 1].map(|k| counts(piece.to)[k] - counts(from)[k]);
            let speed = limit.speed / unit;
            let fault = |reason| PathError {
                piece: index,
                line: Some(step.line),
                reason,
            };
            let (made, speed, ramp_s) = match piece.course.arc().map_err(fault)? {
                None => {
                    let ramp_s = self.ramp_scans as f64 * settings.scan_s();
                    let (word, speed) = line_speed(way, speed, settings).map_err(fault)?;
                    (Way::Line { speed: word }, speed, ramp_s)
                }
                Some(circle) => {
                    let refuse = |error: PathError| PathError {
                        piece: index,
                        line: Some(step.line),
                        ..error
                    };
                    let at = [arc_at[0], arc_at[1], 0.0];
                    let start = at.map(|counts| counts / settings.counts_per_mm);
                    let moved = [moved(piece, circle, start, speed)];
                    let timing = settings.arcs().timing(&ArcWidths::FULL)?;
                    let prepared = prepare(start, &moved, &timing).map_err(refuse)?;
                    let made = arc_records(
                        &prepared,
                        settings.counts_per_mm,
                        &ArcWidths::FULL,
                        settings.arcs().rounding,
                    )
                    .map_err(refuse)?;
                    let ended = counts(moved[0].to);
                    arc_at = ended;
                    let records = made.len();
                    self.arcs.extend(made);
                    (
                        Way::Arc { records },
                        prepared.pieces[0].speed,
                        2.0 * timing.half_blend_s(),
                    )
                }
            };
            let profile = length_in_time(stretch.begin, stretch.length, speed * unit, ramp_s);
            self.moving_s += profile.duration;
            let made_profile = profile_records(&profile, self.path.motion.period, widths);
            self.moves.push(Move {
                piece: index,
                line: step.line,
                rapid: step.rapid,
                way: made,
                to: [0, 1].map(|k| (counts(piece.to)[k] - origin[k]) as i64),
                records: made_profile.len(),
            });
            self.profile.extend(made_profile);
        }
        Ok(())
    }
}

/// Returns the word of a speed in mm/s over a line's distance in counts, and the exact speed of
/// that word, which the profile must have too: the interpolator's speed has limited fraction bits.
fn line_speed(way: [f64; 2], speed: f64, settings: &Settings) -> Result<(u64, f64), Reason> {
    let (length, master) = (way[0].hypot(way[1]), way[0].abs().max(way[1].abs()));
    if master == 0.0 {
        // Shorter than a count: only the profile moves.
        return Ok((1, speed));
    }
    // Counts per scan at one millimetre per second.
    let scale = settings.counts_per_mm * settings.scan_s() * master / length;
    let least = SLOWEST / scale;
    let word = speed_word(speed * scale).filter(|_| speed >= least);
    let word = word.ok_or(Reason::Slow { speed, least })?;
    Ok((word, word as f64 / SPEED_ONE as f64 / scale))
}

/// Returns an arc's piece moved to another start.
fn moved(piece: &Piece, circle: &Circle, start: Point, speed: f64) -> Piece {
    let by = sub(start, circle.start);
    let circle = Circle {
        centre: add(circle.centre, by),
        start,
        ..*circle
    };
    Piece {
        course: Course::Arc(circle),
        to: circle.end(),
        speed,
        line: piece.line,
    }
}

/// Returns a trapezoidal speed profile over a part of the path; a short one keeps its times and
/// has a lower peak, as in the interpolator.
fn length_in_time(begin: u64, length: u64, speed: f64, ramp_s: f64) -> Profile {
    let span = Span {
        length,
        speed: speed.min(length as f64 / ramp_s),
        entry: 0.0,
    };
    let slope = Slope {
        acceleration: span.speed / ramp_s,
        time_constant: 0.0,
        jerk_time: 0.0,
    };
    let mut profile = plan(&[span], slope);
    for piece in &mut profile.pieces {
        piece.q += begin as f64;
    }
    profile.length += begin as f64;
    profile
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The profile's speed is that of the interpolator's word, on any slope.
    #[test]
    fn a_line_goes_as_fast_as_its_word_says() {
        // 1000 counts per millimetre and a scan of a millisecond: one count per scan is one
        // millimetre per second.
        let settings = Settings::default();
        let speed = |way, speed| line_speed(way, speed, &settings);
        let (word, exact) = speed([4000.0, 0.0], 25.75).unwrap();
        assert_eq!((word, exact), (103 * SPEED_ONE / 4, 25.75));
        // Less than the last bit of the fraction is lost.
        let (word, exact) = speed([4000.0, 0.0], 25.0 + 1.9 / 4096.0).unwrap();
        assert_eq!(word, 25 * SPEED_ONE + 1);
        assert!((exact - 25.0 - 1.0 / 4096.0).abs() < 1e-9, "{exact}");
        // Three, four, five: the master axis has four fifths of the speed.
        let (word, exact) = speed([-3000.0, 4000.0], 25.0).unwrap();
        assert_eq!(word, 20 * SPEED_ONE);
        assert!((exact - 25.0).abs() < 1e-9, "{exact}");
        assert_eq!(speed([0.0, 0.0], 0.3).unwrap(), (1, 0.3));
        assert!(matches!(
            speed([3000.0, 4000.0], 0.03),
            Err(Reason::Slow { least, .. }) if (least - 1.25 * 100.0 / 4096.0).abs() < 1e-9
        ));
    }
}
