//! The step/direction timing monitor on lines whose times are known.

use super::common::{player, widths};
use motion_rtl::circuits::pulse_interpolator::Variant;
use motion_rtl::hdl::zero;
use motion_rtl::jobs::pulse_interpolator::StepTiming;
use motion_rtl::jobs::pulse_interpolator::step_dir::{Driver, Drivers, TimingMinima, TooShort};
use motion_rtl::sim::RunError;
use motion_rtl::trace::LastTicks;

/// Runs a driver over lines drawn as `_` and `#`; the first complaint with its tick.
fn watch(limits: StepTiming, step: &str, dir: &str) -> (Driver, Option<(u64, TooShort)>) {
    assert_eq!(step.len(), dir.len());
    let mut driver = Driver::new(limits);
    let mut complaint = None;
    for (tick, (step, dir)) in (0..).zip(step.bytes().zip(dir.bytes())) {
        let seen = driver.sample(tick, step == b'#', dir == b'#');
        complaint = complaint.or(seen.err().map(|short| (tick, short)));
    }
    (driver, complaint)
}

#[test]
fn minima_counts_and_position() {
    let step = "__##_###____#____##__#__";
    let dir_ = "_______________#########";
    let (driver, complaint) = watch(StepTiming::NONE, step, dir_);
    assert_eq!(complaint, None);
    assert_eq!((driver.pulses(), driver.position()), (5, 1));
    assert_eq!(
        driver.minima(),
        TimingMinima {
            high: Some(1),
            low: Some(1),
            setup: Some(2),
            hold: Some(3),
        }
    );
}

#[test]
fn no_edges_give_no_minima() {
    let (driver, _) = watch(StepTiming::NONE, "______", "######");
    assert_eq!(driver.minima(), TimingMinima::default());
    assert_eq!((driver.pulses(), driver.position()), (0, 0));
}

#[test]
fn the_level_of_direction_at_the_start_is_no_change() {
    let (driver, _) = watch(StepTiming::NONE, "#_#_", "####");
    assert_eq!(driver.minima().setup, None);
    assert_eq!(driver.minima().hold, None);
    assert_eq!(driver.position(), -2);
}

#[test]
fn a_direction_that_turns_twice_counts_from_its_last_turn() {
    let (driver, _) = watch(StepTiming::NONE, "_#________#_", "____#__#____");
    assert_eq!(driver.minima().setup, Some(2));
    assert_eq!(driver.minima().hold, Some(3));
}

#[test]
fn each_limit_is_judged_to_the_tick() {
    let lines = [
        ("high", "_###___", "_______", 3, 4),
        ("low", "_#___#_", "_______", 3, 5),
        ("setup", "_____#_", "__#####", 3, 5),
        ("hold", "_#_____", "____###", 3, 4),
    ];
    for (what, step, dir, ticks, at) in lines {
        for limit in 0..6 {
            let limits = StepTiming {
                step_high_ticks: if what == "high" { limit } else { 0 },
                step_low_ticks: if what == "low" { limit } else { 0 },
                dir_setup_ticks: if what == "setup" { limit } else { 0 },
                dir_hold_ticks: if what == "hold" { limit } else { 0 },
            };
            let expected = (u64::from(limit) > ticks).then(|| {
                (
                    at,
                    TooShort {
                        what,
                        ticks,
                        limit: limit.into(),
                    },
                )
            });
            assert_eq!(watch(limits, step, dir).1, expected, "{what} {limit}");
        }
    }
}

#[test]
fn a_step_in_the_tick_of_the_turn_has_no_setup() {
    let limits = StepTiming {
        dir_setup_ticks: 1,
        ..StepTiming::NONE
    };
    let (driver, complaint) = watch(limits, "__#_", "__##");
    let ticks = 0;
    let (what, limit) = ("setup", 1);
    assert_eq!(complaint, Some((2, TooShort { what, ticks, limit })));
    assert_eq!(driver.position(), -1);
}

#[test]
fn drivers_on_a_group_end_the_run_at_the_first_time_too_short() {
    let group = player(widths(4, 4, 1), Variant::Safe, &[3], 10, true);
    // The first pulse rises at tick 13 and falls at 16; the next rises at 19 and is cut at 20.
    for (min_high, ends) in [(1, None), (2, Some(20)), (3, Some(20)), (4, Some(16))] {
        let limits = StepTiming {
            step_high_ticks: min_high,
            ..StepTiming::NONE
        };
        let mut simulator = LastTicks::simulator(&group).unwrap();
        let run = simulator.run(60, |_, _| zero(&group), Drivers::new(1, limits));
        match (run, ends) {
            (Ok(()), None) => assert_eq!(simulator.tick(), 60),
            (Err(RunError::Violation { tick, signals, .. }), Some(end)) => {
                assert_eq!(
                    (tick, signals),
                    (end, vec!["step_x".into(), "dir_x".into()])
                );
            }
            (run, _) => panic!("min_high = {min_high}: {run:?}"),
        }
    }
}
