use super::*;
use crate::input::{Course, Drawing, Move, Point};
use std::f64::consts::{PI, TAU};

mod random;

fn line(x: f64, y: f64, z: f64) -> Move {
    Move {
        to: [x, y, z],
        course: Course::Line,
        rapid: false,
        feed_mm_per_min: None,
        line: 1,
    }
}

fn arc(x: f64, y: f64, z: f64, centre: [f64; 2], clockwise: bool) -> Move {
    Move {
        course: Course::Arc { centre, clockwise },
        ..line(x, y, z)
    }
}

fn drawing(start: Point, moves: Vec<Move>) -> Drawing {
    Drawing {
        file: "test".into(),
        fourth: Vec::new(),
        zero_length: 0,
        start,
        moves: moves.into_iter().collect(),
        warnings: Vec::new(),
    }
}

/// Feed 10 mm/s, rapid 50 mm/s, 100 mm/s², stop at corners.
const LIMITS: MotionLimits = MotionLimits {
    feed_mm_per_min: 600.0,
    rapid_mm_per_min: 3000.0,
    corner_mm_per_min: 0.0,
    acceleration_mm_per_s2: 100.0,
};

fn close(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-9 * (1.0 + a.abs().max(b.abs()))
}

fn distance(a: Point, b: Point) -> f64 {
    (0..3).map(|k| (a[k] - b[k]).powi(2)).sum::<f64>().sqrt()
}

fn duration(drawing: &Drawing, limits: &MotionLimits) -> f64 {
    Plan::new(drawing, limits).unwrap().duration_s()
}

#[test]
fn single_line_takes_length_by_feed_plus_one_ramp() {
    let straight = drawing([1.0, 2.0, 3.0], vec![line(1.0, 42.0, 33.0)]);
    let plan = Plan::new(&straight, &LIMITS).unwrap();
    assert!(close(plan.length_mm(), 50.0));
    assert!(close(plan.duration_s(), 50.0 / 10.0 + 10.0 / 100.0));
    let mut sampler = plan.sampler();
    assert_eq!(sampler.at(0.0).position, [1.0, 2.0, 3.0]);
    // Half a ramp: a·t²/2 along the direction (0, 0.8, 0.6).
    let early = sampler.at(0.05);
    assert!(close(early.speed, 5.0) && close(early.travelled_mm, 0.125));
    assert!(distance(early.position, [1.0, 2.1, 3.075]) < 1e-12);
    let middle = sampler.at(plan.duration_s() / 2.0);
    assert!(distance(middle.position, [1.0, 22.0, 18.0]) < 1e-9);
    assert_eq!(sampler.at(plan.duration_s()).position, plan.end());
    assert_eq!(sampler.at(1e9).speed, 0.0);
    // Going back is allowed.
    assert_eq!(sampler.at(0.05), early);
}

#[test]
fn short_line_is_a_triangle() {
    let short = drawing([0.0; 3], vec![line(0.25, 0.0, 0.0)]);
    let plan = Plan::new(&short, &LIMITS).unwrap();
    assert!(close(plan.duration_s(), 2.0 * (0.25_f64 / 100.0).sqrt()));
    assert!(close(plan.segment(0).0.peak, 5.0));
}

#[test]
fn circle_runs_at_the_feed_or_at_the_centripetal_limit() {
    let circle = |radius: f64| {
        let round = arc(radius, 0.0, 0.0, [0.0, 0.0], false);
        drawing([radius, 0.0, 0.0], vec![round])
    };
    // √(a·R) is 20 mm/s at 4 mm and 5 mm/s at 0.25 mm.
    let wide = TAU * 4.0 / 10.0 + 0.1;
    assert!(close(duration(&circle(4.0), &LIMITS), wide));
    let tight = TAU * 0.25 / 5.0 + 0.05;
    assert!(close(duration(&circle(0.25), &LIMITS), tight));
    let whole = circle(4.0);
    let plan = Plan::new(&whole, &LIMITS).unwrap();
    let half = plan.sampler().at(plan.duration_s() / 2.0);
    assert!(distance(half.position, [-4.0, 0.0, 0.0]) < 1e-9 && half.arc);
    let quarter = plan.sampler().at(wide / 2.0 - TAU / 4.0 * 4.0 / 10.0);
    assert!(
        distance(quarter.position, [0.0, 4.0, 0.0]) < 1e-9,
        "counter-clockwise"
    );
}

#[test]
fn arcs_turn_the_way_they_say_and_as_far() {
    // From (2, 0) about the origin: end, clockwise, turn, and the point halfway.
    let diagonal = 2.0_f64.sqrt();
    let cases = [
        ([0.0, 2.0], false, TAU / 4.0, [diagonal, diagonal]),
        ([0.0, 2.0], true, TAU * 0.75, [-diagonal, -diagonal]),
        ([0.0, -2.0], false, TAU * 0.75, [-diagonal, diagonal]),
        ([0.0, -2.0], true, TAU / 4.0, [diagonal, -diagonal]),
        ([2.0, 0.0], false, TAU, [-2.0, 0.0]),
        ([2.0, 0.0], true, TAU, [-2.0, 0.0]),
    ];
    for (to, clockwise, turn, half_way) in cases {
        let round = arc(to[0], to[1], 0.0, [0.0, 0.0], clockwise);
        let path = drawing([2.0, 0.0, 0.0], vec![round]);
        let plan = Plan::new(&path, &LIMITS).unwrap();
        assert!(
            close(plan.length_mm(), 2.0 * turn),
            "{to:?}, clockwise {clockwise}"
        );
        let half = plan.sampler().at(plan.duration_s() / 2.0).position;
        assert!(distance(half, [half_way[0], half_way[1], 0.0]) < 1e-9);
        let start = plan.sampler().at(0.02).position;
        assert_eq!(start[1] > 0.0, !clockwise);
    }
}

#[test]
fn helix_climbs_in_proportion_to_its_angle() {
    let down = arc(0.0, -3.0, 4.0, [0.0, 0.0], true);
    let helix = drawing([0.0, 3.0, 0.0], vec![down]);
    let plan = Plan::new(&helix, &LIMITS).unwrap();
    assert!(close(plan.length_mm(), (3.0 * PI).hypot(4.0)));
    let half = plan.sampler().at(plan.duration_s() / 2.0).position;
    assert!(
        distance(half, [3.0, 0.0, 2.0]) < 1e-9,
        "clockwise: {half:?}"
    );
}

#[test]
fn spiral_between_two_radii_ends_exactly() {
    let unequal = arc(-2.0, 0.0, 0.0, [0.0, 0.0], false);
    let spiral = drawing([1.0, 0.0, 0.0], vec![unequal, line(-2.0, 5.0, 0.0)]);
    let plan = Plan::new(&spiral, &LIMITS).unwrap();
    let joint = plan.segment(1).0.start_s;
    let mut sampler = plan.sampler();
    assert!(distance(sampler.at(joint - 1e-12).position, [-2.0, 0.0, 0.0]) < 1e-9);
    let mut before = sampler.at(0.0).position;
    for k in 1..=1000 {
        let here = sampler.at(joint * f64::from(k) / 1000.0).position;
        assert!(distance(here, before) <= 10.0 * joint / 1000.0 + 1e-12);
        before = here;
    }
}

#[test]
fn corners_limit_the_sudden_change_of_velocity() {
    let square = drawing([0.0; 3], vec![line(50.0, 0.0, 0.0), line(50.0, 50.0, 0.0)]);
    let stopping = Plan::new(&square, &LIMITS).unwrap();
    assert_eq!(stopping.segment(1).0.entry, 0.0);
    assert!(close(stopping.duration_s(), 2.0 * (5.0 + 0.1)));
    let slowing = MotionLimits {
        corner_mm_per_min: 60.0,
        ..LIMITS
    };
    let entry = Plan::new(&square, &slowing).unwrap().segment(1).0.entry;
    assert!(
        close(entry * 2.0_f64.sqrt(), 1.0),
        "a right angle changes it by √2 times the speed"
    );
    let reversing = drawing([0.0; 3], vec![line(50.0, 0.0, 0.0), line(0.0, 0.0, 0.0)]);
    let entry = Plan::new(&reversing, &slowing).unwrap().segment(1).0.entry;
    assert!(close(entry, 0.5));
}

#[test]
fn tangents_and_collinear_moves_do_not_slow_down() {
    let track = drawing(
        [0.0; 3],
        vec![
            line(10.0, 0.0, 0.0),
            line(10.0, 0.0, 0.0),
            line(30.0, 0.0, 0.0),
            arc(40.0, 10.0, 0.0, [30.0, 10.0], false),
            line(40.0, 30.0, 0.0),
        ],
    );
    let plan = Plan::new(&track, &LIMITS).unwrap();
    assert_eq!(plan.segments().len(), 4, "a move without length is none");
    let length = 30.0 + 5.0 * PI + 20.0;
    assert!(close(plan.duration_s(), length / 10.0 + 0.1));
}

#[test]
fn feeds_and_rapids_are_kept_and_met_ahead() {
    let mut moves = vec![
        line(100.0, 0.0, 0.0),
        line(200.0, 0.0, 0.0),
        line(300.0, 0.0, 0.0),
    ];
    moves[1].feed_mm_per_min = Some(120.0);
    moves[2].rapid = true;
    let path = drawing([0.0; 3], moves);
    let plan = Plan::new(&path, &LIMITS).unwrap();
    let speeds: Vec<_> = plan.segments().map(|s| (s.entry, s.peak, s.exit)).collect();
    assert_eq!(
        speeds,
        [(0.0, 10.0, 2.0), (2.0, 2.0, 2.0), (2.0, 50.0, 0.0)]
    );
}

#[test]
fn tiny_segments_next_to_huge_ones() {
    let mut moves = Vec::new();
    let mut x = 0.0;
    for k in 0..2000 {
        x += if k % 100 == 50 { 1e4 } else { 1e-9 };
        moves.push(line(x, 0.0, 0.0));
    }
    let path = drawing([0.0; 3], moves);
    let plan = Plan::new(&path, &LIMITS).unwrap();
    let expected = x / 10.0 + 0.1;
    assert!((plan.duration_s() - expected).abs() < 1e-6 * expected);
    let mut sampler = plan.sampler();
    let mut before = sampler.at(0.0);
    for k in 1..=100_000 {
        let here = sampler.at(plan.duration_s() * f64::from(k) / 1e5);
        assert!(here.position[0] >= before.position[0] && here.speed <= 10.0);
        before = here;
    }
    assert_eq!(before.position, plan.end());
}

#[test]
fn nothing_to_do() {
    for path in [
        drawing([1.0; 3], vec![line(1.0, 1.0, 1.0)]),
        drawing([1.0; 3], vec![]),
    ] {
        let plan = Plan::new(&path, &LIMITS).unwrap();
        assert_eq!((plan.duration_s(), plan.segments().len()), (0.0, 0));
        assert_eq!(plan.sampler().at(3.0).position, [1.0; 3]);
    }
}

#[test]
fn refuses_what_it_cannot_plan_with() {
    let refuse = |start: Point, step: Move| {
        Plan::new(&drawing(start, vec![step]), &LIMITS)
            .unwrap_err()
            .to_string()
    };
    let good = line(1.0, 0.0, 0.0);
    assert!(refuse([0.0; 3], line(f64::NAN, 0.0, 0.0)).contains("line 1: X = NaN"));
    assert!(refuse([0.0, 0.0, -2e6], good).contains("line 0: Z = -2000000 mm"));
    let feed = |f| {
        let mut step = line(1.0, 0.0, 0.0);
        step.feed_mm_per_min = Some(f);
        step
    };
    assert!(refuse([0.0; 3], feed(0.0)).contains("feed 0 mm/min"));
    assert!(refuse([0.0; 3], feed(f64::INFINITY)).contains("feed inf"));
    assert!(refuse([0.0; 3], arc(1.0, 0.0, 0.0, [1.0, 0.0], true)).contains("radius 0 mm"));
    let far = arc(1.0, 0.0, 0.0, [0.0, f64::INFINITY], true);
    assert!(refuse([0.0; 3], far).contains("centre Y = inf"));
    type Change = fn(&mut MotionLimits, f64);
    let fields: [(&str, Change); 4] = [
        ("feed_mm_per_min", |l, v| l.feed_mm_per_min = v),
        ("rapid_mm_per_min", |l, v| l.rapid_mm_per_min = v),
        ("corner_mm_per_min", |l, v| l.corner_mm_per_min = v),
        ("acceleration_mm_per_s2", |l, v| {
            l.acceleration_mm_per_s2 = v
        }),
    ];
    for (field, set) in fields {
        for bad in [-1.0, f64::NAN, f64::INFINITY] {
            let mut limits = LIMITS;
            set(&mut limits, bad);
            let message = limits.ranges().unwrap_err().to_string();
            assert!(
                message.starts_with(&format!("{field}: is {bad}; allowed")),
                "{message}"
            );
        }
    }
}

#[test]
fn a_million_moves_end_at_rest() {
    let moves = (1..=1_000_000)
        .map(|k| {
            let angle = f64::from(k) * 0.01;
            line(angle, 30.0 * angle.sin(), 0.0)
        })
        .collect();
    let path = drawing([0.0; 3], moves);
    let plan = Plan::new(&path, &LIMITS).unwrap();
    assert_eq!(plan.segments().len(), 1_000_000);
    let last = plan.segments().last().unwrap();
    assert_eq!(last.exit, 0.0);
}

#[test]
fn the_outline_of_an_arc_that_is_almost_closed_goes_nearly_all_around() {
    for gap in [1e-3, 1e-6] {
        for clockwise in [false, true] {
            let end = if clockwise { gap } else { -gap };
            let open = drawing(
                [10.0, 0.0, 0.0],
                vec![arc(10.0, end, 0.0, [0.0; 2], clockwise)],
            );
            let points: Vec<_> = outline(&open, 0, 180).collect();
            assert_eq!(points.len(), 180);
            assert_eq!(points[179], [10.0, end, 0.0]);
            let way = |k: usize| distance(points[k - 1], points[k]);
            let around: f64 = (1..180).map(way).sum();
            let chord = 20.0 * (PI / 180.0).sin();
            assert!((around - 179.0 * chord).abs() < 2.0 * gap, "{around}");
            // The first quarter is on the side to which the arc turns.
            assert_eq!(points[44][1] < 0.0, clockwise);
        }
    }
}
