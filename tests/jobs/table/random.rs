//! Random paths under random settings.

use super::judge::{drawing, run};
use motion_rtl::circuits::pulse_interpolator::counts;
use motion_rtl::input::{Course, Drawing, Move, Point};
use motion_rtl::jobs::pulse_interpolator::{Settings, StepTiming};
use motion_rtl::plan::MotionLimits;
use proptest::prelude::*;

/// A random path: chained lines and arcs, each arc by an angle about a centre.
fn any_path() -> impl Strategy<Value = Drawing> {
    let reach = prop_oneof![Just(0.0), -0.02..0.02, -5.0..5.0];
    let round = proptest::option::of(([0.1..3.0, -3.0..3.0], any::<bool>()));
    let step = ([reach.clone(), reach.clone(), reach], round, any::<bool>());
    let start = [-2.0..2.0, -2.0..2.0, -2.0..2.0];
    (start, proptest::collection::vec(step, 1..10)).prop_map(|(start, steps)| {
        let (mut at, mut moves): (Point, Vec<Move>) = (start, Vec::new());
        for (by, round, rapid) in steps {
            let course = match round {
                None => Course::Line,
                Some((c, clockwise)) => Course::Arc {
                    centre: [at[0] + c[0], at[1] + c[1]],
                    clockwise,
                },
            };
            at = match course {
                Course::Line | Course::Spline { .. } => std::array::from_fn(|k| at[k] + by[k]),
                Course::Arc { centre, .. } => {
                    let (x, y) = (at[0] - centre[0], at[1] - centre[1]);
                    let (sin, cos) = by[0].sin_cos();
                    [
                        centre[0] + x * cos - y * sin,
                        centre[1] + x * sin + y * cos,
                        at[2] + by[2],
                    ]
                }
            };
            moves.push(Move {
                to: at,
                course,
                rapid,
                feed_mm_per_min: None,
                line: 0,
            });
        }
        drawing(start, moves)
    })
}

fn any_settings() -> impl Strategy<Value = Settings> {
    let scale = (1.0..400.0, any::<bool>()).prop_map(|(s, r): (f64, bool)| if r { -s } else { s });
    let motion = (
        60.0..9000.0,
        60.0..9000.0,
        prop_oneof![Just(0.0), 1.0..9000.0],
        50.0..50_000.0,
    );
    (
        proptest::collection::vec(scale, 1..=3),
        motion,
        [40_u32..3000, 40_u32..3000],
        [0_u32..15, 0_u32..15, 0_u32..20, 0_u32..40],
        20_000_u64..200_000,
    )
        .prop_map(
            |(steps_per_mm, motion, periods, timing, clock_hz)| Settings {
                clock_hz,
                steps_per_mm,
                motion: MotionLimits {
                    feed_mm_per_min: motion.0,
                    rapid_mm_per_min: motion.1,
                    corner_mm_per_min: motion.2,
                    acceleration_mm_per_s2: motion.3,
                },
                line_unit_ticks: periods[0],
                arc_unit_ticks: periods[1],
                timing: StepTiming {
                    step_high_ticks: timing[0],
                    step_low_ticks: timing[1],
                    dir_setup_ticks: timing[2],
                    dir_hold_ticks: timing[3],
                },
                ..Settings::default()
            },
        )
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    #[ignore = "takes long"]
    fn pulses_add_up_to_the_steps_demanded(path in any_path(), settings in any_settings()) {
        let (table, report) = run(&path, &settings);
        if let Some(remedy) = report.remedy {
            let (_, remedied) = run(&path, &settings.with_period(remedy.period));
            prop_assert_eq!(remedied.unattainable_units, 0);
        }
        for (period, words) in table.iter() {
            for word in words.iter().filter(|w| w.half_period() > 0) {
                prop_assert!(counts::pulses(word.half_period(), period) > 0);
            }
        }
    }
}
