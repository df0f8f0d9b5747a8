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
        let quarter = ((position_counts + 0.5).floor() as i64).rem_euclid(4);
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
