//! Record sequencer: one segment after the other, one point for every sampling time.
//!
//! ```text
//!                     ┌───────────────────┐
//!  start, halt ──────▶│                   ├──▶ take
//!  sample ───────────▶│                   ├──▶ advance, rotate
//!  available, loaded ▶│ record_sequencer  ├──▶ present, sampled
//!  load, word, data ─▶│                   ├──▶ kind, rotating, modulus
//!  rotated ──────────▶│                   ├──▶ busy, late, starved
//!                     └───────────────────┘
//! ```
//!
//! A → A⁺ → (B) → C⁻ → C of JPH0743606B2 is a blend, an arc and a blend; with lines it becomes line,
//! blend, arc, blend, line. The sequencer does not tell these apart: each segment begins at the
//! point where the one before it has ended, and says how many samples it has.
//!
//! With `sample` the point becomes the command, and the next point is made at once: it is ready
//! long before the next `sample`. After the last point of a segment the next segment is fetched
//! first. The first point of a path is the beginning of its first segment. A segment of 0 samples
//! gives the point where it begins.

use super::record_memory::{ARC, KINDS};
use crate::check::{Invariants, Specified, require};
use crate::kernel::Circuit;
use crate::logic::{Bit, Logic, Sim, Unsigned};
use crate::signals;

/// Names of the states.
const STATES: &[&str] = &["idle", "fetch", "step", "rotate", "ready"];
const IDLE: u64 = 0;
const FETCH: u64 = 1;
const STEP: u64 = 2;
const ROTATE: u64 = 3;
const READY: u64 = 4;

signals! {
    /// Ports in.
    pub struct In<L, const D: usize> {
        /// Begins a path, unless one is under way or no segment waits.
        pub start: L::Bit,
        /// Ends the path: the commands stay where they are, what waits is forgotten.
        pub halt: L::Bit,
        /// A sampling time begins.
        pub sample: L::Bit,
        /// A segment waits.
        pub available: L::Bit,
        /// `data` is word `word` of a record.
        pub load: L::Bit,
        /// Number of the word.
        pub word: L::U<5>,
        /// Its data.
        pub data: L::U<D> as Hex,
        /// The record is complete.
        pub loaded: L::Bit,
        /// The rotation has its next point.
        pub rotated: L::Bit,
    }
}

signals! {
    /// Flip-flops.
    pub struct Reg<L, const F: usize, const N: usize> {
        /// What it does.
        state: L::U<3> as States(STATES) = 0,
        /// The point is the first of a path.
        first: L::Bit = 0,
        /// The segment's kind.
        pub kind: L::U<2> as States(KINDS) = 0,
        /// The segment ends at rest.
        rests: L::Bit = 0,
        /// Points of the segment that are yet to be made.
        remaining: L::U<N> as Analog = 0,
        /// The modulus of the segment's differences.
        pub modulus: L::U<F> = 0,
        /// The next record is fetched.
        pub take: L::Bit = 0,
        /// The rotation makes the next point.
        pub rotate: L::Bit = 0,
        /// New commands stand in this tick.
        pub sampled: L::Bit = 0,
        /// A sampling time began before the point was ready; until the next path begins.
        pub late: L::Bit = 0,
        /// The path ended in motion, since no segment waited; until the next path begins.
        pub starved: L::Bit = 0,
    }
}

signals! {
    /// Nets.
    pub struct Net<L> {
        /// The word is a record's first.
        header: L::Bit,
        /// A path begins.
        begins: L::Bit,
        /// The segment's last point becomes the command.
        over: L::Bit,
        /// The segment is an arc.
        pub rotating: L::Bit,
        /// The next point is made.
        makes: L::Bit,
        /// The difference engines make it.
        pub advance: L::Bit,
        /// The point becomes the command.
        pub present: L::Bit,
        /// A path is under way.
        pub busy: L::Bit,
        /// A sampling time begins too early.
        hurried: L::Bit,
    }
}

/// Sequencer for segments of up to 2^`N` − 1 samples, moduli of `F` bits and records with words of
/// `D` bits.
#[derive(Debug, Clone, Default)]
pub struct RecordSequencer<const F: usize, const N: usize, const D: usize>;

impl<const F: usize, const N: usize, const D: usize> Circuit for RecordSequencer<F, N, D> {
    const NAME: &'static str = "record_sequencer";
    const ABOUT: &'static str = "segment after segment, a point for every sampling time";
    type In<L: Logic> = In<L, D>;
    type Reg<L: Logic> = Reg<L, F, N>;
    type Net<L: Logic> = Net<L>;

    fn comb<L: Logic>(&self, q: &Reg<L, F, N>, i: &In<L, D>) -> Net<L> {
        const {
            assert!(
                D >= N + 3 && D >= F,
                "a word of a record holds header and modulus"
            )
        };
        let is = |state: u64| q.state.equals(state.into());
        let begins = is(IDLE) & i.start & i.available & !i.halt;
        let present = is(READY) & i.sample & !i.halt;
        let over = present & q.remaining.is_zero();
        let rotating = q.kind.equals(ARC.into());
        let makes = is(STEP) & !i.halt;
        Net {
            header: i.load & i.word.is_zero(),
            begins,
            over,
            rotating,
            makes,
            advance: makes & !rotating,
            present,
            busy: !is(IDLE),
            hurried: i.sample & !q.first & !i.halt & (is(FETCH) | is(STEP) | is(ROTATE)),
        }
    }

    fn next<L: Logic>(&self, q: Reg<L, F, N>, w: &Net<L>, i: &In<L, D>) -> Reg<L, F, N> {
        let modulus = i.load & i.word.equals(1.into());
        let to = |state: u64| -> L::U<3> { state.into() };
        let loaded = i.loaded & q.state.equals(FETCH.into());
        let rotated = i.rotated & q.state.equals(ROTATE.into());
        let ended = i.available.mux(to(FETCH), to(IDLE));
        let state = w.begins.mux(to(FETCH), q.state);
        let stands = q.first | q.remaining.is_zero();
        let state = loaded.mux(stands.mux(to(READY), to(STEP)), state);
        let made = w.rotating.mux(to(ROTATE), to(READY));
        let state = w.makes.mux(made, state);
        let state = rotated.mux(to(READY), state);
        let state = w.present.mux(w.over.mux(ended, to(STEP)), state);
        Reg {
            state: i.halt.mux(to(IDLE), state),
            first: w.begins | (q.first & !w.present),
            kind: w.header.mux(i.data.resize(), q.kind),
            rests: w.header.mux(i.data.bit(2), q.rests),
            remaining: w.header.mux(
                i.data.shift_right(3).resize(),
                w.makes.mux(q.remaining - 1, q.remaining),
            ),
            modulus: modulus.mux(i.data.resize(), q.modulus),
            take: w.begins | (w.over & i.available),
            rotate: w.makes & w.rotating,
            sampled: w.present,
            late: (q.late & !w.begins) | w.hurried,
            starved: (q.starved & !w.begins) | (w.over & !q.rests & !i.available),
        }
    }
}

/// What the control does next, in the words of its description: `None` where it stays as it is.
fn after<const F: usize, const N: usize, const D: usize>(
    q: &Reg<Sim, F, N>,
    i: &In<Sim, D>,
) -> Option<u64> {
    let on = |condition: bool, state| condition.then_some(state);
    let next = on(i.available.get(), FETCH).unwrap_or(IDLE);
    match q.state.get() {
        _ if i.halt.get() => Some(IDLE),
        IDLE => on(i.start.get() && i.available.get(), FETCH),
        FETCH if q.first.get() || q.remaining.get() == 0 => on(i.loaded.get(), READY),
        FETCH => on(i.loaded.get(), STEP),
        STEP if q.kind.get() == ARC => Some(ROTATE),
        STEP => Some(READY),
        ROTATE => on(i.rotated.get(), READY),
        _ if q.remaining.get() == 0 => on(i.sample.get(), next),
        _ => on(i.sample.get(), STEP),
    }
}

impl<const F: usize, const N: usize, const D: usize> Specified for RecordSequencer<F, N, D> {
    fn invariants(&self) -> Invariants<'_, Self> {
        Invariants::<Self>::new()
            .step("state after state as described", |now, next| {
                let expected = after(now.q, now.i).unwrap_or(now.q.state.get());
                require(next.state.get() == expected, ["state"], || {
                    format!("not {}", STATES[expected as usize])
                })
            })
            .step(
                "a point is made for every step, and counted",
                |now, next| {
                    let header = now.i.load.get() && now.i.word.get() == 0;
                    let steps = now.q.state.get() == STEP && !now.i.halt.get();
                    let made = u64::from(now.w.advance.get()) + u64::from(next.rotate.get());
                    let arc = now.q.kind.get() == ARC;
                    let left = (now.q.remaining.get() + (1 << N) - made) % (1 << N);
                    let counted = header || next.remaining.get() == left;
                    let right = made == u64::from(steps) && next.rotate.get() == (steps && arc);
                    require(right && counted, ["remaining", "advance", "rotate"], || {
                        format!("{made} made")
                    })
                },
            )
            .step(
                "a command with a sample where the point is ready, nowhere else",
                |now, next| {
                    let due = now.i.sample.get() && now.q.state.get() == READY && !now.i.halt.get();
                    let right = now.w.present.get() == due && next.sampled.get() == due;
                    require(right, ["present", "sampled"], || "not so".into())
                },
            )
            .step(
                "a record is taken where a fetch begins, and only there",
                |now, next| {
                    let fetches = next.state.get() == FETCH && now.q.state.get() != FETCH;
                    require(next.take.get() == fetches, ["take", "state"], || {
                        "not so".into()
                    })
                },
            )
            .step(
                "a path's first point is first until it becomes the command",
                |now, next| {
                    let begins = now.q.state.get() == IDLE && next.state.get() == FETCH;
                    let expected = begins || (now.q.first.get() && !next.sampled.get());
                    require(next.first.get() == expected, ["first"], || {
                        format!("not {expected}")
                    })
                },
            )
            .step(
                "late: a sample came while the next point was made",
                |now, next| {
                    let making = [FETCH, STEP, ROTATE].contains(&now.q.state.get());
                    let missed = now.i.sample.get() && !now.i.halt.get();
                    let missed = missed && making && !now.q.first.get();
                    let begins = now.q.state.get() == IDLE && next.state.get() == FETCH;
                    let expected = missed || (now.q.late.get() && !begins);
                    require(next.late.get() == expected, ["late"], || {
                        format!("not {expected}")
                    })
                },
            )
            .step(
                "starved: it became idle without rest and without halt",
                |now, next| {
                    let idles = now.q.state.get() != IDLE && next.state.get() == IDLE;
                    let moving = idles && !now.i.halt.get() && !now.q.rests.get();
                    let begins = now.q.state.get() == IDLE && next.state.get() == FETCH;
                    let expected = moving || (now.q.starved.get() && !begins);
                    require(next.starved.get() == expected, ["starved"], || {
                        format!("not {expected}")
                    })
                },
            )
            .step(
                "words 0 and 1 of a record are header and modulus",
                |now, next| {
                    let word = now.i.load.get().then(|| now.i.word.get());
                    let data = now.i.data.get();
                    let header = match word {
                        Some(0) => [data % 4, data / 4 % 2],
                        _ => [now.q.kind.get(), u64::from(now.q.rests.get())],
                    };
                    let samples = data / 8 % (1 << N);
                    let counted = word != Some(0) || next.remaining.get() == samples;
                    let modulus = match word {
                        Some(1) => data % (1 << F),
                        _ => now.q.modulus.get(),
                    };
                    let same = [next.kind.get(), u64::from(next.rests.get())] == header;
                    let right = same && counted && next.modulus.get() == modulus;
                    require(right, ["kind", "rests", "remaining", "modulus"], || {
                        "not so".into()
                    })
                },
            )
    }

    /// A word is loaded in a fetch; one from 2 on does not differ from another such.
    fn applies(&self, i: &In<Sim, D>) -> bool {
        match i.load.get() {
            true => i.word.get() <= 2 && !i.loaded.get(),
            false => i.word.get() == 0 && i.data.get() == 0,
        }
    }
}
