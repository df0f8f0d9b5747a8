//! Subtractor 15 and multiplier 16: the lead N·(Dx − Dx(−Δt/N)).
//!
//! ```text
//!                 ┌──────┐
//!  present, old ─▶│ lead ├──▶ difference
//!  ratio ────────▶│      ├──▶ lead
//!                 └──────┘
//! ```
//!
//! Words wrap, so the difference is right as long as the way of a tap is below half the range of a
//! position, and so is the prediction, wherever on the ring the lead ends.

use crate::check::{Invariants, Specified, require};
use crate::kernel::{Circuit, Nothing};
use crate::logic::{Logic, Signed, Unsigned};
use crate::signals;

signals! {
    /// Ports in.
    pub struct In<L, const W: usize> {
        /// Dx: the present sample.
        pub present: L::I<W>,
        /// Dx(−Δt/N): the earlier one.
        pub old: L::I<W>,
        /// N, up to 10; 0 for no lead.
        pub ratio: L::U<4>,
    }
}

signals! {
    /// Nets.
    pub struct Net<L, const W: usize> {
        /// N with a sign.
        factor: L::I<5>,
        /// 15: Δx, the way of the last Δt/N.
        pub difference: L::I<W> as Analog,
        /// 16: N·Δx, the way that Δt will take at this speed.
        pub lead: L::I<W> as Analog,
    }
}

/// Subtractor and multiplier for positions of `W` bits. Combinational.
#[derive(Debug, Clone, Default)]
pub struct Lead<const W: usize>;

impl<const W: usize> Circuit for Lead<W> {
    const NAME: &'static str = "lead_arithmetic";
    const ABOUT: &'static str = "the way of the last tap, N times";
    type In<L: Logic> = In<L, W>;
    type Reg<L: Logic> = Nothing<L>;
    type Net<L: Logic> = Net<L, W>;

    fn comb<L: Logic>(&self, _: &Nothing<L>, i: &In<L, W>) -> Net<L, W> {
        let difference = i.present - i.old;
        let factor = i.ratio.resize::<5>().signed();
        Net {
            factor,
            difference,
            lead: difference.times::<5, W>(factor),
        }
    }

    fn next<L: Logic>(&self, _: Nothing<L>, _: &Net<L, W>, _: &In<L, W>) -> Nothing<L> {
        Nothing::new()
    }
}

impl<const W: usize> Specified for Lead<W> {
    fn invariants(&self) -> Invariants<'_, Self> {
        let range = 1i128 << W;
        Invariants::<Self>::new()
            .always("the difference is the short way round", move |now| {
                let way = i128::from(now.i.present.get()) - i128::from(now.i.old.get());
                let difference = i128::from(now.w.difference.get());
                let right = (way - difference) % range == 0;
                require(right, ["difference"], || format!("{difference} for {way}"))
            })
            .always(
                "the lead is N of them, on the ring of positions",
                move |now| {
                    let ways = i128::from(now.i.ratio.get())
                        * (i128::from(now.i.present.get()) - i128::from(now.i.old.get()));
                    let lead = i128::from(now.w.lead.get());
                    require((ways - lead) % range == 0, ["lead"], || {
                        format!("{lead} for {ways}")
                    })
                },
            )
    }
}
