//! What a run is judged by: how far the commands and the motors were off the ideal lines.

use crate::circuits::linear_interpolator::Rule;
use std::ops::Range;

/// One scan of a run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ScanRecord {
    /// The tick in which the command stands.
    pub tick: u64,
    /// Commanded position of X and Y, in counts.
    pub command: [i64; 2],
    /// True position of the motors, in counts.
    pub motor: [f64; 2],
}

/// One positioning cycle of a run.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Cycle {
    /// Where it starts, in counts.
    pub from: [i64; 2],
    /// Where it is to end.
    pub to: [i64; 2],
    /// The axis that leads, or has the longer way where none does: 0 is X, 1 is Y.
    pub master: usize,
    /// Its records, from the first command to the last.
    pub scans: Range<usize>,
    /// The command when it ended.
    pub end: [i64; 2],
}

/// What was seen of a run.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Played {
    /// Ticks of the run.
    pub ticks: u64,
    /// Every scan.
    pub records: Vec<ScanRecord>,
    /// Every cycle, in order.
    pub cycles: Vec<Cycle>,
    /// A scan came before the command of the scan before was ready.
    pub late: bool,
    /// Targets that were too far away.
    pub refused: u64,
    /// X and Y: the feedback counter has lost counts.
    pub lost: [bool; 2],
    /// An axis did not come into position, and the run was given up.
    pub unsettled: bool,
    /// X and Y: scans in which the speed command was at its limit.
    pub saturated_scans: [u64; 2],
}

impl Played {
    /// The records of a cycle, and those of the wait after it: until the next one begins.
    #[must_use]
    pub fn records_of(&self, cycle: usize) -> &[ScanRecord] {
        let Some(this) = self.cycles.get(cycle) else {
            return &[];
        };
        let end = match self.cycles.get(cycle + 1) {
            Some(next) => next.scans.start,
            None => self.records.len(),
        };
        self.records.get(this.scans.start..end).unwrap_or(&[])
    }

    /// The measures of every cycle; `counts_per_mm` is that of X and Y.
    #[must_use]
    pub fn segments(&self, counts_per_mm: [f64; 2]) -> Vec<Segment> {
        (0..self.cycles.len())
            .map(|cycle| self.segment(cycle, counts_per_mm))
            .collect()
    }

    fn segment(&self, number: usize, counts_per_mm: [f64; 2]) -> Segment {
        let cycle = &self.cycles[number];
        let (master, slave) = (cycle.master, 1 - cycle.master);
        let delta = cycle.delta();
        let commands = self.records.get(cycle.scans.clone()).unwrap_or(&[]);
        let off = commands.iter().map(|record| cycle.off(record.command));
        let off = off.max().unwrap_or(0);
        let divisor = delta[master].unsigned_abs();
        let length = (delta[master] as f64).hypot(delta[slave] as f64);
        let largest = |scale: [f64; 2]| {
            let motors = self.records_of(number).iter();
            motors
                .map(|record| cycle.contour_error(record.motor, scale).abs())
                .fold(0.0, f64::max)
        };
        Segment {
            delta,
            acceleration: cycle.acceleration(commands),
            master,
            scans: commands.len(),
            end_error: [0, 1].map(|axis| cycle.end[axis] - cycle.to[axis]),
            deviation: Deviation {
                numerator: off,
                denominator: u128::from(divisor.max(1)),
            },
            perpendicular_counts: if length > 0.0 {
                off as f64 / length
            } else {
                0.0
            },
            contour_counts: largest([1.0; 2]),
            contour_um: largest(counts_per_mm) * 1e3,
        }
    }
}

impl Cycle {
    /// The way in X and Y.
    #[must_use]
    pub fn delta(&self) -> [i64; 2] {
        [0, 1].map(|axis| self.to[axis] - self.from[axis])
    }

    /// The largest second difference of commands that begin and end at rest.
    fn acceleration(&self, commands: &[ScanRecord]) -> [u64; 2] {
        let Some(last) = commands.last() else {
            return [0; 2];
        };
        let stands = |at| std::iter::repeat_n(at, 2);
        let course = commands.iter().map(|record| record.command);
        let course = stands(self.from).chain(course).chain(stands(last.command));
        let course: Vec<[i64; 2]> = course.collect();
        [0, 1].map(|axis| {
            let second = |three: &[[i64; 2]]| three[0][axis] - 2 * three[1][axis] + three[2][axis];
            let changes = course.windows(3).map(|three| second(three).unsigned_abs());
            changes.max().unwrap_or(0)
        })
    }

    /// |Δm·(s − s0) − Δs·(m − m0)|: |Δm| times the deviation of a point along the slave axis, and
    /// the length of the segment times its perpendicular distance.
    fn off(&self, point: [i64; 2]) -> u128 {
        let delta = self.delta().map(i128::from);
        let at = [0, 1].map(|axis| i128::from(point[axis]) - i128::from(self.from[axis]));
        (delta[0] * at[1] - delta[1] * at[0]).unsigned_abs()
    }

    /// Where a point is off the line through the segment, to the left of it positive: the nearest
    /// point of the line, and the distance, in counts over `scale`.
    #[must_use]
    pub fn foot(&self, point: [f64; 2], scale: [f64; 2]) -> ([f64; 2], f64) {
        let from = [0, 1].map(|axis| self.from[axis] as f64 / scale[axis]);
        let delta = [0, 1].map(|axis| self.delta()[axis] as f64 / scale[axis]);
        let at = [0, 1].map(|axis| point[axis] / scale[axis] - from[axis]);
        let length = delta[0].hypot(delta[1]);
        if length == 0.0 {
            return (from, at[0].hypot(at[1]));
        }
        let unit = delta.map(|part| part / length);
        let along = unit[0] * at[0] + unit[1] * at[1];
        let off = unit[0] * at[1] - unit[1] * at[0];
        ([0, 1].map(|axis| from[axis] + along * unit[axis]), off)
    }

    /// The contour error of a point: its distance from the line through the segment, to the left
    /// of it positive, in counts over `scale`.
    #[must_use]
    pub fn contour_error(&self, point: [f64; 2], scale: [f64; 2]) -> f64 {
        self.foot(point, scale).1
    }
}

/// A deviation along the slave axis, exact, in counts (LSB).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Deviation {
    /// |Δm·(s − s0) − Δs·(m − m0)|.
    pub numerator: u128,
    /// |Δm|.
    pub denominator: u128,
}

impl Deviation {
    /// In LSB.
    #[must_use]
    pub fn lsb(self) -> f64 {
        self.numerator as f64 / self.denominator as f64
    }

    /// Whether the rule allows for it: below 1 LSB, centred at most one half.
    #[must_use]
    pub fn is_within(self, rule: Rule) -> bool {
        match rule {
            Rule::Floor | Rule::Truncating => self.numerator < self.denominator,
            Rule::Centred => 2 * self.numerator <= self.denominator,
        }
    }
}

/// The measures of one cycle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Segment {
    /// Δx and Δy in counts.
    pub delta: [i64; 2],
    /// The axis that leads, or has the longer way where none does: 0 is X, 1 is Y.
    pub master: usize,
    /// Scans from the first command to the last, both counted.
    pub scans: usize,
    /// The command at the end less the target.
    pub end_error: [i64; 2],
    /// X and Y: the largest change of the commanded speed from scan to scan, from rest to rest, in
    /// counts per scan.
    pub acceleration: [u64; 2],
    /// Largest deviation of a command from the ideal line, along the slave axis.
    pub deviation: Deviation,
    /// The same perpendicular to the line, in counts.
    pub perpendicular_counts: f64,
    /// Largest distance of the motors from the line until the next cycle begins, in counts.
    pub contour_counts: f64,
    /// The same in micrometres.
    pub contour_um: f64,
}
