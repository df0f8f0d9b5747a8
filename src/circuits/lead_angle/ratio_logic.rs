//! Logic circuit 13: computes the ratio N and the tap Δt/N from the time Δt.
//!
//! ```text
//!               ┌─────────────┐
//!  lead_time ──▶│             ├──▶ ratio, tap
//!               │ ratio logic ├──▶ code, on_grid
//!               └─────────────┘
//! ```
//!
//! A time is counted in CKs. With K stages of history a ratio N reaches times up to N·K in steps of
//! N, and the smallest N is taken: with K = 199 these are 1–199, 200–398 by 2, 400–995 by 5 and
//! 1000–1990 by 10, the 519 codes of the text's table.
//!
//! Departures: a time between two codes gives the nearest code of its range, with `on_grid` low. So
//! the user can refuse the time or use the rounded one. A time of 0 is on the grid, with a ratio of
//! 0: no lead.

use super::codes;
use crate::prelude::*;

/// 2^17 / 5, rounded up: below 43,690 the product's integer part is a fifth, exactly.
const FIFTH: u64 = (1 << 17) / 5 + 1;

/// Logic circuit 13. Combinational.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RatioLogic {
    /// Stages of history.
    pub stages: usize,
}

impl RatioLogic {
    /// The first time of each ratio above 1.
    fn first(&self) -> [u64; 3] {
        let stages = self.stages as u64;
        let two = stages + 1 + (stages + 1) % 2;
        [two, (2 * stages / 5 + 1) * 5, (5 * stages / 10 + 1) * 10]
    }

    fn tap(&self) -> usize {
        codes::tap_width(self.stages)
    }

    fn time(&self) -> usize {
        codes::time_width(self.stages)
    }
}

signals! { for RatioLogic as c;
    /// Input ports.
    pub struct In {
        /// Δt in CKs.
        pub lead_time: U(c.time()),
    }
    /// Nets.
    pub struct Net {
        /// Lead time, extended for the sums.
        wide: U(14),
        /// The time is beyond the codes of ratio 1.
        two: Bit,
        /// The time is beyond the codes of ratio 2.
        five: Bit,
        /// The time is beyond the codes of ratio 5.
        ten: Bit,
        /// Time plus half of its ratio.
        rounded: U(14),
        /// `rounded`, or half of `rounded` where the ratio is even.
        halved: U(14),
        /// `halved` times 2^17/5.
        product: U(29),
        /// A fifth of `halved`.
        fifth: U(14),
        /// Time divided by its ratio, rounded to the nearest.
        quotient: U(14),
        /// N: 1, 2, 5 or 10; 0 for no lead.
        pub ratio: U(4),
        /// Δt/N: age of the earlier sample in CKs; 0 for no lead.
        pub tap: U(c.tap()),
        /// N·tap in CKs: nearest code of the range that the time is in.
        pub code: U(c.time()),
        /// The time is a code.
        pub on_grid: Bit,
    }
}

impl Circuit for RatioLogic {
    const NAME: &'static str = "ratio_logic";
    const ABOUT: &'static str = "ratio N and tap of the history from the lead time";
    records!(In, Nothing, Net);

    fn objection(&self) -> Option<String> {
        // A time has at most 13 bits: half a ratio is added to it in 14.
        let few = (1..=819).contains(&self.stages);
        (!few).then(|| format!("{} stages of history, not 1 to 819", self.stages))
    }

    fn tick(&self, i: In, _: Nothing, _: Nothing) -> (Net, Nothing) {
        let time = i.lead_time.resize(14);
        let [two, five, ten] = self.first().map(|first| !time.below(first));
        let half = ten.mux(5, five.mux(2, two.word().resize(14)));
        let rounded = time + half;
        let even = ten | (two & !five);
        let halved = even.mux(rounded.shift_right(1), rounded);
        let product = halved.times(U::new(FIFTH, 15), 29);
        let fifth = product.shift_right(17).resize(14);
        let quotient = five.mux(fifth, halved);
        let last = U::new(self.stages as u64, 14);
        let tap = last.below(quotient).mux(last, quotient).resize(self.tap());
        let present = (!time.is_zero()).word().resize(4);
        let ratio = ten.mux(10, five.mux(5, two.mux(2, present)));
        let code = tap.times(ratio, self.time());
        let net = Net {
            wide: time,
            two,
            five,
            ten,
            rounded,
            halved,
            product,
            fifth,
            quotient,
            ratio,
            tap,
            code,
            on_grid: code.equals(i.lead_time),
        };
        (net, Nothing)
    }

    fn properties(&self, now: &Moment<Self>) -> Vec<Property> {
        let (time, w) = (now.i.lead_time, &now.w);
        let none = time.is_zero();
        let nothing = w.ratio.is_zero() & w.tap.is_zero() & w.on_grid;
        let mut known = !none | nothing;
        let mut around = w.code.is_zero().equals(none);
        let mut on_grid = none;
        for codes in self.codes() {
            let is_code = codes.reach(time) & is_multiple(codes.ratio, time);
            known = known & (!is_code | (codes.divided(w, time) & w.on_grid));
            around = around & codes.around(time, w.code);
            on_grid = on_grid | is_code;
        }
        let last = 10 * self.stages as u64;
        let beyond = !time.below(last);
        let product = w.ratio.times(w.tap, self.tap() + 4).equals_any(w.code);
        vec![
            Property::always(
                "on_grid is high only if lead_time is a code, with the ratio and tap of that code",
                &["ratio", "tap", "on_grid"],
                known & (on_grid | !w.on_grid),
            ),
            Property::always(
                "code is one of the two codes around lead_time, or the last for longer times",
                &["code"],
                around & product & (!beyond | w.code.equals(last)),
            ),
        ]
    }
}

/// Codes of a ratio.
struct Codes {
    ratio: u64,
    /// Last code of the ratio before.
    before: u64,
    /// First code.
    first: u64,
    /// Last code.
    last: u64,
}

impl RatioLogic {
    fn codes(&self) -> [Codes; 4] {
        let stages = self.stages as u64;
        [(1, 0), (2, 1), (5, 2), (10, 5)].map(|(ratio, smaller)| Codes {
            ratio,
            before: smaller * stages,
            first: (smaller * stages / ratio + 1) * ratio,
            last: ratio * stages,
        })
    }
}

impl Codes {
    /// High if a time is none before the first code and none past the last.
    fn reach(&self, time: U) -> Bit {
        !time.below(self.first) & time.below(self.last + 1)
    }

    /// High if the ratio is this one, and the tap the time divided by it.
    fn divided(&self, w: &Net, time: U) -> Bit {
        let ratio = U::new(self.ratio, 4);
        let product = w.tap.times(ratio, w.tap.width() + 4);
        w.ratio.equals(ratio) & product.equals_any(time)
    }

    /// High if `code` is one of the two around a time that these codes reach, or that is between
    /// them and the ratio before.
    fn around(&self, time: U, code: U) -> Bit {
        let apart = code.below(time).mux(time - code, code - time);
        let near = is_multiple(self.ratio, code) & apart.below(self.ratio);
        let between = !time.below(self.before + 1) & time.below(self.first);
        let end = code.equals(self.before) | code.equals(self.first);
        (!self.reach(time) | near) & (!between | end)
    }
}

/// High if a time of 13 bits at most is a multiple of a ratio.
fn is_multiple(ratio: u64, time: U) -> Bit {
    // 16 is 1 modulo 5, so a word is the sum of its hexadecimal digits.
    let digits = |word: U| {
        let digits = [0, 4, 8, 12].map(|low| word.slice(low, 4).resize(16));
        digits[0] + digits[1] + digits[2] + digits[3]
    };
    let rest = digits(digits(time.resize(16)));
    let five = [5, 10, 15].map(|multiple| rest.equals(multiple));
    let five = rest.is_zero() | five[0] | five[1] | five[2];
    match ratio {
        1 => Bit::high(),
        2 => !time.bit(0),
        5 => five,
        _ => five & !time.bit(0),
    }
}

impl Specified for RatioLogic {}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::trace::LastTicks;

    const FULL: RatioLogic = RatioLogic { stages: 199 };

    fn of(simulator: &mut Simulator<RatioLogic>, lead_time: u64) -> Net<Value> {
        simulator
            .step_with(&In { lead_time }, |now| (*now.w).clone())
            .unwrap()
    }

    /// The table of the text, row by row.
    #[test]
    fn all_519_codes_map_as_the_table_says() {
        let rows = [(1, 1, 199), (2, 200, 398), (5, 400, 995), (10, 1000, 1990)];
        let mut simulator = LastTicks::simulator(&FULL).unwrap();
        let mut count = 0;
        for time in 1..2048u64 {
            let row = rows
                .iter()
                .find(|(ratio, first, last)| (*first..=*last).contains(&time) && time % ratio == 0);
            let w = of(&mut simulator, time);
            assert_eq!(w.on_grid, row.is_some(), "{time}");
            if let Some((ratio, ..)) = row {
                assert_eq!((w.ratio, w.tap), (*ratio, time / ratio), "{time}");
                count += 1;
            }
        }
        assert_eq!(count, 519);
        assert_eq!(codes::grid(199).len(), 519);
        for refused in [399, 401, 996, 999, 1001, 1991, 2000] {
            assert!(!of(&mut simulator, refused).on_grid, "{refused}");
        }
    }

    /// Nearest within a range; into the gaps between ranges it goes down.
    #[test]
    fn a_time_between_codes_is_rounded() {
        let mut simulator = LastTicks::simulator(&FULL).unwrap();
        for (time, code) in [
            (0, 0),
            (201, 202),
            (399, 398),
            (401, 400),
            (402, 400),
            (403, 405),
            (999, 995),
            (1004, 1000),
            (1005, 1010),
            (1991, 1990),
            (2047, 1990),
        ] {
            assert_eq!(of(&mut simulator, time).code, code, "{time}");
        }
    }

    #[test]
    fn it_is_proved_for_every_time_of_eleven_bits() {
        let all = FULL.invariants();
        let outcome = reach(&FULL, &all).run().expect("narrow enough");
        assert!(matches!(outcome, Outcome::Proof(_)), "{outcome}");
    }
}
