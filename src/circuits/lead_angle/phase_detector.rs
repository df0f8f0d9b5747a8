//! Position detector 10 as a phase-shift detector: the phase of a secondary in a pitch, taken at each 0
//! phase of its carrier and continued beyond the pitch.
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
//! sampling clock of the detector, a pulse for each period of the reference signal.

use super::{PhaseCounter, Unwrapper, phase_counter, unwrapper};
use crate::prelude::*;

/// Phase-shift detector, with a position that continues over the pitches.
///
/// A place is as old as its crossing, up to a period of the secondary; from 0 phase to `position` it
/// takes three ticks.
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
        /// The secondary is above zero: a comparator with hysteresis, asynchronous.
        pub secondary: Bit,
        /// M: ticks of the carrier's period, and counts of a pitch; 0 for 2^phase. 4 at least.
        pub modulus: U(c.phase),
        /// The next place is taken for the position, as after power-on; `lost` off.
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
        /// The carrier is in the first half of its period: a square wave in phase with its sine.
        pub square_wave: Bit,
        /// A sample is new in this tick: CK.
        pub sample: Bit,
        /// Dx: place in the pitch, and the pitches since; wraps.
        pub position: I(c.position) as Analog,
        /// A crossing came too soon or not in time, or the body was too fast, since `clear`.
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
}
