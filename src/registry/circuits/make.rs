//! Circuits from the numbers that an entry takes.

use crate::circuits::arc_generator::{Blend, Rounding};
use crate::circuits::linear_interpolator::{MasterAxis, Rule};
use crate::circuits::pulse_interpolator::Variant;

/// Both kinds of pulse interpolator, by their numbers.
pub const VARIANTS: &[Variant] = &[Variant::Safe, Variant::Literal];

/// Which way a remainder goes, by its number.
pub const RULES: &[Rule] = &[Rule::Floor, Rule::Truncating, Rule::Centred];

/// Which axis leads, by its number.
pub const MASTERS: &[MasterAxis] = &[MasterAxis::Longer, MasterAxis::X, MasterAxis::Y];

/// How coordinates are rounded, by its number.
pub const ROUNDINGS: &[Rounding] = &[Rounding::Nearest, Rounding::Floor];

/// How blends are made, by its number.
pub const BLENDS: &[Blend] = &[Blend::Differences, Blend::Products];

/// Without or with, by its number.
pub const FLAGS: &[bool] = &[false, true];

/// So many numbers at most.
pub fn at_most(given: &[u64], count: usize) -> Option<()> {
    (given.len() <= count).then_some(())
}

/// The width that comes first.
pub fn width(given: &[u64]) -> Option<usize> {
    match given.first()? {
        width @ 1..=64 => Some(*width as usize),
        _ => None,
    }
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

/// What the only number chooses, of a circuit with its full widths.
pub fn only<T: Copy>(given: &[u64], of: &[T]) -> Option<T> {
    at_most(given, 1)?;
    choice(given, 0, of)
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
