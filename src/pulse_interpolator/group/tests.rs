//! Idle ticks against ticks stepped, in every state of small groups, reachable or not.

use crate::check::Random;
use crate::kernel::{Circuit, pack, zero};
use crate::logic::Sim;
use crate::pulse_interpolator::group::{Group, In, Reg};
use crate::pulse_interpolator::{Variant, axis};

type Words<const AXES: usize, const W: usize> = Reg<Sim, AXES, W, W, 1>;

/// Takes the low `bits` off.
fn take(from: &mut u64, bits: usize) -> u64 {
    let taken = *from & ((1 << bits) - 1);
    *from >>= bits;
    taken
}

/// Counters, flip-flops, half-periods and T from the bits of `state`; what is left of it.
fn set<const AXES: usize, const W: usize>(q: &mut Words<AXES, W>, mut state: u64) -> u64 {
    q.unit_time.active = take(&mut state, W).into();
    q.counter.count = take(&mut state, W).into();
    for axis::Reg {
        memory,
        generator,
        sync,
    } in &mut q.axes
    {
        memory.half_period = take(&mut state, W).into();
        generator.count = take(&mut state, W).into();
        generator.toggle = (take(&mut state, 1) == 1).into();
        sync.step = (take(&mut state, 1) == 1).into();
    }
    state
}

/// The ports out.
fn outputs<const AXES: usize, const W: usize>(
    group: &Group<AXES, W, W, 1>,
    q: &Words<AXES, W>,
    i: &In<Sim, W, W, 1>,
) -> Vec<bool> {
    let w = group.comb(q, i);
    let lines = w.step.iter().chain(&w.dir);
    let lines = lines.chain([&w.unit_rst, &w.ready, &w.busy]);
    lines.map(|line| line.get()).collect()
}

/// Whether a counter that stops before it stands at its greatest value. The properties of the
/// counters say that it never does.
fn beyond<const AXES: usize, const W: usize>(variant: Variant, q: &Words<AXES, W>) -> bool {
    let greatest = (1 << W) - 1;
    let axis = |axis: &axis::Reg<Sim, W, 1>| axis.generator.count.get() == greatest;
    q.counter.count.get() == greatest || variant == Variant::Safe && q.axes.iter().any(axis)
}

/// Every value of what `set` sets and of the strobes; everything else is random.
fn compare<const AXES: usize, const W: usize>(variant: Variant) {
    let group = Group::<AXES, W, W, 1>::new(variant, 0);
    let mut random = Random::new(8);
    let mut longest = 0;
    for state in 0..1u64 << (2 * W + AXES * (2 * W + 2) + 3) {
        let mut q: Words<AXES, W> = random.signals();
        let mut i: In<Sim, W, W, 1> = random.signals();
        let mut strobes = set(&mut q, state);
        for strobe in [&mut i.command, &mut i.write_period, &mut i.write] {
            *strobe = (take(&mut strobes, 1) == 1).into();
        }
        i.unit_end = random.word().is_multiple_of(8).into();
        let acts = (i.command | i.write_period | i.unit_end | i.write).get();
        let idle = group.coasts_for(&q, &group.comb(&q, &i), &i);
        longest = longest.max(idle);
        assert!(!acts || idle == 0, "{i:?}");

        let (first, before) = (outputs(&group, &q, &i), q.clone());
        for ticks in 1..=idle {
            assert_eq!(
                outputs(&group, &q, &i),
                first,
                "{before:?}: idle for {idle} ticks"
            );
            let w = group.comb(&q, &i);
            q = group.next(q, &w, &i);
            let jumped = group.coasted(before.clone(), ticks);
            assert_eq!(
                pack(&q),
                pack(&jumped),
                "{before:?}: {ticks} of {idle} ticks"
            );
        }
        if acts || beyond(variant, &q) {
            continue;
        }
        let w = group.comb(&q, &i);
        let next = group.next(q.clone(), &w, &i);
        assert_ne!(
            pack(&next),
            pack(&group.coasted(q, 1)),
            "{before:?}: idle for more than {idle} ticks"
        );
    }
    assert_eq!(longest, (1 << W) - 2, "the longest there are");
}

#[test]
fn one_axis_of_three_bits() {
    compare::<1, 3>(Variant::Safe);
    compare::<1, 3>(Variant::Literal);
}

#[test]
fn two_axes_of_two_bits() {
    compare::<2, 2>(Variant::Safe);
    compare::<2, 2>(Variant::Literal);
}

#[test]
fn without_a_pulse_the_unit_time_alone_counts() {
    let group = Group::<8>::new(Variant::Safe, (1 << 24) - 1);
    let q = group.power_on();
    let idle = group.coasts_for(&q, &group.comb(&q, &zero()), &zero());
    assert_eq!(idle, (1 << 24) - 2);
    let q = group.coasted(q, idle);
    assert!(group.comb(&q, &zero()).unit_rst.get());
}
