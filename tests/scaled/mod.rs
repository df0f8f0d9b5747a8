//! Circuits of the catalogue with all their widths changed at once.

use motion_rtl::registry::{AnyModel, Base, Entry, Pair};

/// Stages of a history where positions have `bits` bits.
fn stages(bits: u64) -> u64 {
    match bits {
        0..=2 => 2,
        3 | 4 => 3,
        _ => 15,
    }
}

/// The small circuit made `bits` wide: every width by the difference, every one in proportion, and
/// every one on the way to the full circuit.
pub fn pairs(entry: &Entry, bits: u64) -> Vec<Vec<Pair>> {
    let small = entry.widths(Base::Small, &[]);
    let own = small.iter().map(|(_, width)| *width).min().unwrap_or(1);
    let full = entry.widths(Base::Full, &[]);
    let full_of = |key: &str| {
        full.iter()
            .find(|(other, _)| other == key)
            .map_or(own, |(_, w)| *w)
    };
    let widest = full
        .iter()
        .map(|(_, width)| *width)
        .min()
        .unwrap_or(1)
        .max(own + 1);
    let all = |width: &dyn Fn(&str, u64) -> u64| -> Vec<Pair> {
        let widths = small
            .iter()
            .map(|(key, of)| Pair::new(key.clone(), width(key, *of)));
        let sizes = entry.sizes(Base::Small, &[]).into_iter();
        let stages = sizes
            .filter(|(key, _)| key.ends_with("stages"))
            .map(|(key, of)| {
                let times = if of == 30 { 10 } else { 1 };
                Pair::new(key, times * stages(bits))
            });
        widths.chain(stages).collect()
    };
    let between = |key: &str, of: u64| {
        let (of, to, at) = (of as i64, full_of(key) as i64, bits as i64 - own as i64);
        (of + (to - of) * at / (widest - own) as i64).max(0) as u64
    };
    vec![
        all(&|_, of| (of + bits).saturating_sub(own)),
        all(&|_, of| (of * bits).div_ceil(own.max(1))),
        all(&between),
    ]
}

/// The circuit made `bits` wide in the first way in which it can be.
#[allow(dead_code, reason = "one test looks at every way")]
pub fn model(entry: &Entry, bits: u64) -> Option<Box<dyn AnyModel>> {
    let mut ways = pairs(entry, bits).into_iter();
    ways.find_map(|pairs| entry.made(Base::Small, &pairs).ok())
}
