//! Gaps in which a dump is switched off: values are unknown then.

/// Time span in which a dump is switched off.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Gap {
    pub from: u64,
    /// Time at which it is switched on again; `None` if it stays off.
    pub to: Option<u64>,
}

impl Gap {
    /// Records in an ordered list of gaps that the dump is switched on or off; repeated switching
    /// has no effect.
    pub fn switch(gaps: &mut Vec<Self>, time: u64, on: bool) {
        match (gaps.last_mut(), on) {
            (Some(gap @ Gap { to: None, .. }), true) => gap.to = Some(time),
            (Some(Gap { to: None, .. }), false) | (_, true) => {}
            _ => gaps.push(Gap {
                from: time,
                to: None,
            }),
        }
    }

    pub fn contains(self, time: u64) -> bool {
        self.from <= time && self.to.is_none_or(|to| time < to)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_off_or_on_already_stays_so() {
        let mut gaps = Vec::new();
        for (time, on) in [
            (0, true),
            (3, false),
            (5, false),
            (8, true),
            (9, true),
            (12, false),
        ] {
            Gap::switch(&mut gaps, time, on);
        }
        let gap = |from, to| Gap { from, to };
        assert_eq!(gaps, [gap(3, Some(8)), gap(12, None)]);
        let off: Vec<u64> = (0..14)
            .filter(|&at| gaps.iter().any(|gap| gap.contains(at)))
            .collect();
        assert_eq!(off, [3, 4, 5, 6, 7, 12, 13]);
    }
}
