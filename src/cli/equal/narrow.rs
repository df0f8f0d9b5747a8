//! Narrower widths, for a proof that takes too long at full width.

use super::Failure;
use super::check::{Attempt, Check, Outcome};
use crate::cli::progress;
use motion_rtl::registry::Pair;
use std::time::Instant;

/// Returns the next greatest width to try: half as much again.
fn next(greatest: u64) -> u64 {
    (greatest + 1).max(greatest * 3 / 2)
}

/// Tries narrower widths of the circuit and the design, all in proportion, from the least up.
/// Returns the widest proof within the time limit, or the first difference; `None` if there is
/// neither, or if no parameter of the design follows the circuit.
pub fn narrower<'a>(
    full: &Check<'a>,
    pairs: &[Pair],
) -> Result<Option<(Check<'a>, Attempt)>, Failure> {
    let (arguments, design, entry) = (full.arguments, full.design, full.entry);
    if !design.follows() {
        return Ok(None);
    }
    let until = arguments.until();
    let mut best = None;
    let mut refusal = None;
    let mut greatest = 2;
    while greatest < entry.greatest_width(pairs) && Instant::now() < until {
        let widths = entry.widths_at(pairs, greatest);
        let width = greatest;
        greatest = next(greatest);
        let narrow = widths.into_iter().map(|(key, bits)| Pair::new(key, bits));
        let narrow: Vec<Pair> = narrow.collect();
        let changes: String = narrow.iter().map(|pair| format!(" --set {pair}")).collect();
        let pairs = [pairs, &narrow].concat();
        // A circuit that does not exist at this width.
        let Ok(mut check) = Check::new(arguments, design, entry, &pairs, changes) else {
            continue;
        };
        check.width = Some(width);
        progress::tell(&format!("width {width}:{}", check.changes));
        match check.attempt(until) {
            Ok(attempt) => match attempt.outcome {
                Outcome::Proved(_) => best = Some((check, attempt)),
                Outcome::Differs(..) => return Ok(Some((check, attempt))),
                Outcome::Open { .. } if best.is_some() => break,
                Outcome::Open { .. } => {}
            },
            Err(failure) if best.is_none() => {
                refusal = Some(format!("at width {width}: {failure}"));
            }
            Err(_) => break,
        }
    }
    match (best, refusal) {
        (None, Some(refusal)) => Err(Failure::Undecided(refusal)),
        (best, _) => Ok(best),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn widths_grow_by_half() {
        let widths = std::iter::successors(Some(1), |width| Some(next(*width)));
        let widths: Vec<u64> = widths.take(8).collect();
        assert_eq!(widths, [1, 2, 3, 4, 6, 9, 13, 19]);
    }
}
