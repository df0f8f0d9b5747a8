//! The comparator on whole walks, against positions without bounds.

use motion_rtl::kernel::Simulator;
use motion_rtl::lead_angle::comparator::In;
use motion_rtl::lead_angle::{Comparator, Comparing};
use motion_rtl::logic::Sim;

const RANGE: i64 = 16;

fn look(position: i64, target: i64, arm: bool) -> In<Sim, 4> {
    In {
        evaluate: (!arm).into(),
        valid: true.into(),
        position: position.into(),
        target: target.into(),
        arm: arm.into(),
        halt: false.into(),
    }
}

/// Whether a step from `from` to `to` gets to an image of the target, or over it.
fn reaches(from: i64, to: i64, target: i64) -> bool {
    let mut images = (-4..=4).map(|turn| target + turn * RANGE);
    images.any(|image| (from < image && to >= image) || (from > image && to <= image))
}

/// All walks of five steps of up to 3 counts on a ring of 16, from every start.
#[test]
fn a_crossing_is_counted_once_in_either_direction() {
    let ready = Simulator::new(&Comparator::<4>::default()).unwrap();
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
            simulator = simulator.step(look(position, target, true), |_| ()).0;
            // The first look finds a side, or the target itself.
            let (next, at_once) =
                simulator.step(look(position, target, false), |now| now.w.fire.get());
            simulator = next;
            assert_eq!(at_once, (position - target) % RANGE == 0);
            let mut fired = at_once;
            for step in steps {
                let to = position + step;
                let (next, (crossing, fire)) = simulator.step(look(to, target, false), |now| {
                    (now.w.crossing.get(), now.w.fire.get())
                });
                simulator = next;
                let reached = reaches(position, to, target);
                assert_eq!(crossing, reached, "{position} to {to} for {target}");
                assert_eq!(fire, reached && !fired);
                if fire {
                    assert_eq!(simulator.registers().upward.get(), step > 0);
                    crossings[usize::from(step > 0)] += 1;
                }
                fired |= reached;
                assert_eq!(simulator.registers().control.get(), fired);
                position = to;
            }
        }
    }
    assert!(
        crossings.iter().all(|&count| count > 10_000),
        "{crossings:?}"
    );
}

/// How many of `speed` neighbouring targets are hit at that speed.
fn hits(comparing: Comparing, speed: i64) -> usize {
    let ready = Simulator::new(&Comparator::<12> { comparing }).unwrap();
    let mut targets = 500..500 + speed;
    let hit = |target: &i64| {
        let mut simulator = ready.clone();
        for ck in 0..1000 / speed {
            let i = In::<Sim, 12> {
                evaluate: true.into(),
                valid: true.into(),
                position: (ck * speed).into(),
                target: (*target).into(),
                arm: (ck == 0).into(),
                halt: false.into(),
            };
            simulator = simulator.step(i, |_| ()).0;
        }
        simulator.registers().control.get()
    };
    targets.by_ref().filter(hit).count()
}

/// As the text has it, a comparison for equality hits one target in v at v counts per CK.
#[test]
fn equality_misses_what_crossing_finds() {
    for speed in 1..=60 {
        assert_eq!(hits(Comparing::Equal, speed), 1, "{speed}");
        assert_eq!(hits(Comparing::Crossing, speed), speed as usize);
    }
}
