//! The count law of one unit time: how many pulses a half-period gives, and which counts exist.
//!
//! The step signal toggles at ticks n, 2n, 3n, … and the reset at tick T has priority, so it rises
//! at every odd multiple of n below T. Times are in reference ticks throughout; a half-period
//! of 0 means "no pulse".

use std::ops::RangeInclusive;

/// Pulses (rising edges) in a unit time of `period` ticks: `floor((floor((T-1)/n)+1)/2)`.
///
/// The result is (T-1)/2n rounded to the nearest integer; halves round up.
#[must_use]
pub fn pulses(half_period: u32, period: u32) -> u32 {
    let toggles = period
        .saturating_sub(1)
        .checked_div(half_period)
        .unwrap_or(0);
    toggles.div_ceil(2)
}

/// Returns true if some half-period gives exactly `pulses` in `period` ticks: `floor((T-1)/(2Y-1))
/// > floor((T-1)/(2Y+1))`, and always for no pulses at all.
#[must_use]
pub fn attainable(pulses: u32, period: u32) -> bool {
    half_periods(pulses, period).is_some()
}

/// The half-periods that give exactly `pulses` in `period` ticks; `None` where none does.
///
/// For no pulses the range is every half-period from T up; 0, which also gives none, is outside
/// it.
#[must_use]
pub fn half_periods(pulses: u32, period: u32) -> Option<RangeInclusive<u32>> {
    if pulses == 0 {
        return Some(period.max(1)..=u32::MAX);
    }
    let last_tick = u64::from(period.saturating_sub(1));
    let odd = 2 * u64::from(pulses) - 1;
    let shortest = last_tick / (odd + 2) + 1;
    let longest = last_tick / odd;
    // Both are at most T, hence the casts keep the value.
    (shortest <= longest).then_some(shortest as u32..=longest as u32)
}

/// The half-period of paragraphs 0021 to 0023: T shared out evenly and lengthened where a fraction
/// is left, `ceil(T/(2Y))`. `None` for no pulses.
///
/// The result does not always give `pulses`: see [`recipe_is_exact`].
#[must_use]
pub fn recipe(pulses: u32, period: u32) -> Option<u32> {
    let share = u64::from(period).div_ceil((2 * u64::from(pulses)).max(1));
    (pulses > 0).then_some(share as u32)
}

/// Returns true if `(2Y-1)² < T`: then the [`recipe`] gives exactly `pulses`, the last of which
/// falls exactly at T.
///
/// Beyond that it still does where 2Y happens to divide T, and else may give fewer.
#[must_use]
pub fn recipe_is_exact(pulses: u32, period: u32) -> bool {
    let odd = (2 * u128::from(pulses)).saturating_sub(1);
    odd * odd < u128::from(period)
}

/// The counts other than 0 that `period` ticks can hold, from the highest down.
pub fn attainable_counts(period: u32) -> impl Iterator<Item = u32> {
    let mut half_period = 1;
    std::iter::from_fn(move || {
        let count = pulses(half_period, period);
        let range = half_periods(count, period).filter(|_| count > 0)?;
        half_period = range.end() + 1;
        Some(count)
    })
}

/// Number of different counts, 0 among them, that `period` ticks can hold: about 1.4·√T.
#[must_use]
pub fn attainable_count(period: u32) -> usize {
    1 + attainable_counts(period).count()
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;

    /// Plays one unit time, tick by tick: rise and fall of each pulse. Independent of the law
    /// above.
    pub(crate) fn play(half_period: u32, period: u32) -> Vec<(u32, u32)> {
        let (mut counter, mut level, mut edges) = (0, false, Vec::new());
        for tick in 1..=period {
            counter += 1;
            let toggle = counter == half_period;
            if toggle {
                counter = 0;
            }
            if tick == period {
                if level {
                    edges.push(tick);
                }
            } else if toggle {
                level = !level;
                edges.push(tick);
            }
        }
        edges.chunks_exact(2).map(|e| (e[0], e[1])).collect()
    }

    #[test]
    fn law_agrees_with_the_played_signal() {
        for period in 0..=64 {
            for half_period in 0..80 {
                assert_eq!(
                    pulses(half_period, period) as usize,
                    play(half_period, period).len(),
                    "n = {half_period}, T = {period}"
                );
            }
        }
    }

    #[test]
    fn published_vectors_at_a_period_of_1000() {
        assert!((1000..2000).all(|n| pulses(n, 1000) == 0));
        assert!((334..=999).all(|n| pulses(n, 1000) == 1));
        assert_ne!(pulses(333, 1000), 1);
        assert_eq!(pulses(1, 1000), 500);
        assert_eq!(attainable_count(1000), 45);
        assert_eq!((0..).find(|&y| !attainable(y, 1000)), Some(27));
    }

    /// Every half-period is counted out by adding it up, so nothing here divides.
    #[test]
    fn attainability_and_ranges_are_exhaustively_right() {
        for period in 1..=2000_u32 {
            let mut giving: Vec<Option<(u32, u32)>> = vec![None; period as usize + 2];
            for half_period in 1..period {
                let (mut rise, mut count) = (half_period, 0_usize);
                while rise < period {
                    count += 1;
                    rise += 2 * half_period;
                }
                let seen = giving[count].get_or_insert((half_period, half_period));
                seen.1 = half_period;
            }
            let mut distinct = 1;
            for (count, seen) in giving.iter().enumerate().skip(1) {
                let count = count as u32;
                assert_eq!(attainable(count, period), seen.is_some());
                let range = half_periods(count, period).map(|r| (*r.start(), *r.end()));
                assert_eq!(range, *seen, "Y = {count}, T = {period}");
                distinct += usize::from(seen.is_some());
            }
            assert_eq!(attainable_count(period), distinct, "T = {period}");
            assert_eq!(half_periods(0, period), Some(period..=u32::MAX));
        }
    }

    #[test]
    fn exact_recipe_gives_the_count_and_falls_at_the_end() {
        for period in 1..=600 {
            for count in (1..).take_while(|&y| recipe_is_exact(y, period)) {
                let played = play(recipe(count, period).unwrap(), period);
                assert_eq!(played.len(), count as usize, "Y = {count}, T = {period}");
                assert_eq!(played.last().map(|p| p.1), Some(period));
            }
        }
    }

    /// The condition is tight: where T is (2Y-1)² the recipe still works only if 2Y divides T,
    /// which an odd square rules out.
    #[test]
    fn recipe_fails_at_the_bound() {
        for count in 2..30 {
            let period = (2 * count - 1) * (2 * count - 1);
            assert!(!recipe_is_exact(count, period));
            assert_ne!(pulses(recipe(count, period).unwrap(), period), count);
            assert!(recipe_is_exact(count, period + 1));
        }
    }

    #[test]
    fn extremes_do_not_overflow() {
        assert_eq!(pulses(1, u32::MAX), u32::MAX / 2);
        assert!(attainable(u32::MAX / 2, u32::MAX));
        assert!(!attainable(u32::MAX, u32::MAX));
        assert_eq!(recipe(u32::MAX, u32::MAX), Some(1));
        assert_eq!(recipe(0, 100), None);
        assert!(!recipe_is_exact(u32::MAX, u32::MAX));
        assert_eq!(attainable_count(0), 1);
        assert_eq!(attainable_count(1), 1);
    }
}
