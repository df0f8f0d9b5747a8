//! Pulse generator 4: an incremental encoder.

/// Pulse generator 4: levels of channels A and B at a position.
///
/// Quarter k of the encoder's period extends from k − ½ to k + ½ counts, so a motor at rest on a
/// whole count is in the middle of a quarter. A leads in the direction of rising positions.
#[derive(Debug, Clone, Copy)]
pub struct Encoder {
    /// Last quarter: its begin and end in counts, and its levels.
    quarter: [f64; 2],
    levels: (bool, bool),
}

impl Default for Encoder {
    fn default() -> Self {
        Encoder {
            quarter: [-0.5, 0.5],
            levels: (false, false),
        }
    }
}

impl Encoder {
    /// Returns channels A and B at a position in counts.
    #[inline]
    pub fn channels(&self, position_counts: f64) -> (bool, bool) {
        levels(quarter(position_counts))
    }

    /// Returns channels A and B and remembers the quarter: most ticks stay in it.
    #[inline]
    pub fn see(&mut self, position_counts: f64) -> (bool, bool) {
        let [begin, end] = self.quarter;
        if !(begin <= position_counts && position_counts < end) {
            self.turn(position_counts);
        }
        self.levels
    }

    fn turn(&mut self, position_counts: f64) {
        let quarter = quarter(position_counts);
        self.quarter = [quarter - 0.5, quarter + 0.5];
        self.levels = levels(quarter);
    }

    /// Returns the greatest speed in counts per second at which a circuit that samples once in
    /// `tick_s` seconds sees every quarter: one count per tick.
    ///
    /// Above it both channels sometimes change at once; above twice that speed quarters are
    /// skipped and the direction appears reversed.
    pub fn countable_counts_per_s(&self, tick_s: f64) -> f64 {
        1.0 / tick_s
    }
}

fn quarter(position_counts: f64) -> f64 {
    let nearest = (position_counts + 0.5).floor();
    // Rounding may move the sum past the end of a quarter.
    match position_counts < nearest - 0.5 {
        true => nearest - 1.0,
        false => nearest,
    }
}

fn levels(quarter: f64) -> (bool, bool) {
    let quarter = (quarter as i64).rem_euclid(4);
    (quarter == 1 || quarter == 2, quarter >= 2)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_it_remembers_is_what_it_sees() {
        let below = |value: f64| f64::from_bits(value.to_bits() - 1);
        let mut encoder = Encoder::default();
        let ends = (0..8).map(|k| f64::from(k) + 0.5);
        let places =
            ends.flat_map(|end| [end - 0.7, below(end), end, -end, -below(end), 1e9 * end]);
        for place in places {
            assert_eq!(encoder.see(place), encoder.channels(place), "{place}");
            assert_eq!(encoder.see(place), encoder.channels(place), "{place}");
        }
        assert_eq!(quarter(below(0.5)), 0.0);
        assert_eq!(
            (quarter(0.5), quarter(-0.5), quarter(-below(0.5))),
            (1.0, 0.0, 0.0)
        );
    }
}
