//! Position history as a RAM: the other form of the memory 11 in the text.
//!
//! ```text
//!                          ┌─────────────┐
//!  ck, position, restart ─▶│             ├──▶ present, old, pair_ratio
//!  tap, ratio ────────────▶│ RAM history ├──▶ fresh, enough
//!                          └─────────────┘
//! ```
//!
//! Samples stay where they were written; only the address moves. In every tick the ports behave as
//! those of the [shift register](super::position_history).

use super::codes::tap_width;
use super::position_history::{In, Net, Pair, is_kept, nets, objection, pair_after, ratio_follows};
use crate::prelude::*;

/// Position history in a RAM, which has a word for every tap that there can be.
///
/// A position that is present in the tick of CK is at the outputs in the next tick.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RamHistory {
    /// Number of samples it reaches back.
    pub stages: usize,
    /// Width of a position.
    pub position: usize,
}

/// The most words of which a property looks at each. Of more it looks at the word that is written,
/// and at the one that the tap selects.
const MOST: usize = 256;

signals! { for RamHistory as c;
    /// Flip-flops and memory.
    pub struct Reg {
        /// Pair at the outputs.
        pub pair: Pair(c),
        /// Write address of the next sample. The sample taken k CKs before it is at `address` − k.
        address: U(tap_width(c.stages)) as Hex,
        /// 11: memory of the samples.
        samples: Ram(tap_width(c.stages), c.position),
    }
}

impl Circuit for RamHistory {
    const NAME: &'static str = "ram_history";
    const ABOUT: &'static str = "position samples in a RAM, read `tap` samples back";
    records!(In, Reg, Net);

    fn objection(&self) -> Option<String> {
        objection(self.stages)
    }

    fn tick(&self, i: In, q: Reg, _: Nothing) -> (Net, Reg<Edge>) {
        let net = nets(self.stages, &q.pair, &i);
        let from = q.address - i.tap;
        let held = q.pair.old.unsigned();
        let old = q.samples.read_when(net.load, from, held).signed();
        let edge = Reg {
            pair: pair_after(self.stages, &q.pair, &net, &i, old),
            address: i.ck.mux(q.address + 1, q.address),
            samples: q.samples.write(i.ck, q.address, i.position.unsigned()),
        };
        (net, edge)
    }

    fn properties(&self, now: &Moment<Self>) -> Vec<Property> {
        let (i, q, next) = (&now.i, &now.q, &now.next.q);
        let counted = next.address.equals(i.ck.mux(q.address + 1, q.address));
        let old = q.address - i.tap;
        let looked_at: Vec<U> = match q.samples.len() {
            words @ ..=MOST => (0..words)
                .map(|at| U::new(at as u64, q.address.width()))
                .collect(),
            _ => vec![q.address, old],
        };
        let words = looked_at.into_iter().map(|at| {
            let written = i.ck & q.address.equals(at);
            let word = written.mux(i.position.unsigned(), q.samples.read(at));
            next.samples.read(at).equals(word)
        });
        let taken = i.ck & is_kept(self.stages, i.tap);
        let sample = q.samples.read(old).signed();
        vec![
            Property::step(
                "CK writes the sample at address and counts address up, and changes no other word",
                &["samples", "address"],
                counted & Bit::all(words),
            ),
            Property::step(
                "at CK, pair.old becomes the sample of tap CKs ago, and otherwise it stays",
                &["pair.old"],
                next.pair.old.equals(taken.mux(sample, q.pair.old)),
            ),
        ]
    }
}

impl Specified for RamHistory {
    fn applies(&self, i: &In<Value>) -> bool {
        ratio_follows(i)
    }
}
