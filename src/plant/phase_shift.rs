//! Phase-shift transducer: two primaries, and a secondary whose phase is the position within a
//! pitch.

/// Transducer that outputs the sign of a secondary, which sine and cosine of a carrier excite.
///
/// The secondary is sin(φ − x): φ is the phase of the carrier, x the position; a pitch of the
/// position is a period. The sign holds from half a tick before to half a tick after the tick, so
/// that a body on a whole count crosses in the middle of a tick.
#[derive(Debug, Clone, Copy)]
pub struct PhaseShiftTransducer {
    pitch_counts: f64,
}

impl PhaseShiftTransducer {
    /// Creates a transducer with `pitch_counts` counts per pitch, which are ticks of the carrier.
    #[must_use]
    pub fn new(pitch_counts: u32) -> Self {
        PhaseShiftTransducer {
            pitch_counts: f64::from(pitch_counts),
        }
    }

    /// True if the secondary is positive in a tick with this phase of the carrier, in ticks, and
    /// the body at a position in counts.
    #[inline]
    #[must_use]
    pub fn secondary(&self, phase: u64, position_counts: f64) -> bool {
        let angle = (phase as f64 - position_counts + 0.5).rem_euclid(self.pitch_counts);
        2.0 * angle < self.pitch_counts
    }

    /// Returns the greatest speed, in counts per tick, at which the secondary's phase is tracked
    /// in whole ticks: from one of its crossings to the next but one, M/(1 + v) ticks later, the
    /// body moves by at most a quarter of a pitch.
    #[must_use]
    pub fn followed_counts_per_tick(pitch_counts: u32) -> f64 {
        let pitch = f64::from(pitch_counts);
        (pitch - 4.0) / (7.0 * pitch + 4.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The secondary is a sine, and crosses zero when the carrier reaches the position.
    #[test]
    fn it_is_the_sign_of_a_sine() {
        let transducer = PhaseShiftTransducer::new(40);
        for quarter in -800..800 {
            let position = f64::from(quarter) / 4.0 + 0.1;
            let levels: Vec<bool> = (0..40)
                .map(|phase| transducer.secondary(phase, position))
                .collect();
            for (phase, level) in levels.iter().enumerate() {
                let turns = (phase as f64 + 0.5 - position) / 40.0;
                assert_eq!(
                    *level,
                    (turns * std::f64::consts::TAU).sin() >= 0.0,
                    "{position}"
                );
            }
            let crossing = (0..40).find(|&phase| levels[phase] && !levels[(phase + 39) % 40]);
            let nearest = (position.round() as i64).rem_euclid(40);
            assert_eq!(crossing, Some(nearest as usize), "{position}");
        }
    }
}
