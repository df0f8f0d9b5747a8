//! Measures of a run: the deviation of commands and motors from the ideal lines.

use crate::circuits::linear_interpolator::Rule;
use serde::{Serialize, Serializer};
use std::ops::Range;

#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ScanRecord {
    /// Tick of the command.
    pub tick: u64,
    /// Commanded position of X and Y, in counts.
    pub command: [i64; 2],
    /// True position of the motors, in counts.
    pub motor: [f64; 2],
}

/// Scan with its context.
#[derive(Debug)]
pub struct Seen<'a> {
    /// Measured scan.
    pub record: ScanRecord,
    /// Cycle whose new command is in this scan.
    pub fresh: Option<usize>,
    /// Cycles so far.
    pub cycles: &'a [Cycle],
}

/// Positioning cycle of a run.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Cycle {
    /// Start in counts.
    pub from: [i64; 2],
    /// Target in counts.
    pub to: [i64; 2],
    /// Master axis, or the axis with the longer distance if there is none: 0 is X, 1 is Y.
    pub master: usize,
    /// Range of its records, from the first command to the last.
    pub scans: Range<usize>,
    /// Command at the end, in counts.
    pub end: [i64; 2],
}

/// Result of a run.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Played {
    /// Number of ticks.
    pub ticks: u64,
    /// All scans; empty for [`play_each`](super::job::play_each).
    pub records: Vec<ScanRecord>,
    /// All cycles in order.
    pub cycles: Vec<Cycle>,
    /// True if a scan came before the command of the scan before was ready.
    pub late: bool,
    /// Number of targets that were too far away.
    pub refused: u64,
    /// True for X and Y if the feedback counter has lost counts.
    pub lost: [bool; 2],
    /// True if an axis did not reach its position, and the run was given up.
    pub unsettled: bool,
    /// Numbers of scans of X and Y with the speed command at its limit.
    pub saturated_scans: [u64; 2],
}

impl Played {
    /// Returns the records of a cycle and of the wait after it, until the next one begins.
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

    /// Returns the measures of every cycle; `counts_per_mm` is for X and Y.
    #[must_use]
    pub fn segments(&self, counts_per_mm: [f64; 2]) -> Vec<Segment> {
        (0..self.cycles.len())
            .map(|cycle| self.segment(cycle, counts_per_mm))
            .collect()
    }

    fn segment(&self, number: usize, counts_per_mm: [f64; 2]) -> Segment {
        let cycle = &self.cycles[number];
        let mut measuring = CycleMeasuring::new(cycle, counts_per_mm);
        let behind = cycle.scans.len();
        for (place, record) in self.records_of(number).iter().enumerate() {
            measuring.take(cycle, record, place < behind);
        }
        measuring.finish(cycle)
    }
}

/// Measurement of all cycles during a run.
#[derive(Debug)]
pub struct Measuring {
    counts_per_mm: [f64; 2],
    segments: Vec<Segment>,
    /// Current cycle.
    latest: Option<CycleMeasuring>,
}

impl Measuring {
    /// Creates an empty measurement; `counts_per_mm` is for X and Y.
    #[must_use]
    pub fn new(counts_per_mm: [f64; 2]) -> Self {
        Measuring {
            counts_per_mm,
            segments: Vec::new(),
            latest: None,
        }
    }

    /// Adds the next scan; returns its cycle, if there is one.
    pub fn take(&mut self, seen: &Seen<'_>) -> Option<usize> {
        if let Some(cycle) = seen.fresh
            && (self.latest.is_none() || cycle != self.segments.len())
        {
            self.close(seen.cycles, cycle);
            self.latest = Some(CycleMeasuring::new(&seen.cycles[cycle], self.counts_per_mm));
        }
        let cycle = self.segments.len();
        let latest = self.latest.as_mut()?;
        latest.take(&seen.cycles[cycle], &seen.record, seen.fresh.is_some());
        Some(cycle)
    }

    /// Ends the cycles before `until`.
    fn close(&mut self, cycles: &[Cycle], until: usize) {
        if let Some(latest) = self.latest.take() {
            let ended = latest.finish(&cycles[self.segments.len()]);
            self.segments.push(ended);
        }
        // A cycle without a scan has no measures.
        for cycle in &cycles[self.segments.len()..until] {
            let none = CycleMeasuring::new(cycle, self.counts_per_mm);
            self.segments.push(none.finish(cycle));
        }
    }

    /// Returns the measures of every cycle after the run.
    #[must_use]
    pub fn finish(mut self, cycles: &[Cycle]) -> Vec<Segment> {
        self.close(cycles, cycles.len());
        self.segments
    }
}

/// Measurement of the current cycle.
#[derive(Debug)]
struct CycleMeasuring {
    counts_per_mm: [f64; 2],
    /// Number of scans from the first command to the last.
    scans: usize,
    off: u128,
    /// Commands since the last new one: they belong to the cycle if another one comes.
    waiting: Vec<[i64; 2]>,
    /// Last two commands.
    before: [[i64; 2]; 2],
    acceleration: [u64; 2],
    contour: [f64; 2],
}

impl CycleMeasuring {
    fn new(cycle: &Cycle, counts_per_mm: [f64; 2]) -> Self {
        CycleMeasuring {
            counts_per_mm,
            scans: 0,
            off: 0,
            waiting: Vec::new(),
            before: [cycle.from; 2],
            acceleration: [0; 2],
            contour: [0.0; 2],
        }
    }

    /// Adds a scan; `fresh` is true for a new command.
    fn take(&mut self, cycle: &Cycle, record: &ScanRecord, fresh: bool) {
        for (largest, scale) in self.contour.iter_mut().zip([[1.0; 2], self.counts_per_mm]) {
            *largest = largest.max(cycle.contour_error(record.motor, scale).abs());
        }
        self.waiting.push(record.command);
        if fresh {
            for command in std::mem::take(&mut self.waiting) {
                self.scans += 1;
                self.off = self.off.max(cycle.off(command));
                self.accelerate(command);
            }
        }
    }

    /// Adds the second difference with the next command.
    fn accelerate(&mut self, command: [i64; 2]) {
        let [first, second] = self.before;
        for (axis, most) in self.acceleration.iter_mut().enumerate() {
            let change = first[axis] - 2 * second[axis] + command[axis];
            *most = change.unsigned_abs().max(*most);
        }
        self.before = [second, command];
    }

    fn finish(mut self, cycle: &Cycle) -> Segment {
        let (master, slave) = (cycle.master, 1 - cycle.master);
        let delta = cycle.delta();
        if self.scans > 0 {
            // From rest to rest.
            let [_, last] = self.before;
            self.accelerate(last);
            self.accelerate(last);
        }
        let off = self.off;
        let divisor = delta[master].unsigned_abs();
        let length = (delta[master] as f64).hypot(delta[slave] as f64);
        let [contour_counts, contour_mm] = self.contour;
        Segment {
            delta,
            master_acceleration: self.acceleration[master],
            slave_acceleration: self.acceleration[slave],
            master,
            scans: self.scans,
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
            contour_counts,
            contour_um: contour_mm * 1e3,
        }
    }
}

impl Cycle {
    /// Returns the distances in X and Y, in counts.
    #[must_use]
    pub fn delta(&self) -> [i64; 2] {
        [0, 1].map(|axis| self.to[axis] - self.from[axis])
    }

    /// Returns |Δm·(s − s0) − Δs·(m − m0)|: |Δm| times the deviation of a point along the slave
    /// axis, and the length of the segment times its perpendicular distance.
    fn off(&self, point: [i64; 2]) -> u128 {
        let delta = self.delta().map(i128::from);
        let at = [0, 1].map(|axis| i128::from(point[axis]) - i128::from(self.from[axis]));
        (delta[0] * at[1] - delta[1] * at[0]).unsigned_abs()
    }

    /// Returns the point of the segment's line nearest to a point, and the point's distance,
    /// positive on the left, in counts over `scale`.
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

    /// Returns the contour error of a point: its distance from the segment's line, positive on the
    /// left, in counts over `scale`.
    #[must_use]
    pub fn contour_error(&self, point: [f64; 2], scale: [f64; 2]) -> f64 {
        self.foot(point, scale).1
    }
}

/// Exact deviation along the slave axis, in counts (LSB).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Deviation {
    /// Numerator |Δm·(s − s0) − Δs·(m − m0)|.
    pub numerator: u128,
    /// Denominator |Δm|.
    pub denominator: u128,
}

/// Serializes the deviation in LSB.
impl Serialize for Deviation {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_f64(self.lsb())
    }
}

impl Deviation {
    /// Returns the deviation in LSB.
    #[must_use]
    pub fn lsb(self) -> f64 {
        self.numerator as f64 / self.denominator as f64
    }

    /// True if the rule allows the deviation: below 1 LSB, or if centred at most one half.
    #[must_use]
    pub fn is_within(self, rule: Rule) -> bool {
        match rule {
            Rule::Floor | Rule::Truncating => self.numerator < self.denominator,
            Rule::Centred => 2 * self.numerator <= self.denominator,
        }
    }
}

/// Measures of one cycle.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Segment {
    /// Distances Δx and Δy in counts.
    #[serde(skip)]
    pub delta: [i64; 2],
    /// Master axis, or the axis with the longer distance if there is none: 0 is X, 1 is Y.
    #[serde(skip)]
    pub master: usize,
    /// Number of scans from the first command to the last, inclusive.
    pub scans: usize,
    /// Command at the end minus target, in counts.
    #[serde(rename = "end_error_counts")]
    pub end_error: [i64; 2],
    /// Greatest change of the master axis' commanded speed from scan to scan, from rest to rest, in
    /// counts per scan.
    #[serde(rename = "master_acceleration_counts_per_scan2")]
    pub master_acceleration: u64,
    /// Greatest such change on the other axis.
    #[serde(rename = "slave_acceleration_counts_per_scan2")]
    pub slave_acceleration: u64,
    /// Greatest deviation of a command from the ideal line, along the slave axis.
    #[serde(rename = "deviation_lsb")]
    #[cfg_attr(feature = "schema", schemars(with = "f64"))]
    pub deviation: Deviation,
    /// Greatest deviation perpendicular to the line, in counts.
    #[serde(rename = "deviation_perpendicular_counts")]
    pub perpendicular_counts: f64,
    /// Greatest distance of the motors from the line until the next cycle begins, in counts.
    #[serde(rename = "contour_error_counts")]
    pub contour_counts: f64,
    /// Greatest distance of the motors from the line, in micrometres.
    #[serde(rename = "contour_error_um")]
    pub contour_um: f64,
}
