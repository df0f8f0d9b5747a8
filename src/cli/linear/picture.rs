//! The picture of a run: the paths of all systems with their errors magnified, the contour error
//! and the speed over time.

use super::Job;
use super::runs::{Run, Runs, Shown};
use crate::cli::magnification::magnification;
use motion_rtl::jobs::linear_interpolator::measure::{Cycle, Played, ScanRecord};
use motion_rtl::jobs::linear_interpolator::settings::Settings;
use motion_rtl::picture::{Curve, Panel, Picture, Points};

const GAP: (f64, f64) = (f64::NAN, f64::NAN);

const IDEAL: &str = "#d8d8d8";
const COMMANDED: &str = "#0072b2";
const MOTORS: &str = "#d55e00";
const OTHER: &str = "#009e73";

/// The picture as SVG.
pub fn draw(job: &Job, runs: &Runs) -> String {
    let settings = &job.settings;
    let mut systems = vec![("linear interpolator", &runs.interpolator)];
    if let Some([same, inverse]) = &runs.conventional {
        systems.push(("conventional, same settings", same));
        systems.push(("conventional, in proportion", inverse));
    }
    let mut picture = Picture::new(format!("{}: linear interpolator", job.stem));
    let size = size(&runs.interpolator.played, settings);
    for &(name, run) in &systems {
        let factor = magnification(run.largest_drawn_mm, size);
        picture = picture.panel(path(job, name, run, factor));
    }
    let mut error = Panel::new("contour error", "time in s", "error in um");
    let mut speed = Panel::new("path speed", "time in s", "speed in mm/s");
    // The interpolator's curves lie on top.
    for ((name, run), colour) in systems.into_iter().zip([COMMANDED, MOTORS, OTHER]).rev() {
        let curve = Curve::thinned(name, errors(run, settings));
        error = error.curve(curve.colour(colour).width(0.8));
        let curve = Curve::thinned(name, speeds(run, settings));
        speed = speed.curve(curve.colour(colour).width(0.8));
    }
    picture.panel(error).panel(speed).render()
}

/// The diagonal of the targets, in millimetres.
fn size(played: &Played, settings: &Settings) -> f64 {
    let [x, y] = [0, 1].map(|axis| {
        let ends = played
            .cycles
            .iter()
            .flat_map(|cycle| [cycle.from, cycle.to]);
        let (least, most) = ends.fold((0, 0), |(least, most), end| {
            (least.min(end[axis]), most.max(end[axis]))
        });
        (most - least) as f64 / settings.counts_per_mm[axis]
    });
    x.hypot(y)
}

/// The scans of each cycle, and of the wait after it.
fn by_cycle(run: &Run) -> Vec<Vec<&Shown>> {
    let mut all = vec![Vec::new(); run.played.cycles.len()];
    for shown in run.shown.iter() {
        if let Some(cycle) = shown.cycle {
            all[cycle].push(shown);
        }
    }
    all
}

fn path(job: &Job, name: &str, run: &Run, factor: f64) -> Panel {
    let scale = job.settings.counts_per_mm;
    let cycles = run.played.cycles.len();
    let scans = || Points::expecting(run.shown.iter().count() + 2 * cycles);
    let mut ideal = [0, 1].map(|_| Points::expecting(3 * cycles));
    let mut commanded = scans();
    let mut motors = [scans(), scans()];
    let cycles = run.played.cycles.iter().zip(&job.compiled.targets);
    for ((cycle, target), shown) in cycles.zip(by_cycle(run)) {
        let ends = [cycle.from, cycle.to].map(|end| end.map(|counts| counts as f64));
        let kind = usize::from(target.rapid);
        ideal[kind].extend(ends.map(|end| (end[0] / scale[0], end[1] / scale[1])));
        ideal[kind].push(GAP);
        let magnified = |point: [f64; 2]| magnify(cycle, point, scale, factor);
        motors[kind].extend(shown.iter().map(|one| magnified(one.record.motor)));
        motors[kind].push(GAP);
        if !target.rapid {
            let commands = shown.iter().map(|one| one.record.command.map(|c| c as f64));
            commanded.push(magnified(ends[0]));
            commanded.extend(commands.map(magnified));
            commanded.push(GAP);
        }
    }
    let title = match factor {
        1.0 => format!("{name}: path"),
        _ => format!("{name}: path, errors times {factor}"),
    };
    let [drawn, rapid] = ideal;
    let [motors, motors_rapid] = motors;
    Panel::new(title, "x in mm", "y in mm")
        .equal_scales()
        .curve(Curve::thinned("ideal", drawn).colour(IDEAL).width(5.0))
        .curve(
            Curve::thinned("rapid", rapid)
                .colour(IDEAL)
                .width(0.8)
                .dashed(),
        )
        .curve(
            Curve::thinned("rapid, motors", motors_rapid)
                .colour("#bdbdbd")
                .width(0.6),
        )
        .curve(Curve::thinned("motors", motors).colour(MOTORS).width(1.0))
        .curve(
            Curve::thinned("commanded", commanded)
                .colour(COMMANDED)
                .width(0.8),
        )
}

/// A point in millimetres with its distance from its line multiplied.
fn magnify(cycle: &Cycle, point: [f64; 2], scale: [f64; 2], factor: f64) -> (f64, f64) {
    let (foot, _) = cycle.foot(point, scale);
    let [x, y] = [0, 1].map(|axis| {
        let at = point[axis] / scale[axis];
        foot[axis] + (at - foot[axis]) * factor
    });
    (x, y)
}

fn time(record: &ScanRecord, settings: &Settings) -> f64 {
    record.tick as f64 / settings.clock_hz as f64
}

/// The contour error over time, in micrometres.
fn errors(run: &Run, settings: &Settings) -> Points {
    let mut points = Points::expecting(run.shown.iter().count());
    let shown = run.shown.iter().filter(|one| one.cycle.is_some());
    points.extend(shown.map(|one| (time(&one.record, settings), one.contour_mm * 1e3)));
    points
}

/// The speed of the motors along their path over time, in mm/s.
fn speeds(run: &Run, settings: &Settings) -> Points {
    let mut points = Points::expecting(run.shown.iter().count());
    let shown = run.shown.iter().skip(1);
    points.extend(shown.map(|one| (time(&one.record, settings), one.speed)));
    points
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_point_is_moved_away_from_its_line_and_not_along_it() {
        let cycle = Cycle {
            from: [100, 0],
            to: [500, 300],
            master: 0,
            scans: 0..0,
            end: [500, 300],
        };
        // A count is 0.1 mm; (6, -8) is perpendicular to (400, 300).
        let (x, y) = magnify(&cycle, [300.0 + 6.0, 150.0 - 8.0], [10.0; 2], 5.0);
        assert!(
            (x - 33.0).abs() < 1e-9 && (y - 11.0).abs() < 1e-9,
            "{x}, {y}"
        );
        let on = magnify(&cycle, [300.0, 150.0], [10.0; 2], 5.0);
        assert!((on.0 - 30.0).abs() < 1e-9 && (on.1 - 15.0).abs() < 1e-9);
    }
}
