//! The picture of a run: the path by both machines with their errors magnified, these errors over
//! time, and the pen lift.

use super::Job;
use super::runs::{self, Run};
use crate::cli::magnification::magnification;
use motion_rtl::input::Point;
use motion_rtl::jobs::machine::measure::Beside;
use motion_rtl::path::pieces::Course;
use motion_rtl::path::vector::{distance, sub};
use motion_rtl::picture::{Curve, Panel, Picture};
use std::f64::consts::TAU;

const GAP: (f64, f64) = (f64::NAN, f64::NAN);
const IDEAL: &str = "#d8d8d8";
const STEPPERS: &str = "#e69f00";
const SERVOS: &str = "#0072b2";
const LIFT: &str = "#009e73";

/// Chords of a full circle.
const CHORDS: f64 = 180.0;

/// A curve with gaps.
type Points = Vec<(f64, f64)>;

/// The picture as SVG.
pub fn draw(job: &Job, run: &Run) -> String {
    Picture::new(format!("{}: machine", job.stem))
        .panel(path(job, run))
        .panel(errors(job, run))
        .panel(lift(job, run))
        .render()
}

fn path(job: &Job, run: &Run) -> Panel {
    let [drawn, rapid] = ideal(job);
    let all = run.steppers.iter().chain(run.loads.iter());
    let all = all.filter(|one| !is_rapid(job, one));
    let largest = all.map(Beside::mm).fold(0.0, f64::max);
    let factor = magnification(largest, size(drawn.iter().chain(&rapid)));
    let title = match factor {
        1.0 => "path".to_owned(),
        _ => format!("path, errors times {factor}"),
    };
    let curve = |points: &runs::Points| -> Points {
        let points = points.iter().map(|one| match is_rapid(job, one) {
            true => GAP,
            false => {
                let off: Point = sub(one.actual, one.nearest);
                let [x, y] = [0, 1].map(|axis| one.nearest[axis] + factor * off[axis]);
                (x, y)
            }
        });
        points.collect()
    };
    Panel::new(title, "x in mm", "y in mm")
        .equal_scales()
        .curve(Curve::new("ideal", drawn).colour(IDEAL).width(5.0))
        .curve(
            Curve::new("pen up", rapid)
                .colour("#9a9a9a")
                .width(0.8)
                .dashed(),
        )
        .curve(Curve::new("steppers", curve(&run.steppers)).colour(STEPPERS))
        .curve(Curve::new("loads of the servos", curve(&run.loads)).colour(SERVOS))
}

/// The diagonal of some points.
fn size<'a>(points: impl Iterator<Item = &'a (f64, f64)>) -> f64 {
    let (mut least, mut most) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    for (x, y) in points.filter(|at| at.0.is_finite()) {
        least = [least[0].min(*x), least[1].min(*y)];
        most = [most[0].max(*x), most[1].max(*y)];
    }
    (most[0] - least[0]).hypot(most[1] - least[1])
}

fn is_rapid(job: &Job, one: &Beside) -> bool {
    let step = job.drawing.moves.get(one.piece);
    step.is_some_and(|step| step.rapid)
}

/// The job: what is drawn, and what is not.
fn ideal(job: &Job) -> [Points; 2] {
    let mut parts = [const { Points::new() }; 2];
    let mut at = job.drawing.start;
    for (piece, step) in job.program.pieces.iter().zip(&job.drawing.moves) {
        let part = &mut parts[usize::from(step.rapid)];
        let flat = |point: Point| (point[0], point[1]);
        if part.last() != Some(&flat(at)) {
            part.extend([GAP, flat(at)]);
        }
        if let Course::Arc(circle) = &piece.course {
            let chords = (circle.angle / TAU * CHORDS).ceil().max(2.0) as u32;
            let angles = (1..chords).map(|k| circle.angle * f64::from(k) / f64::from(chords));
            part.extend(angles.map(|angle| flat(circle.point(angle))));
        }
        part.push(flat(piece.to));
        at = piece.to;
    }
    parts
}

/// The distances from the path over time.
fn errors(job: &Job, run: &Run) -> Panel {
    let curve = |points: &runs::Points| -> Points {
        let hz = job.settings.clock_hz as f64;
        let points = points.iter().map(|one| {
            let um = 1e3 * distance(one.actual, one.nearest);
            (one.tick as f64 / hz, um)
        });
        points.collect()
    };
    Panel::new("distance from the path", "time in s", "µm")
        .curve(
            Curve::new("steppers", curve(&run.steppers))
                .colour(STEPPERS)
                .width(0.6),
        )
        .curve(Curve::new("loads of the servos", curve(&run.loads)).colour(SERVOS))
}

/// The pen lift over time, and where it was told to stop and stood.
fn lift(job: &Job, run: &Run) -> Panel {
    let seconds = |tick: u64| tick as f64 / job.settings.clock_hz as f64;
    let lift = &run.lift;
    let points = lift.positions.iter();
    let points = points.map(|(tick, position)| (seconds(*tick), *position as f64));
    let panel = Panel::new("pen lift", "time in s", "counts")
        .curve(Curve::new("position", points.collect()).colour(LIFT));
    let at = |tick: u64| {
        let position = lift.marks.get(&tick).unwrap_or(&lift.last);
        (seconds(tick), *position as f64)
    };
    let steps = run.played.liftings.iter().enumerate();
    steps.fold(panel, |panel, (number, lifting)| {
        // Words at the first; there is no room for more.
        let words = |words: &'static str| if number == 0 { words } else { "" };
        panel
            .mark(at(lifting.fired), words("fire"))
            .mark(at(lifting.completed), words("complete"))
    })
}
