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
use crate::logic::{Bit, Logic, Sim, Unsigned};
use crate::signals;

/// Samples that fill the flip-flops of a channel.
const FILLED: u64 = 3;
/// The flip-flop of a channel that holds its present level.
const PRESENT: usize = 1;
/// That of the level before.
const PREVIOUS: usize = 2;

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
        /// The last three samples of channel A: bit 0 is the flip-flop at the pin, read by nothing
        /// but the second; bit 1 the present level; bit 2 the level a tick before it.
        sync_a: L::U<3> as Hex = 0,
        /// Those of channel B.
        sync_b: L::U<3> as Hex = 0,
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
        /// Channel A has changed.
        changes_a: L::Bit,
        /// Channel B has changed.
        changes_b: L::Bit,
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

    fn comb<L: Logic>(&self, q: &Reg<L, W>, _: &In<L>) -> Net<L> {
        let changes = |sync: L::U<3>| sync.bit(PRESENT) ^ sync.bit(PREVIOUS);
        let (changes_a, changes_b) = (changes(q.sync_a), changes(q.sync_b));
        let valid = q.samples.equals(FILLED.into());
        Net {
            valid,
            changes_a,
            changes_b,
            moves: valid & (changes_a ^ changes_b),
            up: q.sync_a.bit(PRESENT) ^ q.sync_b.bit(PREVIOUS),
            illegal: valid & changes_a & changes_b,
        }
    }

    fn next<L: Logic>(&self, q: Reg<L, W>, w: &Net<L>, i: &In<L>) -> Reg<L, W> {
        let moved = w.up.mux(q.position + 1, q.position - 1);
        Reg {
            sync_a: q.sync_a.join(i.a.word()),
            sync_b: q.sync_b.join(i.b.word()),
            samples: w.valid.mux(q.samples, q.samples + 1),
            position: i.clear.mux(0.into(), w.moves.mux(moved, q.position)),
            lost: (q.lost | w.illegal) & !i.clear,
        }
    }
}

/// The quarter of the encoder's period, 0 to 3 in the direction up.
fn quarter(a: bool, b: bool) -> u32 {
    match (a, b) {
        (false, false) => 0,
        (true, false) => 1,
        (true, true) => 2,
        (false, true) => 3,
    }
}

/// The quarter that a flip-flop of each channel holds.
fn held<const W: usize>(q: &Reg<Sim, W>, place: usize) -> u32 {
    let level = |sync: u64| sync >> place & 1 == 1;
    quarter(level(q.sync_a.get()), level(q.sync_b.get()))
}

/// Quarters turned between the previous and the present levels, 0 to 3; none before they are real.
fn turned<const W: usize>(q: &Reg<Sim, W>) -> u32 {
    match q.samples.get() {
        3 => (held(q, PRESENT) + 4 - held(q, PREVIOUS)) % 4,
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
                    let signals = ["position", "sync_a", "sync_b"];
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
                    let passed = held(next, 0) == quarter(i.a.get(), i.b.get())
                        && held(next, PRESENT) == held(q, 0)
                        && held(next, PREVIOUS) == held(q, PRESENT)
                        && next.samples.get() == 3.min(q.samples.get() + 1);
                    require(passed, ["sync_a", "sync_b", "samples"], || {
                        "not those of a tick ago".into()
                    })
                },
            )
    }
}

#[cfg(test)]
mod tests;
