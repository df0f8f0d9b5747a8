//! Position command of one coordinate: the point in whole counts, at the sampling time.
//!
//! ```text
//!                       ┌──────────────────┐
//!  load, word, data ───▶│                  │
//!  rotating ───────────▶│ position_command ├──▶ command
//!  polynomial, offset ─▶│                  │
//!  present ────────────▶│                  │
//!                       └──────────────────┘
//! ```
//!
//! Equation \[4\] of the text, OPi = OG + GPi. On a blend or a line the origin is 0 and the
//! difference engine gives the point itself.

use crate::check::{Invariants, Specified, require};
use crate::kernel::Circuit;
use crate::logic::{Bit, Logic, Signed, Sim, Unsigned};
use crate::signals;

signals! {
    /// Ports in.
    pub struct In<L, const P: usize, const D: usize> {
        /// `data` is word `word` of a record.
        pub load: L::Bit,
        /// Number of the word.
        pub word: L::U<5>,
        /// Its data.
        pub data: L::U<D> as Hex,
        /// The point is on an arc.
        pub rotating: L::Bit,
        /// The coordinate as the difference engine has it.
        pub polynomial: L::I<P>,
        /// The coordinate of the vector from the centre, as the rotation has it.
        pub offset: L::I<P>,
        /// The point becomes the command.
        pub present: L::Bit,
    }
}

signals! {
    /// Flip-flops.
    pub struct Reg<L, const W: usize, const P: usize> {
        /// G: the centre on an arc, 0 elsewhere.
        origin: L::I<P> = 0,
        /// The coordinate in counts.
        pub command: L::I<W> as Analog = 0,
    }
}

signals! {
    /// Nets.
    pub struct Net<L, const W: usize, const P: usize> {
        /// The coordinate with its guard bits.
        point: L::I<P> as Analog,
        /// The same and half a count.
        raised: L::I<P>,
        /// The coordinate to the nearest count, a half upwards.
        nearest: L::I<W>,
    }
}

/// Position command of `W` bits from points of `P` bits, of which `P` − `W` are guard bits, for
/// records with words of `D` bits.
#[derive(Debug, Clone, Default)]
pub struct PositionCommand<const W: usize, const P: usize, const D: usize> {
    /// 0, 1, 2 for x, y, z: it decides which word of a record is the origin.
    pub coordinate: u64,
}

impl<const W: usize, const P: usize, const D: usize> Circuit for PositionCommand<W, P, D> {
    const NAME: &'static str = "position_command";
    const ABOUT: &'static str = "centre and vector added, rounded to counts, at the sampling time";
    type In<L: Logic> = In<L, P, D>;
    type Reg<L: Logic> = Reg<L, W, P>;
    type Net<L: Logic> = Net<L, W, P>;

    fn comb<L: Logic>(&self, q: &Reg<L, W, P>, i: &In<L, P, D>) -> Net<L, W, P> {
        const {
            assert!(
                P > W && D >= P,
                "there are guard bits, and a record holds them"
            )
        };
        let point = q.origin + i.rotating.mux(i.offset, i.polynomial);
        let raised = point + (1i64 << (P - W - 1));
        Net {
            point,
            raised,
            nearest: raised.shift_right(P - W).resize(),
        }
    }

    fn next<L: Logic>(&self, q: Reg<L, W, P>, w: &Net<L, W, P>, i: &In<L, P, D>) -> Reg<L, W, P> {
        let word = L::parameter("origin_word", 5 + self.coordinate);
        let load = i.load & i.word.equals(word);
        Reg {
            origin: load.mux(i.data.resize().signed(), q.origin),
            command: i.present.mux(w.nearest, q.command),
        }
    }
}

impl<const W: usize, const P: usize, const D: usize> Specified for PositionCommand<W, P, D> {
    fn invariants(&self) -> Invariants<'_, Self> {
        let count = 1i64 << (P - W);
        Invariants::<Self>::new()
            .step(
                "the command is the point to the nearest count",
                move |now, next| {
                    let from = match now.i.rotating.get() {
                        true => now.i.offset,
                        false => now.i.polynomial,
                    };
                    // Half a count off at most, a half upwards, and as far as a command reaches.
                    let over = next.command.get() * count - (now.q.origin.get() + from.get());
                    let over = (over + count / 2).rem_euclid(1 << P) - count / 2;
                    let right = -count / 2 < over && over <= count / 2;
                    require(right || !now.i.present.get(), ["command"], || {
                        format!("{over} guard units above the point")
                    })
                },
            )
            .step(
                "the command changes with present, at no other time",
                |now, next| {
                    let held = next.command == now.q.command;
                    require(held || now.i.present.get(), ["command"], || {
                        "changes".into()
                    })
                },
            )
            .step("its word is the origin, others are not", |now, next| {
                let own = now.i.load.get() && now.i.word.get() == 5 + self.coordinate;
                let expected = match own {
                    true => (now.i.data.get() as i64).into(),
                    false => now.q.origin,
                };
                require(next.origin == expected, ["origin"], || {
                    format!("not {expected:?}")
                })
            })
    }

    /// A word that is not its own does not differ from another such.
    fn applies(&self, i: &In<Sim, P, D>) -> bool {
        let own = i.word.get() == 5 + self.coordinate;
        match i.load.get() {
            true => own || i.word.get() == 0,
            false => i.word.get() == 0 && i.data.get() == 0,
        }
    }
}
