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
//! of a tick ago: every edge of either channel counts (x4). A level that stands at the pin from
//! tick n on is in `position` from tick n + 3 on.
//!
//! The text says only that the pulses are counted. Synchronisers, x4, the flag and the clear are
//! additions. Nothing is counted until the three flip-flops hold samples, whatever the level at
//! which the channels stand.

use crate::check::{Invariants, Specified, require};
use crate::kernel::Circuit;
use crate::logic::sim::Wire;
use crate::logic::{Bit, Logic, Sim, Unsigned};
use crate::signals;

/// Samples that fill the flip-flops of a channel.
const FILLED: u64 = 3;

signals! {
    /// Ports in.
    pub struct In<L> {
        /// Channel A of the encoder, asynchronous.
        pub a: L::Bit,
        /// Channel B, asynchronous; the position goes up where A leads.
        pub b: L::Bit,
        /// Position to 0, `lost` off.
        pub clear: L::Bit,
    }
}

signals! {
    /// Flip-flops.
    pub struct Reg<L, const W: usize> {
        /// First flip-flop of channel A; read by nothing but the second.
        meta_a: L::Bit,
        /// First flip-flop of channel B; read by nothing but the second.
        meta_b: L::Bit,
        /// Second flip-flop of channel A: its present level.
        present_a: L::Bit,
        /// Second flip-flop of channel B: its present level.
        present_b: L::Bit,
        /// Channel A a tick before its present level.
        previous_a: L::Bit,
        /// Channel B a tick before its present level.
        previous_b: L::Bit,
        /// Samples taken since power-on, up to 3: from then on the levels above are real.
        samples: L::U<2>,
        /// Position in counts, quarters of an encoder period; wraps.
        pub position: L::I<W> as Analog = 0,
        /// Both channels changed at once since `clear`: the position is wrong.
        pub lost: L::Bit,
    }
}

signals! {
    /// Nets.
    pub struct Net<L> {
        /// The levels are real.
        valid: L::Bit,
        /// One channel has changed: the position moves by one.
        moves: L::Bit,
        /// Upwards, if it moves.
        up: L::Bit,
        /// Both channels have changed: the direction is unknown, nothing is counted.
        pub illegal: L::Bit,
    }
}

/// Quadrature counter with a position of `W` bits, which wraps.
#[derive(Debug, Clone, Default)]
pub struct QuadratureCounter<const W: usize>;

impl<const W: usize> Circuit for QuadratureCounter<W> {
    const NAME: &'static str = "quadrature_counter";
    const ABOUT: &'static str = "position from the two channels of an incremental encoder";
    type In<L: Logic> = In<L>;
    type Reg<L: Logic> = Reg<L, W>;
    type Net<L: Logic> = Net<L>;

    #[inline(always)]
    fn comb<L: Logic>(&self, q: &Reg<L, W>, _: &In<L>) -> Net<L> {
        let a = q.present_a ^ q.previous_a;
        let b = q.present_b ^ q.previous_b;
        let valid = q.samples.equals(FILLED.into());
        Net {
            valid,
            moves: valid & (a ^ b),
            up: q.present_a ^ q.previous_b,
            illegal: valid & a & b,
        }
    }

    #[inline(always)]
    fn next<L: Logic>(&self, q: Reg<L, W>, w: &Net<L>, i: &In<L>) -> Reg<L, W> {
        let moved = w.up.mux(q.position + 1, q.position - 1);
        Reg {
            meta_a: i.a,
            meta_b: i.b,
            present_a: q.meta_a,
            present_b: q.meta_b,
            previous_a: q.present_a,
            previous_b: q.present_b,
            samples: w.valid.mux(q.samples, q.samples + 1),
            position: i.clear.mux(0.into(), w.moves.mux(moved, q.position)),
            lost: (q.lost | w.illegal) & !i.clear,
        }
    }

    #[inline(always)]
    fn gated<L: Logic>(&self, q: &Reg<L, W>, _: &Self::Net<L>, i: &In<L>) -> Option<L::Bit> {
        let a = (i.a ^ q.meta_a) | (q.meta_a ^ q.present_a) | (q.present_a ^ q.previous_a);
        let b = (i.b ^ q.meta_b) | (q.meta_b ^ q.present_b) | (q.present_b ^ q.previous_b);
        Some(!(i.clear | a | b) & q.samples.equals(FILLED.into()))
    }
}

/// The quarter of the encoder's period, 0 to 3 in the direction up.
fn quarter(a: Wire, b: Wire) -> u32 {
    match (a.get(), b.get()) {
        (false, false) => 0,
        (true, false) => 1,
        (true, true) => 2,
        (false, true) => 3,
    }
}

/// Quarters turned between the previous and the present levels, 0 to 3; none before they are real.
fn turned<const W: usize>(q: &Reg<Sim, W>) -> u32 {
    let before = quarter(q.previous_a, q.previous_b);
    match q.samples.get() {
        3 => (quarter(q.present_a, q.present_b) + 4 - before) % 4,
        _ => 0,
    }
}

impl<const W: usize> Specified for QuadratureCounter<W> {
    fn invariants(&self) -> Invariants<'_, Self> {
        Invariants::<Self>::new()
            .step(
                "a quarter moves the position by one, clear makes it 0, nothing else moves it",
                |now, next| {
                    let moved = match turned(now.q) {
                        1 => 1,
                        3 => -1,
                        _ => 0,
                    };
                    let expected = match now.i.clear.get() {
                        true => 0.into(),
                        false => now.q.position + moved,
                    };
                    let signals = ["position", "present_a", "present_b"];
                    require(next.position == expected, signals, || {
                        format!("{} after {}", next.position.get(), now.q.position.get())
                    })
                },
            )
            .always(
                "half a turn in one tick is illegal, nothing else is",
                |now| {
                    let half = turned(now.q) == 2;
                    require(now.w.illegal.get() == half, ["illegal"], || {
                        format!("{} quarters", turned(now.q))
                    })
                },
            )
            .step(
                "an illegal step is kept in mind until clear",
                |now, next| {
                    let lost = (now.q.lost.get() || turned(now.q) == 2) && !now.i.clear.get();
                    require(next.lost.get() == lost, ["lost"], || {
                        format!("{:?}", next.lost)
                    })
                },
            )
            .step(
                "a level passes one flip-flop a tick, and three fill them",
                |now, next| {
                    let (q, i) = (now.q, now.i);
                    let passed = quarter(next.meta_a, next.meta_b) == quarter(i.a, i.b)
                        && quarter(next.present_a, next.present_b) == quarter(q.meta_a, q.meta_b)
                        && quarter(next.previous_a, next.previous_b)
                            == quarter(q.present_a, q.present_b)
                        && next.samples.get() == 3.min(q.samples.get() + 1);
                    require(passed, ["meta_a", "meta_b", "samples"], || {
                        "not those of a tick ago".into()
                    })
                },
            )
    }
}

#[cfg(test)]
mod tests;
