use super::*;
use proptest::prelude::*;

/// End of a move, centre of an arc (from the start) with its direction, rapid, feed.
type AnyMove = (Point, Option<([f64; 2], bool)>, bool, Option<f64>);

fn any_move() -> impl Strategy<Value = AnyMove> {
    let magnitude = prop_oneof![1e-9..1e-6, 0.01..1.0, 1.0..50.0];
    let coordinate =
        (magnitude, any::<bool>()).prop_map(|(m, s): (f64, bool)| if s { m } else { -m });
    let centre = ([0.5..20.0, 0.5..20.0], any::<bool>());
    (
        [coordinate.clone(), coordinate.clone(), coordinate],
        proptest::option::of(centre),
        any::<bool>(),
        proptest::option::of(60.0..6000.0),
    )
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(256))]

    #[test]
    fn limits_hold_everywhere(
        steps in proptest::collection::vec(any_move(), 1..20),
        corner in prop_oneof![Just(0.0), 1.0..2000.0],
    ) {
        let limits = MotionLimits { corner_mm_per_min: corner, ..LIMITS };
        let a = limits.acceleration_mm_per_s2;
        let (mut moves, mut at): (Vec<Move>, Point) = (Vec::new(), [0.0; 3]);
        for (number, (by, round, rapid, feed)) in steps.into_iter().enumerate() {
            let course = round.map_or(Course::Line, |(c, clockwise)| {
                Course::Arc { centre: [at[0] + c[0], at[1] + c[1]], clockwise }
            });
            at = match course {
                Course::Line | Course::Spline { .. } => std::array::from_fn(|k| at[k] + by[k]),
                // Any angle, and a radius off by up to a tenth.
                Course::Arc { centre, .. } => {
                    let r = (at[0] - centre[0]).hypot(at[1] - centre[1]) * (1.0 + by[1] / 500.0);
                    let (sin, cos) = by[0].sin_cos();
                    [centre[0] + r * cos, centre[1] + r * sin, at[2] + by[2]]
                }
            };
            moves.push(Move { to: at, course, rapid, feed_mm_per_min: feed, line: number });
        }
        let path = drawing([0.0; 3], moves);
        let plan = Plan::new(&path, &limits).unwrap();
        let mut sampler = plan.sampler();
        let steps = 4000;
        let dt = plan.duration_s() / f64::from(steps);
        let mut before = sampler.at(0.0);
        prop_assert_eq!((before.position, before.speed), (path.start, 0.0));
        for k in 1..=steps {
            let here = sampler.at(dt * f64::from(k));
            let step = path.moves.get(here.line).unwrap();
            let feed = if step.rapid { 3000.0 } else { step.feed_mm_per_min.unwrap_or(600.0) };
            let fast = feed / 60.0;
            prop_assert!(here.speed <= fast * (1.0 + 1e-12));
            prop_assert!(here.travelled_mm >= before.travelled_mm);
            let way = here.travelled_mm - before.travelled_mm;
            prop_assert!(distance(here.position, before.position) <= way + 1e-9);
            prop_assert!((here.speed - before.speed).abs() <= a * dt * (1.0 + 1e-6) + 1e-6);
            if let Course::Arc { centre, .. } = step.course
                && here.line == before.line
            {
                let r = (here.position[0] - centre[0]).hypot(here.position[1] - centre[1]);
                let flat = (here.position[0] - before.position[0])
                    .hypot(here.position[1] - before.position[1]) / dt;
                prop_assert!(flat * flat / r <= a * 1.01 + 1e-6);
            }
            before = here;
        }
        let end = sampler.at(plan.duration_s());
        prop_assert_eq!((end.position, end.speed), (at, 0.0));
    }
}
