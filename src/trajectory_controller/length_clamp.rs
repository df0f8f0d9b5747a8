//! Length clamp: a length is held on the path.
//!
//! ```text
//!             ┌──────────────┐
//!  length ───▶│ length_clamp ├──▶ clamped
//!  path_end ─▶│              │
//!             └──────────────┘
//! ```
//!
//! Departure: the text has no answer where the tangential response overshoots the path's end, as it
//! does with K2 < 4·K1. There is no path behind it: the reference point stays on the end. The
//! command's length goes through the same, whatever the profile says.

use crate::check::{Invariants, Specified, require};
use crate::kernel::{Circuit, Nothing};
use crate::logic::{Bit, Logic, Signed};
use crate::signals;

signals! {
    /// Ports in.
    pub struct In<L, const P: usize> {
        /// A length along the path.
        pub length: L::I<P>,
        /// L: where the path ends; not negative.
        pub path_end: L::I<P>,
    }
}

signals! {
    /// Nets.
    pub struct Net<L, const P: usize> {
        /// The length is behind the end.
        beyond: L::Bit,
        /// The length, 0 at least and the end at most.
        pub clamped: L::U<P>,
    }
}

/// Clamp of lengths of `P` bits.
#[derive(Debug, Clone, Default)]
pub struct LengthClamp<const P: usize>;

impl<const P: usize> Circuit for LengthClamp<P> {
    const NAME: &'static str = "length_clamp";
    const ABOUT: &'static str = "holds a length on the path";
    type In<L: Logic> = In<L, P>;
    type Reg<L: Logic> = Nothing<L>;
    type Net<L: Logic> = Net<L, P>;

    fn comb<L: Logic>(&self, _: &Nothing<L>, i: &In<L, P>) -> Net<L, P> {
        let beyond = i.path_end.below(i.length);
        let on = beyond.mux(i.path_end.unsigned(), i.length.unsigned());
        Net {
            beyond,
            clamped: i.length.is_negative().mux(0.into(), on),
        }
    }

    fn next<L: Logic>(&self, q: Nothing<L>, _: &Net<L, P>, _: &In<L, P>) -> Nothing<L> {
        q
    }
}

impl<const P: usize> Specified for LengthClamp<P> {
    fn invariants(&self) -> Invariants<'_, Self> {
        Invariants::<Self>::new().always("it is on the path, and the length where that is", |now| {
            let end = now.i.path_end.get();
            let expected = now.i.length.get().clamp(0, end.max(0)) as u64;
            let right = end < 0 || now.w.clamped.get() == expected;
            require(right, ["clamped"], || format!("not {expected}"))
        })
    }
}
