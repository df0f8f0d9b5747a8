//! The comparator on whole walks, against positions without bounds.

use motion_rtl::circuits::lead_angle::comparator::In;
use motion_rtl::circuits::lead_angle::{Comparator, Comparing};
use motion_rtl::hdl::{Cut, Value};
use motion_rtl::sim::{Sample, Simulator};
use motion_rtl::trace::LastTicks;

const RANGE: i64 = 16;

fn look(position: i64, target: i64, arm: bool) -> In<Value> {
    In {
        evaluate: !arm,
        valid: true,
        position: position.cut(4),
        target,
        arm,
        halt: false,
    }
}

fn comparator(position: usize, comparing: Comparing) -> Simulator<Comparator> {
    let circuit = Comparator {
        position,
        comparing,
    };
    LastTicks::simulator(&circuit).unwrap()
}

/// Returns true if a step from `from` to `to` reaches or passes an image of the target.
fn reaches(from: i64, to: i64, target: i64) -> bool {
    let mut images = (-4..=4).map(|turn| target + turn * RANGE);
    images.any(|image| (from < image && to >= image) || (from > image && to <= image))
}

/// All walks of five steps of up to 3 counts on a ring of 16, from every start.
#[test]
fn a_crossing_is_counted_once_in_either_direction() {
    let ready = comparator(4, Comparing::default());
    let mut crossings = [0u64; 2];
    for start in 0..RANGE {
        for walk in 0..7i64.pow(5) {
            let steps = (0..5).scan(walk, |rest, _| {
                let step = *rest % 7 - 3;
                *rest /= 7;
                Some(step)
            });
            let mut simulator = ready.clone();
            let mut position = start;
            let target = walk % 5;
            simulator
                .step_with(&look(position, target, true), |_| ())
                .unwrap();
            // The first look finds a side, or the target itself.
            let at_once = simulator
                .step_with(&look(position, target, false), |now| now.w.fire)
                .unwrap();
            assert_eq!(at_once, (position - target) % RANGE == 0);
            let mut fired = at_once;
            for step in steps {
                let to = position + step;
                let show = |now: &Sample<'_, Comparator>| (now.w.crossing, now.w.fire);
                let (crossing, fire) = simulator.step_with(&look(to, target, false), show).unwrap();
                let reached = reaches(position, to, target);
                assert_eq!(crossing, reached, "{position} to {to} for {target}");
                assert_eq!(fire, reached && !fired);
                if fire {
                    assert_eq!(simulator.registers().q.upward, step > 0);
                    crossings[usize::from(step > 0)] += 1;
                }
                fired |= reached;
                assert_eq!(simulator.registers().q.control, fired);
                position = to;
            }
        }
    }
    assert!(
        crossings.iter().all(|&count| count > 10_000),
        "{crossings:?}"
    );
}

/// Returns how many of `speed` neighbouring targets are hit at that speed.
fn hits(comparing: Comparing, speed: i64) -> usize {
    let ready = comparator(12, comparing);
    let mut targets = 500..500 + speed;
    let hit = |target: &i64| {
        let mut simulator = ready.clone();
        for ck in 0..1000 / speed {
            let i = In {
                evaluate: true,
                valid: true,
                position: ck * speed,
                target: *target,
                arm: ck == 0,
                halt: false,
            };
            simulator.step_with(&i, |_| ()).unwrap();
        }
        simulator.registers().q.control
    };
    targets.by_ref().filter(hit).count()
}

/// The text's comparison for equality hits one target in v at v counts per CK.
#[test]
fn equality_misses_what_crossing_finds() {
    for speed in 1..=60 {
        assert_eq!(hits(Comparing::Equal, speed), 1, "{speed}");
        assert_eq!(hits(Comparing::Crossing, speed), speed as usize);
    }
}
