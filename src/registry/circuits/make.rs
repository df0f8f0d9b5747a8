//! Circuits from the numbers that an entry takes.

use crate::pulse_interpolator::{Group, Pattern, PatternMemory, Variant};
use crate::registry::entry::at_width;
use crate::registry::{AnyCircuit, AnyModel};

/// The argument after the width, or else `default`.
pub fn second(arguments: &[u64], default: u64) -> u64 {
    arguments.get(1).copied().unwrap_or(default)
}

pub fn variant(argument: u64) -> Variant {
    match argument {
        0 => Variant::Safe,
        _ => Variant::Literal,
    }
}

/// The address bits of a memory whose words have `width` bits: one is what a proof can bear.
pub const fn address_bits(width: usize) -> usize {
    if width <= 4 { 1 } else { 4 }
}

/// Fills a memory from address 0 up; a word is a half-period, 2^`N` more for the direction down.
fn fill<const N: usize, const A: usize>(
    memory: &mut PatternMemory<N, A>,
    words: impl Iterator<Item = u64>,
) {
    for (address, word) in words.enumerate() {
        memory.half_periods.set(address, word);
        memory.directions.set(address, word >> N);
    }
}

/// A memory of axis 0, or of the one that is given, with the words given after that.
pub fn memory<const N: usize, const A: usize>(arguments: &[u64]) -> PatternMemory<N, A> {
    let mut memory = PatternMemory::new(second(arguments, 0));
    fill(&mut memory, arguments.iter().skip(2).copied());
    memory
}

/// A group of one axis whose memory holds half-periods 1 and 2 in turn, the second downwards.
fn small_group<const W: usize>(period: u64) -> Group<1, W, W, 1> {
    let mut group = Group::new(Variant::Safe, period);
    fill(&mut group.axes[0].memory, [1, 2 | 1 << W].into_iter());
    group
}

/// A group of two axes with eight words of memory each; `words` are those of x and y in turn.
fn group_of_two<const W: usize>(
    period: u64,
    kind: u64,
    start: u64,
    words: &[u64],
) -> Group<2, W, W, 3> {
    let mut group = Group::new(variant(kind), period);
    for (axis, block) in group.axes.iter_mut().enumerate() {
        fill(
            &mut block.memory,
            words.iter().skip(axis).step_by(2).copied(),
        );
    }
    group.port.free_running = (start > 0).then_some(Pattern {
        base: 0,
        last: (words.len().div_ceil(2) as u64).saturating_sub(1),
        cyclic: start == 2,
        period,
    });
    group
}

/// A group as small as a proof needs, or, where more than width and T is given, one for charts.
pub fn group(arguments: &[u64]) -> Option<Box<dyn AnyCircuit>> {
    let period = second(arguments, 3);
    match arguments {
        [_, _, kind, start, words @ ..] => {
            at_width!([2 3 4], arguments, W => group_of_two::<W>(period, *kind, *start, words))
        }
        _ => at_width!([2 3 4], arguments, W => small_group::<W>(period)),
    }
}

/// The same; the wide ones have two axes and wait for a command unless told otherwise.
pub fn group_model(arguments: &[u64]) -> Option<Box<dyn AnyModel>> {
    if let Some(small) = group(arguments) {
        return Some(small);
    }
    let (kind, start) = (arguments.get(2), arguments.get(3));
    let (kind, start) = (kind.copied().unwrap_or(0), start.copied().unwrap_or(0));
    let (period, words) = (second(arguments, 3), arguments.get(4..).unwrap_or(&[]));
    at_width!([8 16], arguments, W => group_of_two::<W>(period, kind, start, words))
}
