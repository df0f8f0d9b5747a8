//! Curves of a picture, thinned while the run goes on.

use std::collections::BTreeSet;

/// Most records of a run that are all kept.
const MOST: usize = 40_000;

/// Records of a run of any length, for a picture. Of many, every interval keeps its first and last
/// and those with the least and the greatest of each of K numbers, which looks the same; intervals
/// double when the records become too many.
#[derive(Debug, Clone)]
pub struct Thinned<T, const K: usize> {
    numbers: fn(&T) -> [f64; K],
    /// Records of an interval.
    interval: usize,
    /// Count of all records so far.
    count: usize,
    /// The records kept, each with its number from 0.
    kept: Vec<(usize, T)>,
    /// Index in `kept` at which the current interval begins.
    latest: usize,
}

impl<T: Copy, const K: usize> Thinned<T, K> {
    /// Starts without records; the extremes of these numbers are kept.
    pub fn by(numbers: fn(&T) -> [f64; K]) -> Self {
        Thinned {
            numbers,
            interval: 1,
            count: 0,
            kept: Vec::new(),
            latest: 0,
        }
    }

    pub fn push(&mut self, record: T) {
        let ended = self.interval > 1 && self.count.is_multiple_of(self.interval);
        if ended && self.latest < self.kept.len() {
            let latest = self.kept.split_off(self.latest);
            self.kept.extend(self.chosen(&latest));
            self.latest = self.kept.len();
        }
        self.kept.push((self.count, record));
        self.count += 1;
        if self.kept.len() > MOST {
            self.widen();
        }
    }

    /// Returns the count of all records.
    pub fn count(&self) -> usize {
        self.count
    }

    /// Iterates over the records kept, each with its number from 0.
    #[cfg(test)]
    fn numbered(&self) -> impl Iterator<Item = (usize, &T)> + Clone {
        self.kept.iter().map(|(number, record)| (*number, record))
    }

    /// Iterates over the records kept.
    pub fn iter(&self) -> impl Iterator<Item = &T> + Clone {
        self.kept.iter().map(|(_, record)| record)
    }

    fn widen(&mut self) {
        self.interval = (2 * self.interval).max(4 * (K + 1));
        let all = std::mem::take(&mut self.kept);
        let (interval, under_way) = (self.interval, self.count / self.interval);
        for group in all.chunk_by(|a, b| a.0 / interval == b.0 / interval) {
            self.latest = self.kept.len();
            match group[0].0 / interval == under_way {
                true => self.kept.extend(group),
                false => self.kept.extend(self.chosen(group)),
            }
        }
        if self.count.is_multiple_of(interval) {
            self.latest = self.kept.len();
        }
    }

    /// Returns the records of an interval that are kept.
    fn chosen(&self, group: &[(usize, T)]) -> Vec<(usize, T)> {
        let numbers: Vec<[f64; K]> = group.iter().map(|(_, one)| (self.numbers)(one)).collect();
        let mut places: BTreeSet<usize> = [0, group.len() - 1].into();
        for k in 0..K {
            let finite = numbers.iter().map(|of| of[k]).enumerate();
            let finite = finite.filter(|(_, value)| value.is_finite());
            let order = |a: &(usize, f64), b: &(usize, f64)| a.1.total_cmp(&b.1);
            let ends = [finite.clone().min_by(order), finite.max_by(order)];
            places.extend(ends.into_iter().flatten().map(|(place, _)| place));
        }
        places.into_iter().map(|place| group[place]).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(values: impl Iterator<Item = f64>) -> Thinned<f64, 1> {
        let mut all = Thinned::by(|value: &f64| [*value]);
        values.for_each(|value| all.push(value));
        all
    }

    #[test]
    fn few_are_all_kept() {
        let all = of((0..MOST).map(|k| k as f64));
        assert!(all.iter().copied().eq((0..MOST).map(|k| k as f64)));
        assert_eq!(all.count(), MOST);
    }

    #[test]
    fn of_many_ends_and_peaks_are_kept_and_the_memory_is_bounded() {
        const COUNT: usize = 3_000_000;
        let value = |k: usize| match k {
            123_456 => 9.0,
            2_000_001 => -9.0,
            77 => f64::NAN,
            _ => (k % 7) as f64 / 10.0,
        };
        let all = of((0..COUNT).map(value));
        assert_eq!(all.count(), COUNT);
        assert!(all.kept.len() <= MOST + 1, "{}", all.kept.len());
        let numbers: Vec<_> = all.numbered().map(|(number, _)| number).collect();
        for kept in [0, 123_456, 2_000_001, COUNT - 1] {
            assert!(numbers.contains(&kept), "{kept} is lost");
        }
        assert!(numbers.is_sorted());
        assert!(all.numbered().all(|(k, one)| k == 77 || *one == value(k)));
        // No part of the run is thinned more than another.
        let widest = numbers.windows(2).map(|pair| pair[1] - pair[0]).max();
        assert!(
            widest.is_some_and(|widest| widest <= all.interval),
            "{widest:?}"
        );
    }
}
