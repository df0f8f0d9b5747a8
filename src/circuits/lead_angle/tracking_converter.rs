//! Tracking converter: computes angle and speed of a resolver from its two windings. Part of
//! position detector 10 of JPH0646367B2.
//!
//! ```text
//!          ┌────────────── tracking converter ──────────────┐
//!  strobe ─┼▶┌────────┐ quadrature, in_phase ┌──────────┐   │
//!  sine ───┼▶│ CORDIC ├─────────────────────▶│ tracking ├───┼▶ angle, speed
//!  cosine ─┼▶│        │◀─────────────────────┤ loop     ├───┼▶ take, fault
//!          │ └────────┘        angle         └──────────┘   │
//!          └────────────────────────────────────────────────┘
//! ```
//!
//! One winding of the resolver is excited by a carrier. The other two output its amplitude times
//! sine and cosine of θ (amplitude mode). Both are sampled by A/D converters at a peak of the
//! carrier, which demodulates them. The vector (sine, cosine) rotated by φ is a·(sin(θ − φ), cos(θ
//! − φ)), where a is the amplitude. No table of sines and no product is needed.

use super::{TrackingLoop, tracking_loop};
use crate::circuits::blocks::{Cordic, cordic};
use crate::prelude::*;

/// Tracking converter.
///
/// `take` is high A + 1 ticks after `strobe`, for the angle that is valid until then: the
/// prediction of earlier conversions for this one.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TrackingConverter {
    /// S: width of the A/D converters' words, at most A.
    pub converter: usize,
    /// The loop; A is the width of its angle.
    pub tracking: TrackingLoop,
}

impl TrackingConverter {
    /// Creates a converter for words and angles of these widths, with the
    /// [loop](TrackingLoop::new) for such angles.
    #[must_use]
    pub const fn new(converter: usize, angle: usize) -> Self {
        TrackingConverter {
            converter,
            tracking: TrackingLoop::new(angle),
        }
    }

    /// Ticks from `strobe` to the next that is converted with a new angle.
    #[must_use]
    pub const fn period(&self) -> u64 {
        self.tracking.angle as u64 + 2
    }

    const fn cordic(&self) -> Cordic {
        Cordic {
            radius: self.tracking.vector(),
            angle: self.tracking.angle,
        }
    }
}

signals! { for TrackingConverter as c;
    /// Input ports.
    pub struct In {
        /// `sine` and `cosine` are new; at least A + 2 ticks after the strobe before. An earlier
        /// strobe is ignored, or uses the angle of the conversion before.
        pub strobe: Bit,
        /// Sine winding, sampled at a peak of the carrier.
        pub sine: I(c.converter) as Analog,
        /// Cosine winding, sampled at a peak of the carrier.
        pub cosine: I(c.converter) as Analog,
    }
    /// The circuits inside.
    pub struct Parts {
        /// Rotation of the windings by the angle.
        pub cordic: Part<Cordic>(c.cordic()),
        /// Tracking loop: angle and speed.
        pub tracking: Part<TrackingLoop>(c.tracking.clone()),
    }
    /// Output ports.
    pub struct Net {
        /// φ: angle, in units of 2^−A pitch.
        pub angle: U(c.tracking.angle, c.tracking.angle) as Analog,
        /// Change of the angle per conversion, in units of 2^−(A + 2·G) pitch.
        pub speed: I(c.tracking.phase(), c.tracking.phase()) as Analog,
        /// The angle is taken as a place.
        pub take: Bit,
        /// The angle is invalid: there is no signal, or the loop is not locked.
        pub fault: Bit,
    }
}

impl Circuit for TrackingConverter {
    const NAME: &'static str = "tracking_converter";
    const ABOUT: &'static str = "angle and speed of a resolver from its two windings";
    records!(In, Nothing, Net, Parts);

    fn objection(&self) -> Option<String> {
        let wider = self.converter > self.tracking.angle;
        wider.then(|| "a word of an A/D converter is no wider than an angle".into())
    }

    fn tick(&self, i: In, _: Nothing, p: Parts) -> (Net, Nothing) {
        let TrackingLoop { angle, .. } = self.tracking;
        let below = angle.saturating_sub(self.converter);
        let full = |word: I| word.resize(self.tracking.vector()).shift_left(below);
        let before = p.tracking.q.phase.slice(self.tracking.fraction(), angle);
        let cordic = p.cordic.settle(cordic::In {
            start: i.strobe,
            halt: Bit::low(),
            radius: full(i.sine),
            offset: full(i.cosine),
            angle: before,
        });
        let tracking = p.tracking.settle(tracking_loop::In {
            done: cordic.w.done,
            quadrature: cordic.w.along,
            in_phase: cordic.w.across,
        });
        let net = Net {
            angle: before,
            speed: tracking.q.speed,
            take: tracking.w.take,
            fault: tracking.w.fault,
        };
        (net, Nothing)
    }
}
