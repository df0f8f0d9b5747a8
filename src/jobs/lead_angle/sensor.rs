//! Sensor of a compensator's detector: the signals at its pins.

use super::job::{Ports, WIDTHS};
use super::settings::{Detector, Settings};
use crate::circuits::lead_angle::Compensator;
use crate::circuits::lead_angle::detector::DetectorPart;
use crate::hdl::At;
use crate::plant::{AbsoluteEncoder, PhaseShiftTransducer, Resolver};
use crate::sim::Watcher;

/// Sensor of a detector that outputs positions.
#[derive(Debug)]
pub(super) enum Sensor {
    /// Incremental encoder, which is part of the body.
    Channels,
    /// Absolute encoder with its own sampling clock.
    Absolute(AbsoluteEncoder),
    /// Phase-shift transducer, excited by the detector.
    PhaseShift(PhaseShiftTransducer),
    /// Resolver with its A/D converters.
    Resolver(Resolver),
}

impl Sensor {
    /// Returns the sensor for the settings.
    pub(super) fn of(settings: &Settings) -> Self {
        match settings.detector {
            Detector::Incremental => Sensor::Channels,
            Detector::Absolute => {
                let period_ticks = settings.sampling_ms() / 1e3 * settings.clock_hz as f64;
                let counts = settings.body.counts_per_rev as u32;
                Sensor::Absolute(AbsoluteEncoder::new(counts, WIDTHS.code, period_ticks))
            }
            Detector::PhaseShift => {
                Sensor::PhaseShift(PhaseShiftTransducer::new(settings.ck_ticks))
            }
            Detector::Resolver => Sensor::Resolver(Resolver::new(
                settings.resolver,
                settings.pitch_counts(),
                WIDTHS.converter,
                settings.ck_ticks,
            )),
        }
    }

    /// Advances one tick with the body at a position in counts and the carrier at a phase; returns
    /// true if the pins are unchanged.
    #[inline]
    pub(super) fn step(&mut self, i: &mut Ports, position_counts: f64, phase: u64) -> bool {
        let pins = |i: &Ports| (i.strobe, i.code, i.secondary, i.sine, i.cosine);
        let before = pins(i);
        match self {
            Sensor::Channels => (),
            Sensor::Absolute(encoder) => (i.strobe, i.code) = encoder.step(position_counts),
            Sensor::PhaseShift(transducer) => {
                i.secondary = transducer.secondary(phase, position_counts);
            }
            Sensor::Resolver(resolver) => {
                (i.strobe, [i.sine, i.cosine]) = resolver.step(position_counts);
            }
        }
        before == pins(i)
    }
}

/// Returns the phase of the carrier, if there is one.
pub(super) fn carrier(watch: &Watcher<'_, Compensator>) -> Option<At<u64>> {
    match &watch.p.detector {
        DetectorPart::PhaseShift(part) => Some(watch.at(part.p.counter.q.phase)),
        _ => None,
    }
}
