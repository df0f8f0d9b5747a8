//! Circuits of the catalogue with all their widths changed at once.

use super::{AnyModel, Base, Entry, Pair};
use crate::check::{Conclusion, ThreadTime};
use std::time::Duration;

/// Returns the stages of a history whose positions have `bits` bits.
fn stages_at(bits: u64) -> u64 {
    match bits {
        0..=2 => 2,
        3 | 4 => 3,
        _ => 15,
    }
}

/// Names of address widths, which would make memories grow.
const ADDRESSES: &[&str] = &["address", "record", "segment", "step", "word"];

/// Returns the width that most words have, the largest of equally many.
fn usual(widths: &[(String, u64)]) -> u64 {
    let count = |of: u64| widths.iter().filter(|(_, width)| *width == of).count();
    let most = widths
        .iter()
        .map(|(_, width)| (count(*width), *width))
        .max();
    most.map_or(1, |(_, width)| width.max(1))
}

/// Results for a property at narrower widths than those of a circuit.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Narrower {
    /// Greatest widths at which it is proved.
    pub proved: Option<Vec<(String, u64)>>,
    /// Least widths at which it is refuted.
    pub refuted: Option<Vec<(String, u64)>>,
}

impl Entry {
    /// Returns the greatest width of the full circuit, some keys changed, in bits.
    pub fn greatest_width(&self, pairs: &[Pair]) -> u64 {
        let widths = self.widths(Base::Full, pairs).into_iter();
        widths.map(|(_, bits)| bits).max().unwrap_or(1).max(1)
    }

    /// Returns all widths of the full circuit, some keys changed, in proportion: the greatest has
    /// `greatest` bits.
    pub fn widths_at(&self, pairs: &[Pair], greatest: u64) -> Vec<(String, u64)> {
        let most = self.greatest_width(pairs);
        let widths = self.widths(Base::Full, pairs).into_iter();
        widths
            .map(|(key, bits)| (key, (bits * greatest).div_ceil(most)))
            .collect()
    }

    /// Proves properties of the full circuit, some keys changed, or of parts of it, at narrower
    /// widths; each is given by the path of the part and its name. All widths grow together from
    /// one bit up, until each property is refuted or no longer proved.
    ///
    /// `limit` is the processor time for each property at each width. No width is begun after
    /// twice this time for each of `asked`.
    pub fn narrower(
        &self,
        pairs: &[Pair],
        asked: &[(Option<&str>, &str)],
        limit: Duration,
    ) -> Vec<Narrower> {
        let most = self.greatest_width(pairs);
        let start = ThreadTime::now();
        let time = limit.saturating_mul(2 * asked.len() as u32);
        let mut found = vec![Narrower::default(); asked.len()];
        let mut open: Vec<usize> = (0..asked.len()).collect();
        for greatest in 1..most {
            if open.is_empty() || start.elapsed() > time {
                break;
            }
            let widths = self.widths_at(pairs, greatest);
            let narrow = widths
                .iter()
                .map(|(key, bits)| Pair::new(key.clone(), *bits));
            let pairs: Vec<_> = pairs.iter().cloned().chain(narrow).collect();
            let Ok(circuit) = self.made(Base::Full, &pairs) else {
                continue;
            };
            let Ok(concluded) = circuit.induct(limit) else {
                continue;
            };
            open.retain(|&index| {
                let (part, property) = asked[index];
                let mut concluded = concluded
                    .iter()
                    .filter(|it| it.property == property && it.part.as_deref() == part);
                let found = &mut found[index];
                match concluded.next().map(|it| &it.conclusion) {
                    Some(Conclusion::Proof { .. }) => {
                        found.proved = Some(widths.clone());
                        true
                    }
                    Some(Conclusion::Refuted(_)) => {
                        found.refuted = Some(widths.clone());
                        false
                    }
                    _ => found.proved.is_none(),
                }
            });
        }
        found
    }

    /// Returns three ways to make the small circuit about `bits` wide: all widths changed by the same
    /// difference, in proportion, or by interpolation between the small and the full circuit.
    pub fn scaled_pairs(&self, bits: u64) -> Vec<Vec<Pair>> {
        let bits = bits.min(64);
        let widths = |base| {
            let mut widths = self.widths(base, &[]);
            widths.retain(|(key, _)| {
                !ADDRESSES.contains(&key.rsplit('.').next().unwrap_or_default())
            });
            widths
        };
        let (small, full) = (widths(Base::Small), widths(Base::Full));
        let own = usual(&small);
        let widest = usual(&full).max(own + 1);
        let all = |width: &dyn Fn(usize, u64) -> u64| -> Vec<Pair> {
            let widths = small.iter().enumerate();
            let widths = widths.map(|(at, (key, of))| Pair::new(key.clone(), width(at, *of)));
            let sizes = self.sizes(Base::Small, &[]).into_iter();
            let stages = sizes.filter(|(key, _)| key.ends_with("stages"));
            let stages = stages.map(|(key, of)| {
                let times = if of == 30 { 10 } else { 1 };
                Pair::new(key, times * stages_at(bits))
            });
            widths.chain(stages).collect()
        };
        let between = |at: usize, of: u64| {
            let to = full.get(at).map_or(of, |(_, width)| *width);
            let (of, to, way) = (of as i64, to as i64, bits as i64 - own as i64);
            (of + (to - of) * way / (widest - own) as i64).max(0) as u64
        };
        vec![
            all(&|_, of| (of + bits).saturating_sub(own)),
            all(&|_, of| (of * bits).div_ceil(own)),
            all(&between),
        ]
    }

    /// Returns the small circuit made `bits` wide, in the first of these ways that gives a circuit.
    pub fn scaled(&self, bits: u64) -> Option<Box<dyn AnyModel>> {
        let mut ways = self.scaled_pairs(bits).into_iter();
        ways.find_map(|pairs| self.made(Base::Small, &pairs).ok())
    }
}
