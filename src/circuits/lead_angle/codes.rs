//! Grid of lead times from the text's table, for programs.
//!
//! ```text
//! N   codes                 at a CK of 0.1 ms
//! 1   1, 2, … 199           0.1 to 19.9 ms by 0.1 ms
//! 2   200, 202, … 398       20 to 39.8 ms by 0.2 ms
//! 5   400, 405, … 995       40 to 99.5 ms by 0.5 ms
//! 10  1000, 1010, … 1990    100 to 199 ms by 1 ms
//! ```

use crate::hdl::log2;

/// Stages of history in the text.
pub const STAGES: u64 = 199;

/// Largest code of this history.
pub const LARGEST: u64 = largest(STAGES as usize);

/// Largest code that `stages` stages allow.
#[must_use]
pub const fn largest(stages: usize) -> u64 {
    10 * stages as u64
}

/// Width of a tap: one of `stages` stages, or none.
#[must_use]
pub fn tap_width(stages: usize) -> usize {
    log2(stages + 1)
}

/// Width of a time: a code, or none.
#[must_use]
pub fn time_width(stages: usize) -> usize {
    log2(10 * stages + 1)
}

/// A lead time that can be set.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Code {
    /// Δt in CKs.
    pub time: u64,
    /// N.
    pub ratio: u64,
    /// Δt/N in CKs.
    pub tap: u64,
}

/// Possible ratios.
const RATIOS: [u64; 4] = [1, 2, 5, 10];

/// Returns all codes that `stages` stages of history allow, in rising order. A ratio begins where
/// the previous one ends.
#[must_use]
pub fn grid(stages: u64) -> Vec<Code> {
    let mut codes: Vec<Code> = Vec::new();
    for ratio in RATIOS {
        let reached = codes.last().map_or(0, |code| code.time);
        let taps = (1..=stages).filter(|tap| tap * ratio > reached);
        codes.extend(taps.map(|tap| Code {
            time: tap * ratio,
            ratio,
            tap,
        }));
    }
    codes
}

/// Returns the code of a time in CKs, if there is one.
#[must_use]
pub fn code(stages: u64, time: u64) -> Option<Code> {
    grid(stages).into_iter().find(|code| code.time == time)
}

/// Returns the code of a time in CKs as the ratio logic rounds it: its own code, or the nearest
/// code of its range.
#[must_use]
pub fn rounded(stages: u64, time: u64) -> Code {
    let below = grid(stages)
        .into_iter()
        .rev()
        .find(|code| code.time <= time);
    let ratio = below.map_or(0, |code| code.ratio);
    let tap = (time + ratio / 2).checked_div(ratio).unwrap_or(0);
    let tap = tap.min(stages);
    Code {
        time: ratio * tap,
        ratio,
        tap,
    }
}

/// Returns the nearest times on the grid below and above a time in CKs; 0 if there is none below,
/// `None` if there is none above.
#[must_use]
pub fn neighbours(stages: u64, time: f64) -> (u64, Option<u64>) {
    let grid = grid(stages);
    let below = grid.iter().rev().find(|code| (code.time as f64) < time);
    let above = grid.iter().find(|code| code.time as f64 > time);
    (
        below.map_or(0, |code| code.time),
        above.map(|code| code.time),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn there_are_519_codes() {
        let codes = grid(STAGES);
        let count = |ratio| codes.iter().filter(|code| code.ratio == ratio).count();
        assert_eq!(RATIOS.map(count), [199, 100, 120, 100]);
        assert_eq!(codes.last().map(|code| code.time), Some(LARGEST));
        assert!(codes.iter().all(|code| code.tap <= STAGES));
    }

    #[test]
    fn the_neighbours_of_what_cannot_be_set() {
        for (time, below, above) in [
            (0.4, 0, Some(1)),
            (199.5, 199, Some(200)),
            (201.0, 200, Some(202)),
            (399.0, 398, Some(400)),
            (997.0, 995, Some(1000)),
            (1991.0, 1990, None),
            (-3.0, 0, Some(1)),
        ] {
            assert_eq!(neighbours(STAGES, time), (below, above), "{time}");
        }
    }
}
