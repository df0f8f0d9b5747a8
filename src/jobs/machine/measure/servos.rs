//! Deviation of the servos from the path.

use super::{Beside, Farthest, Path, Reason, Servos, farthest};
use crate::circuits::trajectory_controller::Widths;
use crate::input::{Drawing, Point};
use crate::jobs::machine::job::Frame;
use crate::jobs::machine::settings::Settings;
use crate::path::pieces::Course;
use crate::path::vector::{distance, sub};
use std::array::from_fn;
use std::collections::VecDeque;
use std::ops::RangeInclusive;

/// Guard units per count.
const COUNT: f64 = (1u64 << Widths::FULL.guard()) as f64;
/// Greatest deviation of a command in counts by rounding alone: half a count in each axis, and
/// another half for the remainder that the linear interpolator carries.
const ROUNDING_COUNTS: f64 = 1.5;
/// Number of sampling times before and after the greatest deviation in which model and command at
/// the same place are searched.
const AROUND: u64 = 16_384;

/// Conversion of the servos' positions to mm.
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

    /// Returns the greatest deviation of the loads from a piece, which is in `worst`, with its
    /// reason from the frames around.
    fn farthest(
        &self,
        path: &Path<'_>,
        piece: usize,
        worst: &Frame,
        frames: &VecDeque<(u64, Frame)>,
    ) -> Option<Farthest> {
        let off = |point: Point| path.off(piece, point);
        // A motor's position is compared with model and command at the same place, not time.
        let near = |place: Point, of: fn(&Self, &Frame) -> Point| {
            let from = |frame: &Frame| distance(of(self, frame), place);
            let all = frames.iter().map(|(_, frame)| frame);
            let nearest = all.min_by(|a, b| from(a).total_cmp(&from(b)));
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
        Some(farthest(worst.tick, load, shares))
    }
}

/// Measurement of the servos on their current piece.
pub(super) struct OnPiece {
    servo: Servo,
    piece: usize,
    pub(super) begun: u64,
    /// Last tick in which the commands moved.
    pub(super) stood: u64,
    first: Option<Frame>,
    pub(super) last: Option<Frame>,
    /// Greatest distances of command, model and motor, in mm.
    largest: [f64; 3],
    count: u64,
    /// Number and frame of the greatest deviation of the loads, and its distance in mm.
    worst: Option<(u64, Frame, f64)>,
    /// Greatest deviation of the loads with its reason, once all frames around it are known.
    found: Option<Farthest>,
    /// Frames around the greatest deviation, or the latest ones, each with its number.
    frames: VecDeque<(u64, Frame)>,
}

impl OnPiece {
    pub(super) fn new(drawing: &Drawing, settings: &Settings, piece: usize, begun: u64) -> Self {
        Self::unseen(Servo::new(drawing, settings), piece, begun)
    }

    /// Creates a measurement of a piece without frames.
    fn unseen(servo: Servo, piece: usize, begun: u64) -> Self {
        OnPiece {
            servo,
            piece,
            begun,
            stood: begun,
            first: None,
            last: None,
            largest: [0.0; 3],
            count: 0,
            worst: None,
            found: None,
            frames: VecDeque::new(),
        }
    }

    /// Adds the next frame; returns the loads beside the piece.
    pub(super) fn take(&mut self, path: &Path<'_>, frame: Frame) -> Beside {
        let (servo, number) = (&self.servo, self.count);
        let mm = |point: Point| distance(path.off(self.piece, point), [0.0; 3]);
        let now = [
            servo.command(&frame),
            servo.model(&frame),
            servo.motor(&frame),
        ];
        for (largest, point) in self.largest.iter_mut().zip(now) {
            *largest = largest.max(mm(point));
        }
        let actual = servo.load(&frame);
        let nearest = path.nearest(self.piece, actual);
        let off = distance(sub(actual, nearest), [0.0; 3]);
        self.frames.push_back((number, frame));
        if self
            .worst
            .is_none_or(|(_, _, most)| off.total_cmp(&most).is_ge())
        {
            (self.worst, self.found) = (Some((number, frame, off)), None);
        }
        if let Some((worst, of, _)) = &self.worst
            && self.found.is_none()
            && number >= worst + AROUND
        {
            self.found = servo.farthest(path, self.piece, of, &self.frames);
        }
        let centre = match (&self.worst, &self.found) {
            (Some((worst, ..)), None) => *worst,
            _ => number,
        };
        while self
            .frames
            .front()
            .is_some_and(|(first, _)| first + AROUND < centre)
        {
            self.frames.pop_front();
        }
        if frame.moving {
            self.stood = frame.tick;
        }
        self.first.get_or_insert(frame);
        self.last = Some(frame);
        self.count += 1;
        Beside {
            tick: frame.tick,
            piece: self.piece,
            actual,
            nearest,
        }
    }

    /// Returns the state at the tick in which it began, for a piece whose end is not reached.
    pub(super) fn at_begin(self, path: &Path<'_>) -> Self {
        let first = self.first;
        let mut only = Self::unseen(self.servo, self.piece, self.begun);
        if let Some(frame) = first.filter(|frame| frame.tick == only.begun) {
            only.take(path, frame);
        }
        only
    }

    /// Returns the measures; `None` without a frame.
    pub(super) fn finish(
        &self,
        path: &Path<'_>,
        ticks: RangeInclusive<u64>,
        left_by_correction: [i64; 2],
    ) -> Option<Servos> {
        let (_, worst, _) = self.worst.as_ref()?;
        let at_end = || self.servo.farthest(path, self.piece, worst, &self.frames);
        let [command_um, model_um, motor_um] = self.largest.map(|mm| mm * 1e3);
        Some(Servos {
            ticks,
            command_um,
            model_um,
            motor_um,
            load: self.found.or_else(at_end)?,
            left_by_correction,
        })
    }
}
