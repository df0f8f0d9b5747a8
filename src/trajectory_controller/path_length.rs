//! Path length: qc, how far along the path the command is, for an interpolation period.
//!
//! ```text
//!             ┌─────────────┐
//!  sample ───▶│             ├──▶ length
//!  present ──▶│ path_length ├──▶ fresh
//!  profile ──▶│             │
//!  restart ──▶│             │
//!             └─────────────┘
//! ```

use crate::check::{Invariants, Specified, require};
use crate::kernel::{Circuit, Nothing};
use crate::logic::{Bit, Logic};
use crate::signals;

signals! {
    /// Ports in.
    pub struct In<L, const P: usize> {
        /// An interpolation period begins.
        pub sample: L::Bit,
        /// The profile has a length for it.
        pub present: L::Bit,
        /// The length.
        pub profile: L::I<P>,
        /// Another path: the length is 0.
        pub restart: L::Bit,
    }
}

signals! {
    /// Flip-flops.
    pub struct Reg<L, const P: usize> {
        /// qc: the length along the path.
        pub length: L::I<P> as Analog = 0,
        /// A period has begun with it.
        pub fresh: L::Bit = 0,
    }
}

/// Register of a length of `P` bits.
#[derive(Debug, Clone, Default)]
pub struct PathLength<const P: usize>;

impl<const P: usize> Circuit for PathLength<P> {
    const NAME: &'static str = "path_length";
    const ABOUT: &'static str = "how far along the path the command is";
    type In<L: Logic> = In<L, P>;
    type Reg<L: Logic> = Reg<L, P>;
    type Net<L: Logic> = Nothing<L>;

    #[inline(always)]
    fn comb<L: Logic>(&self, _: &Reg<L, P>, _: &In<L, P>) -> Nothing<L> {
        Nothing::new()
    }

    #[inline(always)]
    fn next<L: Logic>(&self, q: Reg<L, P>, _: &Nothing<L>, i: &In<L, P>) -> Reg<L, P> {
        let length = i.present.mux(i.profile, q.length);
        Reg {
            length: i.restart.mux(0.into(), length),
            fresh: i.sample,
        }
    }
}

impl<const P: usize> Specified for PathLength<P> {
    fn invariants(&self) -> Invariants<'_, Self> {
        Invariants::<Self>::new().step(
            "the length is that of the profile's last, or 0 on a new path",
            |now, next| {
                let i = now.i;
                let expected = match (i.restart.get(), i.present.get()) {
                    (true, _) => 0.into(),
                    (false, true) => i.profile,
                    (false, false) => now.q.length,
                };
                let right = next.length == expected && next.fresh == i.sample;
                require(right, ["length", "fresh"], || format!("not {expected:?}"))
            },
        )
    }
}
