//! The picture of a run: the path as commanded and as pulsed, and the following error over time.

use super::Job;
use motion_rtl::circuits::pulse_interpolator::AXIS_NAMES;
use motion_rtl::input::{COORDINATES, Course};
use motion_rtl::jobs::pulse_interpolator::job::Played;
use motion_rtl::jobs::pulse_interpolator::{FollowingError, TableError, follow};
use motion_rtl::picture::{Curve, Panel, Picture, Points};
use motion_rtl::plan::outline;

/// Chords of a full circle.
const CHORDS: u32 = 180;

/// Following errors at the end of every unit time, as the drivers saw them.
#[derive(Debug)]
pub struct Following {
    /// The largest of each axis, X first.
    pub largest: Vec<FollowingError>,
    /// The largest at the end of a unit time, of all axes, in steps.
    pub end_error: f64,
    /// Time in seconds and error in steps, for each axis.
    curves: Vec<Points>,
    /// Position of the axes by their pulses, in millimetres.
    pulsed: Pair,
}

impl Following {
    /// Compares where the axes were with where the path demanded them.
    ///
    /// # Errors
    /// The path cannot be planned, which a job that is compiled rules out.
    pub fn new(job: &Job, played: &Played) -> Result<Self, TableError> {
        let (drawing, settings, table) = (&job.drawing, &job.settings, &job.table);
        let mut curves = vec![Points::expecting(table.units()); job.report.axes.len()];
        let mut pulsed = Pair::expecting(table.units());
        let mut at = pulsed_point(job, &[0; COORDINATES]);
        let mut end_error = 0.0f64;
        let largest = follow(drawing, settings, table, &played.positions, |end| {
            let to = pulsed_point(job, &end.positions);
            pulsed.of(end.rapid, at).push(to);
            at = to;
            let errors = end.end_errors.iter().map(|error| error.abs());
            end_error = errors.fold(end_error, f64::max);
            for (curve, error) in curves.iter_mut().zip(end.errors) {
                curve.push((end.time_s, error));
            }
        })?;
        Ok(Following {
            largest,
            end_error,
            curves,
            pulsed,
        })
    }
}

/// The picture as SVG.
pub fn draw(job: &Job, following: Following) -> String {
    let (drawn, rapid) = commanded(job);
    let (pulsed, pulsed_rapid) = following.pulsed.points();
    let path = Panel::new("path", "x in mm", "y in mm")
        .equal_scales()
        .curve(
            Curve::thinned("as commanded", drawn)
                .colour("#f0c9a0")
                .width(5.0),
        )
        .curve(
            Curve::thinned("rapid, as commanded", rapid)
                .colour("#e8e8e8")
                .width(3.0),
        )
        .curve(
            Curve::thinned("rapid, as pulsed", pulsed_rapid)
                .colour("#9a9a9a")
                .width(0.7)
                .dashed(),
        )
        .curve(Curve::thinned("as pulsed", pulsed).colour("#0072b2"));
    let picture = Picture::new(format!("{}: pulse interpolator", job.stem)).panel(path);
    let curves = following.curves.into_iter().zip(AXIS_NAMES);
    curves
        .fold(picture, |picture, (curve, name)| {
            let title = format!("largest following error of {name} in each unit time");
            let panel = Panel::new(title, "time in s", "error in steps");
            picture.panel(panel.curve(Curve::thinned(name, curve).colour("#0072b2").width(0.6)))
        })
        .render()
}

/// Converts a position in steps to millimetres.
fn pulsed_point(job: &Job, positions: &[i32]) -> (f64, f64) {
    let coordinate = |axis: usize| {
        let of = job.report.axes.get(axis)?;
        let steps = f64::from(of.start_position) + f64::from(positions[axis]);
        Some(steps / job.settings.steps_per_mm[axis])
    };
    (coordinate(0).unwrap_or(0.0), coordinate(1).unwrap_or(0.0))
}

/// A curve with gaps.
#[derive(Debug, Clone)]
struct Strokes {
    points: Points,
    /// Interrupted, or not begun.
    up: bool,
}

impl Strokes {
    fn push(&mut self, point: (f64, f64)) {
        self.points.push(point);
        self.up = false;
    }
}

/// Strokes that draw and strokes that do not, one going on where the other stops.
#[derive(Debug, Clone)]
struct Pair {
    drawn: Strokes,
    rapid: Strokes,
}

impl Pair {
    /// Starts without points, with room for about `count`.
    fn expecting(count: usize) -> Self {
        let strokes = || Strokes {
            points: Points::expecting(count),
            up: true,
        };
        Pair {
            drawn: strokes(),
            rapid: strokes(),
        }
    }

    /// Returns the points of drawing moves and of rapid moves.
    fn points(self) -> (Points, Points) {
        (self.drawn.points, self.rapid.points)
    }

    /// Returns the strokes of one kind, continued at `at`, and interrupts the other kind.
    fn of(&mut self, rapid: bool, at: (f64, f64)) -> &mut Strokes {
        let (to, other) = match rapid {
            true => (&mut self.rapid, &mut self.drawn),
            false => (&mut self.drawn, &mut self.rapid),
        };
        if to.up {
            to.push(at);
        }
        if !other.up {
            other.push((f64::NAN, f64::NAN));
            other.up = true;
        }
        to
    }
}

/// Returns the points of the drawing's drawing moves and rapid moves.
fn commanded(job: &Job) -> (Points, Points) {
    let points = job.drawing.moves.iter().map(|step| match step.course {
        Course::Line => 1,
        Course::Arc { .. } | Course::Spline { .. } => CHORDS as usize,
    });
    let mut strokes = Pair::expecting(points.sum());
    let mut at = job.drawing.start;
    for (index, step) in job.drawing.moves.iter().enumerate() {
        let to = strokes.of(step.rapid, (at[0], at[1]));
        for point in outline(&job.drawing, index, CHORDS) {
            to.push((point[0], point[1]));
        }
        at = step.to;
    }
    strokes.points()
}
