//! What the tests of the pulse interpolator share.

use motion_rtl::kernel::{Sample, Simulator, StopWhen, zero};
use motion_rtl::logic::Sim;
use motion_rtl::pulse_interpolator::group::{Group, In};
use motion_rtl::pulse_interpolator::{Pattern, Variant};

/// All ports in low.
pub fn idle<const N: usize, const T: usize, const A: usize>() -> In<Sim, N, T, A> {
    zero()
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
pub fn player<const N: usize, const T: usize, const A: usize>(
    variant: Variant,
    half_periods: &[u64],
    period: u64,
    cyclic: bool,
) -> Group<1, N, T, A> {
    let last = half_periods.len() as u64 - 1;
    let base = 0;
    let mut group = Group::free_running(
        variant,
        Pattern {
            base,
            last,
            cyclic,
            period,
        },
    );
    for (address, half_period) in half_periods.iter().enumerate() {
        group.axes[0].memory.half_periods.set(address, *half_period);
    }
    group
}

/// The step line of a group of one axis over `ticks` ticks.
pub fn steps<const N: usize, const T: usize, const A: usize>(
    group: &Group<1, N, T, A>,
    ticks: u64,
) -> Vec<bool> {
    let mut wave = Vec::new();
    let look = |now: &Sample<Group<1, N, T, A>>| {
        wave.push(now.w.step[0].get());
        false
    };
    Simulator::new(group)
        .unwrap()
        .run(ticks, |_, _| idle(), StopWhen(look))
        .expect("no observer fails");
    wave
}
