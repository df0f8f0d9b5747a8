//! Position history: memory 11 as a shift register of samples, and the tap selector 14.
//!
//! ```text
//!                          ┌──────────────────┐
//!  ck, position, restart ─▶│                  ├──▶ present, old, pair_ratio
//!  tap, ratio ────────────▶│ position history ├──▶ fresh, enough
//!                          └──────────────────┘
//! ```
//!
//! At each CK a sample goes in at stage 0 and all others move on by a stage: stage k holds the
//! sample that is k CKs older than the present one. With the sample goes a pair to the outputs, the
//! sample itself and the one a tap of CKs before it, together with the ratio that belongs to it.
//!
//! Departures: how many samples there are since `restart` is counted, since a history of zeros
//! predicts twice the position. Sample and earlier sample change at the same edge, so that they
//! always belong together, whatever the rate of CK.

use crate::check::{Invariants, Specified, require};
use crate::kernel::Circuit;
use crate::logic::{Bit, Logic, ShiftRegister, Signed, Sim, Unsigned};
use crate::signals;

signals! {
    /// Ports in; also those of the [RAM form](super::ram_history).
    pub struct In<L, const T: usize, const W: usize> {
        /// CK: a sample is taken.
        pub ck: L::Bit,
        /// What was sampled so far counts no more.
        pub restart: L::Bit,
        /// The position.
        pub position: L::I<W>,
        /// How many CKs old the other sample of the pair is, 1 to K; 0 for none.
        pub tap: L::U<T>,
        /// N, which goes with the pair.
        pub ratio: L::U<4>,
    }
}

signals! {
    /// What leads a sample to the outputs; also of the [RAM form](super::ram_history).
    pub struct Pair<L, const T: usize, const W: usize> {
        /// Dx: the present sample.
        pub present: L::I<W> as Analog,
        /// Dx(−Δt/N): the sample a tap of CKs before it.
        pub old: L::I<W> as Analog,
        /// N of this pair.
        pub pair_ratio: L::U<4>,
        /// `old` was sampled since the last restart, or none is wanted.
        pub enough: L::Bit,
        /// The pair is new in this tick.
        pub fresh: L::Bit,
        /// Samples since the last restart, up to K.
        pub samples: L::U<T>,
    }
}

signals! {
    /// Flip-flops.
    pub struct Reg<L, const K: usize, const T: usize, const W: usize> {
        /// What is at the outputs.
        pub pair: Pair<L, T, W>,
        /// 11: stage k holds the sample k CKs before the present one.
        stages: L::ShiftRegister<K, W>,
    }
}

signals! {
    /// Nets; also those of the [RAM form](super::ram_history).
    pub struct Net<L, const T: usize> {
        /// The stage that the tap names before the shift.
        index: L::U<T>,
        /// There is such a stage, and a sample is taken.
        pub(super) load: L::Bit,
        /// There are samples for this tap.
        covered: L::Bit,
    }
}

/// Position history of `K` stages of `W` bits with taps of `T` bits.
///
/// A position that stands in the tick of CK is at the outputs in the tick after it.
#[derive(Debug, Clone, Default)]
pub struct PositionHistory<const K: usize, const T: usize, const W: usize>;

/// The nets of either form.
pub(super) fn nets<L: Logic, const K: usize, const T: usize, const W: usize>(
    pair: &Pair<L, T, W>,
    i: &In<L, T, W>,
) -> Net<L, T> {
    const { assert!(K >= 1 && K < 1 << T, "a tap names each stage") };
    let index = i.tap - 1;
    Net {
        index,
        load: i.ck & index.below((K as u64).into()),
        covered: !pair.samples.below(i.tap),
    }
}

/// The outputs of either form after the edge; `old` is what its memory gives.
pub(super) fn pair_after<L: Logic, const K: usize, const T: usize, const W: usize>(
    pair: Pair<L, T, W>,
    w: &Net<L, T>,
    i: &In<L, T, W>,
    old: L::I<W>,
) -> Pair<L, T, W> {
    let full = pair.samples.equals((K as u64).into());
    let counted = (i.ck & !full).mux(pair.samples + 1, pair.samples);
    Pair {
        present: i.ck.mux(i.position, pair.present),
        old,
        pair_ratio: i.ck.mux(i.ratio, pair.pair_ratio),
        enough: i.ck.mux(w.covered, pair.enough) & !i.restart,
        fresh: i.ck & !i.restart,
        samples: i.restart.mux(0.into(), counted),
    }
}

impl<const K: usize, const T: usize, const W: usize> Circuit for PositionHistory<K, T, W> {
    const NAME: &'static str = "position_history";
    const ABOUT: &'static str = "shift register of position samples, with a tap selector";
    type In<L: Logic> = In<L, T, W>;
    type Reg<L: Logic> = Reg<L, K, T, W>;
    type Net<L: Logic> = Net<L, T>;

    fn comb<L: Logic>(&self, q: &Reg<L, K, T, W>, i: &In<L, T, W>) -> Net<L, T> {
        nets::<L, K, T, W>(&q.pair, i)
    }

    fn next<L: Logic>(
        &self,
        q: Reg<L, K, T, W>,
        w: &Net<L, T>,
        i: &In<L, T, W>,
    ) -> Reg<L, K, T, W> {
        let old = w.load.mux(q.stages.tap(w.index).signed(), q.pair.old);
        Reg {
            pair: pair_after::<L, K, T, W>(q.pair, w, i, old),
            stages: q.stages.shift(i.ck, i.position.unsigned()),
        }
    }
}

impl<const K: usize, const T: usize, const W: usize> Specified for PositionHistory<K, T, W> {
    fn invariants(&self) -> Invariants<'_, Self> {
        Invariants::<Self>::new()
            .step(
                "at CK every sample becomes a CK older, between CKs nothing moves",
                |now, next| {
                    let stage = |q: &Reg<Sim, K, T, W>, k: usize| q.stages.stage(k).signed().get();
                    let before: Vec<_> = (0..K).map(|k| stage(now.q, k)).collect();
                    let mut expected = before.clone();
                    if now.i.ck.get() {
                        expected.insert(0, now.i.position.get());
                        expected.truncate(K);
                    }
                    let after: Vec<_> = (0..K).map(|k| stage(next, k)).collect();
                    require(after == expected, ["stages"], || {
                        format!("{after:?} where {expected:?} is expected")
                    })
                },
            )
            .step(
                "the pair is the sample and the one a tap of CKs before it",
                |now, next| {
                    let (tap, pair) = (now.i.tap.get() as usize, &next.pair);
                    if !now.i.ck.get() {
                        let held = pair.present == now.q.pair.present
                            && pair.old == now.q.pair.old
                            && pair.pair_ratio == now.q.pair.pair_ratio;
                        return require(held, ["pair.present", "pair.old"], || "moved".into());
                    }
                    let old = match tap {
                        0 => now.q.pair.old,
                        tap if tap > K => now.q.pair.old,
                        tap => now.q.stages.stage(tap - 1).signed(),
                    };
                    let right = pair.present == now.i.position
                        && pair.old == old
                        && pair.pair_ratio == now.i.ratio;
                    require(right, ["pair.present", "pair.old"], || {
                        format!("{} and {}", pair.present.get(), pair.old.get())
                    })
                },
            )
            .step(
                "it is fresh after CK, and enough where the tap reaches back to the restart at most",
                |now, next| {
                    let (ck, restart) = (now.i.ck.get(), now.i.restart.get());
                    let enough = match ck {
                        true => now.q.pair.samples.get() >= now.i.tap.get(),
                        false => now.q.pair.enough.get(),
                    };
                    let right = next.pair.fresh.get() == (ck && !restart)
                        && next.pair.enough.get() == (enough && !restart);
                    require(right, ["pair.fresh", "pair.enough"], || {
                        format!("{enough} with {} samples", now.q.pair.samples.get())
                    })
                },
            )
            .step("samples are counted up to K", |now, next| {
                let more = (now.q.pair.samples.get() + u64::from(now.i.ck.get())).min(K as u64);
                let expected = if now.i.restart.get() { 0 } else { more };
                let right = next.pair.samples.get() == expected;
                require(right, ["pair.samples"], || format!("{expected} expected"))
            })
    }

    /// The ratio is only handed on: it may depend on the position.
    fn applies(&self, i: &In<Sim, T, W>) -> bool {
        i.ratio.get() == i.position.unsigned().get() % 2 * 15
    }
}
