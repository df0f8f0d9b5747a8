//! Circuits from the numbers that an entry takes.

use crate::arc_generator::Rounding;
use crate::linear_interpolator::Rule;
use crate::pulse_interpolator::{Group, Pattern, PatternMemory, Variant};
use crate::registry::entry::at_width;
use crate::registry::{AnyCircuit, AnyModel};

/// Both kinds of pulse interpolator, by their numbers.
pub const VARIANTS: &[Variant] = &[Variant::Safe, Variant::Literal];

/// Which way a remainder goes, by its number.
pub const RULES: &[Rule] = &[Rule::Floor, Rule::Truncating, Rule::Centred];

/// How coordinates are rounded, by its number.
pub const ROUNDINGS: &[Rounding] = &[Rounding::Nearest, Rounding::Floor];

/// So many numbers at most.
pub fn at_most(given: &[u64], count: usize) -> Option<()> {
    (given.len() <= count).then_some(())
}

/// What a number chooses; the first where it is not given.
pub fn choice<T: Copy>(given: &[u64], place: usize, of: &[T]) -> Option<T> {
    let number = given.get(place).copied().unwrap_or(0);
    of.get(usize::try_from(number).ok()?).copied()
}

/// What the last number chooses, behind the width.
pub fn one_of<T: Copy>(given: &[u64], of: &[T]) -> Option<T> {
    at_most(given, 2)?;
    choice(given, 1, of)
}

/// A number that fits in `width` bits.
pub fn word(number: u64, width: usize) -> Option<u64> {
    (width >= 64 || number >> width == 0).then_some(number)
}

/// Numbers from a place on, at most so many of `width` bits each.
pub fn words(given: &[u64], place: usize, count: usize, width: usize) -> Option<&[u64]> {
    let words = given.get(place..).unwrap_or(&[]);
    at_most(words, count)?;
    let fit = words.iter().all(|&number| word(number, width).is_some());
    fit.then_some(words)
}

/// The number behind the width, of as many bits.
pub fn second(given: &[u64], default: u64, width: usize) -> Option<u64> {
    word(given.get(1).copied().unwrap_or(default), width)
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
pub fn memory<const N: usize, const A: usize>(given: &[u64]) -> Option<PatternMemory<N, A>> {
    let words = words(given, 2, 1 << A, N + 1)?;
    let mut memory = PatternMemory::new(second(given, 0, 3)?);
    fill(&mut memory, words.iter().copied());
    Some(memory)
}

/// A group of one axis whose memory holds half-periods 1 and 2 in turn, the second downwards.
fn small_group<const W: usize>(given: &[u64]) -> Option<Group<1, W, W, 1>> {
    at_most(given, 2)?;
    let mut group = Group::new(Variant::Safe, second(given, 3, W)?);
    fill(&mut group.axes[0].memory, [1, 2 | 1 << W].into_iter());
    Some(group)
}

/// A group of two axes with eight words of memory each; the words given are those of x and y in
/// turn.
fn group_of_two<const W: usize>(given: &[u64]) -> Option<Group<2, W, W, 3>> {
    let (period, variant) = (second(given, 3, W)?, choice(given, 2, VARIANTS)?);
    let cyclic = choice(given, 3, &[None, Some(false), Some(true)])?;
    let words = words(given, 4, 16, W + 1)?;
    let mut group = Group::new(variant, period);
    for (axis, block) in group.axes.iter_mut().enumerate() {
        fill(
            &mut block.memory,
            words.iter().skip(axis).step_by(2).copied(),
        );
    }
    group.port.free_running = cyclic.map(|cyclic| Pattern {
        base: 0,
        last: (words.len().div_ceil(2) as u64).saturating_sub(1),
        cyclic,
        period,
    });
    Some(group)
}

/// A group as small as a proof needs.
pub fn group(given: &[u64]) -> Option<Box<dyn AnyCircuit>> {
    at_width!([2 4], given, W => small_group::<W>(given)?)
}

/// The same, or, where more than width and T is given, one for charts. The wide one has two axes and
/// waits for a command unless told otherwise.
pub fn group_model(given: &[u64]) -> Option<Box<dyn AnyModel>> {
    match given {
        [4] | [4, _] => Some(Box::new(small_group::<4>(given)?)),
        _ => at_width!([4 8], given, W => group_of_two::<W>(given)?),
    }
}
