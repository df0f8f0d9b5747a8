//! The servos beside the path.

use super::{Path, Reason, Servos, farthest};
use crate::circuits::trajectory_controller::Widths;
use crate::input::{Drawing, Point};
use crate::jobs::machine::job::Frame;
use crate::jobs::machine::settings::Settings;
use crate::path::pieces::Course;
use crate::path::vector::{distance, sub};
use std::array::from_fn;

/// Guard units of a count.
const COUNT: f64 = (1u64 << Widths::FULL.guard()) as f64;
/// By how many counts rounding alone puts a command beside the path: half a one of each axis,
/// and another half for the remainder that the linear interpolator carries.
const ROUNDING_COUNTS: f64 = 1.5;

/// Positions of the servos in mm.
pub(super) struct Servo {
    origin: [f64; 2],
    height: f64,
    per_mm: f64,
}

impl Servo {
    pub(super) fn new(drawing: &Drawing, settings: &Settings) -> Self {
        let per_mm = settings.counts_per_mm;
        Servo {
            origin: from_fn(|axis| (drawing.start[axis] * per_mm).round()),
            height: drawing.start[2],
            per_mm,
        }
    }

    fn point(&self, counts: [f64; 2]) -> Point {
        let [x, y] = from_fn(|axis| (self.origin[axis] + counts[axis]) / self.per_mm);
        [x, y, self.height]
    }

    fn command(&self, frame: &Frame) -> Point {
        self.point(frame.command.map(|counts| counts as f64))
    }

    fn model(&self, frame: &Frame) -> Point {
        self.point(frame.model.map(|units| units as f64 / COUNT))
    }

    fn motor(&self, frame: &Frame) -> Point {
        self.point(frame.motor.map(|counts| counts as f64))
    }

    pub(super) fn load(&self, frame: &Frame) -> Point {
        self.point(frame.load)
    }

    /// How far the servos were from a piece in these frames, without their ticks.
    pub(super) fn farthest(
        &self,
        path: &Path<'_>,
        piece: usize,
        frames: &[Frame],
    ) -> Option<Servos> {
        let off = |point: Point| path.off(piece, point);
        let mm = |point: Point| distance(off(point), [0.0; 3]);
        let largest = |of: fn(&Self, &Frame) -> Point| {
            let all = frames.iter().map(|frame| mm(of(self, frame)));
            all.fold(0.0, f64::max)
        };
        let worst = frames
            .iter()
            .max_by(|a, b| mm(self.load(a)).total_cmp(&mm(self.load(b))))?;
        // What a motor owes its place to are model and command of the same place, not time.
        let near = |place: Point, of: fn(&Self, &Frame) -> Point| {
            let from = |frame: &Frame| distance(of(self, frame), place);
            let nearest = frames.iter().min_by(|a, b| from(a).total_cmp(&from(b)));
            nearest.map(|frame| of(self, frame))
        };
        let motor = self.motor(worst);
        let model = near(motor, Self::model)?;
        let command = near(model, Self::command)?;
        let [command, model, motor, load] = [command, model, motor, self.load(worst)].map(off);
        let is_arc = matches!(path.pieces[piece].course, Course::Arc(_));
        let rounding = distance(command, [0.0; 3]) <= ROUNDING_COUNTS / self.per_mm;
        let commanded = match is_arc && !rounding {
            true => Reason::Blend,
            false => Reason::WholeCounts,
        };
        let shares = [
            (commanded, command),
            (Reason::Lag, sub(model, command)),
            (Reason::Motor, sub(motor, model)),
            (Reason::Shaft, sub(load, motor)),
        ];
        Some(Servos {
            ticks: 0..=0,
            command_mm: largest(Self::command),
            model_mm: largest(Self::model),
            motor_mm: largest(Self::motor),
            load: farthest(worst.tick, load, shares),
            left_counts: [0; 2],
        })
    }
}
