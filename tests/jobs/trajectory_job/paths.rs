//! Any path: profile, commands and models against the equations in floating point.

use super::*;
use motion_rtl::jobs::trajectory_controller::profile_record::lengths;
use std::f64::consts::TAU;

/// p' = p + v, v' = v + K2(K1(u − p) − v), from old values.
#[derive(Clone, Copy, Default)]
struct Model {
    p: f64,
    v: f64,
}

impl Model {
    fn step(&mut self, u: f64, [k1, k2]: [f64; 2]) -> f64 {
        let a = k2 * (k1 * (u - self.p) - self.v);
        self.p += self.v;
        self.v += a;
        self.p
    }
}

/// Rounding error of the circuit's models: three in a row, each by 1/(2·K1·K2) units at most, and
/// the points.
const ROUNDING: f64 = 160.0;

/// The circuit, period by period, against the profile and equations (1) to (8).
fn check(run: &Run, correction: Correction) {
    let Run {
        program, played, ..
    } = run;
    let whole = lengths(&program.records, &Widths::FULL);
    let gains = [program.tangential.k1, program.tangential.k2].map(|word| word as f64 / 32_768.0);
    let mut tangential = Model::default();
    let mut responses = [Model::default(); 3];
    let mut models = [Model::default(); 3];
    let origin = program.path.point(0.0);
    for (n, period) in played.periods.iter().enumerate() {
        let [exact, ..] = program.profile.at(n as f64 * program.motion.period);
        assert!((period.length as f64 - exact).abs() <= 1.0, "{n}: {exact}");
        assert_eq!(period.length, whole[n.min(whole.len() - 1)], "{n}");
        let answered = tangential.step(period.length as f64, gains);
        assert!(
            (period.answered as f64 - answered).abs() < ROUNDING / 3.0,
            "{n}: {answered}"
        );
        let command = program.path.point(period.length as f64);
        let reference = program.path.point(match correction {
            Correction::Steady => period.length as f64,
            _ => answered,
        });
        for axis in 0..played.axes {
            let command = command[axis] - origin[axis];
            let response = responses[axis].step(command, gains);
            let corrected = match correction {
                Correction::None => command,
                Correction::Vector => command + (reference[axis] - origin[axis] - response),
                // The widened path and the motors are looked at elsewhere.
                Correction::Steady | Correction::Feedback => period.corrected[axis] as f64,
            };
            let model = models[axis].step(corrected, gains);
            let seen = [
                (period.command[axis], command, 3.0),
                (period.response[axis], response, ROUNDING / 2.0),
                (period.corrected[axis], corrected, ROUNDING),
                (period.model[axis], model, 1.5 * ROUNDING),
            ];
            for (seen, exact, near) in seen {
                let off = seen as f64 - exact;
                assert!(
                    off.abs() < near,
                    "{n}, {axis}: {seen} instead of {exact}: {off}"
                );
            }
            if correction == Correction::Steady {
                let reference = period.reference[axis];
                assert_eq!(period.corrected[axis], reference);
            }
        }
    }
    let last = played.periods.last().unwrap();
    assert_eq!(last.length, program.path.length as i64);
    assert!(played.settled);
}

#[test]
fn a_corner() {
    let corner = [
        line([15.0, 0.0, 0.0], 100.0),
        line([15.0, 10.0, 0.0], 100.0),
    ];
    for corner_mm_per_min in [0.0, 1800.0] {
        let settings = Settings {
            corner_mm_per_min,
            ..settings()
        };
        for correction in ALL {
            let run = run(
                [0.0; 3],
                &corner,
                &settings,
                &[Default::default(); 2],
                correction,
            );
            check(&run, correction);
            let measured = run.measured();
            // Models lag, so they cut the corner, even where the command stops there for a moment.
            let cut = match (corner_mm_per_min > 0.0, correction) {
                (false, Correction::Vector) => 0.0825,
                (false, _) => 0.0936,
                (true, Correction::Vector) => 0.1738,
                (true, _) => 0.2015,
            };
            let seen = measured.model;
            assert!(
                (seen.contour_max_um - 1e3 * cut).abs() < 0.1,
                "{}",
                seen.contour_max_um
            );
            assert!((seen.at_mm - 15.0).abs() < 0.3, "{}", seen.at_mm);
        }
    }
}

/// Chords of 25 µm, a quarter of what is run in a period.
#[test]
fn micro_segments_are_run_as_the_arc_they_are_of() {
    let count = 1500;
    let chords: Vec<Piece> = (1..=count)
        .map(|k| {
            let (sin, cos) = (TAU * 0.6 * f64::from(k) / f64::from(count)).sin_cos();
            line([10.0 * (cos - 1.0), 10.0 * sin, 0.0], 100.0)
        })
        .collect();
    for correction in [Correction::None, Correction::Vector] {
        let run = run(
            [0.0; 3],
            &chords,
            &settings(),
            &[Default::default(); 2],
            correction,
        );
        check(&run, correction);
        let fastest = run.program.profile.pieces.iter().map(|piece| piece.v);
        assert!((fastest.fold(0.0, f64::max) / (100.0 * MM) - 1.0).abs() < 1e-6);
        let steady = super::circle::closed(correction, 0.01, 0.05, 0.2)[1];
        let model = &run.measured().model;
        let behind = model
            .deviations
            .iter()
            .filter(|one| (28.0..32.0).contains(&one.length_mm));
        let errors: Vec<f64> = behind.map(|one| one.contour_mm).collect();
        let mean = errors.iter().sum::<f64>() / errors.len() as f64;
        // A chord is 80 nm within the arc at most.
        assert!(
            (mean - steady).abs() < 1e-4 + 0.01 * steady,
            "{mean}, not {steady}"
        );
    }
}

#[test]
fn three_axes_from_a_start_that_is_not_zero() {
    let start = [5.0, -3.0, 2.0];
    let to = [7.0, -1.0, 2.0];
    let circle = Circle::around([5.0, -1.0, 2.0], to, [5.0, 1.0, 2.0], [0.0, 0.0, 1.0]).unwrap();
    let pieces = [
        line([5.0, -3.0, -1.0], 50.0),
        line([7.0, -1.0, 2.0], 80.0),
        Piece {
            course: Course::Arc(circle),
            ..line([5.0, 1.0, 2.0], 60.0)
        },
        line([4.0, 1.0, 5.0], 60.0),
    ];
    let settings = Settings {
        jerk_time_ms: 10.0,
        ..settings()
    };
    for correction in ALL {
        let run = run(
            start,
            &pieces,
            &settings,
            &[Default::default(); 3],
            correction,
        );
        check(&run, correction);
        let measured = run.measured();
        for errors in [&measured.model, &measured.motor, &measured.load] {
            assert!(errors.end_um < 5.0, "{}", errors.end_um);
            let off = errors.deviations[0].actual;
            assert!((0..3).all(|k| (off[k] - start[k]).abs() < 1e-9));
        }
    }
}
