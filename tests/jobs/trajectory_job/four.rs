//! A fourth axis beside the three of a path: W, linear with the length of each piece.

use super::*;
use motion_rtl::jobs::trajectory_controller::each_axis::EachAxis;
use motion_rtl::jobs::trajectory_controller::job::Period;
use motion_rtl::jobs::trajectory_controller::measure::apart;
use motion_rtl::jobs::trajectory_controller::program::ProgramError;
use motion_rtl::jobs::trajectory_controller::segments::FourthAxis;
use motion_rtl::path::pieces::{Speeds, Taught, from_points};

/// Four ticks more than three axes take, for the words of the fourth.
fn with_w() -> Settings {
    Settings {
        clock_hz: 1000 * (LEAST_PERIOD_TICKS + 4),
        corner_mm_per_min: 1200.0,
        ..Settings::default()
    }
}

fn planned(
    pieces: &[Piece],
    fourth: &FourthAxis,
    settings: &Settings,
    axes: usize,
) -> Result<Program, ProgramError> {
    let machine = vec![TwoMassParameters::default(); axes];
    let start = [0.0; 3];
    Program::with_fourth(
        start,
        pieces,
        Some(fourth),
        settings,
        &machine,
        &Widths::FULL,
    )
}

fn played(pieces: &[Piece], fourth: &FourthAxis, correction: Correction) -> Run {
    let settings = with_w();
    let program = planned(pieces, fourth, &settings, 4).unwrap();
    let circuit = controller(4, correction, settings.rounding);
    let machine = [TwoMassParameters::default(); 4];
    let plants = plants(&machine, 1.0 / settings.clock_hz as f64);
    let played = play(&circuit, &program, plants, &mut ()).unwrap();
    assert!(!played.late && !played.starved && !played.lost && played.settled);
    assert_eq!(played.axes, 4);
    Run {
        machines: machine.to_vec(),
        program,
        played,
    }
}

/// An arc, a line, W alone, a line back; W from 2 to 6, on to 3, to 8 alone, and there.
fn bent() -> ([Piece; 4], FourthAxis) {
    let quarter = arc(10.0, 1.5, 100.0);
    let [x, y, _] = quarter.to;
    let to = [x - 20.0, y + 5.0, 3.0];
    let pieces = [
        quarter,
        line(to, 100.0),
        line(to, 100.0),
        line([0.0, 0.0, 1.0], 100.0),
    ];
    let to_mm = vec![6.0, 3.0, 8.0, 8.0];
    let from_mm = 2.0;
    (pieces, FourthAxis { from_mm, to_mm })
}

/// W where the path is at a length, from where it begins, by the pieces.
fn w_at(run: &Run, fourth: &FourthAxis, length: f64) -> f64 {
    let path = &run.program.path;
    let length = length.clamp(0.0, path.length as f64);
    let stretch = &path.stretches[path.index(length)];
    let from = match stretch.piece {
        0 => fourth.from_mm,
        piece => fourth.to_mm[piece - 1],
    };
    let part = (length - stretch.begin as f64) / stretch.length as f64;
    (from + part * (fourth.to_mm[stretch.piece] - from) - fourth.from_mm) * MM
}

#[test]
fn a_length_is_the_way_of_all_four() {
    let (pieces, fourth) = bent();
    let program = planned(&pieces, &fourth, &with_w(), 4).unwrap();
    let path = &program.path;
    assert_eq!(path.stretches.len(), 4);
    let [x, y, _] = pieces[0].to;
    let back = (x - 20.0).hypot(y + 5.0).hypot(2.0);
    let ways = [
        15f64.hypot(4.0),
        20f64.hypot(5.0).hypot(3.0).hypot(3.0),
        5.0,
        back,
    ];
    for (stretch, way) in path.stretches.iter().zip(ways) {
        assert!(
            (stretch.length as f64 - way * MM).abs() <= 1.0,
            "{stretch:?}"
        );
    }
    // W turns back from 4 to -3 mm over these lengths, where the arc ends: no tangent.
    let [before, after] = [0, 1].map(|k| path.stretches[k]);
    let [way, next] = [before.directions[1], after.directions[0]];
    let beside = after.segment.fourth.unwrap().along - before.segment.fourth.unwrap().along;
    assert!((beside + 4.0 / ways[0] + 3.0 / ways[1]).abs() < 1e-6);
    let turn = (0..3).map(|k| (next[k] - way[k]).powi(2)).sum::<f64>();
    let speed = 20.0 / (turn + beside * beside).sqrt() * MM;
    let [at, ..] = program.profile.at(0.0);
    assert_eq!(at, 0.0);
    let joint = before.length as f64;
    let mut fastest = 0.0f64;
    for k in 0..4000 {
        let [length, speed, ..] = program.profile.at(f64::from(k) * 1e-4);
        if (length - joint).abs() < 0.01 * MM {
            fastest = fastest.max(speed);
        }
    }
    assert!(
        fastest > 0.5 * speed && fastest < 1.01 * speed,
        "{fastest} {speed}"
    );
}

/// Points, sums and errors of all four axes; W is corrected as the others are.
#[test]
#[ignore = "takes long"]
fn w_is_on_the_path_and_is_corrected() {
    let (pieces, fourth) = bent();
    let mut rms = Vec::new();
    for correction in [Correction::None, Correction::Vector, Correction::Feedback] {
        let run = played(&pieces, &fourth, correction);
        let mut squares = [0.0; 2];
        let measured = run.measured();
        for (number, period) in run.played.periods.iter().enumerate() {
            let exact = w_at(&run, &fourth, period.length as f64);
            let off = period.command[3] as f64 - exact;
            assert!(off.abs() < 3.0, "{off}: {period:?}");
            if correction == Correction::Vector {
                let off = period.reference[3] as f64 - w_at(&run, &fourth, period.answered as f64);
                assert!(off.abs() < 3.0, "{off}: {period:?}");
                for axis in 0..4 {
                    let sum = period.command[axis] + period.reference[axis] - period.response[axis];
                    assert_eq!(period.corrected[axis], sum);
                }
            }
            let model = period.model.map(|units| units as f64);
            let load = period.load.map(|of| of * COUNT);
            for (part, (at, seen)) in [(model, &measured.model), (load, &measured.load)]
                .into_iter()
                .enumerate()
            {
                let off = contour(&run, &fourth, period, at);
                squares[part] += off.powi(2);
                // The search has steps of 0.2 um.
                let one = seen.deviations[number];
                assert!(
                    (one.contour_mm * MM - off).abs() < 1e-4 * MM,
                    "{off}: {one:?}"
                );
                assert!((one.w_mm * MM - fourth.from_mm * MM - at[3]).abs() < 1.0);
                let command = period.command.map(|units| units as f64);
                let late = apart(at, command);
                assert!(
                    (one.following_mm * MM - late).abs() < 1.0,
                    "{late}: {one:?}"
                );
            }
        }
        let end = [0, 0, 1000, 6000].map(|counts| f64::from(counts) * COUNT);
        let last = run.played.periods.last().unwrap();
        let off = apart(last.model.map(|units| units as f64), end) / MM;
        assert!((measured.model.end_um - 1e3 * off).abs() < 1e-3, "{off}");
        for (axis, end) in [0i64, 0, 1000, 6000].into_iter().enumerate() {
            assert!((last.motor[axis] - end).abs() <= 2, "{last:?}");
            assert!((last.load[axis] - end as f64).abs() <= 2.0, "{last:?}");
        }
        let axes = measured.axes;
        let names: Vec<_> = axes.iter().map(|axis| axis.axis).collect();
        assert_eq!(names, ["x", "y", "z", "w"]);
        assert!(
            axes[3].torque_max_nm > 0.03 * run.machines[3].max_torque_nm,
            "{axes:?}"
        );
        let count = run.played.periods.len() as f64;
        let own = squares.map(|sum| (sum / count).sqrt() / MM * 1e3);
        println!("{correction:?}: {own:.2?} um rms of models and loads");
        rms.push(own);
    }
    // The errors left by the vector correction are at the corners.
    for part in 0..2 {
        assert!(rms[1][part] < 0.7 * rms[0][part], "{rms:?}");
        assert!(rms[2][part] < 0.3 * rms[0][part], "{rms:?}");
    }
}

/// Distance from the path in all four, by a search around where the tangential response is.
fn contour(run: &Run, fourth: &FourthAxis, period: &Period, at: [f64; 4]) -> f64 {
    let path = &run.program.path;
    let off = |length: f64| {
        let [x, y, z] = path.point(length.clamp(0.0, path.length as f64));
        let due = [x, y, z, w_at(run, fourth, length)];
        apart(at, due)
    };
    let search = |from: f64, step: f64| {
        let from = from.clamp(0.0, path.length as f64);
        let lengths = (-200..=200).map(|k| from + f64::from(k) * step);
        lengths.min_by(|a, b| off(*a).total_cmp(&off(*b))).unwrap()
    };
    let near = search(period.answered as f64, 0.02 * MM);
    off(search(near, 2e-4 * MM))
}

/// Where W is told what Y is told, both are the same to the bit, whatever corrects them.
#[test]
#[ignore = "takes long"]
fn w_beside_y_is_y() {
    let pieces = [
        line([10.0, 4.0, 0.0], 100.0),
        line([13.0, 12.0, 2.0], 80.0),
        line([13.0, -3.0, 2.0], 100.0),
    ];
    let fourth = FourthAxis {
        from_mm: 0.0,
        to_mm: vec![4.0, 12.0, -3.0],
    };
    for correction in [ALL.as_slice(), &[Correction::Feedback]].concat() {
        let run = played(&pieces, &fourth, correction);
        let same = |of: fn(&Period) -> [i64; 4]| {
            let mut all = run.played.periods.iter().map(of);
            all.all(|[_, y, _, w]| y == w)
        };
        assert!(same(|period| period.command), "{correction:?}");
        assert!(same(|period| period.reference), "{correction:?}");
        assert!(same(|period| period.response), "{correction:?}");
        assert!(same(|period| period.corrected), "{correction:?}");
        assert!(same(|period| period.model), "{correction:?}");
        assert!(same(|period| period.motor), "{correction:?}");
        assert!(same(|period| period.torque), "{correction:?}");
        let moved = run
            .played
            .periods
            .iter()
            .any(|period| period.motor[3] > 11_000);
        assert!(moved, "{correction:?}");
    }
}

/// W has no more acceleration than it is allowed, and no less than it could have, on lines.
#[test]
fn w_is_within_its_own_acceleration() {
    let (pieces, fourth) = bent();
    let settings = |w: f64| Settings {
        acceleration_mm_per_s2: Some(1e4),
        axis_acceleration_mm_per_s2: Some(EachAxis::Each(vec![1e9, 1e9, 1e9, w])),
        ..with_w()
    };
    // W moves alone, so that what it is allowed is all that the path has.
    let acceleration = |w: f64| {
        let program = planned(&pieces, &fourth, &settings(w), 4).unwrap();
        program.motion.slope.acceleration / MM
    };
    assert!((acceleration(300.0) / 300.0 - 1.0).abs() < 1e-9);
    assert_eq!(acceleration(9e8), 1e4);
    // On an arc of 15 mm with 4 of W: its part of the way, and as much for what is across.
    let (arc, way) = (&pieces[..1], 4.0 / 15f64.hypot(4.0));
    let program = planned(arc, &fourth, &settings(300.0), 4).unwrap();
    let own = program.motion.slope.acceleration / MM;
    assert!(
        (own * way * 2f64.sqrt() / 300.0 - 1.0).abs() < 1e-6,
        "{own}"
    );
}

#[test]
fn a_fourth_axis_at_fault_is_refused() {
    let (pieces, fourth) = bent();
    let refused = |fourth: &FourthAxis, settings: &Settings, axes: usize, text: &str| {
        let error = planned(&pieces, fourth, settings, axes).unwrap_err();
        assert_eq!(error.to_string(), text);
    };
    refused(&fourth, &with_w(), 3, "axes: is 3; allowed: 4");
    let short = settings();
    refused(
        &fourth,
        &short,
        4,
        &format!(
            "period_ms: is 1: {LEAST_PERIOD_TICKS} ticks; allowed: {} ticks or more for 4 axes",
            LEAST_PERIOD_TICKS + 4
        ),
    );
    let with = |at: usize, mm: f64| {
        let mut other = fourth.clone();
        other.to_mm[at] = mm;
        other
    };
    let path = |fourth: &FourthAxis| planned(&pieces, fourth, &with_w(), 4).unwrap_err();
    let error = path(&with(1, f64::NAN)).to_string();
    assert!(error.contains("w is NaN"), "{error}");
    // Half of the range of 31 bits, from where it begins.
    let error = path(&with(2, 600_000.0)).to_string();
    assert!(error.contains('w'), "{error}");
    // Along a spline W may stand, but not move.
    let taught = [1.0, 2.0, 3.0].map(|x| Taught {
        to: [x, x * x, 0.0],
        via: None,
        spline: true,
        speed: Some(50.0),
    });
    let curve = from_points([0.0; 3], &taught, Speeds::from(&with_w())).unwrap();
    let along = |to_mm: [f64; 3]| {
        let to_mm = to_mm.to_vec();
        let from_mm = 1.0;
        planned(&curve, &FourthAxis { from_mm, to_mm }, &with_w(), 4)
    };
    assert!(along([1.0; 3]).is_ok());
    let error = along([1.0, 1.0, 2.0]).unwrap_err().to_string();
    assert!(error.contains("is a spline along which W moves"), "{error}");
    // Lists are of four.
    let lists = Settings {
        axis_acceleration_mm_per_s2: Some(EachAxis::Each(vec![1e3; 3])),
        ..with_w()
    };
    refused(
        &fourth,
        &lists,
        4,
        "axis_acceleration_mm_per_s2: is a list of 3; allowed: a number for all axes, or a list \
         of 4",
    );
    // Three axes have no fourth.
    let machine = [TwoMassParameters::default(); 4];
    let three = Program::of([0.0; 3], &pieces, &with_w(), &machine, &Widths::FULL);
    let error = three.unwrap_err().to_string();
    assert_eq!(error, "axes: is 4; allowed: 2 or 3");
}
