//! Command join: the position command of an X-Y machine, of which the lines come from one circuit
//! and the arcs from another.
//!
//! ```text
//!                    ┌──────────────┐
//!  line_x, line_y ──▶│              ├──▶ counts_x, counts_y
//!  arc_x, arc_y ────▶│ command_join ├──▶ x, y
//!  take ────────────▶│              │
//!                    └──────────────┘
//! ```
//!
//! Each of the two counts only its own way and rests while the other moves, so the sum is the whole
//! path. It is taken once in a sampling time: whoever computes with it in between sees it rest.

use crate::check::{Invariants, Specified, require};
use crate::kernel::Circuit;
use crate::logic::{Bit, Logic, Signed};
use crate::signals;

signals! {
    /// Ports in.
    pub struct In<L, const W: usize, const V: usize> {
        /// The sum is taken.
        pub take: L::Bit,
        /// Way on lines, X, in counts.
        pub line_x: L::I<W>,
        /// Way on lines, Y.
        pub line_y: L::I<W>,
        /// Way on arcs, X, in counts.
        pub arc_x: L::I<V>,
        /// Way on arcs, Y.
        pub arc_y: L::I<V>,
    }
}

signals! {
    /// Flip-flops.
    pub struct Reg<L, const P: usize> {
        /// Position command of X in 2^-`G` counts.
        pub x: L::I<P> as Analog = 0,
        /// Position command of Y.
        pub y: L::I<P> as Analog = 0,
    }
}

signals! {
    /// Nets.
    pub struct Net<L, const W: usize> {
        /// Position command of X in counts.
        pub counts_x: L::I<W> as Analog,
        /// Position command of Y.
        pub counts_y: L::I<W> as Analog,
    }
}

/// Join of ways of `W` and `V` bits to commands of `P` bits, `G` of them behind the count. A
/// command shows one tick after `take`.
#[derive(Debug, Clone, Default)]
pub struct CommandJoin<const W: usize, const V: usize, const P: usize, const G: usize>;

impl<const W: usize, const V: usize, const P: usize, const G: usize> Circuit
    for CommandJoin<W, V, P, G>
{
    const NAME: &'static str = "command_join";
    const ABOUT: &'static str = "one position command from that of the lines and that of the arcs";
    type In<L: Logic> = In<L, W, V>;
    type Reg<L: Logic> = Reg<L, P>;
    type Net<L: Logic> = Net<L, W>;

    #[inline(always)]
    fn comb<L: Logic>(&self, _: &Reg<L, P>, i: &In<L, W, V>) -> Net<L, W> {
        const { assert!(W >= V && P > G, "the sum is as wide as the lines' way") };
        Net {
            counts_x: i.line_x + i.arc_x.resize(),
            counts_y: i.line_y + i.arc_y.resize(),
        }
    }

    #[inline(always)]
    fn next<L: Logic>(&self, q: Reg<L, P>, w: &Net<L, W>, i: &In<L, W, V>) -> Reg<L, P> {
        Reg {
            x: i.take.mux(w.counts_x.resize().shift_left(G), q.x),
            y: i.take.mux(w.counts_y.resize().shift_left(G), q.y),
        }
    }
}

impl<const W: usize, const V: usize, const P: usize, const G: usize> Specified
    for CommandJoin<W, V, P, G>
{
    fn invariants(&self) -> Invariants<'_, Self> {
        let wrap = |value: i64| value << (64 - P) >> (64 - P);
        Invariants::<Self>::new().step(
            "a command is the sum of both ways in fractions of a count, and stays until the next",
            move |now, next| {
                let i = now.i;
                let sum = |line: i64, arc: i64| {
                    let counts = (line + arc) << (64 - W) >> (64 - W);
                    wrap(counts * (1 << G))
                };
                let due = match i.take.get() {
                    true => [
                        sum(i.line_x.get(), i.arc_x.get()),
                        sum(i.line_y.get(), i.arc_y.get()),
                    ],
                    false => [now.q.x.get(), now.q.y.get()],
                };
                let right = [next.x.get(), next.y.get()] == due;
                require(right, ["x", "y", "take"], || format!("not {due:?}"))
            },
        )
    }
}
