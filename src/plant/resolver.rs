//! Resolver in amplitude mode with A/D converters: one winding is excited, two are read.

use crate::settings::settings;
use std::f64::consts::TAU;
use std::ops::RangeInclusive;

/// Allowed number of pole pairs.
pub const POLE_PAIRS_RANGE: RangeInclusive<u32> = 1..=64;
/// Allowed offsets and mismatches, as parts of the amplitude.
pub const WINDING_RANGE: RangeInclusive<f64> = -0.1..=0.1;

settings! {
    /// Pitch of a resolver, and errors of its windings.
    #[derive(Copy)]
    pub struct ResolverParameters {
        /// Pole pairs of a resolver, the pitches of a turn; each has whole counts.
        pub pole_pairs: u32 = 4, in POLE_PAIRS_RANGE,
            "with detector = \"resolver\" alone";
        /// Offset of a resolver's sine channel at an angle of 0, as a part of the amplitude.
        pub sine_offset: f64 = 0.0, in WINDING_RANGE,
            "with detector = \"resolver\" alone";
        /// Excess of a resolver's sine amplitude over the cosine amplitude, as a part of it.
        pub gain_mismatch: f64 = 0.0, in WINDING_RANGE,
            "with detector = \"resolver\" alone";
    }
}

/// Resolver that outputs the A/D words of both windings, each at a peak of the carrier.
///
/// The windings are a·sin θ and a·cos θ with a = 0.9 of the converters' full scale, rounded to
/// whole words. They are sampled simultaneously, and constant until the next strobe.
#[derive(Debug, Clone, Copy)]
pub struct Resolver {
    parameters: ResolverParameters,
    pitch_counts: f64,
    /// Greatest word.
    full_scale: f64,
    period_ticks: u32,
    /// Number of ticks since the last strobe.
    ticks: u32,
    words: [i64; 2],
}

impl Resolver {
    /// Amplitude of the windings, as a part of full scale.
    pub const AMPLITUDE: f64 = 0.9;

    /// Creates a resolver with `pitch_counts` counts per pitch and A/D words of `bits`, sampled
    /// once in `period_ticks` ticks, starting with the first.
    #[must_use]
    pub fn new(
        parameters: ResolverParameters,
        pitch_counts: f64,
        bits: usize,
        period_ticks: u32,
    ) -> Self {
        Resolver {
            parameters,
            pitch_counts,
            full_scale: (bits as f64 - 1.0).exp2() - 1.0,
            period_ticks,
            ticks: 0,
            words: [0; 2],
        }
    }

    /// Advances one tick with the body at a position in counts; returns the strobe, and the words
    /// of sine and cosine.
    #[inline]
    pub fn step(&mut self, position_counts: f64) -> (bool, [i64; 2]) {
        let strobe = self.ticks == 0;
        if strobe {
            let (sine, cosine) = (position_counts / self.pitch_counts * TAU).sin_cos();
            let sine = (1.0 + self.parameters.gain_mismatch) * sine + self.parameters.sine_offset;
            let full = self.full_scale;
            self.words = [sine, cosine]
                .map(|part| (Self::AMPLITUDE * full * part).round().clamp(-full, full) as i64);
        }
        self.ticks = (self.ticks + 1) % self.period_ticks;
        (strobe, self.words)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The words are sine and cosine of a pitch, once per period, with the sine's imperfections.
    #[test]
    fn it_samples_sine_and_cosine() {
        let parameters = ResolverParameters {
            sine_offset: 0.02,
            gain_mismatch: -0.05,
            ..ResolverParameters::default()
        };
        let mut resolver = Resolver::new(parameters, 500.0, 12, 7);
        let mut before = [0; 2];
        for tick in 0..7_000 {
            let position = f64::from(tick) - 3000.0;
            let (strobe, words) = resolver.step(position);
            assert_eq!(strobe, tick % 7 == 0);
            let angle = position / 500.0 * TAU;
            let exact = [0.95 * angle.sin() + 0.02, angle.cos()].map(|part| part * 0.9 * 2047.0);
            for (word, exact) in words.into_iter().zip(exact) {
                assert!(!strobe || (word as f64 - exact).abs() <= 0.5, "{tick}");
            }
            assert!(strobe || words == before, "{tick}");
            before = words;
        }
    }

    /// Values beyond full scale are clipped.
    #[test]
    fn a_converter_has_an_end() {
        let parameters = ResolverParameters {
            sine_offset: 0.1,
            gain_mismatch: 0.1,
            ..ResolverParameters::default()
        };
        let mut resolver = Resolver::new(parameters, 400.0, 10, 1);
        assert_eq!(resolver.step(100.0).1, [511, 0]);
        // (-1.1 + 0.1)·0.9 of it.
        assert_eq!(resolver.step(300.0).1, [-460, 0]);
    }
}
