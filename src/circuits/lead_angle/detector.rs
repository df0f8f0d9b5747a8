//! Position detectors 10 that a compensator can have.

use super::compensator::In;
use super::{
    AbsoluteDetector, PhaseDetector, ResolverDetector, TrackingConverter, Widths,
    absolute_detector, phase_detector, resolver_detector,
};
use crate::circuits::blocks::{QuadratureCounter, quadrature_counter};
use crate::prelude::*;
use serde::{Deserialize, Serialize};

/// Kind of a compensator's position detector.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Detector {
    /// An incremental encoder and a counter, sampled with a CK of the reference clock.
    #[default]
    Incremental,
    /// An absolute encoder of a turn, whose sampling clock is CK.
    Absolute,
    /// A phase-shift transducer, whose carrier is CK.
    PhaseShift,
    /// A resolver, whose conversions are CK.
    Resolver,
}

choice! {
    /// Position detector 10.
    pub enum DetectorSource as DetectorPart {
        /// The counter.
        Incremental(QuadratureCounter),
        /// The words of a turn, continued.
        Absolute(AbsoluteDetector),
        /// The phase in a pitch, continued.
        PhaseShift(PhaseDetector),
        /// The angle in a pitch, continued.
        Resolver(ResolverDetector),
    }
}

impl DetectorSource {
    /// The detector of this kind.
    pub(super) fn of(kind: Detector, widths: &Widths) -> Self {
        let Widths {
            position,
            code,
            converter,
            ..
        } = *widths;
        match kind {
            Detector::Incremental => Self::Incremental(QuadratureCounter { width: position }),
            Detector::Absolute => Self::Absolute(AbsoluteDetector { code, position }),
            Detector::PhaseShift => Self::PhaseShift(PhaseDetector {
                phase: code,
                position,
            }),
            Detector::Resolver => Self::Resolver(ResolverDetector {
                converter: TrackingConverter::new(converter, code),
                position,
            }),
        }
    }
}

/// Outputs of a detector.
pub(super) struct Detected {
    /// CK.
    pub(super) ck: Bit,
    /// Dx.
    pub(super) position: I,
    /// The position is wrong.
    pub(super) lost: Bit,
    /// Phase of the carrier of a phase-shift detector.
    pub(super) carrier: Option<U>,
}

impl DetectorPart {
    /// Settles it by the ports of a compensator and the CK of its counter.
    pub(super) fn detect(self, i: &In, ck: Bit) -> Detected {
        let clear = i.clear;
        let (ck, position, lost, carrier) = match self {
            DetectorPart::Incremental(part) => {
                let (a, b) = (i.a, i.b);
                let q = part.settle(quadrature_counter::In { a, b, clear }).q;
                (ck, q.position, q.lost, None)
            }
            DetectorPart::Absolute(part) => {
                let ports = absolute_detector::In {
                    strobe: i.strobe,
                    code: i.code,
                    turn: i.turn,
                    clear,
                };
                let w = part.settle(ports).w;
                (w.sample, w.position, w.lost, None)
            }
            DetectorPart::PhaseShift(part) => {
                let ports = phase_detector::In {
                    secondary: i.secondary,
                    modulus: i.turn,
                    clear,
                };
                let w = part.settle(ports).w;
                (w.sample, w.position, w.lost, Some(w.phase))
            }
            DetectorPart::Resolver(part) => {
                let ports = resolver_detector::In {
                    strobe: i.strobe,
                    sine: i.sine,
                    cosine: i.cosine,
                    modulus: i.turn,
                    clear,
                };
                let w = part.settle(ports).w;
                (w.sample, w.position, w.lost, None)
            }
        };
        Detected {
            ck,
            position,
            lost,
            carrier,
        }
    }
}
