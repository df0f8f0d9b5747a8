//! What the detector of a compensator sees of the body: the signals at its pins.

use super::job::{Ports, WIDTHS};
use super::settings::{Detector, Settings};
use crate::circuits::lead_angle::Compensator;
use crate::circuits::lead_angle::detector::DetectorPart;
use crate::hdl::{At, Watcher};
use crate::plant::{AbsoluteEncoder, PhaseShiftTransducer, Resolver};

/// The sensor of a detector that gives places.
#[derive(Debug)]
pub(super) enum Sensor {
    /// An incremental encoder, which is on the body.
    Channels,
    /// An absolute encoder with a sampling clock of its own.
    Absolute(AbsoluteEncoder),
    /// A phase-shift transducer, excited by the detector.
    PhaseShift(PhaseShiftTransducer),
    /// A resolver and its A/D converters.
    Resolver(Resolver),
}

impl Sensor {
    /// The sensor of these settings.
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

    /// One tick, with the body at a position in counts and the carrier at a phase; whether the pins
    /// stand as they were.
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

/// Phase of the carrier, where there is one.
pub(super) fn carrier(watch: &Watcher<'_, Compensator>) -> Option<At<u64>> {
    match &watch.p.detector {
        DetectorPart::PhaseShift(part) => Some(watch.at(part.p.counter.q.phase)),
        _ => None,
    }
}
