//! Detectors of the settings: what they follow, and which turns and pitches they have.

use super::{Detector, SettingError, Settings, WIDTHS};
use crate::circuits::lead_angle::TrackingConverter;
use crate::plant::{PhaseShiftTransducer, ResolverParameters};
use std::ops::RangeInclusive;

/// Counts of a turn that an absolute encoder can have, by twos: as many as it has words at most.
pub const TURN_RANGE_COUNTS: RangeInclusive<u32> = 4..=1 << WIDTHS.code;
/// Counts of a pitch; of a phase-shift transducer's they are ticks of its carrier, and so of CK.
pub const PITCH_RANGE_COUNTS: RangeInclusive<u32> = 16..=1 << WIDTHS.code;
/// Ticks of a resolver's conversion, which a CK has at least.
pub const CONVERSION_TICKS: u32 =
    TrackingConverter::new(WIDTHS.converter, WIDTHS.code).period() as u32;
/// Allowed error of an absolute encoder's sampling clock, in parts per million.
pub const SAMPLING_RANGE_PPM: RangeInclusive<f64> = -10_000.0..=10_000.0;

impl Settings {
    /// The fastest speed that the detector follows, in counts a second: an incremental encoder is
    /// counted at one count per tick, an absolute one may go a quarter of a turn in a CK, a phase-shift
    /// transducer about a seventh of a count per tick, a resolver an eighth of a pitch in a CK.
    #[must_use]
    pub fn followed_counts_per_s(&self) -> f64 {
        let clock = self.clock_hz as f64;
        match self.detector {
            Detector::Incremental => clock,
            Detector::Absolute => self.body.counts_per_rev / 4e-3 / self.sampling_ms(),
            Detector::PhaseShift => {
                clock * PhaseShiftTransducer::followed_counts_per_tick(self.ck_ticks)
            }
            Detector::Resolver => self.pitch_counts() / 8e-3 / self.ck_ms(),
        }
    }

    /// Counts of a resolver's pitch: of a pole pair.
    pub(in crate::jobs::lead_angle) fn pitch_counts(&self) -> f64 {
        self.body.counts_per_rev / f64::from(self.resolver.pole_pairs)
    }

    /// The period of an absolute encoder's sampling clock, which is CK then.
    pub(in crate::jobs::lead_angle) fn sampling_ms(&self) -> f64 {
        self.ck_ms() / (1.0 + self.sampling_clock_ppm / 1e6)
    }

    /// An absolute encoder's turn is a whole number of counts, and an even one, so that its code has a
    /// neighbour over the seam. A turn has whole pitches of a phase-shift transducer, and a pole pair of a
    /// resolver whole counts.
    pub(super) fn validate_detector(&self) -> Result<(), SettingError> {
        self.validate_resolver()?;
        let (ppm, turn) = (self.sampling_clock_ppm, self.body.counts_per_rev);
        let refused = |allowed: &str| Err(SettingError::value("sampling_clock_ppm", ppm, allowed));
        let (range, allowed) = match self.detector {
            Detector::Incremental if ppm == 0.0 => return Ok(()),
            Detector::Incremental => {
                return refused("0 with detector = \"incremental\", whose CK is ck_ticks");
            }
            Detector::PhaseShift if ppm != 0.0 => {
                return refused("0 with detector = \"phase_shift\", whose carrier is ck_ticks");
            }
            Detector::Resolver if ppm != 0.0 => {
                return refused("0 with detector = \"resolver\", whose strobe is ck_ticks");
            }
            Detector::Absolute => {
                let (least, most) = TURN_RANGE_COUNTS.into_inner();
                let allowed =
                    format!("an even number from {least} to {most} with detector = \"absolute\"");
                ((2, least, most), allowed)
            }
            Detector::PhaseShift => {
                let (least, most) = PITCH_RANGE_COUNTS.into_inner();
                if !PITCH_RANGE_COUNTS.contains(&self.ck_ticks) {
                    let allowed = format!(
                        "{least} to {most} with detector = \"phase_shift\", counts of its pitch"
                    );
                    return Err(SettingError::value("ck_ticks", self.ck_ticks, allowed));
                }
                let pitch = self.ck_ticks;
                let allowed = format!(
                    "a multiple of {pitch} with detector = \"phase_shift\", whose pitch is ck_ticks"
                );
                ((pitch, pitch, u32::MAX), allowed)
            }
            Detector::Resolver => {
                let pairs = self.resolver.pole_pairs;
                let (least, most) = PITCH_RANGE_COUNTS.into_inner();
                let (least, most) = (pairs * least, pairs * most);
                let allowed = format!(
                    "a multiple of {pairs} from {least} to {most} with detector = \"resolver\", \
                     whose pitch is a pole pair"
                );
                ((pairs, least, most), allowed)
            }
        };
        let (step, least, most) = range;
        let within = f64::from(least)..=f64::from(most);
        match within.contains(&turn) && turn % f64::from(step) == 0.0 {
            true => Ok(()),
            false => Err(SettingError::value("counts_per_rev", turn, allowed)),
        }
    }

    /// Checks that only a resolver has a resolver's settings, and that a CK is long enough for its
    /// conversion.
    fn validate_resolver(&self) -> Result<(), SettingError> {
        let (own, without) = (self.resolver, ResolverParameters::default());
        let least = CONVERSION_TICKS;
        if self.detector == Detector::Resolver {
            let allowed = format!("{least} or more with detector = \"resolver\": a conversion");
            return match self.ck_ticks >= least {
                true => Ok(()),
                false => Err(SettingError::value("ck_ticks", self.ck_ticks, allowed)),
            };
        }
        let fields = [
            (
                "pole_pairs",
                f64::from(own.pole_pairs),
                f64::from(without.pole_pairs),
            ),
            ("sine_offset", own.sine_offset, without.sine_offset),
            ("gain_mismatch", own.gain_mismatch, without.gain_mismatch),
        ];
        match fields
            .into_iter()
            .find(|(_, value, default)| value != default)
        {
            None => Ok(()),
            Some((field, value, default)) => {
                let allowed = format!("{default} without detector = \"resolver\"");
                Err(SettingError::value(field, value, allowed))
            }
        }
    }
}
