//! Pulse counts that one unit time offers within the driver's limits, each with its half-period.

use crate::circuits::pulse_interpolator::counts::{attainable_counts, half_periods, recipe};

/// Limits on the pulses of one unit time, in reference ticks.
///
/// A pulse is high for a half-period, except the last, which the reset at T may cut short. It is
/// low before each rising edge for at least a half-period, also across the unit's boundary.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PulseLimits {
    /// Greatest half-period of the memory word.
    pub max_half_period: u32,
    /// Least time for which the step signal may be high.
    pub min_high: u32,
    /// Least time for which the step signal may be low.
    pub min_low: u32,
    /// Earliest first rising edge, from the start of the unit time (direction setup).
    pub lead: u32,
    /// Least time from the last rising edge to the end of the unit time (direction hold).
    pub tail: u32,
}

impl PulseLimits {
    /// Creates limits for a half-period register of `half_period_bits` bits and a driver's step
    /// input, without limits on the direction.
    #[must_use]
    pub fn new(half_period_bits: u32, min_high: u32, min_low: u32) -> Self {
        Self {
            max_half_period: 1_u32
                .checked_shl(half_period_bits)
                .unwrap_or(0)
                .wrapping_sub(1),
            min_high,
            min_low,
            lead: 0,
            tail: 0,
        }
    }
}

/// Returns the half-period for `pulses` in `period` ticks, or `None` if the count is impossible or
/// every half-period for it violates a limit. Returns 0 for no pulses.
///
/// The patent's recipe is preferred if it is a candidate, since it spreads the pulses most evenly;
/// otherwise the candidate with the greatest minimum of high and low times.
#[must_use]
pub fn choose_half_period(pulses: u32, period: u32, limits: &PulseLimits) -> Option<u32> {
    let Some(even) = recipe(pulses, period) else {
        return Some(0);
    };
    let range = half_periods(pulses, period)?;
    let last_rise = |n: u32| (2 * u64::from(pulses) - 1) * u64::from(n);
    let room = u64::from(period.checked_sub(limits.min_high.max(limits.tail))?);
    let shortest = [limits.min_high, limits.min_low, limits.lead]
        .into_iter()
        .fold(*range.start(), u32::max);
    let longest = u64::from((*range.end()).min(limits.max_half_period)).min(room / last_rise(1));
    // Limited by the range's end, so the cast keeps the value.
    let longest = longest as u32;
    if shortest > longest {
        return None;
    }
    if (shortest..=longest).contains(&even) {
        return Some(even);
    }
    // The low time grows with n and the last high time shrinks: the best n is one of the two
    // around the crossing T/(2Y), or the end of the range next to it.
    let narrowest = |n: u32| u64::from(n).min(u64::from(period) - last_rise(n));
    [even.saturating_sub(1), even]
        .map(|n| n.clamp(shortest, longest))
        .into_iter()
        .max_by_key(|&n| narrowest(n))
}

/// Count offered by a unit time.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Offer {
    /// Number of pulses in the unit time.
    pub pulses: u32,
    /// Half-period that gives them, in ticks; 0 for no pulses.
    pub half_period: u32,
}

/// All counts offered by one unit time, with the half-period chosen for each.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct CountTable {
    period: u32,
    offers: Vec<Offer>,
}

impl CountTable {
    /// Creates the table of counts in `period` ticks within `limits`. Zero pulses are always
    /// included.
    #[must_use]
    pub fn new(period: u32, limits: &PulseLimits) -> Self {
        let mut offers: Vec<Offer> = attainable_counts(period)
            .filter_map(|pulses| {
                let half_period = choose_half_period(pulses, period, limits)?;
                Some(Offer {
                    pulses,
                    half_period,
                })
            })
            .collect();
        offers.push(Offer {
            pulses: 0,
            half_period: 0,
        });
        offers.reverse();
        Self { period, offers }
    }

    /// Returns the unit time in ticks.
    #[must_use]
    pub fn period(&self) -> u32 {
        self.period
    }

    /// Returns all offers, in ascending order of pulses.
    #[must_use]
    pub fn offers(&self) -> &[Offer] {
        &self.offers
    }

    /// True if exactly this count is offered.
    #[must_use]
    pub fn contains(&self, pulses: u32) -> bool {
        self.at_most(pulses).pulses == pulses
    }

    /// Returns the greatest count offered that is not above `demand`.
    #[must_use]
    pub fn at_most(&self, demand: u32) -> Offer {
        let above = self.offers.partition_point(|offer| offer.pulses <= demand);
        self.offers[above.saturating_sub(1)]
    }

    /// Returns the count offered nearest to `demand`; of two equally near the smaller, since a
    /// deficit can be made up for and an excess cannot.
    #[must_use]
    pub fn nearest(&self, demand: u32) -> Offer {
        let above = self.offers.partition_point(|offer| offer.pulses <= demand);
        let below = self.offers[above.saturating_sub(1)];
        match self.offers.get(above) {
            Some(&next) if next.pulses - demand < demand - below.pulses => next,
            _ => below,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::circuits::pulse_interpolator::counts::tests::play;

    /// Returns shortest high time, shortest low time before a rise, and last rise, from the played
    /// signal.
    fn measure(half_period: u32, period: u32) -> (u32, u32, u32) {
        let (mut high, mut low, mut fall, mut rise) = (u32::MAX, u32::MAX, 0, 0);
        for (up, down) in play(half_period, period) {
            high = high.min(down - up);
            low = low.min(up - fall);
            (rise, fall) = (up, down);
        }
        (high, low, rise)
    }

    #[test]
    fn chosen_half_period_is_the_recipe_or_the_widest_allowed() {
        let limits = [
            (1, 1, 0, 0, 7),
            (3, 2, 0, 0, 6),
            (2, 5, 9, 0, 6),
            (1, 1, 0, 12, 5),
            (4, 3, 7, 9, 5),
        ];
        for (min_high, min_low, lead, tail, bits) in limits {
            let limits = PulseLimits {
                lead,
                tail,
                ..PulseLimits::new(bits, min_high, min_low)
            };
            for period in 1..=90 {
                let mut expected: Vec<Option<u32>> = vec![None; 60];
                let mut widest = vec![0; 60];
                for n in 1..=limits.max_half_period {
                    let count = play(n, period).len();
                    let (high, low, rise) = measure(n, period);
                    let first = n;
                    let fits = high >= min_high
                        && low >= min_low
                        && first >= lead
                        && period - rise >= tail;
                    if count == 0 || !fits {
                        continue;
                    }
                    let even = n == period.div_ceil(2 * count as u32);
                    let width = if even { u32::MAX } else { high.min(low) };
                    if width > widest[count] {
                        widest[count] = width;
                        expected[count] = Some(n);
                    }
                }
                let table = CountTable::new(period, &limits);
                assert_eq!(table.offers().len(), 1 + expected.iter().flatten().count());
                for (count, expected) in expected.iter().enumerate().skip(1) {
                    let chosen = choose_half_period(count as u32, period, &limits);
                    let width = |n: u32| {
                        let (high, low, _) = measure(n, period);
                        if n == period.div_ceil(2 * count as u32) {
                            u32::MAX
                        } else {
                            high.min(low)
                        }
                    };
                    // Two half-periods may be equally good.
                    assert_eq!(
                        chosen.map(width),
                        expected.map(width),
                        "Y = {count}, T = {period}, {limits:?}"
                    );
                    if let Some(n) = chosen {
                        let (high, low, rise) = measure(n, period);
                        assert_eq!(play(n, period).len(), count);
                        assert!(
                            high >= min_high
                                && low >= min_low
                                && n >= lead
                                && period - rise >= tail
                        );
                        assert!(n <= limits.max_half_period);
                    }
                    assert_eq!(table.contains(count as u32), chosen.is_some());
                }
            }
        }
    }

    #[test]
    fn unlimited_table_holds_every_attainable_count() {
        let table = CountTable::new(1000, &PulseLimits::new(16, 1, 1));
        assert_eq!(table.period(), 1000);
        assert_eq!(table.offers().len(), 45);
        assert_eq!(
            table.offers()[0],
            Offer {
                pulses: 0,
                half_period: 0
            }
        );
        assert_eq!(
            table.offers()[10],
            Offer {
                pulses: 10,
                half_period: 50
            }
        );
        assert!(table.contains(26) && !table.contains(27));
    }

    #[test]
    fn nearest_and_at_most_agree_with_a_search() {
        let table = CountTable::new(300, &PulseLimits::new(16, 1, 1));
        for demand in 0..400 {
            let near = table
                .offers()
                .iter()
                .min_by_key(|o| (o.pulses.abs_diff(demand), o.pulses));
            assert_eq!(Some(&table.nearest(demand)), near);
            let under = table.offers().iter().rfind(|o| o.pulses <= demand);
            assert_eq!(Some(&table.at_most(demand)), under);
        }
        assert_eq!(table.nearest(u32::MAX).pulses, 150);
    }

    #[test]
    fn widths_of_register() {
        assert_eq!(PulseLimits::new(16, 1, 1).max_half_period, 65_535);
        assert_eq!(PulseLimits::new(32, 1, 1).max_half_period, u32::MAX);
        // One pulse in T needs a half-period above T/3, which does not fit four bits.
        let table = CountTable::new(100, &PulseLimits::new(4, 1, 1));
        assert!(!table.contains(1) && table.contains(4));
    }
}
