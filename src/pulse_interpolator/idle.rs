//! How long a group only counts: until a half-period or the unit time is over, or the control
//! computer acts.
//!
//! The free-running counters are that of the unit time, 30, and those of the reference clock, 201.

use super::{Axis, Group, Variant};
use super::{axis, group, pulse_generator};
use crate::kernel::FastForward;
use crate::logic::Sim;

impl<const AXES: usize, const N: usize, const T: usize, const A: usize> FastForward
    for Group<AXES, N, T, A>
{
    #[inline(always)]
    fn idle(&self, q: &group::Reg<Sim, AXES, N, T, A>, i: &group::In<Sim, N, T, A>) -> u64 {
        if (i.command | i.write_period | i.unit_end | i.write).get() {
            return 0;
        }
        let unit = ticks_below(q.counter.count.get(), q.unit_time.active.get());
        let axes = self.axes.iter().zip(&q.axes);
        axes.fold(unit, |least, (axis, q)| least.min(axis.idle(q)))
    }

    #[inline(always)]
    fn forward(&self, q: &mut group::Reg<Sim, AXES, N, T, A>, ticks: u64) {
        q.counter.count = q.counter.count + ticks;
        for (axis, q) in self.axes.iter().zip(&mut q.axes) {
            axis.forward(q, ticks);
        }
    }
}

impl<const N: usize, const A: usize> Axis<N, A> {
    /// Idle ticks from this one on, if the unit time does not end before.
    #[inline(always)]
    fn idle(&self, q: &axis::Reg<Sim, N, A>) -> u64 {
        let pulse_generator::Reg { count, toggle } = q.generator;
        let half_period = q.memory.half_period;
        if q.sync.step != toggle {
            return 0;
        }
        match self.generator.variant {
            Variant::Safe if half_period.get() > 0 => ticks_below(count.get(), half_period.get()),
            Variant::Safe if count.get() == 0 && !toggle.get() => u64::MAX,
            Variant::Safe => 0,
            Variant::Literal => (half_period - 1 - count).get(),
        }
    }

    /// Makes the registers those after so many idle ticks.
    #[inline(always)]
    fn forward(&self, q: &mut axis::Reg<Sim, N, A>, ticks: u64) {
        if self.generator.variant == Variant::Literal || q.memory.half_period.get() > 0 {
            q.generator.count = q.generator.count + ticks;
        }
    }
}

/// The ticks from `count` on in which the count after the edge is still below `limit`.
#[inline(always)]
fn ticks_below(count: u64, limit: u64) -> u64 {
    limit.saturating_sub(1).saturating_sub(count)
}

#[cfg(test)]
mod tests;
