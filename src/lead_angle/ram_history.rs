//! The same position history as a RAM, the other form that the text gives for the memory 11.
//!
//! ```text
//!                          ┌─────────────┐
//!  ck, position, restart ─▶│             ├──▶ present, old, pair_ratio
//!  tap, ratio ────────────▶│ RAM history ├──▶ fresh, enough
//!                          └─────────────┘
//! ```
//!
//! Samples stay where they were written; what moves is the address. Ports and every tick at them
//! are those of the [shift register](super::position_history).

use super::PositionHistory;
use super::position_history::{In, Net, Pair, nets, pair_after};
use crate::check::{Invariants, SamePorts, Specified, require};
use crate::kernel::Circuit;
use crate::logic::{Bit, Logic, Ram, Signed, Sim, Unsigned};
use crate::signals;

signals! {
    /// Flip-flops and memory.
    pub struct Reg<L, const T: usize, const W: usize> {
        /// What is at the outputs.
        pub pair: Pair<L, T, W>,
        /// Where the next sample is written; the one k CKs before it is k addresses below.
        address: L::U<T> as Hex,
        /// 11: the samples.
        samples: L::Ram<T, W>,
    }
}

/// Position history of `K` samples of `W` bits in a RAM of 2^`T`.
///
/// A position that stands in the tick of CK is at the outputs in the tick after it.
#[derive(Debug, Clone, Default)]
pub struct RamHistory<const K: usize, const T: usize, const W: usize>;

impl<const K: usize, const T: usize, const W: usize> Circuit for RamHistory<K, T, W> {
    const NAME: &'static str = "ram_history";
    const ABOUT: &'static str = "position samples in a RAM, read a tap of samples back";
    type In<L: Logic> = In<L, T, W>;
    type Reg<L: Logic> = Reg<L, T, W>;
    type Net<L: Logic> = Net<L, T>;

    fn comb<L: Logic>(&self, q: &Reg<L, T, W>, i: &In<L, T, W>) -> Net<L, T> {
        nets::<L, K, T, W>(&q.pair, i)
    }

    fn next<L: Logic>(&self, q: Reg<L, T, W>, w: &Net<L, T>, i: &In<L, T, W>) -> Reg<L, T, W> {
        let from = q.address - i.tap;
        let held = q.pair.old.unsigned();
        let old = q.samples.read_when(w.load, from, held).signed();
        Reg {
            pair: pair_after::<L, K, T, W>(q.pair, w, i, old),
            address: i.ck.mux(q.address + 1, q.address),
            samples: q.samples.write(i.ck, q.address, i.position.unsigned()),
        }
    }
}

impl<const K: usize, const T: usize, const W: usize> SamePorts<PositionHistory<K, T, W>>
    for RamHistory<K, T, W>
{
    fn ports<L: Logic>(i: &In<L, T, W>) -> &In<L, T, W> {
        i
    }
}

impl<const K: usize, const T: usize, const W: usize> Specified for RamHistory<K, T, W> {
    fn invariants(&self) -> Invariants<'_, Self> {
        Invariants::<Self>::new()
            .step(
                "a sample is written below the next address, and no other changes",
                |now, next| {
                    let ck = now.i.ck.get();
                    let at = now.q.address.get();
                    let address = (at + u64::from(ck)) % (1 << T);
                    let right = next.address.get() == address
                        && (0..1 << T).all(|place: u64| {
                            let sample = match ck && place == at {
                                true => now.i.position.unsigned(),
                                false => now.q.samples.read(place.into()),
                            };
                            next.samples.read(place.into()) == sample
                        });
                    require(right, ["samples", "address"], || format!("at {at}"))
                },
            )
            .step(
                "the pair is the sample and the one a tap of samples before it",
                |now, next| {
                    let (tap, pair) = (now.i.tap.get(), &next.pair);
                    let q = now.q;
                    let old = match now.i.ck.get() && tap > 0 && tap <= K as u64 {
                        true => {
                            let place = (q.address.get() + (1 << T) - tap) % (1 << T);
                            q.samples.read(place.into()).signed()
                        }
                        false => q.pair.old,
                    };
                    require(pair.old == old, ["pair.old"], || {
                        format!("{} where {} is expected", pair.old.get(), old.get())
                    })
                },
            )
    }

    /// The ratio is only handed on: it may depend on the position.
    fn applies(&self, i: &In<Sim, T, W>) -> bool {
        i.ratio.get() == i.position.unsigned().get() % 2 * 15
    }
}
