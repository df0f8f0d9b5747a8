//! Error 27, position register 30 and overrun 31: what a positioning tells of its lead time.
//!
//! ```text
//!                       ┌────────────┐
//!  fire ───────────────▶│            ├──▶ overrun
//!  position, target ───▶│ stop error ├──▶ error
//!                       └────────────┘
//! ```
//!
//! `overrun` (d1) is the way since the control signal, `error` (d2) the way past the target; both
//! are positive upwards. They are meant when the positioning is complete.
//!
//! Departure: the text's error is Sx − Dx. With it learning goes the wrong way: the relative error
//! r of a time becomes r² where it should become (1 − r)². That is the variant [`Sign::Literal`].

use crate::check::{Invariants, Specified, require};
use crate::kernel::Circuit;
use crate::logic::{Bit, Logic};
use crate::signals;
use serde::{Deserialize, Serialize};

/// Which way the error counts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Sign {
    /// Dx − Sx: learning converges.
    #[default]
    Converging,
    /// Sx − Dx, as the text has it: learning diverges.
    Literal,
}

signals! {
    /// Ports in.
    pub struct In<L, const W: usize> {
        /// The control signal begins.
        pub fire: L::Bit,
        /// Dx.
        pub position: L::I<W>,
        /// Sx.
        pub target: L::I<W>,
    }
}

signals! {
    /// Flip-flops.
    pub struct Reg<L, const W: usize> {
        /// 30: where the body was when the control signal began.
        trigger_position: L::I<W> as Analog,
    }
}

signals! {
    /// Nets.
    pub struct Net<L, const W: usize> {
        /// 31: d1, the way since the control signal.
        pub overrun: L::I<W>,
        /// 27: d2, the way past the target.
        pub error: L::I<W>,
    }
}

/// Error and overrun of positions of `W` bits; `overrun` counts from the tick after `fire` on.
#[derive(Debug, Clone, Default)]
pub struct StopError<const W: usize> {
    /// Which way the error counts.
    pub sign: Sign,
}

impl<const W: usize> Circuit for StopError<W> {
    const NAME: &'static str = "stop_error";
    const ABOUT: &'static str = "overrun since the control signal, and way past the target";
    type In<L: Logic> = In<L, W>;
    type Reg<L: Logic> = Reg<L, W>;
    type Net<L: Logic> = Net<L, W>;

    fn comb<L: Logic>(&self, q: &Reg<L, W>, i: &In<L, W>) -> Net<L, W> {
        Net {
            overrun: i.position - q.trigger_position,
            error: match self.sign {
                Sign::Converging => i.position - i.target,
                Sign::Literal => i.target - i.position,
            },
        }
    }

    fn next<L: Logic>(&self, q: Reg<L, W>, _: &Net<L, W>, i: &In<L, W>) -> Reg<L, W> {
        Reg {
            trigger_position: i.fire.mux(i.position, q.trigger_position),
        }
    }
}

impl<const W: usize> Specified for StopError<W> {
    fn invariants(&self) -> Invariants<'_, Self> {
        let range = 1i64 << W;
        let sign = match self.sign {
            Sign::Converging => 1,
            Sign::Literal => -1,
        };
        Invariants::<Self>::new()
            .step(
                "the register keeps where the control signal began",
                |now, next| {
                    let expected = match now.i.fire.get() {
                        true => now.i.position,
                        false => now.q.trigger_position,
                    };
                    let right = next.trigger_position == expected;
                    require(right, ["trigger_position"], || "another".into())
                },
            )
            .always("overrun and error are the ways since", move |now| {
                let position = now.i.position.get();
                let ways = [
                    position - now.q.trigger_position.get() - now.w.overrun.get(),
                    position - now.i.target.get() - sign * now.w.error.get(),
                ];
                let right = ways.iter().all(|way| way % range == 0);
                require(right, ["overrun", "error"], || format!("{ways:?} off"))
            })
    }
}
