//! Logic circuit 13: from the time Δt to the ratio N and the tap Δt/N.
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
//! Departures: a time between two codes gives the nearest code of its range and `on_grid` low, for
//! whoever has to refuse it or to round to it. A time of 0 is on the grid, with a ratio of 0: no
//! lead.

use crate::check::{Invariants, Specified, require};
use crate::kernel::{Circuit, Nothing};
use crate::logic::{Bit, Logic, Unsigned};
use crate::signals;

signals! {
    /// Ports in.
    pub struct In<L, const C: usize> {
        /// Δt in CKs.
        pub lead_time: L::U<C>,
    }
}

signals! {
    /// Nets.
    pub struct Net<L, const T: usize, const C: usize> {
        /// The time, with room for what is added.
        wide: L::U<14>,
        /// The time is beyond the codes of ratio 1.
        two: L::Bit,
        /// The time is beyond the codes of ratio 2.
        five: L::Bit,
        /// The time is beyond the codes of ratio 5.
        ten: L::Bit,
        /// The time and half of its ratio.
        rounded: L::U<14>,
        /// The same, or half of it where the ratio is even.
        halved: L::U<14>,
        /// `halved` times 2^17/5.
        product: L::U<29>,
        /// A fifth of `halved`.
        fifth: L::U<14>,
        /// The time divided by its ratio, to the nearest.
        quotient: L::U<14>,
        /// N: 1, 2, 5 or 10; 0 for no lead.
        pub ratio: L::U<4>,
        /// Δt/N: CKs that the earlier sample is old; 0 for no lead.
        pub tap: L::U<T>,
        /// N·tap: the nearest code of the range that the time is in.
        pub code: L::U<C>,
        /// The time is a code.
        pub on_grid: L::Bit,
    }
}

/// Logic circuit 13 for `K` stages of history, taps of `T` bits and times of `C` bits.
/// Combinational.
#[derive(Debug, Clone, Default)]
pub struct RatioLogic<const K: usize, const T: usize, const C: usize>;

impl<const K: usize, const T: usize, const C: usize> RatioLogic<K, T, C> {
    /// The first time of each ratio above 1.
    const FIRST: [u64; 3] = {
        assert!(K >= 1 && K < 1 << T, "a tap names each stage");
        assert!(C <= 13 && 10 * K < 1 << C, "a time holds the last code");
        let (k, next) = (K as u64, K as u64 + 1);
        [next + next % 2, (2 * k / 5 + 1) * 5, (5 * k / 10 + 1) * 10]
    };
    /// The last code, 10·K.
    pub const LAST: u64 = 10 * K as u64;
    /// 2^17 / 5, rounded up: below 43,690 the product's integer part is a fifth, exactly.
    const FIFTH: u64 = (1 << 17) / 5 + 1;
}

impl<const K: usize, const T: usize, const C: usize> Circuit for RatioLogic<K, T, C> {
    const NAME: &'static str = "ratio_logic";
    const ABOUT: &'static str = "from the lead time to the ratio N and the tap of the history";
    type In<L: Logic> = In<L, C>;
    type Reg<L: Logic> = Nothing<L>;
    type Net<L: Logic> = Net<L, T, C>;

    fn comb<L: Logic>(&self, _: &Nothing<L>, i: &In<L, C>) -> Net<L, T, C> {
        let time: L::U<14> = i.lead_time.resize();
        let from = |first: u64| !time.below(first.into());
        let [two, five, ten] = Self::FIRST.map(from);
        let half = ten.mux(5.into(), five.mux(2.into(), two.word().resize()));
        let rounded = time + half;
        let even = ten | (two & !five);
        let halved = even.mux(rounded.shift_right(1), rounded);
        let product = halved.times::<15, 29>(Self::FIFTH.into());
        let fifth = product.shift_right(17).resize();
        let quotient = five.mux(fifth, halved);
        let last: L::U<14> = (K as u64).into();
        let tap: L::U<T> = last.below(quotient).mux(last, quotient).resize();
        let present: L::U<4> = (!time.is_zero()).word().resize();
        let ratio = ten.mux(10.into(), five.mux(5.into(), two.mux(2.into(), present)));
        let code: L::U<C> = tap.times::<4, C>(ratio);
        Net {
            wide: time,
            product,
            two,
            five,
            ten,
            rounded,
            halved,
            fifth,
            quotient,
            ratio,
            tap,
            code,
            on_grid: code.equals(i.lead_time),
        }
    }

    fn next<L: Logic>(&self, _: Nothing<L>, _: &Net<L, T, C>, _: &In<L, C>) -> Nothing<L> {
        Nothing::new()
    }
}

impl<const K: usize, const T: usize, const C: usize> Specified for RatioLogic<K, T, C> {
    fn invariants(&self) -> Invariants<'_, Self> {
        let codes = crate::lead_angle::codes::grid(K as u64);
        let known = codes.clone();
        Invariants::<Self>::new()
            .always(
                "a code gives its ratio and its tap, nothing else is on the grid",
                move |now| {
                    let time = now.i.lead_time.get();
                    let given = (now.w.ratio.get(), now.w.tap.get(), now.w.on_grid.get());
                    let code = known.iter().find(|code| code.time == time);
                    let right = match (time, code) {
                        (0, _) => given == (0, 0, true),
                        (_, Some(code)) => given == (code.ratio, code.tap, true),
                        (_, None) => !given.2,
                    };
                    require(right, ["ratio", "tap", "on_grid"], || {
                        format!("{given:?} for {time}")
                    })
                },
            )
            .always(
                "between codes it is one of the two around, past the last the last",
                move |now| {
                    let (time, code) = (now.i.lead_time.get(), now.w.code.get());
                    let below = codes.iter().rev().find(|code| code.time <= time);
                    let above = codes.iter().find(|code| code.time >= time);
                    let around = [below, above].map(|code| code.map_or(0, |code| code.time));
                    let product = now.w.ratio.get() * now.w.tap.get();
                    let right =
                        around.contains(&code) && code == product && (code > 0) == (time > 0);
                    require(right, ["code"], || format!("{code} for {time}, {around:?}"))
                },
            )
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::check::{Outcome, reach};
    use crate::lead_angle::codes;
    use crate::logic::Sim;

    type Full = RatioLogic<199, 8, 11>;

    fn of(time: u64) -> Net<Sim, 8, 11> {
        Full::default().comb(
            &Nothing::new(),
            &In {
                lead_time: time.into(),
            },
        )
    }

    /// The table of the text, row by row.
    #[test]
    fn all_519_codes_map_as_the_table_says() {
        let rows = [(1, 1, 199), (2, 200, 398), (5, 400, 995), (10, 1000, 1990)];
        let mut count = 0;
        for time in 1..2048u64 {
            let row = rows
                .iter()
                .find(|(ratio, first, last)| (*first..=*last).contains(&time) && time % ratio == 0);
            let w = of(time);
            assert_eq!(w.on_grid.get(), row.is_some(), "{time}");
            if let Some((ratio, ..)) = row {
                assert_eq!(
                    (w.ratio.get(), w.tap.get()),
                    (*ratio, time / ratio),
                    "{time}"
                );
                count += 1;
            }
        }
        assert_eq!(count, 519);
        assert_eq!(codes::grid(199).len(), 519);
        for refused in [399, 401, 996, 999, 1001, 1991, 2000] {
            assert!(!of(refused).on_grid.get(), "{refused}");
        }
    }

    /// Nearest within a range; into the gaps between ranges it goes down.
    #[test]
    fn a_time_between_codes_is_rounded() {
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
            assert_eq!(of(time).code.get(), code, "{time}");
        }
    }

    #[test]
    fn it_is_proved_for_every_time_of_eleven_bits() {
        let circuit = Full::default();
        let all = circuit.invariants();
        let outcome = reach(&circuit, &all).run().expect("narrow enough");
        assert!(matches!(outcome, Outcome::Proof(_)), "{outcome}");
    }
}
