//! Position detector 10 as a resolver in amplitude mode: the angle in a pitch is sampled at peaks
//! of the carrier and converted to counts, and the position is continued over the pitches.
//!
//! ```text
//!           ┌──────────────────── resolver detector ────────────────────┐
//!  strobe ──┼▶┌────────────────────┐ take, fault                        │
//!  sine ────┼▶│ tracking converter ├────────────────────▶┌───────────┐  │
//!  cosine ──┼▶└─────────┬──────────┘   ┌────────┐ place  │ unwrapper ├──┼▶ sample, position, lost
//!  modulus ─┼▶          └─────────────▶│ scaler ├───────▶│           │  │
//!  clear ───┼─────────────── angle     └────────┘        └───────────┘  │
//!           └───────────────────────────────────────────────────────────┘
//! ```
//!
//! The text lists a resolver with the means that make digital data of its signals. `sample` is CK
//! of the memory 11: a conversion is done. A pitch can have any number of counts, but the angle is
//! a binary fraction of it. So the scaler converts the angle to counts, while the CORDIC rotates.

use super::{TrackingConverter, Unwrapper, tracking_converter, unwrapper};
use crate::circuits::blocks::{Scaler, scaler};
use crate::prelude::*;

/// Resolver detector, with a position that continues over the pitches.
///
/// From `strobe` to `position` it takes A + 2 ticks, where A is the width of an angle.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ResolverDetector {
    /// The converter; a place is as wide as its angle.
    pub converter: TrackingConverter,
    /// Width of the position, greater than that.
    pub position: usize,
}

impl ResolverDetector {
    /// A: width of an angle and of a place.
    const fn angle(&self) -> usize {
        self.converter.tracking.angle
    }
}

signals! { for ResolverDetector as c;
    /// Input ports.
    pub struct In {
        /// `sine` and `cosine` are new; at least A + 2 ticks after the strobe before.
        pub strobe: Bit,
        /// Sine winding, sampled at a peak of the carrier.
        pub sine: I(c.converter.converter) as Analog,
        /// Cosine winding, sampled at a peak of the carrier.
        pub cosine: I(c.converter.converter) as Analog,
        /// M: counts of a pitch; 0 for 2^A.
        pub modulus: U(c.angle()),
        /// The next place becomes the position, as after power-on; clears `lost`.
        pub clear: Bit,
    }
    /// The circuits inside.
    pub struct Parts {
        /// Converter for the angle in a pitch.
        pub converter: Part<TrackingConverter>(c.converter.clone()),
        /// Scaler from angle to counts.
        pub scaler: Part<Scaler>(Scaler { gain: c.angle(), value: c.angle() + 2 }),
        /// Position, continued over the pitches.
        pub unwrapper: Part<Unwrapper>(Unwrapper { place: c.angle(), position: c.position }),
    }
    /// Output ports.
    pub struct Net {
        /// Change of the angle per conversion, in units of 2^−(A + 2·G) pitch.
        pub speed: I(c.converter.tracking.phase(), c.converter.tracking.phase()) as Analog,
        /// High for one tick: `position` is a new sample. CK of the memory 11.
        pub sample: Bit,
        /// Dx: place in the pitch, rounded down, plus the counts of whole pitches; wraps.
        pub position: I(c.position) as Analog,
        /// The signal was too small, or the body too fast; cleared by `clear`.
        pub lost: Bit,
    }
}

impl Circuit for ResolverDetector {
    const NAME: &'static str = "resolver_detector";
    const ABOUT: &'static str = "position from the windings of a resolver";
    records!(In, Nothing, Net, Parts);

    fn tick(&self, i: In, _: Nothing, p: Parts) -> (Net, Nothing) {
        let converter = p.converter.settle(tracking_converter::In {
            strobe: i.strobe,
            sine: i.sine,
            cosine: i.cosine,
        });
        let counts = i.modulus.is_zero().word().join(i.modulus);
        let scaler = p.scaler.settle(scaler::In {
            start: i.strobe,
            clear: Bit::low(),
            value: counts.resize(self.angle() + 2),
            gain: converter.w.angle,
        });
        let unwrapper = p.unwrapper.settle(unwrapper::In {
            take: converter.w.take,
            fault: converter.w.fault,
            // A gain has a bit before the point, an angle none.
            place: scaler.q.scaled.slice(1, self.angle()),
            modulus: i.modulus,
            clear: i.clear,
        });
        let net = Net {
            speed: converter.w.speed,
            sample: unwrapper.q.sample,
            position: unwrapper.q.position,
            lost: unwrapper.q.lost,
        };
        (net, Nothing)
    }
}
