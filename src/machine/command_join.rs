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
    pub struct Reg<L, const W: usize> {
        /// Position command of X in counts.
        pub x: L::I<W> as Analog = 0,
        /// Position command of Y.
        pub y: L::I<W> as Analog = 0,
    }
}

signals! {
    /// Nets.
    pub struct Net<L, const W: usize> {
        /// Both ways together, X, as they stand.
        pub counts_x: L::I<W> as Analog,
        /// Y.
        pub counts_y: L::I<W> as Analog,
    }
}

/// Join of ways of `W` and `V` bits to commands of `W` bits. A command shows one tick after `take`.
#[derive(Debug, Clone, Default)]
pub struct CommandJoin<const W: usize, const V: usize>;

impl<const W: usize, const V: usize> Circuit for CommandJoin<W, V> {
    const NAME: &'static str = "command_join";
    const ABOUT: &'static str = "one position command from that of the lines and that of the arcs";
    type In<L: Logic> = In<L, W, V>;
    type Reg<L: Logic> = Reg<L, W>;
    type Net<L: Logic> = Net<L, W>;

    fn comb<L: Logic>(&self, _: &Reg<L, W>, i: &In<L, W, V>) -> Net<L, W> {
        const { assert!(W >= V, "the sum is as wide as the lines' way") };
        Net {
            counts_x: i.line_x + i.arc_x.resize(),
            counts_y: i.line_y + i.arc_y.resize(),
        }
    }

    fn next<L: Logic>(&self, q: Reg<L, W>, w: &Net<L, W>, i: &In<L, W, V>) -> Reg<L, W> {
        Reg {
            x: i.take.mux(w.counts_x, q.x),
            y: i.take.mux(w.counts_y, q.y),
        }
    }
}

impl<const W: usize, const V: usize> Specified for CommandJoin<W, V> {
    fn invariants(&self) -> Invariants<'_, Self> {
        Invariants::<Self>::new().step(
            "a command is the sum of both ways, and stays until the next",
            move |now, next| {
                let i = now.i;
                let sum = |line: i64, arc: i64| (line + arc) << (64 - W) >> (64 - W);
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
