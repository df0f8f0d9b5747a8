//! Absolute encoder of one turn, with its own sampling clock.

/// Encoder that outputs the position within the turn as a Gray word, sampled by its own clock.
///
/// A turn of T counts uses the T words in the middle of the code. The strobe is high for the first
/// half of each period, and the word is constant from one rising edge to the next.
#[derive(Debug, Clone, Copy)]
pub struct AbsoluteEncoder {
    counts: i64,
    first: i64,
    period_ticks: f64,
    /// Number of ticks so far, and number of samples taken.
    ticks: u64,
    samples: u64,
    word: u64,
}

impl AbsoluteEncoder {
    /// Creates an encoder of `counts` per turn with words of `bits`, which samples once in
    /// `period_ticks` ticks of the reference clock.
    #[must_use]
    pub fn new(counts: u32, bits: usize, period_ticks: f64) -> Self {
        let counts = i64::from(counts);
        AbsoluteEncoder {
            counts,
            first: ((1 << bits) - counts) / 2,
            period_ticks,
            ticks: 0,
            samples: 0,
            word: 0,
        }
    }

    /// Advances one tick with the body at a position in counts; returns strobe and word.
    #[inline]
    pub fn step(&mut self, position_counts: f64) -> (bool, u64) {
        let now = self.ticks as f64;
        self.ticks += 1;
        if now >= self.samples as f64 * self.period_ticks {
            self.samples += 1;
            let place = ((position_counts + 0.5).floor() as i64).rem_euclid(self.counts);
            let number = (place + self.first) as u64;
            self.word = number ^ (number >> 1);
        }
        let falls = (self.samples as f64 - 0.5) * self.period_ticks;
        (now < falls, self.word)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn neighbours_differ_in_one_bit_over_the_seam_too() {
        let mut encoder = AbsoluteEncoder::new(90, 7, 1.0);
        let words: Vec<u64> = (-1..=90)
            .map(|count| encoder.step(f64::from(count)).1)
            .collect();
        for pair in words.windows(2) {
            assert_eq!((pair[0] ^ pair[1]).count_ones(), 1, "{words:?}");
        }
        assert_eq!((words[0], words[1]), (words[90], words[91]));
        let mut all = words[1..91].to_vec();
        all.sort_unstable();
        all.dedup();
        assert_eq!(all.len(), 90);
    }

    /// A period is ten and eleven ticks in turn, with the strobe high for half of it.
    #[test]
    fn it_samples_by_its_own_clock() {
        let mut encoder = AbsoluteEncoder::new(1000, 10, 10.5);
        let mut before = false;
        let mut rises = Vec::new();
        for tick in 0..100u32 {
            let (strobe, word) = encoder.step(f64::from(tick));
            if strobe && !before {
                rises.push(tick);
            }
            before = strobe;
            let last = rises[rises.len() - 1];
            let taken = u64::from(last) + 12;
            assert_eq!(word, taken ^ (taken >> 1), "{tick}");
            assert_eq!(
                strobe,
                tick - last < if last % 21 == 0 { 6 } else { 5 },
                "{tick}"
            );
        }
        assert_eq!(rises, [0, 11, 21, 32, 42, 53, 63, 74, 84, 95]);
    }
}
