//! Quadrature counter: position from the two channels of an incremental encoder. Feedback counter
//! 13 of JP3608587B2 (¶0003).
//!
//! ```text
//!         ┌────────────────────┐
//!  a ────▶│                    ├──▶ position
//!  b ────▶│ quadrature counter ├──▶ lost
//!  clear ▶│                    ├──▶ illegal
//!         └────────────────────┘
//! ```
//!
//! Each channel goes through two flip-flops, since it is asynchronous, and a third holds its level
//! of the tick before: every edge of either channel counts (x4). A level that is at the pin from
//! tick n on is in `position` from tick n + 3 on.
//!
//! The text says only that the pulses are counted. Synchronisers, x4, the flag and the clear are
//! additions. Nothing is counted until the three flip-flops hold samples, whatever the initial
//! levels of the channels.

use crate::prelude::*;

/// Samples that fill the flip-flops of a channel.
const FILLED: u64 = 3;
/// The flip-flop of a channel that holds its present level.
const PRESENT: usize = 1;
/// The flip-flop that holds the level before.
const PREVIOUS: usize = 2;

/// Quadrature counter with a position that wraps.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct QuadratureCounter {
    /// Width of the position in bits.
    pub width: usize,
}

signals! { for QuadratureCounter as c;
    /// Input ports.
    pub struct In {
        /// Channel A of the encoder, asynchronous.
        pub a: Bit,
        /// Channel B of the encoder, asynchronous. The position counts up when A leads.
        pub b: Bit,
        /// Clears `position` and `lost`.
        pub clear: Bit,
    }
    /// Flip-flops.
    pub struct Reg {
        /// Last three samples of channel A. Bit 0: first synchronizer flip-flop, feeds bit 1 only.
        /// Bit 1: present level. Bit 2: level one tick before.
        sync_a: U(3) as Hex = 0,
        /// Last three samples of channel B, in the same order.
        sync_b: U(3) as Hex = 0,
        /// Samples taken since power-on, up to 3. At 3, `sync_a` and `sync_b` are filled.
        samples: U(2),
        /// Position in counts (quarter periods of the encoder); wraps.
        pub position: I(c.width) as Analog = 0,
        /// Both channels have changed at once since the last `clear`: the position is wrong.
        pub lost: Bit,
    }
    /// Nets.
    pub struct Net {
        /// The synchronizers are filled: `sync_a` and `sync_b` hold samples only.
        valid: Bit,
        /// Channel A has changed.
        changes_a: Bit,
        /// Channel B has changed.
        changes_b: Bit,
        /// Exactly one channel has changed: the position moves by one count.
        moves: Bit,
        /// Direction of the move; high counts up.
        up: Bit,
        /// Both channels have changed: the direction is unknown, and nothing is counted.
        pub illegal: Bit,
    }
}

impl Circuit for QuadratureCounter {
    const NAME: &'static str = "quadrature_counter";
    const ABOUT: &'static str = "position from the two channels of an incremental encoder";
    records!(In, Reg, Net);

    fn tick(&self, i: In, q: Reg, _: Nothing) -> (Net, Reg<Edge>) {
        let changes = |sync: U| sync.bit(PRESENT) ^ sync.bit(PREVIOUS);
        let (changes_a, changes_b) = (changes(q.sync_a), changes(q.sync_b));
        let valid = q.samples.equals(FILLED);
        let moves = valid & (changes_a ^ changes_b);
        let up = q.sync_a.bit(PRESENT) ^ q.sync_b.bit(PREVIOUS);
        let illegal = valid & changes_a & changes_b;
        let sampled = |sync: U, level: Bit| sync.resize(2).join(level.word());
        let moved = up.mux(q.position + 1, q.position - 1);
        let net = Net {
            valid,
            changes_a,
            changes_b,
            moves,
            up,
            illegal,
        };
        let next = Reg {
            sync_a: sampled(q.sync_a, i.a),
            sync_b: sampled(q.sync_b, i.b),
            samples: valid.mux(q.samples, q.samples + 1),
            position: i.clear.mux(0, moves.mux(moved, q.position)),
            lost: (q.lost | illegal) & !i.clear,
        };
        (net, next)
    }

    fn properties(&self, now: &Moment<Self>) -> Vec<Property> {
        let (i, q, w, next) = (&now.i, &now.q, &now.w, &now.next.q);
        let [forth, half, back] = [1, 2, 3].map(|quarters| turned(q).equals(quarters));
        let moved = forth.mux(q.position + 1, back.mux(q.position - 1, q.position));
        let taken = held(next, 0).equals(quarter(i.a, i.b));
        let present = held(next, PRESENT).equals(held(q, 0));
        let previous = held(next, PREVIOUS).equals(held(q, PRESENT));
        let filled = q.samples.equals(FILLED);
        let samples = filled.mux(q.samples, q.samples + 1);
        vec![
            Property::step(
                "only a quarter period changes the position, by one, and clear sets it to 0",
                &["position", "sync_a", "sync_b"],
                next.position.equals(i.clear.mux(0, moved)),
            ),
            Property::always(
                "illegal is high if and only if the encoder moves by half a period in one tick",
                &["illegal"],
                w.illegal.equals(half),
            ),
            Property::step(
                "an illegal step sets lost, which stays high until clear",
                &["lost"],
                next.lost.equals((q.lost | half) & !i.clear),
            ),
            Property::step(
                "a level advances one flip-flop per tick, and samples counts the first three",
                &["sync_a", "sync_b", "samples"],
                taken & present & previous & next.samples.equals(samples),
            ),
        ]
    }
}

/// Returns the quarter of the encoder's period, 0 to 3 in the direction up: A alone is the first
/// one, both channels the second, B alone the third.
fn quarter(a: Bit, b: Bit) -> U {
    b.word().join((a ^ b).word())
}

/// Returns the quarter that a flip-flop of each channel holds.
fn held(q: &Reg<Open>, place: usize) -> U {
    quarter(q.sync_a.bit(place), q.sync_b.bit(place))
}

/// Returns the quarters turned between the previous and the present levels, 0 to 3; none before
/// they are real.
fn turned(q: &Reg<Open>) -> U {
    let way = held(q, PRESENT) - held(q, PREVIOUS);
    q.samples.equals(FILLED).mux(way, 0)
}

impl Specified for QuadratureCounter {}

#[cfg(test)]
mod tests;
