//! Position detector 10 as an absolute encoder of a turn: its word, taken with its own sampling clock
//! and continued beyond the turn.
//!
//! ```text
//!           ┌───────────────── absolute detector ─────────────────┐
//!  strobe, ─┼▶┌───────────────┐ take, place, outside ┌───────────┐ │
//!  code,    │ │ gray receiver ├─────────────────────▶│ unwrapper ├─┼▶ sample, position, lost
//!  turn     │ └───────────────┘           clear, ───▶└───────────┘ │
//!           │                             turn                    │
//!           └─────────────────────────────────────────────────────┘
//! ```
//!
//! `sample` is CK of the memory 11, as the text advises.

use super::{GrayReceiver, Unwrapper, gray_receiver, unwrapper};
use crate::prelude::*;

/// Absolute detector of a turn, with a position that continues over the turns.
///
/// A word at the pins from tick n on, with its strobe, is in `position` from n + 4 on, with `sample`
/// in that tick.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct AbsoluteDetector {
    /// Width of the encoder's word.
    pub code: usize,
    /// Width of the position, greater than that.
    pub position: usize,
}

signals! { for AbsoluteDetector as c;
    /// Input ports.
    pub struct In {
        /// The encoder's sampling clock, asynchronous; a new word comes with each rise. High and low
        /// for a tick at least, four ticks from rise to rise.
        pub strobe: Bit,
        /// The encoder's word in Gray code, asynchronous.
        pub code: U(c.code) as Hex,
        /// T: counts of a turn; 0 for 2^code.
        pub turn: U(c.code),
        /// The next word is taken for the position, as after power-on; `lost` off.
        pub clear: Bit,
    }
    /// The circuits inside.
    pub struct Parts {
        /// Place of the encoder in its turn.
        pub receiver: Part<GrayReceiver>(GrayReceiver { code: c.code }),
        /// Position, continued over the turns.
        pub unwrapper: Part<Unwrapper>(Unwrapper { place: c.code, position: c.position }),
    }
    /// Output ports.
    pub struct Net {
        /// A sample is new in this tick: CK.
        pub sample: Bit,
        /// Dx: place in the turn, and the turns since; wraps.
        pub position: I(c.position) as Analog,
        /// The encoder was too fast, or a word was outside the turn, since `clear`.
        pub lost: Bit,
    }
}

impl Circuit for AbsoluteDetector {
    const NAME: &'static str = "absolute_detector";
    const ABOUT: &'static str = "position from the Gray words of an absolute encoder of a turn";
    records!(In, Nothing, Net, Parts);

    fn tick(&self, i: In, _: Nothing, p: Parts) -> (Net, Nothing) {
        let receiver = p.receiver.settle(gray_receiver::In {
            strobe: i.strobe,
            code: i.code,
            turn: i.turn,
        });
        let unwrapper = p.unwrapper.settle(unwrapper::In {
            take: receiver.w.take,
            fault: receiver.w.outside,
            place: receiver.w.place.resize(self.code),
            modulus: i.turn,
            clear: i.clear,
        });
        let net = Net {
            sample: unwrapper.q.sample,
            position: unwrapper.q.position,
            lost: unwrapper.q.lost,
        };
        (net, Nothing)
    }
}
