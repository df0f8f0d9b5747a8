//! Position history with subtractor 15 between memory 11 and take-out 14.
//!
//! ```text
//!                          ┌────────────────────┐
//!  ck, position, restart ─▶│                    ├──▶ present, difference, pair_ratio
//!  tap, ratio ────────────▶│ difference history ├──▶ fresh, enough
//!                          └────────────────────┘
//! ```
//!
//! The text allows this (引算器15は記憶回路11と取り出し回路14との間に設けてもよい). Every stage then has a subtractor, and
//! the tap selects a difference instead of a sample. Selection and timing are those of the [shift
//! register](super::position_history).

use super::codes::tap_width;
use super::position_history::{
    In, Net as Taking, Pair, is_kept, moved_on, nets, objection, pair_after, ratio_follows,
};
use crate::prelude::*;

/// Position history whose tap takes a difference.
///
/// A position that is present in the tick of CK is at the outputs in the next tick.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct DifferenceHistory {
    /// Number of samples kept.
    pub stages: usize,
    /// Width of a position.
    pub position: usize,
}

signals! { for DifferenceHistory as c;
    /// Sample and difference at the outputs.
    pub struct DifferencePair {
        /// Dx: present sample.
        pub present: I(c.position) as Analog,
        /// 15: Δx, the distance since the sample `tap` CKs earlier.
        pub difference: I(c.position) as Analog,
        /// N of the pair.
        pub pair_ratio: U(4),
        /// The earlier sample was taken since the last restart, or `tap` was 0.
        pub enough: Bit,
        /// The pair is new in this tick.
        pub fresh: Bit,
        /// Samples since the last restart, up to K.
        pub samples: U(tap_width(c.stages)),
    }
    /// Flip-flops.
    pub struct Reg {
        /// Pair at the outputs.
        pub pair: DifferencePair(c),
        /// 11: stage k holds the sample k CKs older than the present one.
        stages: Shift(c.stages, c.position),
    }
    /// Nets.
    pub struct Net {
        /// Selection of the stage.
        taking: Taking(c) as Flat,
        /// 15: distance since the sample of this stage.
        ways: [I(c.position); c.stages],
    }
}

/// Returns the word at `index`, by a tree of multiplexers; arbitrary if there is no such word.
fn taken(words: &[I], index: U) -> I {
    if let [word] = words {
        return *word;
    }
    let half = words.len().next_power_of_two() / 2;
    let (low, high) = words.split_at(half);
    let bit = index.bit(half.trailing_zeros() as usize);
    bit.mux(taken(high, index), taken(low, index))
}

impl Circuit for DifferenceHistory {
    const NAME: &'static str = "difference_history";
    const ABOUT: &'static str =
        "shift register of position samples, with a subtractor at each stage";
    records!(In, Reg, Net);

    fn objection(&self) -> Option<String> {
        objection(self.stages)
    }

    fn tick(&self, i: In, q: Reg, _: Nothing) -> (Net, Reg<Edge>) {
        let stage = |stage| i.position - q.stages.stage(stage).signed();
        let ways: Vec<I> = (0..self.stages).map(stage).collect();
        let before = Pair {
            present: q.pair.present,
            old: q.pair.difference,
            pair_ratio: q.pair.pair_ratio,
            enough: q.pair.enough,
            fresh: q.pair.fresh,
            samples: q.pair.samples,
        };
        let taking = nets(self.stages, &before, &i);
        let way = taking.load.mux(taken(&ways, taking.index), before.old);
        let after = pair_after(self.stages, &before, &taking, &i, way);
        let edge = Reg {
            pair: DifferencePair {
                present: after.present,
                difference: after.old,
                pair_ratio: after.pair_ratio,
                enough: after.enough,
                fresh: after.fresh,
                samples: after.samples,
            },
            stages: q.stages.shift(i.ck, i.position.unsigned()),
        };
        (Net { taking, ways }, edge)
    }

    fn properties(&self, now: &Moment<Self>) -> Vec<Property> {
        let (i, q, next) = (&now.i, &now.q, &now.next.q);
        let sample = i.position.unsigned();
        let taken = i.ck & is_kept(self.stages, i.tap);
        // One case for each tap.
        let cases = q.stages.iter().enumerate().map(|(stage, old)| {
            let difference = next.pair.difference.equals(i.position - old.signed());
            (taken & i.tap.equals(stage as u64 + 1)).implies(difference)
        });
        let stays = next.pair.difference.equals(q.pair.difference);
        vec![
            Property::step(
                "at CK every sample moves to the next stage, and between CKs no stage changes",
                &["stages"],
                moved_on(i.ck, sample, &q.stages, &next.stages),
            ),
            Property::step(
                "only CK changes difference, to the distance from the sample of tap CKs ago",
                &["pair.difference"],
                Bit::all(cases) & (taken | stays),
            ),
        ]
    }
}

impl Specified for DifferenceHistory {
    fn applies(&self, i: &In<Value>) -> bool {
        ratio_follows(i)
    }
}
