//! Helpers of the pulse interpolator's tests.

use motion_rtl::circuits::pulse_interpolator::{Group, Pattern, Variant, Widths};
use motion_rtl::hdl::zero;
use motion_rtl::sim::{Each, Sample};
use motion_rtl::trace::LastTicks;

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

/// The step line of a group of one axis over `ticks` ticks.
pub fn steps(group: &Group, ticks: u64) -> Vec<bool> {
    let mut wave = Vec::new();
    let look = |now: &Sample<'_, Group>| {
        wave.push(now.w.step[0]);
    };
    LastTicks::simulator(group)
        .unwrap()
        .run(ticks, |_, _| zero(group), Each(look))
        .expect("no observer fails");
    wave
}
