//! Pulse generator 4: an incremental encoder.

/// Pulse generator 4: the levels of channels A and B at a position.
///
/// Quarter k of the encoder's period reaches from k − ½ to k + ½ counts, so a motor at rest on a
/// whole count stands in the middle of a quarter. A leads where the position goes up.
#[derive(Debug, Clone, Copy, Default)]
pub struct Encoder;

impl Encoder {
    /// Channels A and B at a position in counts.
    #[inline]
    pub fn channels(&self, position_counts: f64) -> (bool, bool) {
        let quarter = floor(position_counts + 0.5) & 3;
        (quarter == 1 || quarter == 2, quarter >= 2)
    }

    /// The highest speed in counts a second at which a circuit that samples once in `tick_s`
    /// seconds sees every quarter: one count a tick.
    ///
    /// Beyond it two channels change at once now and then, beyond twice of it quarters are
    /// skipped and the direction seems to turn.
    pub fn countable_counts_per_s(&self, tick_s: f64) -> f64 {
        1.0 / tick_s
    }
}

/// The greatest whole number that is no greater: `f64::floor` is a call where the processor may be
/// an old one, and this is asked for in every tick.
#[inline]
fn floor(value: f64) -> i64 {
    let cut = value as i64;
    cut - i64::from(value < cut as f64)
}

#[cfg(test)]
mod tests {
    use super::floor;

    #[test]
    fn it_rounds_down() {
        for value in [
            0.0,
            -0.0,
            0.5,
            -0.5,
            3.0,
            -3.0,
            -3.000_001,
            2.999_999,
            1e15,
            -1e15 - 0.5,
        ] {
            assert_eq!(floor(value), value.floor() as i64, "{value}");
        }
    }
}
