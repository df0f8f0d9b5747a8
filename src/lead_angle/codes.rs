//! The grid of lead times, from the text's table: what a program works with.

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

/// The ratios that there are.
const RATIOS: [u64; 4] = [1, 2, 5, 10];

/// All codes that `stages` stages of history allow, in rising order: a ratio begins where the
/// ratio before it ends.
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

/// The code of a time, if it is one.
pub fn code(stages: u64, time: u64) -> Option<Code> {
    grid(stages).into_iter().find(|code| code.time == time)
}
