//! Position detector 10 as a single-turn absolute encoder: its word is taken with the encoder's own
//! sampling clock, and the position is continued over the turns.
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

/// Single-turn absolute detector, with a position that continues over the turns.
///
/// A word that is at the pins with its strobe from tick n on is in `position` from tick n + 4 on.
/// `sample` is high in tick n + 4.
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
        /// Sampling clock of the encoder, asynchronous; a new word comes with each rising edge.
        /// High and low for at least one tick; at least four ticks from edge to edge.
        pub strobe: Bit,
        /// Word of the encoder in Gray code, asynchronous.
        pub code: U(c.code) as Hex,
        /// T: counts of a turn; 0 for 2^code.
        pub turn: U(c.code),
        /// The next place becomes the position, as after power-on; clears `lost`.
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
        /// High for one tick: `position` is a new sample. CK of the memory 11.
        pub sample: Bit,
        /// Dx: place in the turn plus the counts of whole turns; wraps.
        pub position: I(c.position) as Analog,
        /// The encoder was too fast, or a word was outside the turn; cleared by `clear`.
        pub lost: Bit,
    }
}

impl Circuit for AbsoluteDetector {
    const NAME: &'static str = "absolute_detector";
    const ABOUT: &'static str = "position from the Gray words of a single-turn absolute encoder";
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
