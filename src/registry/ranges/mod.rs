//! Values that the sizes of the catalogue's circuits take.

use super::keys::is_width;

/// Bits of a word.
const WIDTHS: (i64, i64) = (1, 64);

/// Sizes with other ranges: circuit, key, least and largest value. All other keys are those of the
/// full circuit, or of the small one where the full one does not have the key.
const OTHERS: &str = include_str!("ranges.txt");

/// Returns the least and the largest value of a width or a number of things that the circuit
/// elaborates with, the other keys as they are; `None` for a key of another type.
pub(super) fn of(circuit: &str, key: &str) -> Option<(i64, i64)> {
    let own = OTHERS.lines().find_map(|line| {
        let rest = line.strip_prefix(circuit)?.strip_prefix(' ')?;
        let (least, most) = rest.strip_prefix(key)?.strip_prefix(' ')?.split_once(' ')?;
        Some((least.parse().ok()?, most.parse().ok()?))
    });
    own.or_else(|| is_width(key).then_some(WIDTHS))
}

#[cfg(test)]
mod tests;
