//! The group at cycle level: start-up, patterns, commands, unit times.

use super::common::{self, Run, player, rises, steps, unit_wave, widths};
use motion_rtl::circuits::pulse_interpolator::Variant::Safe;
use motion_rtl::circuits::pulse_interpolator::group::{Group, In};
use motion_rtl::circuits::pulse_interpolator::{Pattern, Widths, pattern_memory::WritePort};
use motion_rtl::hdl::{Declarations, Value, zero};
use motion_rtl::netlist::Role;

type Port = In<Value>;

/// Widths of most groups here.
fn small() -> Widths {
    widths(4, 4, 3)
}

/// All ports in low.
fn idle() -> Port {
    zero(&Group::new(1, small(), Safe, 1))
}

/// Signals of the group in a tick.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Seen {
    unit_rst: bool,
    busy: bool,
    ready: bool,
    address: u64,
    period: u64,
    step: bool,
    dir: bool,
}

/// Runs the group under a stimulus and shows every tick.
fn run(group: &Group, ticks: u64, stimulus: impl Fn(u64) -> Port) -> Run<Seen> {
    common::run(group, ticks, stimulus, |now| Seen {
        unit_rst: now.w.unit_rst,
        busy: now.w.busy,
        ready: now.w.ready,
        address: now.see(|s| s.p.sequencer.q.address),
        period: now.see(|s| s.p.unit_time.q.active),
        step: now.w.step[0],
        dir: now.w.dir[0],
    })
}

/// A command that starts the pattern `base..=last`.
fn start(base: u64, last: u64, cyclic: bool, now: bool, period: u64) -> Port {
    Port {
        command: true,
        base,
        last,
        cyclic,
        run: true,
        now,
        period,
        ..idle()
    }
}

/// A group whose memory holds half-period 1 at every address, and which waits for commands.
fn waiting(period: u64) -> Group {
    let mut group = Group::new(1, small(), Safe, period);
    for address in 0..8 {
        group.memories[0].half_periods.set(address, 1);
    }
    group
}

/// The addresses of the unit times while the group is busy, one for each unit time.
fn units(seen: &[Seen]) -> Vec<u64> {
    let mut begins = true;
    let mut units = Vec::new();
    for tick in seen {
        if begins && tick.busy {
            units.push(tick.address);
        }
        begins = tick.unit_rst;
    }
    units
}

/// The ticks in which RST is high.
fn resets(seen: &[Seen]) -> Vec<u64> {
    (0..)
        .zip(seen)
        .filter(|(_, tick)| tick.unit_rst)
        .map(|(n, _)| n)
        .collect()
}

#[test]
fn the_first_unit_time_after_power_on_is_silent() {
    for period in 1..=15u64 {
        for half_period in 1..=15u64 {
            let group = player(small(), Safe, &[half_period], period, true);
            let first = (period + half_period) as usize;
            let wave = steps(&group, 3 * period);
            for (tick, level) in wave.iter().enumerate().take(first) {
                assert!(!level, "T = {period}, n = {half_period}: high at {tick}");
            }
            if half_period < period {
                assert!(
                    wave[first],
                    "T = {period}, n = {half_period}: low at {first}"
                );
            }
        }
    }
}

#[test]
fn a_looping_pattern_skips_no_address() {
    for last in 0..8u64 {
        let half_periods = vec![0; last as usize + 1];
        let group = player(small(), Safe, &half_periods, 3, true);
        let seen = run(&group, 3 + 3 * 40, |_| idle());
        let expected: Vec<_> = (0..40).map(|unit| unit % (last + 1)).collect();
        assert_eq!(units(&seen), expected);
        assert!(seen[3..].iter().all(|tick| tick.busy));
    }
}

#[test]
fn a_pattern_that_stops_holds_its_last_address_without_pulses() {
    for last in 0..8u64 {
        let half_periods = vec![1; last as usize + 1];
        let group = player(small(), Safe, &half_periods, 3, false);
        let seen = run(&group, 3 * 40, |_| idle());
        assert_eq!(units(&seen), (0..=last).collect::<Vec<_>>());
        let end = 3 + 3 * (last as usize + 1);
        for tick in &seen[end..] {
            assert!(!tick.busy && !tick.step && tick.address == last);
        }
        assert_eq!(
            seen.iter().filter(|tick| tick.step).count() as u64,
            last + 1
        );
    }
}

#[test]
fn a_pattern_may_run_across_the_top_of_the_memory() {
    let seen = run(&waiting(3), 30, |tick| match tick {
        0 => start(6, 1, false, false, 3),
        _ => idle(),
    });
    assert_eq!(units(&seen), [6, 7, 0, 1]);
}

#[test]
fn a_new_unit_time_is_in_force_only_from_the_next_reset_on() {
    for old in 1..=7u64 {
        for new in 1..=15u64 {
            for write in 0..3 * old {
                let group = player(small(), Safe, &[2], old, true);
                let seen = run(&group, 80, |tick| Port {
                    write_period: tick == write,
                    period: new,
                    ..idle()
                });
                // The pattern loads its own unit time at tick `old`; a write in the tick before
                // waits in the shadow register for the reset after it.
                let in_force = match write {
                    write if write + 1 < old => 0,
                    write => (write + 2).next_multiple_of(old).max(2 * old),
                };
                let mut expected = vec![];
                let mut next = 0;
                while next < 80 {
                    let long = if in_force > 0 && next >= in_force {
                        new
                    } else {
                        old
                    };
                    next += long;
                    expected.push(next - 1);
                }
                expected.retain(|tick| *tick < 80);
                assert_eq!(resets(&seen), expected, "{old} -> {new} written at {write}");
            }
        }
    }
}

#[test]
fn a_command_brings_its_unit_time_along_and_waits_for_the_end_of_the_pattern() {
    let seen = run(&waiting(2), 40, |tick| match tick {
        0 => start(0, 1, false, false, 5),
        3 => start(4, 5, false, false, 7),
        _ => idle(),
    });
    assert_eq!(resets(&seen)[..6], [1, 6, 11, 18, 25, 32]);
    assert_eq!(units(&seen), [0, 1, 4, 5]);
    let periods: Vec<_> = [0, 2, 7, 12, 19].map(|tick| seen[tick].period).to_vec();
    assert_eq!(periods, [2, 5, 5, 7, 7]);
    // One command waits from the tick after it was given to the tick it is taken in.
    let waits: Vec<_> = (0..40).filter(|tick| !seen[*tick].ready).collect();
    assert_eq!(waits, (1..=1).chain(4..=11).collect::<Vec<_>>());
}

#[test]
fn a_command_is_for_the_first_reset_after_the_tick_it_was_given_in() {
    for given in 8..16u64 {
        let seen = run(&waiting(4), 60, |tick| match tick {
            0 => start(0, 7, true, false, 4),
            tick if tick == given => start(3, 3, false, true, 4),
            _ => idle(),
        });
        // Resets are at 3, 7, 11, …; a command given at 11 itself waits for 15.
        let taken = (given + 2).next_multiple_of(4);
        let before = (taken - 4) / 4;
        let expected: Vec<_> = (0..before).chain([3]).collect();
        assert_eq!(units(&seen), expected, "given at {given}");
    }
}

#[test]
fn a_restart_in_mid_unit_leaves_the_unit_whole() {
    let mut group = waiting(5);
    for address in 0..8 {
        group.memories[0].half_periods.set(address, 2);
    }
    for given in 10..15u64 {
        let seen = run(&group, 30, |tick| match tick {
            0 => start(0, 7, true, false, 5),
            tick if tick == given => start(0, 7, true, true, 5),
            _ => idle(),
        });
        let wave: Vec<_> = seen.iter().map(|tick| tick.step).collect();
        for unit in wave[5..].chunks(5) {
            assert_eq!(unit, unit_wave(2, 5));
        }
    }
}

#[test]
fn a_stop_command_ends_the_pattern_at_the_next_reset() {
    let stop = Port {
        run: false,
        ..start(0, 0, false, true, 4)
    };
    let seen = run(&waiting(4), 40, |tick| match tick {
        0 => start(0, 7, true, false, 4),
        9 => stop.clone(),
        _ => idle(),
    });
    assert_eq!(units(&seen), [0, 1]);
    assert!(seen[12..].iter().all(|tick| !tick.busy && !tick.step));
}

#[test]
fn a_command_with_now_replaces_the_one_that_waits() {
    let seen = run(&waiting(4), 40, |tick| match tick {
        0 => start(0, 1, true, false, 4),
        5 => start(2, 2, false, false, 4),
        6 => start(7, 7, false, true, 4),
        _ => idle(),
    });
    assert_eq!(units(&seen), [0, 7]);
}

#[test]
fn a_command_without_now_does_not_disturb_the_one_that_waits() {
    let seen = run(&waiting(4), 40, |tick| match tick {
        0 => start(0, 1, false, false, 4),
        5 => start(2, 2, false, false, 4),
        6 => start(7, 7, false, false, 4),
        _ => idle(),
    });
    assert_eq!(units(&seen), [0, 1, 2]);
}

#[test]
fn a_word_written_while_it_is_read_is_read_as_it_was() {
    for write in 0..8u64 {
        let mut group = waiting(4);
        group.memories[0].half_periods.set(1, 0);
        let seen = run(&group, 40, |tick| Port {
            port: WritePort {
                write: tick == write,
                write_axis: 0,
                write_address: 1,
                write_half_period: 2,
                write_direction: true,
            },
            ..match tick {
                0 => start(0, 1, false, false, 4),
                _ => idle(),
            }
        });
        // Address 1 is read in tick 7, the RST before its unit time.
        let wave: Vec<_> = seen[8..12].iter().map(|tick| tick.step).collect();
        let half_period = if write < 7 { 2 } else { 0 };
        assert_eq!(wave, unit_wave(half_period, 4), "written at {write}");
        assert!(seen[8..].iter().all(|tick| tick.dir == (write < 7)));
        assert!(seen[..8].iter().all(|tick| !tick.dir));
    }
}

#[test]
fn a_write_goes_to_the_axis_it_names() {
    let group = Group::new(2, widths(3, 3, 1), Safe, 4);
    for axis in 0..8u64 {
        let drive = |tick| In {
            port: WritePort {
                write: tick == 0,
                write_axis: axis,
                write_half_period: 1,
                ..zero(&group).port
            },
            command: tick == 1,
            run: true,
            period: 4,
            ..zero(&group)
        };
        let shown = common::run(&group, 20, drive, |now| now.w.step.clone());
        let rose = [0, 1].map(|line| {
            let wave: Vec<bool> = shown.iter().map(|step| step[line]).collect();
            rises(&wave)
        });
        assert_eq!(rose, [0, 1].map(|line| if line == axis { 2 } else { 0 }));
    }
}

#[test]
fn half_periods_at_the_edges() {
    // n = 1 toggles every tick, n = T - 1 rises in the last tick, n = T and beyond never.
    for period in 2..=15u64 {
        for (half_period, count) in [(1, period / 2), (period - 1, 1), (period, 0), (15, 0)] {
            let group = player(small(), Safe, &[half_period], period, false);
            assert_eq!(
                rises(&steps(&group, 3 * period)),
                count,
                "T = {period}, n = {half_period}"
            );
        }
    }
}

#[test]
fn default_word_lengths() {
    let group = Group::new(2, Widths::default(), Safe, 1000);
    let leaves = Declarations::of(&group).leaves;
    let bits = |scope: &str| -> usize {
        let inside = leaves.iter().filter(|leaf| {
            let scopes = leaf.scopes.get(1).is_some_and(|inner| inner == scope);
            scopes && leaf.role == Role::Register
        });
        inside.map(|leaf| leaf.shape.width).sum()
    };
    assert_eq!(bits("unit_time"), 2 * 24);
    // Words with direction, their output register, then count, toggle and step.
    for axis in ["x", "y"] {
        assert_eq!(bits(axis), 4096 * 17 + 17 + 16 + 1 + 1);
    }
}

#[test]
fn eight_axes_under_one_unit_time_counter() {
    let half_periods = [1, 2, 3, 5, 40, 99, 100, 0];
    let pattern = Pattern {
        base: 4090,
        last: 4091,
        cyclic: true,
        period: 100,
    };
    let mut group = Group::free_running(8, Widths::default(), Safe, pattern);
    for (memory, half_period) in group.memories.iter_mut().zip(half_periods) {
        memory.half_periods.set(4090, half_period);
        memory.half_periods.set(4091, 100 - half_period);
    }
    let shown = common::run(&group, 500, |_| zero(&group), |now| now.w.step.clone());
    for (axis, half_period) in half_periods.into_iter().enumerate() {
        let wave: Vec<bool> = shown.iter().map(|step| step[axis]).collect();
        assert_eq!(wave[..100], [false; 100], "before the first unit time");
        let (first, second) = (
            unit_wave(half_period, 100),
            unit_wave(100 - half_period, 100),
        );
        let expected = [first.clone(), second.clone(), first, second].concat();
        assert_eq!(wave[100..], expected, "n = {half_period}");
    }
}
