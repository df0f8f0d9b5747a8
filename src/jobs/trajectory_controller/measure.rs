//! Measures of a run: distances of models, motors and loads from the path and from their commands.

use super::job::{Period, Played, Program};
use super::segments::{Arc, Path, Segment};
use crate::circuits::trajectory_controller::Widths;
use crate::circuits::trajectory_controller::path_point::{AXES, AXIS_NAMES};
use crate::input::{COORDINATES, Point};
use crate::path::cubic::{rise, rises};
use crate::path::vector::{add, dot, scale, sub};
use crate::plant::{TwoMassAxis, TwoMassParameters};
use serde::Serialize;
use std::array::from_fn;
use std::f64::consts::TAU;

/// Guard units per count.
const COUNT: f64 = (1u64 << Widths::FULL.guard()) as f64;

/// Deviation in a period of a run, in mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Deviation {
    /// Time from the path's start in s.
    pub time_s: f64,
    /// Length along the path of the nearest point.
    pub length_mm: f64,
    /// Actual position in X, Y and Z.
    pub actual: Point,
    /// Nearest point of the path.
    pub nearest: Point,
    /// Actual W; 0 if there is none.
    pub w_mm: f64,
    /// Contour error: the distance of both, including W if there is one.
    pub contour_mm: f64,
    /// Following error: the distance from P_c of the same period, including W if there is one.
    pub following_mm: f64,
}

/// Errors of models, motors or loads.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Errors {
    /// Deviations, period by period; empty for [`Measuring`].
    #[serde(skip)]
    pub deviations: Vec<Deviation>,
    /// Greatest contour error: the distance from the path.
    pub contour_max_um: f64,
    /// Root mean square of the contour error.
    pub contour_rms_um: f64,
    /// Length along the path at the greatest contour error.
    pub at_mm: f64,
    /// Tick of the greatest contour error.
    pub at_tick: u64,
    /// Period of the greatest contour error.
    #[serde(skip)]
    pub at_period: usize,
    /// Greatest following error: the distance from the command of the same period.
    pub following_max_mm: f64,
    /// Root mean square of the following error.
    #[serde(skip)]
    pub following_rms_mm: f64,
    /// Distance from the path's end in the last period.
    pub end_um: f64,
}

/// Measures of an axis.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct AxisMeasured {
    /// Name of the axis.
    pub axis: &'static str,
    /// End position of the motor, in counts from the path's start.
    pub end_position: i64,
    /// Greatest torque.
    pub torque_max_nm: f64,
    /// Number of periods with limited torque.
    pub saturated_periods: usize,
    /// Greatest distance of the motor from its model.
    pub off_model_um: f64,
}

/// Measures of a run.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Measured {
    /// Errors of the servos' models, which the motors follow.
    pub model: Errors,
    /// Errors of the motors, by their encoders.
    pub motor: Errors,
    /// Errors of the loads.
    pub load: Errors,
    /// Measures of each axis.
    pub axes: Vec<AxisMeasured>,
}

impl Measured {
    /// Measures a run of `machines`; `None` for a run without periods.
    #[must_use]
    pub fn of(program: &Program, machines: &[TwoMassParameters], played: &Played) -> Option<Self> {
        let mut measuring = Measuring::new(program, machines);
        let mut deviations = [const { Vec::new() }; 3];
        for period in &played.periods {
            for (all, one) in deviations.iter_mut().zip(measuring.take(period)) {
                all.push(one);
            }
        }
        let mut measured = measuring.finish(played)?;
        let errors = [&mut measured.model, &mut measured.motor, &mut measured.load];
        for (errors, deviations) in errors.into_iter().zip(deviations) {
            errors.deviations = deviations;
        }
        Some(measured)
    }
}

/// Measurement of a run while it goes on.
#[derive(Debug)]
pub struct Measuring<'p> {
    program: &'p Program,
    machines: &'p [TwoMassParameters],
    /// Number of periods so far.
    periods: usize,
    /// Errors of models, motors and loads; distances in mm.
    errors: [Errors; 3],
    axes: Vec<Axis>,
}

/// Measures of an axis while a run goes on.
#[derive(Debug, Clone, Copy, Default)]
struct Axis {
    /// Greatest torque in words.
    torque: i64,
    /// Number of periods with limited torque.
    saturated: usize,
    /// Greatest distance of the motor from its model, in guard units.
    off_model: f64,
}

impl<'p> Measuring<'p> {
    /// Creates a measurement of a run of `program` on `machines`, one for each axis.
    #[must_use]
    pub fn new(program: &'p Program, machines: &'p [TwoMassParameters]) -> Self {
        Measuring {
            program,
            machines,
            periods: 0,
            errors: from_fn(|_| Errors::default()),
            axes: vec![Axis::default(); machines.len()],
        }
    }

    /// Adds the next period; returns the deviations of models, motors and loads.
    pub fn take(&mut self, period: &Period) -> [Deviation; 3] {
        for (axis, own) in self.axes.iter_mut().enumerate() {
            own.torque = own.torque.max(period.torque[axis].abs());
            own.saturated += usize::from(period.saturated[axis]);
            let off = period.motor[axis] as f64 * COUNT - period.model[axis] as f64;
            own.off_model = own.off_model.max(off.abs());
        }
        let positions = [
            period.model.map(|units| units as f64),
            period.motor.map(|counts| counts as f64 * COUNT),
            period.load.map(|counts| counts * COUNT),
        ];
        let index = self.periods;
        self.periods += 1;
        from_fn(|k| {
            let (deviation, end_mm) = deviation(self.program, period, index, positions[k]);
            self.errors[k].add(&deviation, end_mm, index, period.tick);
            deviation
        })
    }

    /// Returns the measures, without the single deviations; `None` without periods.
    #[must_use]
    pub fn finish(self, played: &Played) -> Option<Measured> {
        let periods = Some(self.periods).filter(|periods| *periods > 0)? as f64;
        let [model, motor, load] = self.errors.map(|errors| errors.finish(periods));
        let axes = self.axes.iter().zip(self.machines).enumerate();
        let axes = axes.map(|(axis, (own, machine))| AxisMeasured {
            axis: AXIS_NAMES[axis],
            end_position: played.motor[axis],
            torque_max_nm: own.torque as f64 / TwoMassAxis::FULL_SCALE as f64
                * machine.max_torque_nm,
            saturated_periods: own.saturated,
            off_model_um: own.off_model / self.program.motion.units_per_mm * 1e3,
        });
        Some(Measured {
            model,
            motor,
            load,
            axes: axes.collect(),
        })
    }
}

impl Errors {
    /// Adds a period. Until the errors are finished, distances are in mm and means are sums of
    /// squares.
    fn add(&mut self, deviation: &Deviation, end_mm: f64, period: usize, tick: u64) {
        let (contour, following) = (deviation.contour_mm, deviation.following_mm);
        self.contour_rms_um += contour.powi(2);
        self.following_rms_mm += following.powi(2);
        if contour > self.contour_max_um {
            self.contour_max_um = contour;
            (self.at_period, self.at_tick) = (period, tick);
            self.at_mm = deviation.length_mm;
        }
        self.following_max_mm = self.following_max_mm.max(following);
        self.end_um = end_mm;
    }

    fn finish(self, periods: f64) -> Self {
        Errors {
            contour_max_um: self.contour_max_um * 1e3,
            contour_rms_um: (self.contour_rms_um / periods).sqrt() * 1e3,
            following_rms_mm: (self.following_rms_mm / periods).sqrt(),
            end_um: self.end_um * 1e3,
            ..self
        }
    }
}

/// Returns the deviation of a position in a period, both relative to the start of the path, and
/// its distance from the path's end in mm.
fn deviation(
    program: &Program,
    period: &Period,
    index: usize,
    position: [f64; AXES],
) -> (Deviation, f64) {
    let path = &program.path;
    let (mm, end) = (1.0 / program.motion.units_per_mm, path.length as f64);
    let place = |from_start: [f64; AXES]| -> [f64; AXES] {
        from_fn(|axis| program.origin[axis] as f64 + from_start[axis])
    };
    let in_space = |[x, y, z, _]: [f64; AXES]| scale([x, y, z], mm);
    let actual = place(position);
    let command = place(period.command.map(|units| units as f64));
    let following = apart(actual, command);
    // The position is near that of the tangential response. Nearer points are within twice the
    // distance to it; beyond that the path may pass by again.
    let answered = period.answered as f64;
    let reach = 2.0 * apart(actual, path.place(answered)) + COUNT;
    let (length, nearest) = path.nearest(actual, [answered - reach, answered + reach]);
    let deviation = Deviation {
        time_s: index as f64 * program.motion.period,
        length_mm: mm * length,
        actual: in_space(actual),
        nearest: in_space(nearest),
        w_mm: mm * actual[COORDINATES],
        contour_mm: mm * apart(actual, nearest),
        following_mm: mm * following,
    };
    (deviation, mm * apart(actual, path.place(end)))
}

/// Returns the distance of two points, including W.
#[must_use]
pub fn apart(one: [f64; AXES], other: [f64; AXES]) -> f64 {
    let squares = one.iter().zip(other).map(|(a, b)| (a - b) * (a - b));
    squares.sum::<f64>().sqrt()
}

impl Path {
    /// Returns the length and the point between two lengths that is nearest to a point; the first
    /// of several. All in guard units.
    #[must_use]
    pub fn nearest(&self, point: [f64; AXES], window: [f64; 2]) -> (f64, [f64; AXES]) {
        let [from, to] = window.map(|length| length.clamp(0.0, self.length as f64));
        let (mut best, mut least) = ((from, self.place(from)), f64::INFINITY);
        for stretch in &self.stretches[self.index(from)..=self.index(to)] {
            let begin = stretch.begin as f64;
            let inside = [
                (from - begin).max(0.0),
                (to - begin).min(stretch.length as f64),
            ];
            for offset in stretch.segment.candidates(point, inside) {
                let near = stretch.segment.place(offset);
                let off = apart(point, near);
                if off < least {
                    // Rounding may move the sum past an end.
                    let length = (begin + offset).max(from).min(to);
                    (best, least) = ((length, near), off);
                }
            }
        }
        best
    }
}

impl Segment {
    /// Returns offsets between two limits, one of which is nearest to a point.
    fn candidates(&self, place: [f64; AXES], [from, to]: [f64; 2]) -> Vec<f64> {
        let [x, y, z, w] = place;
        let (point, climb) = ([x, y, z], self.fourth.map_or(0.0, |fourth| fourth.along));
        // W is constant along a spline.
        if let Some(bits) = self.powers {
            // The spline turns so little that there is at most one.
            let ahead = |at: f64| dot(sub(self.point(at), point), self.derivatives(bits, at)[0]);
            return vec![from, to, rise([from, to], ahead)];
        }
        let way = sub(point, self.base.map(|units| units as f64));
        let [along, across] = [dot(way, self.along), dot(way, self.across)];
        let Some(arc) = self.arc else {
            // Motion of length 1 per unit of length, except for rounding.
            let square = dot(self.along, self.along) + climb * climb;
            let ahead = along + climb * (w - self.fourth_point(0.0));
            return vec![(ahead / square).clamp(from, to)];
        };
        if self.third != [0.0; COORDINATES] || climb != 0.0 {
            let parts = ((to - from) / arc.turn * 8.0).ceil().max(1.0) as u32;
            let ahead = |at: f64| {
                let beside = climb * (self.fourth_point(at) - w);
                dot(sub(self.point(at), point), self.helical(&arc, at)) + beside
            };
            let turns = rises([from, to], parts, ahead);
            return turns.chain([from, to]).collect();
        }
        let turn = arc.turn / TAU * across.atan2(along).rem_euclid(TAU);
        let turns = turn + ((from - turn) / arc.turn).ceil() * arc.turn;
        let mut offsets = vec![from, to];
        offsets.extend((from..=to).contains(&turns).then_some(turns));
        offsets
    }

    /// Returns the derivative of a helix by its length.
    fn helical(&self, arc: &Arc, offset: f64) -> Point {
        let (sin, cos) = (TAU * (offset / arc.turn)).sin_cos();
        let around = sub(scale(self.across, cos), scale(self.along, sin));
        add(scale(around, arc.radius * TAU / arc.turn), self.third)
    }
}
