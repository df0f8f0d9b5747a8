//! Helpers of the pulse interpolator's tests.

use motion_rtl::circuits::pulse_interpolator::group::In;
use motion_rtl::circuits::pulse_interpolator::{Group, Pattern, Variant, Widths};
use motion_rtl::hdl::{Value, zero};
use motion_rtl::sim::{Each, Sample, Simulator};
use motion_rtl::trace::LastTicks;
use std::ops::Deref;

/// Widths of half-period, unit time and address.
pub fn widths(half_period: usize, period: usize, address: usize) -> Widths {
    Widths {
        half_period,
        period,
        address,
    }
}

/// The step line in each tick of one unit time, from the definition: it toggles every
/// `half_period` ticks and starts low.
pub fn unit_wave(half_period: u64, period: u64) -> Vec<bool> {
    (0..period)
        .map(|tick| half_period > 0 && (tick / half_period) % 2 == 1)
        .collect()
}

/// The number of rising edges, the line being low before.
pub fn rises(wave: &[bool]) -> u64 {
    let before = std::iter::once(&false).chain(wave);
    before.zip(wave).filter(|(a, b)| !**a && **b).count() as u64
}

/// A free-running group of one axis with the given half-periods as its one pattern.
pub fn player(
    widths: Widths,
    variant: Variant,
    half_periods: &[u64],
    period: u64,
    cyclic: bool,
) -> Group {
    let pattern = Pattern {
        base: 0,
        last: half_periods.len() as u64 - 1,
        cyclic,
        period,
    };
    let mut group = Group::free_running(1, widths, variant, pattern);
    for (address, half_period) in half_periods.iter().enumerate() {
        group.memories[0].half_periods.set(address, *half_period);
    }
    group
}

/// One value for each tick of a run. A test that fails while it has a run leaves the waves of its
/// last ticks.
pub struct Run<T> {
    shown: Vec<T>,
    _simulator: Simulator<Group>,
}

impl<T> Deref for Run<T> {
    type Target = [T];

    fn deref(&self) -> &[T] {
        &self.shown
    }
}

/// Runs a group from power-on for `ticks` ticks; `show` gives the value of each.
pub fn run<T>(
    group: &Group,
    ticks: u64,
    stimulus: impl Fn(u64) -> In<Value>,
    mut show: impl FnMut(&Sample<'_, Group>) -> T,
) -> Run<T> {
    let mut shown = Vec::new();
    let look = |now: &Sample<'_, Group>| shown.push(show(now));
    let mut simulator = LastTicks::simulator(group).unwrap();
    simulator
        .run(ticks, |tick, _| stimulus(tick), Each(look))
        .expect("no observer fails");
    Run {
        shown,
        _simulator: simulator,
    }
}

/// The step line of a group of one axis over `ticks` ticks.
pub fn steps(group: &Group, ticks: u64) -> Run<bool> {
    run(group, ticks, |_| zero(group), |now| now.w.step[0])
}
