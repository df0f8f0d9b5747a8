//! Conversion of a drawing's lines and arcs to moves of the conventional device, each with its
//! parameters (¶0003–0004): the device itself computes the amounts of every unit time.
//!
//! Every move has a constant speed from its first unit time to its last; the device supports no
//! other.

use super::beside::{Arc, Order};
use super::table::{Settings, UnitDemand};
use crate::circuits::blocks::cordic_state::GAIN;
use crate::circuits::blocks::{Cordic, cordic};
use crate::circuits::pulse_interpolator::circular_interpolator::GUARD;
use crate::circuits::pulse_interpolator::motor_controller::ConventionalWidths;
use crate::circuits::pulse_interpolator::{CircularInterpolator, Conventional};
use crate::input::{COORDINATES, Course, Drawing, Move, Point};
use crate::plan::FEED_RANGE;
use crate::sim::{RunError, Simulator};
use std::array::from_fn;
use std::f64::consts::TAU;

/// Reason why a drawing cannot be converted to moves of the device.
#[derive(Debug, thiserror::Error)]
pub enum MoveError {
    /// A move cannot be expressed by the device's parameters.
    #[error("line {line}: {field} {problem}; allowed: {allowed}")]
    Move {
        /// Line of the input.
        line: usize,
        /// Field at fault: "path" or "F".
        field: &'static str,
        /// Description of the fault.
        problem: String,
        /// Allowed values.
        allowed: String,
    },
    /// The scales of X and Y differ, so that a circle is not a circle in steps.
    #[error("an arc as one move needs the same scale on X and Y")]
    Scales,
    /// The device's CORDIC cannot be run.
    #[error(transparent)]
    Run(#[from] RunError),
}

/// Moves of a drawing, and their positions at the end of every unit time.
#[derive(Debug, Clone, Default)]
pub struct Moves {
    /// Moves in order.
    pub orders: Vec<Order>,
    /// Positions, unit after unit.
    pub demands: Vec<UnitDemand>,
}

/// Computer 7 while it converts a drawing.
struct Planner<'s> {
    settings: &'s Settings,
    circular: CircularInterpolator,
    /// Scale of each axis in steps per millimetre; 0 for axes that are not driven.
    scale: Point,
    /// First point of the drawing in mm.
    start: Point,
    /// Position of the axes after the moves so far, in steps.
    at: [i64; COORDINATES],
    made: Moves,
}

/// Converts a drawing to moves.
///
/// # Errors
/// Returns an error if a move has too many steps or unit times for the device, an arc moves in Z
/// too, or the scales of X and Y differ and there is an arc.
pub fn moves(drawing: &Drawing, settings: &Settings) -> Result<Moves, MoveError> {
    let scales = &settings.steps_per_mm;
    let mut planner = Planner {
        settings,
        circular: Conventional {
            axes: scales.len(),
            widths: ConventionalWidths::default(),
            period: 1,
            arcs: true,
        }
        .circular(),
        scale: from_fn(|axis| scales.get(axis).copied().unwrap_or(0.0)),
        start: drawing.start,
        at: [0; COORDINATES],
        made: Moves::default(),
    };
    let mut from = drawing.start;
    for step in &drawing.moves {
        match step.course {
            Course::Arc { centre, clockwise } => planner.arc(from, &step, centre, clockwise)?,
            Course::Line | Course::Spline { .. } => planner.line(from, &step)?,
        }
        from = step.to;
    }
    Ok(planner.made)
}

impl Planner<'_> {
    /// Converts a point of the drawing to steps from the axes' start.
    fn steps(&self, point: Point) -> Point {
        from_fn(|axis| {
            let begin = (self.start[axis] * self.scale[axis]).round();
            point[axis] * self.scale[axis] - begin
        })
    }

    /// Returns the unit times that a move of a length in mm takes at its speed, if its fastest
    /// axis has this share of `reach` steps in each.
    fn units(
        &self,
        step: &Move,
        (length, reach): (f64, f64),
        period: u32,
    ) -> Result<u32, MoveError> {
        let motion = &self.settings.motion;
        let speed = match step.rapid {
            true => motion.rapid_mm_per_min,
            false => step.feed_mm_per_min.unwrap_or(motion.feed_mm_per_min),
        };
        let refuse = |field, problem: String, allowed: String| MoveError::Move {
            line: step.line,
            field,
            problem,
            allowed,
        };
        if !FEED_RANGE.contains(&speed) {
            let (least, most) = (FEED_RANGE.start(), FEED_RANGE.end());
            let allowed = format!("{least} to {most} mm/min");
            return Err(refuse("F", format!("is {speed} mm/min"), allowed));
        }
        let widths = &self.circular.controller.widths;
        let ticks = length / speed * 60.0 * self.settings.clock_hz as f64;
        let units = (ticks / f64::from(period)).ceil();
        // No axis has more steps in a unit time than its driver allows.
        let timing = &self.settings.timing;
        let pulse = 2 * timing.step_high_ticks.max(timing.step_low_ticks).max(1);
        let pulses = f64::from((period / pulse).max(1));
        let units = units.max((reach / pulses).ceil()).max(1.0);
        let most = (1u64 << widths.units) - 1;
        if units > most as f64 {
            let allowed = format!("up to {most}: a shorter move, a higher feed or a longer T");
            return Err(refuse(
                "path",
                format!("is a move of {units} unit times"),
                allowed,
            ));
        }
        Ok(units as u32)
    }

    /// Returns an error for a distance in steps that does not fit in a word of the device.
    fn fits(&self, step: &Move, steps: f64, what: &str) -> Result<(), MoveError> {
        let most = (1u64 << self.circular.controller.widths.distance) - 1;
        match steps <= most as f64 {
            true => Ok(()),
            false => Err(MoveError::Move {
                line: step.line,
                field: "path",
                problem: format!("is a move with {what} of {steps:.0} steps"),
                allowed: format!("up to {most}"),
            }),
        }
    }

    fn line(&mut self, from: Point, step: &Move) -> Result<(), MoveError> {
        let [begin, end] = [from, step.to].map(|point| self.steps(point));
        let delta: [i64; COORDINATES] = from_fn(|axis| end[axis].round() as i64 - self.at[axis]);
        let reach = delta.iter().map(|steps| steps.abs()).max().unwrap_or(0);
        if reach == 0 {
            return Ok(());
        }
        self.fits(step, reach as f64, "a way")?;
        let way = crate::path::vector::distance(from, step.to);
        let period = self.settings.line_unit_ticks;
        let units = self.units(step, (way, reach as f64), period)?;
        let exact = |share: f64| from_fn(|k| begin[k] + share * (end[k] - begin[k]));
        self.push(
            Order {
                delta,
                units,
                period,
                arc: None,
            },
            exact,
        );
        self.at = from_fn(|axis| self.at[axis] + delta[axis]);
        Ok(())
    }

    fn arc(
        &mut self,
        from: Point,
        step: &Move,
        centre: [f64; 2],
        clockwise: bool,
    ) -> Result<(), MoveError> {
        let [scale, other, _] = self.scale;
        if scale.abs().to_bits() != other.abs().to_bits() {
            return Err(MoveError::Scales);
        }
        if from[2] != step.to[2] {
            return Err(MoveError::Move {
                line: step.line,
                field: "path",
                problem: "is an arc that moves in Z too".to_owned(),
                allowed: "arcs in the X-Y plane: the device has no others".to_owned(),
            });
        }
        let middle = self.steps([centre[0], centre[1], from[2]]);
        let [begin, end] = [from, step.to].map(|point| self.steps(point));
        let angle = |point: Point| (point[1] - middle[1]).atan2(point[0] - middle[0]);
        // A negative scale reverses the direction.
        let backwards = clockwise != (scale * other < 0.0);
        let turned = (angle(end) - angle(begin)).rem_euclid(TAU);
        let full = from[..2] == step.to[..2];
        let sweep = match (full, backwards) {
            (true, false) => TAU,
            (true, true) => -TAU,
            (false, false) => turned,
            (false, true) => turned - TAU,
        };
        let radius = (begin[0] - middle[0]).hypot(begin[1] - middle[1]);
        // A rounded point may be one step outside.
        self.fits(step, radius + 1.0, "a radius")?;
        let (way, period) = (radius * sweep.abs(), self.settings.arc_unit_ticks);
        // The rotation per unit time must be below half a turn.
        let units = self.units(step, (way / scale.abs(), way), period)?.max(3);
        let bits = self.circular.angle;
        let words = (bits as f64).exp2() / TAU;
        let word = |angle: f64| ((angle * words).round() as i64 as u64) & ((1 << bits) - 1);
        let arc = Arc {
            radius: (radius / GAIN * (1u64 << GUARD) as f64).round() as u64,
            angle: word(angle(begin)),
            turn: word(sweep / f64::from(units)),
        };
        let first = angle(begin);
        let exact = |share: f64| {
            let (sine, cosine) = (first + share * sweep).sin_cos();
            [
                middle[0] + radius * cosine,
                middle[1] + radius * sine,
                begin[2],
            ]
        };
        let order = Order {
            delta: [0; COORDINATES],
            units,
            period,
            arc: Some(arc),
        };
        self.push(order, exact);
        let last = (arc.angle + arc.turn * u64::from(units)) & ((1 << bits) - 1);
        let points = [arc.angle, last].map(|angle| self.point(arc.radius, angle));
        let [begun, ended] = points;
        let (begun, ended) = (begun?, ended?);
        for axis in 0..2 {
            self.at[axis] += ended[axis] - begun[axis];
        }
        Ok(())
    }

    /// Returns the rounded point of the device's own CORDIC.
    fn point(&self, radius: u64, angle: u64) -> Result<[i64; 2], RunError> {
        let circuit: Cordic = self.circular.cordic();
        let mut simulator = Simulator::new(&circuit)?;
        let i = cordic::In {
            start: true,
            halt: false,
            radius: radius as i64,
            offset: 0,
            angle,
        };
        simulator.step_with(&i, |_| ())?;
        simulator.set(|i| i.start, false)?;
        while !simulator.see(|now| now.w.done) {
            simulator.step();
        }
        let half = 1 << (GUARD - 1);
        let point = [
            simulator.see(|now| now.w.along),
            simulator.see(|now| now.w.across),
        ];
        Ok(point.map(|word| (word + half) >> GUARD))
    }

    /// Adds a move; `exact` returns its exact point for a share of its unit times.
    fn push(&mut self, order: Order, exact: impl Fn(f64) -> Point) {
        for unit in 1..=order.units {
            let exact = exact(f64::from(unit) / f64::from(order.units));
            self.made.demands.push(UnitDemand {
                period: order.period,
                exact,
                rounded: exact.map(|steps| steps.round() as i64),
            });
        }
        self.made.orders.push(order);
    }
}
