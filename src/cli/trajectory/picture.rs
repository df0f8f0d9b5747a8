//! The picture of a run: the path with the loads' errors magnified, contour error, following error
//! and speed over time, by each correction.

use super::Job;
use super::runs::{Run, Runs};
use crate::cli::magnification::magnification;
use motion_rtl::input::Point;
use motion_rtl::jobs::trajectory_controller::measure::Deviation;
use motion_rtl::jobs::trajectory_controller::program::Program;
use motion_rtl::jobs::trajectory_controller::settings::Correction;
use motion_rtl::path::vector::{distance, sub};
use motion_rtl::picture::{Curve, Panel, Picture, Points as Thinning};

const GAP: (f64, f64) = (f64::NAN, f64::NAN);

const IDEAL: &str = "#d8d8d8";
/// Colour of the plan.
const PLANNED: &str = "#8c8c8c";

/// Colour of the run at full feed, where the others are slower.
const FULL_FEED: &str = "#d55e00";

/// The loads' speed.
const LOADS: &str = "#0072b2";

/// A point of the path is drawn for at most so long a way, as a part of the path.
const STEP: f64 = 1e-3;

/// A curve with gaps.
type Points = Vec<(f64, f64)>;

/// A run's curve: wider below, for what is the same to be seen.
fn curve(run: &Run, points: Points) -> Curve {
    let (colour, width) = match run.correction {
        _ if run.full_feed => (FULL_FEED, 0.9),
        Correction::None => ("#e69f00", 2.6),
        Correction::Steady => ("#009e73", 1.4),
        Correction::Feedback => ("#cc79a7", 1.1),
        Correction::Vector => ("#0072b2", 0.9),
    };
    Curve::new(run.name(), points).colour(colour).width(width)
}

/// The picture as SVG.
pub fn draw(job: &Job, runs: &Runs) -> String {
    Picture::new(format!("{}: trajectory controller", job.stem))
        .panel(path(job, runs))
        .panel(over_time(runs, "contour error of the loads", "µm", |one| {
            one.contour_mm * 1e3
        }))
        .panel(over_time(
            runs,
            "following error of the loads",
            "mm",
            |one| one.following_mm,
        ))
        .panel(speed(job, runs))
        .render()
}

fn path(job: &Job, runs: &Runs) -> Panel {
    let factor = magnification(largest(runs), size(job));
    let view = match job.axes() {
        2 => "path",
        _ => "path from above",
    };
    let title = match factor {
        1.0 => view.to_owned(),
        _ => format!("{view}, errors of the loads times {factor}"),
    };
    let [drawn, rapid] = ideal(job);
    let mut panel = Panel::new(title, "x in mm", "y in mm")
        .equal_scales()
        .curve(Curve::new("ideal", drawn).colour(IDEAL).width(5.0));
    if !rapid.is_empty() {
        let curve = Curve::new("rapid", rapid).colour(IDEAL).width(0.8);
        panel = panel.curve(curve.dashed());
    }
    for run in &runs.runs {
        panel = panel.curve(curve(run, magnified(run, factor)));
    }
    panel
}

/// The diagonal of the path in the plane, in mm.
fn size(job: &Job) -> f64 {
    let points = ideal(job)
        .into_iter()
        .flatten()
        .filter(|at| at.0.is_finite());
    let start = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    let (least, most) = points.fold(start, |(least, most), (x, y)| {
        (
            [least[0].min(x), least[1].min(y)],
            [most[0].max(x), most[1].max(y)],
        )
    });
    (most[0] - least[0]).hypot(most[1] - least[1])
}

/// The largest error that is drawn, in mm.
fn largest(runs: &Runs) -> f64 {
    let all = runs.runs.iter().map(|run| run.largest_drawn_mm);
    all.fold(0.0, f64::max)
}

/// The path in the plane: what is drawn, and rapid moves.
fn ideal(job: &Job) -> [Points; 2] {
    let (path, unit) = (&job.program.path, job.program.motion.units_per_mm);
    let step = path.length as f64 * STEP;
    let mut parts = [const { Points::new() }; 2];
    for stretch in &path.stretches {
        let part = &mut parts[usize::from(job.is_rapid(stretch.piece))];
        let pieces = match stretch.radius {
            None => 1,
            Some(_) => (stretch.length as f64 / step).ceil().max(8.0) as u32,
        };
        let points = (0..=pieces).map(|k| {
            let offset = stretch.length as f64 * f64::from(k) / f64::from(pieces);
            let [x, y, _] = stretch.segment.point(offset);
            (x / unit, y / unit)
        });
        let begins = stretch.segment.point(0.0);
        let gap = part
            .last()
            .is_some_and(|&(x, y)| distance([x * unit, y * unit, begins[2]], begins) > 1e-3 * unit);
        part.extend(gap.then_some(GAP));
        part.extend(points);
    }
    parts
}

/// Returns the points of the loads, their distance from the path multiplied by `factor`.
fn magnified(run: &Run, factor: f64) -> Points {
    let points = run.shown.iter().map(|one| {
        if one.rapid {
            return GAP;
        }
        let (actual, nearest) = (one.load.actual, one.load.nearest);
        let off: Point = sub(actual, nearest);
        let [x, y] = [0, 1].map(|axis| nearest[axis] + factor * off[axis]);
        (x, y)
    });
    points.collect()
}

/// An error by each correction.
fn over_time(runs: &Runs, title: &str, unit: &str, of: fn(&Deviation) -> f64) -> Panel {
    let mut panel = Panel::new(title, "time in s", unit);
    for run in &runs.runs {
        let all = run.shown.iter().map(|one| &one.load);
        let points = all.map(|one| (one.time_s, of(one))).collect();
        panel = panel.curve(curve(run, points));
    }
    panel
}

/// The planned speed, and that of the loads in the run with waves.
fn speed(job: &Job, runs: &Runs) -> Panel {
    let (run, period) = (runs.traced(), job.period_s());
    let periods = run.shown.count();
    let planned = |program: &Program, name: &str| {
        let unit = program.motion.units_per_mm;
        let mut points = Thinning::expecting(periods);
        points.extend((0..periods).map(|sample| {
            let t = sample as f64 * period;
            (t, program.profile.at(t)[1] / unit)
        }));
        let curve = Curve::thinned(name, points);
        curve.colour(PLANNED).dashed()
    };
    let loads = run.shown.iter().filter_map(|one| one.speed);
    let name = format!("loads, {}", run.correction.name());
    let mut panel = Panel::new("speed", "time in s", "mm/s")
        .curve(Curve::new(name, loads.collect()).colour(LOADS))
        .curve(planned(&job.program, "planned"));
    if let Some(program) = &job.full_feed {
        let curve = planned(program, "planned, full feed");
        panel = panel.curve(curve.colour(FULL_FEED));
    }
    panel
}
