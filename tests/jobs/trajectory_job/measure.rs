//! Measurements, against places that are known, and against a search of all lengths.

use super::*;
use motion_rtl::jobs::trajectory_controller::job::Period;
use motion_rtl::jobs::trajectory_controller::measure::{Measured, apart};
use motion_rtl::jobs::trajectory_controller::segments::{FourthAxis, Path};
use proptest::prelude::*;
use std::f64::consts::TAU;

impl Run {
    pub fn measured(&self) -> Measured {
        Measured::of(&self.program, &self.machines, &self.played).unwrap()
    }
}

fn off(a: Point, b: Point) -> f64 {
    (0..3).map(|k| (a[k] - b[k]).powi(2)).sum::<f64>().sqrt()
}

/// A line, three quarters of a circle, a line back across the first.
fn pieces() -> [Piece; 3] {
    let circle = Circle {
        centre: [10.0, 4.0, 0.0],
        axis: [0.0, 0.0, 1.0],
        start: [10.0, 0.0, 0.0],
        radius: 4.0,
        angle: 0.75 * TAU,
    };
    [
        line([10.0, 0.0, 0.0], 100.0),
        Piece {
            course: Course::Arc(circle),
            ..line([6.0, 4.0, 0.0], 100.0)
        },
        line([6.0, -5.0, 0.0], 100.0),
    ]
}

proptest! {
    #[test]
    fn the_nearest_point_is_that_of_a_search(
        x in -5.0..20.0f64,
        y in -8.0..12.0f64,
        w in -8.0..8.0f64,
        fourth in prop::bool::ANY,
        ends in [0.0..1.0f64, 0.0..1.0],
    ) {
        // With W the circle is a helix, and the lines climb.
        let own = FourthAxis { from_mm: 1.0, to_mm: vec![5.0, -6.0, 2.0] };
        let own = fourth.then_some(&own);
        let path = Path::with_fourth([0.0; 3], &pieces(), own, 1000.0, &Widths::FULL).unwrap();
        let point = [x, y, 0.0, if fourth { w } else { 0.0 }].map(|mm| mm * MM);
        let length = path.length as f64;
        let window = [ends[0].min(ends[1]) * length, ends[0].max(ends[1]) * length];
        let (at, near) = path.nearest(point, window);
        prop_assert!(window[0] <= at && at <= window[1]);
        prop_assert!(apart(near, path.place(at)) < 2.0);
        let steps = 4000;
        let searched = (0..=steps).map(|k| {
            let part = f64::from(k) / f64::from(steps);
            apart(point, path.place(window[0] + part * (window[1] - window[0])))
        });
        let least = searched.fold(f64::INFINITY, f64::min);
        let step = (window[1] - window[0]) / f64::from(steps);
        let found = apart(point, near);
        prop_assert!(found <= least + 2.0 && least <= found + step, "{} {}", found, least);
    }
}

/// A run that never was: everything is beside the path by its normal, and behind its command.
fn beside(program: &Program, off_mm: [f64; 3], behind_mm: f64) -> Played {
    let path = &program.path;
    let steps = 900;
    let periods = (0..=steps).map(|k| {
        let length = path.length as f64 * f64::from(k) / f64::from(steps);
        let command = path.point(length);
        let at = (length - behind_mm * MM).max(0.0);
        // Not across the corner at the end of the arc.
        let [here, next] = [at - 10.0, at + 10.0].map(|length| path.point(length));
        let way = off(here, next);
        let normal = [(next[1] - here[1]) / way, (here[0] - next[0]) / way];
        let place = |axis: usize, mm: f64| path.point(at)[axis] + normal[axis] * mm * MM;
        let each = |mm: f64| [place(0, mm), place(1, mm), 0.0, 0.0];
        Period {
            tick: 1000 + k as u64,
            length: length as i64,
            answered: at as i64,
            command: [command[0] as i64, command[1] as i64, 0, 0],
            reference: [0; 4],
            response: [0; 4],
            corrected: [0; 4],
            model: each(off_mm[0]).map(|units| units as i64),
            motor: each(off_mm[1]).map(|units| (units / COUNT).round() as i64),
            load: each(off_mm[2]).map(|units| units / COUNT),
            torque: [k as i64 - 300, 7, 0, 0],
            saturated: [k % 3 == 0, false, false, false],
        }
    });
    Played {
        axes: 2,
        periods: periods.collect(),
        ..Played::default()
    }
}

/// Greatest torques of X and Y in words.
fn torques(measured: &Measured) -> [f64; 2] {
    let full = TwoMassParameters::default().max_torque_nm / TwoMassAxis::FULL_SCALE as f64;
    [0, 1].map(|axis: usize| (measured.axes[axis].torque_max_nm / full).round())
}

#[test]
fn what_is_beside_the_path_is_measured_so() {
    let machine = [TwoMassParameters::default(); 2];
    let program = Program::of(
        [0.0; 3],
        &pieces()[..2],
        &settings(),
        &machine,
        &Widths::FULL,
    )
    .unwrap();
    for side in [1.0, -1.0] {
        let offs = [0.02, 0.1, 0.3].map(|mm| side * mm);
        let played = beside(&program, offs, 1.5);
        let measured = Measured::of(&program, &machine, &played).unwrap();
        let all = [&measured.model, &measured.motor, &measured.load];
        for ((errors, off_mm), near) in all.into_iter().zip(offs).zip([1e-4, 2e-3, 1e-4]) {
            let off_mm = off_mm.abs();
            assert!(
                (errors.contour_rms_um / 1e3 - off_mm).abs() < near,
                "{}",
                errors.contour_rms_um
            );
            assert!((errors.contour_max_um / 1e3 - off_mm).abs() < near);
            // Farther by the way of the lag, on the arc by its chord.
            let far = off_mm.hypot(1.5);
            assert!(
                (errors.following_max_mm - far).abs() < 0.15,
                "{}",
                errors.following_max_mm
            );
            assert!(errors.following_rms_mm < errors.following_max_mm);
            let last = errors.deviations.last().unwrap();
            let end = program.path.length as f64 / MM;
            assert!(
                (last.length_mm - end + 1.5).abs() < 0.01,
                "{}",
                last.length_mm
            );
            assert!((errors.end_um / 1e3 - last.following_mm).abs() < 1e-9);
            assert_eq!(errors.at_tick, 1000 + errors.at_period as u64);
            let peak = errors.deviations[errors.at_period];
            assert_eq!(peak.contour_mm * 1e3, errors.contour_max_um);
            assert_eq!(peak.length_mm, errors.at_mm);
            for pair in errors.deviations.windows(2) {
                assert!(pair[0].length_mm <= pair[1].length_mm + 1e-3);
            }
        }
        assert_eq!(torques(&measured), [600.0, 7.0]);
        let saturated = [0, 1].map(|axis: usize| measured.axes[axis].saturated_periods);
        assert_eq!(saturated, [301, 0]);
    }
}

/// The largest of either sign, of each axis, in the first, a middle and the last period.
#[test]
fn torque_and_distance_from_the_model_have_two_signs() {
    let machine = [TwoMassParameters::default(); 2];
    let path = &pieces()[..2];
    let program = Program::of([0.0; 3], path, &settings(), &machine, &Widths::FULL).unwrap();
    for period in [0, 450, 900] {
        for sign in [1, -1] {
            let mut played = beside(&program, [0.0; 3], 1.5);
            played.periods[period].torque = [sign * 5000, sign * 6000, 0, 0];
            for axis in 0..2 {
                let own = played.periods[period].model[axis] / COUNT as i64;
                played.periods[period].motor[axis] = own + sign * (700 + 100 * axis as i64);
            }
            let measured = Measured::of(&program, &machine, &played).unwrap();
            assert_eq!(torques(&measured), [5000.0, 6000.0]);
            for (axis, wanted) in measured.axes.iter().zip([0.7, 0.8]) {
                let off = axis.off_model_um / 1e3;
                assert!((off - wanted).abs() < 0.001, "{sign} in {period}: {off}");
            }
        }
    }
}

#[test]
fn a_run_without_periods_has_no_measures() {
    let machine = [TwoMassParameters::default(); 2];
    let program = Program::of([0.0; 3], &pieces(), &settings(), &machine, &Widths::FULL).unwrap();
    assert_eq!(Measured::of(&program, &machine, &Played::default()), None);
}

/// There and back, what is there belongs to the way that is under way.
#[test]
fn a_path_that_meets_itself_is_measured_where_it_is() {
    let there_and_back = [line([20.0, 0.0, 0.0], 100.0), line([0.0; 3], 100.0)];
    for pieces in [&pieces()[..], &there_and_back] {
        let machine = [TwoMassParameters::default(); 2];
        let run = run([0.0; 3], pieces, &settings(), &machine, Correction::Vector);
        let measured = run.measured();
        for errors in [&measured.model, &measured.motor, &measured.load] {
            for (deviation, period) in errors.deviations.iter().zip(&run.played.periods) {
                let behind = period.length as f64 / MM - deviation.length_mm;
                assert!((-0.2..2.6).contains(&behind), "{behind}: {period:?}");
            }
        }
    }
}
