//! Position detector 10 as a resolver in amplitude mode: the angle in a pitch, in counts, at each peak of
//! the carrier that is sampled, continued beyond the pitch.
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
//! The text lists it as a resolver and the means that make digital data of its signals. `sample` is CK
//! of the memory 11, a conversion that is done. The scaler makes counts of the angle while the CORDIC
//! turns, since a pitch has as many counts as the machine wants and the angle is a binary part of it.

use super::{TrackingConverter, Unwrapper, tracking_converter, unwrapper};
use crate::circuits::blocks::{Scaler, scaler};
use crate::prelude::*;

/// Resolver detector, with a position that continues over the pitches.
///
/// From `strobe` to `position` it takes A + 2 ticks, A being the width of an angle.
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
        /// The words are new, A + 2 ticks after those before at least.
        pub strobe: Bit,
        /// The sine winding at a peak of the carrier.
        pub sine: I(c.converter.converter) as Analog,
        /// The cosine winding.
        pub cosine: I(c.converter.converter) as Analog,
        /// M: counts of a pitch; 0 for 2^A.
        pub modulus: U(c.angle()),
        /// The next place is taken for the position, as after power-on; `lost` off.
        pub clear: Bit,
    }
    /// The circuits inside.
    pub struct Parts {
        /// The angle in a pitch.
        pub converter: Part<TrackingConverter>(c.converter.clone()),
        /// The angle in counts.
        pub scaler: Part<Scaler>(Scaler { gain: c.angle(), value: c.angle() + 2 }),
        /// Position, continued over the pitches.
        pub unwrapper: Part<Unwrapper>(Unwrapper { place: c.angle(), position: c.position }),
    }
    /// Output ports.
    pub struct Net {
        /// Change of the angle per conversion, in units of 2^−(A + 2·G) pitch.
        pub speed: I(c.converter.tracking.phase()) as Analog,
        /// A sample is new in this tick: CK.
        pub sample: Bit,
        /// Dx: place in the pitch, rounded down, and the pitches since; wraps.
        pub position: I(c.position) as Analog,
        /// The signal was too small, or the body too fast, since `clear`.
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
