//! A phase-shift transducer: two primaries, and a secondary whose phase is the place in a pitch.

/// Gives the sign of a secondary that is excited by sine and cosine of a carrier.
///
/// The secondary is sin(φ − x): φ is the phase of the carrier, x the position, a whole pitch of it being
/// a whole period. It stands for the tick from half a tick before to half a tick after, so that a body
/// on a whole count crosses in the middle of a tick.
#[derive(Debug, Clone, Copy)]
pub struct PhaseShiftTransducer {
    pitch_counts: f64,
}

impl PhaseShiftTransducer {
    /// A transducer with so many counts in a pitch, which are ticks of the carrier.
    #[must_use]
    pub fn new(pitch_counts: u32) -> Self {
        PhaseShiftTransducer {
            pitch_counts: f64::from(pitch_counts),
        }
    }

    /// Whether the secondary is above zero in a tick with this phase of the carrier, in ticks, and the
    /// body at a position in counts.
    #[inline]
    #[must_use]
    pub fn secondary(&self, phase: u64, position_counts: f64) -> bool {
        let angle = (phase as f64 - position_counts + 0.5).rem_euclid(self.pitch_counts);
        2.0 * angle < self.pitch_counts
    }

    /// The fastest speed, in counts a tick, at which the secondary's phase is followed in whole ticks: in
    /// a period of the carrier two of its crossings, which come in M/(1 + v), are at most a quarter of a
    /// pitch on.
    #[must_use]
    pub fn followed_counts_per_tick(pitch_counts: u32) -> f64 {
        let pitch = f64::from(pitch_counts);
        (pitch - 4.0) / (7.0 * pitch + 4.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The secondary is the sine, and crosses where the carrier comes to the place.
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
