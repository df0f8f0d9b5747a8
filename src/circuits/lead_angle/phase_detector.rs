//! Position detector 10 as a phase-shift detector: the phase of the secondary in a pitch is taken
//! at each 0 phase of the carrier, and the position is continued over the pitches.
//!
//! ```text
//!             ┌───────────── phase detector ─────────────┐
//!             │ ┌───────────────┐                        │
//!  secondary ─┼▶│               ├────────────────────────┼▶ phase, square_wave
//!  modulus ───┼▶│ phase counter │ take, place            │
//!             │ │               ├──────────▶┌───────────┐│
//!             │ └───────────────┘ fault     │ unwrapper ├┼▶ sample, position, lost
//!  clear ─────┼────────────────────────────▶└───────────┘│
//!             └──────────────────────────────────────────┘
//! ```
//!
//! This is the detector that the text prefers (位相シフト方式). `sample` is CK of the memory 11: the
//! sampling clock of the detector, one pulse per period of the reference signal.

use super::{PhaseCounter, Unwrapper, phase_counter, unwrapper};
use crate::prelude::*;

/// Phase-shift detector, with a position that continues over the pitches.
///
/// A place is as old as its crossing, up to one period of the secondary. From 0 phase to `position`
/// it takes three ticks.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PhaseDetector {
    /// Width of a phase, and of a place in a pitch.
    pub phase: usize,
    /// Width of the position, greater than that.
    pub position: usize,
}

signals! { for PhaseDetector as c;
    /// Input ports.
    pub struct In {
        /// Secondary above zero, from a comparator with hysteresis; asynchronous.
        pub secondary: Bit,
        /// M: ticks of the carrier period, and counts of a pitch; at least 4, or 0 for 2^phase.
        pub modulus: U(c.phase),
        /// The next place becomes the position, as after power-on; clears `lost`.
        pub clear: Bit,
    }
    /// The circuits inside.
    pub struct Parts {
        /// Carrier, and place of the body in a pitch.
        pub counter: Part<PhaseCounter>(PhaseCounter { phase: c.phase }),
        /// Position, continued over the pitches.
        pub unwrapper: Part<Unwrapper>(Unwrapper { place: c.phase, position: c.position }),
    }
    /// Output ports.
    pub struct Net {
        /// Phase of the carrier, for the D/A converters of the primaries.
        pub phase: U(c.phase) as Analog,
        /// Square wave in phase with the carrier's sine: high in the first half of the period.
        pub square_wave: Bit,
        /// High for one tick: `position` is a new sample. CK of the memory 11.
        pub sample: Bit,
        /// Dx: place in the pitch plus the counts of whole pitches; wraps.
        pub position: I(c.position) as Analog,
        /// A crossing came too early or was overdue, or the body was too fast; cleared by `clear`.
        pub lost: Bit,
    }
}

impl Circuit for PhaseDetector {
    const NAME: &'static str = "phase_detector";
    const ABOUT: &'static str = "position from the phase of a phase-shift transducer's secondary";
    records!(In, Nothing, Net, Parts);

    fn tick(&self, i: In, _: Nothing, p: Parts) -> (Net, Nothing) {
        let counter = p.counter.settle(phase_counter::In {
            secondary: i.secondary,
            modulus: i.modulus,
        });
        let unwrapper = p.unwrapper.settle(unwrapper::In {
            take: counter.w.take,
            fault: counter.q.fault,
            place: counter.q.place,
            modulus: i.modulus,
            clear: i.clear,
        });
        let net = Net {
            phase: counter.q.phase,
            square_wave: counter.w.square_wave,
            sample: unwrapper.q.sample,
            position: unwrapper.q.position,
            lost: unwrapper.q.lost,
        };
        (net, Nothing)
    }

    fn properties(&self, now: &Moment<Self>) -> Vec<Property> {
        let modulus = now.i.modulus;
        vec![Property::given(
            "modulus is 0 or at least 4",
            modulus.is_zero() | !modulus.shift_right(2).is_zero(),
        )]
    }
}
