//! Circuits of the catalogue with all their widths changed at once.

use motion_rtl::registry::{AnyModel, Base, Entry, Pair};

/// Stages of a history where positions have `bits` bits.
fn stages_at(bits: u64) -> u64 {
    match bits {
        0..=2 => 2,
        3 | 4 => 3,
        _ => 15,
    }
}

/// Widths of addresses, with which memories would grow.
const ADDRESSES: &[&str] = &["address", "record", "segment", "step", "word"];

/// The width that most words have, the largest of equally many.
fn usual(widths: &[(String, u64)]) -> u64 {
    let count = |of: u64| widths.iter().filter(|(_, width)| *width == of).count();
    let most = widths
        .iter()
        .map(|(_, width)| (count(*width), *width))
        .max();
    most.map_or(1, |(_, width)| width.max(1))
}

/// The small circuit made `bits` wide: every width by the difference, every one in proportion, and
/// every one on the way to the full circuit.
pub fn pairs(entry: &Entry, bits: u64) -> Vec<Vec<Pair>> {
    let widths = |base| {
        let mut widths = entry.widths(base, &[]);
        widths.retain(|(key, _)| !ADDRESSES.contains(&key.rsplit('.').next().unwrap()));
        widths
    };
    let (small, full) = (widths(Base::Small), widths(Base::Full));
    let own = usual(&small);
    let widest = usual(&full).max(own + 1);
    let all = |width: &dyn Fn(usize, u64) -> u64| -> Vec<Pair> {
        let widths = small.iter().enumerate();
        let widths = widths.map(|(at, (key, of))| Pair::new(key.clone(), width(at, *of)));
        let sizes = entry.sizes(Base::Small, &[]).into_iter();
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

/// The circuit made `bits` wide in the first way in which it can be.
#[allow(dead_code, reason = "one test looks at every way")]
pub fn model(entry: &Entry, bits: u64) -> Option<Box<dyn AnyModel>> {
    let mut ways = pairs(entry, bits).into_iter();
    ways.find_map(|pairs| entry.made(Base::Small, &pairs).ok())
}
