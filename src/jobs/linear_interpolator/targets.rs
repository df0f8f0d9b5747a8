//! Conversion of a drawing to positioning cycles: the target data 20.
//!
//! Every straight move is one cycle; an arc has one cycle per chord. Targets are the drawing's
//! points rounded to encoder counts separately, so that errors do not add up. Z is ignored.

use super::profile::{Profile, SLOWEST, SPEED_ONE, speed_word};
use super::settings::{AXIS_NAMES, Settings};
use crate::circuits::linear_interpolator::{LinearInterpolator, MasterAxis, Rule, Widths};
use crate::input::{Drawing, Point};
use crate::plan::digits::round_up;
use crate::plan::{PlanError, check, chords};
use crate::settings::{SettingError, tidy};

/// Number of ticks that the dividers need within a scan.
pub const LATENCY_TICKS: u32 = {
    let interpolator = LinearInterpolator {
        widths: Widths::FULL,
        rule: Rule::Floor,
        master: MasterAxis::Longer,
    };
    interpolator.latency() as u32
};

/// Greatest time of acceleration and of deceleration, in scans.
pub const LONGEST_RAMP: u64 = (1 << TIME_BITS) - 1;

/// Width of these times in bits.
pub(super) const TIME_BITS: usize = Widths::FULL.time;

/// Greatest absolute value of a position, in counts.
pub const REACH_COUNTS: i64 = 1 << 30;

/// Greatest number of cycles of a drawing.
pub const MOST_TARGETS: usize = 1 << 20;

/// Greatest number of steady scans of a cycle.
const MOST_STEADY: f64 = i32::MAX as f64;

/// Positioning cycle with `N` settings of speed and times: one for the master axis, or one each
/// for X and Y.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Target<const N: usize = 1> {
    /// X in counts.
    pub x: i64,
    /// Y in counts.
    pub y: i64,
    /// Speeds and times.
    pub profiles: [Profile; N],
    /// Requested speed along the line, in mm/min.
    pub feed_mm_per_min: f64,
    /// Line of the input; 0 for the way to a start that is not the origin.
    pub line: usize,
    /// True if the pen is up.
    pub rapid: bool,
}

/// Cycles of a drawing.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Targets {
    /// Cycles; they begin at the origin, where the command registers are at power-on.
    pub targets: Vec<Target>,
    /// Number of points left out because their counts equal those of the point before.
    pub dropped: usize,
    /// True if the drawing moves in Z, which no axis drives.
    pub moves_in_z: bool,
}

/// Reason why a drawing cannot be converted to cycles.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum TargetError {
    /// A setting is out of range.
    #[error(transparent)]
    Setting(#[from] SettingError),
    /// The drawing has a value that cannot be used.
    #[error(transparent)]
    Drawing(#[from] PlanError),
    /// A feed is above 100 % speed, or makes an encoder move by more than one count per tick.
    #[error("line {line}: feed {} mm/min: allowed are up to {}", tidy(*value), tidy(*most))]
    Feed {
        /// Line of the input.
        line: usize,
        /// Feed in mm/min.
        value: f64,
        /// Greatest feed in mm/min.
        most: f64,
    },
    /// A feed makes the master axis so slow that the fraction of its speed is too coarse, or that
    /// the cycle has too many scans.
    #[error(
        "line {line}: feed {} mm/min: allowed are {least} and more in this direction",
        tidy(*value)
    )]
    Slow {
        /// Line of the input; 0 for the way to a start that is not the origin.
        line: usize,
        /// Feed in mm/min.
        value: f64,
        /// Least feed in this direction in mm/min, rounded up to six digits.
        least: f64,
    },
    /// A position is out of reach.
    #[error("line {line}: {axis} = {counts} counts: allowed are -{REACH_COUNTS} to {REACH_COUNTS}")]
    Position {
        /// Line of the input.
        line: usize,
        /// Axis: "x" or "y".
        axis: &'static str,
        /// Position in counts.
        counts: f64,
    },
    /// There are more than [`MOST_TARGETS`] cycles.
    #[error("line {line}: more than {MOST_TARGETS} cycles")]
    TooMany {
        /// Line of the input.
        line: usize,
    },
}

/// Converts a drawing to cycles.
///
/// # Errors
///
/// Returns an error for a setting out of range; a coordinate, feed or radius that cannot be used;
/// a feed that an encoder cannot follow, above 100 % speed or too slow; a position out of reach;
/// more than [`MOST_TARGETS`] cycles.
pub fn compile(drawing: &Drawing, settings: &Settings) -> Result<Targets, TargetError> {
    settings.validate()?;
    check(drawing)?;
    let mut compiler = Compiler {
        settings,
        at: [0; 2],
        made: Targets::default(),
    };
    let start = compiler.counts(0, drawing.start)?;
    if start != [0; 2] {
        compiler.go(start, settings.rapid_mm_per_min, 0, true)?;
    }
    let mut z = drawing.start[2];
    for (index, step) in drawing.moves.iter().enumerate() {
        compiler.made.moves_in_z |= step.to[2] != z;
        z = step.to[2];
        let feed = match step.rapid {
            true => settings.rapid_mm_per_min,
            false => step.feed_mm_per_min.unwrap_or(settings.feed_mm_per_min),
        };
        let (line, most) = (step.line, settings.fastest_mm_per_min());
        if feed > most {
            let value = feed;
            return Err(TargetError::Feed { line, value, most });
        }
        for point in chords::ends(drawing, index, settings.chord_tolerance_mm) {
            let to = compiler.counts(line, point)?;
            compiler.go(to, feed, line, step.rapid)?;
        }
    }
    Ok(compiler.made)
}

struct Compiler<'a> {
    settings: &'a Settings,
    at: [i64; 2],
    made: Targets,
}

impl Compiler<'_> {
    /// Converts a point to counts.
    fn counts(&self, line: usize, point: Point) -> Result<[i64; 2], TargetError> {
        let mut counts = [0; 2];
        for axis in 0..2 {
            let exact = (point[axis] * self.settings.counts_per_mm[axis]).round();
            if exact.abs() > REACH_COUNTS as f64 {
                return Err(TargetError::Position {
                    line,
                    axis: AXIS_NAMES[axis],
                    counts: exact,
                });
            }
            counts[axis] = exact as i64;
        }
        Ok(counts)
    }

    /// Adds the cycle to a point, unless the last one ends there.
    fn go(&mut self, to: [i64; 2], feed: f64, line: usize, rapid: bool) -> Result<(), TargetError> {
        if to == self.at {
            self.made.dropped += 1;
            return Ok(());
        }
        if self.made.targets.len() == MOST_TARGETS {
            return Err(TargetError::TooMany { line });
        }
        let settings = self.settings;
        let way = [0, 1].map(|axis| to[axis] - self.at[axis]);
        let [x_mm, y_mm] = [0, 1].map(|axis| way[axis] as f64 / settings.counts_per_mm[axis]);
        let master = settings.master.of(way);
        let own = way[master].unsigned_abs();
        let scans = x_mm.hypot(y_mm) / (feed / 60.0) / settings.scan_s();
        let exact = own as f64 / scans;
        let slowest = SLOWEST.max(own as f64 / MOST_STEADY);
        let Some(speed) = speed_word(exact).filter(|_| exact >= slowest) else {
            let least = round_up(feed * slowest / exact);
            let value = feed;
            return Err(TargetError::Slow { line, value, least });
        };
        let speed = speed.min(u64::from(settings.scan_ticks) * SPEED_ONE);
        let short = Some(settings.short_moves);
        let profile = Profile::over(settings, master, own, speed, settings.ramp_scans(), short);
        self.made.targets.push(Target {
            x: to[0],
            y: to[1],
            profiles: [profile],
            feed_mm_per_min: feed,
            line,
            rapid,
        });
        self.at = to;
        Ok(())
    }
}
