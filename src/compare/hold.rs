use super::value::Value;
use std::ops::Range;

/// Sampled values of a signal, and the tick that its file counts as 0.
#[derive(Debug)]
pub(super) struct Samples {
    pub changes: Vec<(u64, Value)>,
    pub zero: i128,
    pub width: u32,
}

/// Result of comparing two signals.
#[derive(Debug, Default, Clone, PartialEq, Eq)]
pub(super) struct Tally {
    /// Number of values compared.
    pub compared: u64,
    /// Number of golden values with an x or z.
    pub unknown: u64,
    pub differing: u64,
    pub first: Option<i128>,
    /// First known golden value.
    golden: Option<Value>,
    /// True if there were two different known golden values.
    pub moved: bool,
}

impl Samples {
    fn tick(&self, place: usize) -> Option<i128> {
        self.changes
            .get(place)
            .map(|change| self.zero + i128::from(change.0))
    }

    /// Returns the number of changes up to this tick.
    fn until(&self, tick: i128) -> usize {
        self.changes
            .partition_point(|change| self.zero + i128::from(change.0) <= tick)
    }

    fn before(&self, place: usize) -> Value {
        let last = place
            .checked_sub(1)
            .and_then(|place| self.changes.get(place));
        last.map_or(Value::unknown(self.width), |change| change.1)
    }

    /// Returns the parts of some ticks in which the value is unknown.
    pub fn unknown(&self, ticks: &Range<i128>) -> Vec<Range<i128>> {
        let mut unknown = Vec::new();
        let (mut from, mut place) = (ticks.start, self.until(ticks.start));
        while from < ticks.end {
            let until = self.tick(place).unwrap_or(ticks.end).min(ticks.end);
            if !self.before(place).is_known() {
                unknown.push(from..until);
            }
            (from, place) = (until, place + 1);
        }
        unknown
    }

    /// Returns the value in a tick.
    pub fn at(&self, tick: i128) -> Value {
        self.before(self.until(tick))
    }
}

impl Tally {
    /// Records a known golden value.
    fn see(&mut self, value: Value) {
        self.moved |= *self.golden.get_or_insert(value) != value;
    }

    /// Adds the result of later ticks.
    pub fn add(&mut self, later: Self) {
        self.compared += later.compared;
        self.unknown += later.unknown;
        self.differing += later.differing;
        self.first = self.first.or(later.first);
        self.moved |= later.moved;
        if let Some(value) = later.golden {
            self.see(value);
        }
    }
}

/// Returns some ticks without others; both are in order.
pub(super) fn without(
    ticks: Range<i128>,
    others: impl Iterator<Item = Range<i128>>,
) -> Vec<Range<i128>> {
    let mut left = Vec::new();
    let mut from = ticks.start;
    for other in others {
        if other.start > from {
            left.push(from..other.start.min(ticks.end));
        }
        from = from.max(other.end);
    }
    left.push(from..ticks.end);
    left.retain(|ticks| !ticks.is_empty());
    left
}

/// Compares two signals in these ticks, from change to change.
pub(super) fn hold(golden: &Samples, other: &Samples, ticks: Range<i128>) -> Tally {
    let mut tally = Tally::default();
    let (mut g, mut o) = (golden.until(ticks.start), other.until(ticks.start));
    let mut now = ticks.start;
    while now < ticks.end {
        let next = [golden.tick(g), other.tick(o)].into_iter().flatten().min();
        let next = next.unwrap_or(ticks.end).min(ticks.end);
        let length = u64::try_from(next - now).unwrap_or(0);
        let (expected, found) = (golden.before(g), other.before(o));
        if !expected.is_known() {
            tally.unknown += length;
        } else {
            tally.compared += length;
            tally.see(expected);
            if expected != found {
                tally.differing += length;
                tally.first.get_or_insert(now);
            }
        }
        now = next;
        g += usize::from(golden.tick(g) == Some(next));
        o += usize::from(other.tick(o) == Some(next));
    }
    tally
}

#[cfg(test)]
mod tests {
    use super::*;

    fn samples(zero: i128, changes: &[(u64, bool)]) -> Samples {
        let value = |level| match level {
            true => Value::HIGH,
            false => Value::HIGH.inverted(1),
        };
        Samples {
            changes: changes
                .iter()
                .map(|&(tick, level)| (tick, value(level)))
                .collect(),
            zero,
            width: 1,
        }
    }

    #[test]
    fn signals_are_held_against_each_other_from_change_to_change() {
        let golden = samples(0, &[(0, false), (10, true), (20, false)]);
        let other = samples(-5, &[(0, false), (15, true), (26, false)]);
        let tally = hold(&golden, &other, 0..30);
        let expected = Tally {
            compared: 30,
            unknown: 0,
            differing: 1,
            first: Some(20),
            golden: Some(Value::HIGH.inverted(1)),
            moved: true,
        };
        assert_eq!(tally, expected);
        assert_eq!(hold(&golden, &other, 21..30).differing, 0);
        assert_eq!(hold(&golden, &other, 20..21).first, Some(20));
        // In the ticks 10 to 19 it is constant; it changes from one such range to another.
        let mut still = hold(&golden, &other, 10..20);
        assert!(!still.moved);
        still.add(hold(&golden, &other, 15..20));
        assert!(!still.moved);
        still.add(hold(&golden, &other, 20..21));
        assert!(still.moved);
        assert_eq!((golden.at(19), other.at(20)), (Value::HIGH, Value::HIGH));
    }

    #[test]
    fn ticks_are_left_out_of_others() {
        let left = |others: &[(i128, i128)]| -> Vec<(i128, i128)> {
            let others = others.iter().map(|&(start, end)| start..end);
            let left = without(3..9, others).into_iter();
            left.map(|ticks| (ticks.start, ticks.end)).collect()
        };
        assert_eq!(left(&[]), [(3, 9)]);
        let between = left(&[(0, 2), (4, 5), (7, 8), (11, 12)]);
        assert_eq!(between, [(3, 4), (5, 7), (8, 9)]);
        assert_eq!(left(&[(0, 4), (8, 12)]), [(4, 8)]);
        assert_eq!(left(&[(4, 7), (5, 6)]), [(3, 4), (7, 9)]);
        assert!(left(&[(3, 9)]).is_empty() && left(&[(0, 12)]).is_empty());
    }

    #[test]
    fn before_its_first_value_golden_is_not_compared_and_the_other_is_unknown() {
        let golden = samples(0, &[(4, true)]);
        let other = samples(0, &[(6, true)]);
        let tally = hold(&golden, &other, 0..10);
        assert_eq!((tally.unknown, tally.compared), (4, 6));
        assert_eq!((tally.first, tally.differing), (Some(4), 2));
    }
}
