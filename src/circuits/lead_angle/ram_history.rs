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
use super::position_history::{In, Net, Pair, nets, objection, pair_after, ratio_follows, stored};
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

signals! { for RamHistory as c;
    /// Flip-flops and memory.
    pub struct Reg {
        /// Pair at the outputs.
        pub pair: Pair(c),
        /// Write address of the next sample; the sample k CKs before it is at `address` − k.
        address: U(tap_width(c.stages)) as Hex,
        /// 11: the samples.
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
}

impl Specified for RamHistory {
    fn invariants(&self) -> Invariants<'_, Self> {
        let &RamHistory { stages, position } = self;
        let addresses = 1u64 << tap_width(stages);
        Invariants::<Self>::new()
            .step(
                "CK writes the sample at address and counts address up, and changes no other word",
                move |now, next| {
                    let (ck, at) = (now.i.ck, now.q.address);
                    let address = (at + u64::from(ck)) % addresses;
                    let right = next.q.address == address
                        && (0..addresses).all(|place| {
                            let sample = match ck && place == at {
                                true => stored(now.i.position, position),
                                false => now.q.samples[place as usize],
                            };
                            next.q.samples[place as usize] == sample
                        });
                    require(right, ["samples", "address"], || format!("at {at}"))
                },
            )
            .step(
                "at CK, pair.old becomes the sample of tap CKs ago, and otherwise it stays",
                move |now, next| {
                    let (tap, q) = (now.i.tap, now.q);
                    let old = match now.i.ck && tap > 0 && tap <= stages as u64 {
                        true => q.samples[((q.address + addresses - tap) % addresses) as usize],
                        false => stored(q.pair.old, position),
                    };
                    let given = stored(next.q.pair.old, position);
                    require(given == old, ["pair.old"], || {
                        format!("{given} where {old} is expected")
                    })
                },
            )
    }

    fn applies(&self, i: &In<Value>) -> bool {
        ratio_follows(i)
    }
}
