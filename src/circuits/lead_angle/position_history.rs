//! Position history: memory 11 as a shift register of samples, and the tap selector 14.
//!
//! ```text
//!                          ┌──────────────────┐
//!  ck, position, restart ─▶│                  ├──▶ present, old, pair_ratio
//!  tap, ratio ────────────▶│ position history ├──▶ fresh, enough
//!                          └──────────────────┘
//! ```
//!
//! At each CK a sample enters stage 0, and all others move on by one stage: stage k holds the
//! sample that is k CKs older than the present one. At the same CK a pair appears at the outputs:
//! the sample itself and the one `tap` CKs older, together with the ratio that belongs to it.
//!
//! Departures: the samples since `restart` are counted, because a history of zeros would predict
//! twice the position. Both samples of a pair change at the same edge, so they always belong
//! together, whatever the rate of CK.

use super::codes::tap_width;
use super::{DifferenceHistory, RamHistory};
use crate::prelude::*;

/// Position history as a shift register.
///
/// A position that is present in the tick of CK is at the outputs in the next tick.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PositionHistory {
    /// Number of samples kept.
    pub stages: usize,
    /// Width of a position.
    pub position: usize,
}

signals! { for (PositionHistory, RamHistory, DifferenceHistory) as c;
    /// Input ports; also those of the [RAM form](super::ram_history) and of the
    /// [differences](super::difference_history).
    pub struct In {
        /// CK: a sample is taken.
        pub ck: Bit,
        /// Discards the samples taken so far.
        pub restart: Bit,
        /// Position, in counts.
        pub position: I(c.position),
        /// Age of the earlier sample of the pair in CKs, 1 to K; 0 for none.
        pub tap: U(tap_width(c.stages)),
        /// N, which is passed on with the pair.
        pub ratio: U(4),
    }
    /// Pair of samples at the outputs; also of the [RAM form](super::ram_history).
    pub struct Pair {
        /// Dx: present sample.
        pub present: I(c.position) as Analog,
        /// Dx(−Δt/N): sample `tap` CKs older.
        pub old: I(c.position) as Analog,
        /// N of the pair.
        pub pair_ratio: U(4),
        /// `old` was sampled since the last restart, or `tap` was 0.
        pub enough: Bit,
        /// The pair is new in this tick.
        pub fresh: Bit,
        /// Samples since the last restart, up to K.
        pub samples: U(tap_width(c.stages)),
    }
    /// Nets; also those of the [RAM form](super::ram_history).
    pub struct Net {
        /// Stage of the earlier sample, before this tick's shift.
        pub(super) index: U(tap_width(c.stages)),
        /// `old` takes a new value: a sample is taken, and the history has the stage `index`.
        pub(super) load: Bit,
        /// The history holds a sample for this tap.
        covered: Bit,
    }
}

signals! { for PositionHistory as c;
    /// Flip-flops.
    pub struct Reg {
        /// Pair at the outputs.
        pub pair: Pair(c),
        /// 11: stage k holds the sample k CKs older than the present one.
        stages: Shift(c.stages, c.position),
    }
}

/// The nets of either form.
pub(super) fn nets(stages: usize, pair: &Pair, i: &In) -> Net {
    let index = i.tap - 1;
    Net {
        index,
        load: i.ck & index.below(stages as u64),
        covered: !pair.samples.below(i.tap),
    }
}

/// Returns the outputs of either form after the edge; `old` comes from its memory.
pub(super) fn pair_after(stages: usize, pair: &Pair, w: &Net, i: &In, old: I) -> Pair<Edge> {
    let full = pair.samples.equals(stages as u64);
    let counted = (i.ck & !full).mux(pair.samples + 1, pair.samples);
    Pair {
        present: i.ck.mux(i.position, pair.present),
        old,
        pair_ratio: i.ck.mux(i.ratio, pair.pair_ratio),
        enough: i.ck.mux(w.covered, pair.enough) & !i.restart,
        fresh: i.ck & !i.restart,
        samples: i.restart.mux(0, counted),
    }
}

/// Returns why this number of stages is not allowed.
pub(super) fn objection(stages: usize) -> Option<String> {
    (stages == 0).then(|| "a history of no samples".into())
}

/// High if at CK `sample` enters stage 0 and every other stage takes the word before it, and if no
/// stage changes between CKs.
pub(super) fn moved_on(ck: Bit, sample: U, before: &Words, after: &Words) -> Bit {
    let newer = std::iter::once(sample).chain(before.iter());
    let stages = newer.zip(before.iter()).zip(after.iter());
    Bit::all(stages.map(|((newer, old), next)| next.equals(ck.mux(newer, old))))
}

/// High if a history of this length keeps the sample of `tap` CKs ago.
pub(super) fn is_kept(stages: usize, tap: U) -> Bit {
    !tap.is_zero() & !U::new(stages as u64, tap.width()).below(tap)
}

/// The ratio is only passed on: in a proof it may depend on the position.
pub(super) fn ratio_follows(i: &In<Value>) -> bool {
    i.ratio == i.position.rem_euclid(2) as u64 * 15
}

impl Circuit for PositionHistory {
    const NAME: &'static str = "position_history";
    const ABOUT: &'static str = "shift register of position samples, with a tap selector";
    records!(In, Reg, Net);

    fn objection(&self) -> Option<String> {
        objection(self.stages)
    }

    fn tick(&self, i: In, q: Reg, _: Nothing) -> (Net, Reg<Edge>) {
        let net = nets(self.stages, &q.pair, &i);
        let old = net.load.mux(q.stages.tap(net.index).signed(), q.pair.old);
        let edge = Reg {
            pair: pair_after(self.stages, &q.pair, &net, &i, old),
            stages: q.stages.shift(i.ck, i.position.unsigned()),
        };
        (net, edge)
    }

    fn properties(&self, now: &Moment<Self>) -> Vec<Property> {
        let (i, q, next) = (&now.i, &now.q.pair, &now.next.q.pair);
        let (stages, moved) = (&now.q.stages, &now.next.q.stages);
        let kept = is_kept(self.stages, i.tap);
        let old = kept.mux(stages.read(i.tap - 1).signed(), q.old);
        let is_pair = |present: I, old: I, ratio: U| {
            let samples = next.present.equals(present) & next.old.equals(old);
            samples & next.pair_ratio.equals(ratio)
        };
        let sampled = is_pair(i.position, old, i.ratio);
        let held = is_pair(q.present, q.old, q.pair_ratio);
        let enough = i.ck.mux(!q.samples.below(i.tap), q.enough) & !i.restart;
        let fresh = i.ck & !i.restart;
        let more = i.ck.mux(q.samples + 1, q.samples);
        let counted = q
            .samples
            .below(self.stages as u64)
            .mux(more, self.stages as u64);
        vec![
            Property::step(
                "at CK every sample moves to the next stage, and between CKs no stage changes",
                &["stages"],
                moved_on(i.ck, i.position.unsigned(), stages, moved),
            ),
            Property::step(
                "only CK changes the pair, to the sample and the sample of tap CKs ago",
                &["pair.present", "pair.old"],
                i.ck.mux(sampled, held),
            ),
            Property::step(
                "fresh follows CK, and enough is high if tap does not reach beyond the restart",
                &["pair.fresh", "pair.enough"],
                next.fresh.equals(fresh) & next.enough.equals(enough),
            ),
            Property::step(
                "samples counts the samples since restart, up to K",
                &["pair.samples"],
                next.samples.equals(i.restart.mux(0, counted)),
            ),
        ]
    }
}

impl Specified for PositionHistory {
    fn applies(&self, i: &In<Value>) -> bool {
        ratio_follows(i)
    }
}
