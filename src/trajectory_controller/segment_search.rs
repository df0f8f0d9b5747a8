//! Segment search: which segment of the path a length belongs to (¶0051).
//!
//! ```text
//!                      ┌────────────────┐
//!  start, length ─────▶│                ├──▶ segment, offset
//!  last ──────────────▶│ segment_search ├──▶ done, busy
//!  write, write_… ────▶│                │
//!                      └────────────────┘
//! ```
//!
//! A binary search in the lengths at which the segments begin, from the highest bit of the number
//! down. It knows nothing of the search before, so the answer is the same whichever way the length
//! came: "if q_s is less than l1, on P0P1; if it is at least l1 and less than l1 + l2, on P1P2".

use crate::kernel::Circuit;
use crate::logic::{Bit, Logic, Ram, Unsigned};
use crate::signals;

/// Names of the states.
const STATES: &[&str] = &["idle", "read", "compare"];
const IDLE: u64 = 0;
const READ: u64 = 1;
const COMPARE: u64 = 2;

signals! {
    /// Ports in.
    pub struct In<L, const A: usize, const Q: usize> {
        /// Begins a search, unless one is under way.
        pub start: L::Bit,
        /// The length along the path; taken with `start`.
        pub length: L::U<Q>,
        /// The path's last segment; constant during a search.
        pub last: L::U<A>,
        /// Writes where a segment begins; not during a search.
        pub write: L::Bit,
        /// The segment.
        pub write_segment: L::U<A>,
        /// The length at which it begins: 0 for segment 0, and growing.
        pub write_begin: L::U<Q>,
    }
}

signals! {
    /// Flip-flops and memory.
    pub struct Reg<L, const A: usize, const Q: usize> {
        /// Where the segments begin.
        begins: L::Ram<A, Q>,
        /// What it does.
        state: L::U<2> as States(STATES) = 0,
        /// The length that is looked for.
        wanted: L::U<Q> = 0,
        /// The bit of the number that is decided.
        weight: L::U<A> as Hex = 0,
        /// The bits that are decided; the segment, from `done` on.
        pub segment: L::U<A> = 0,
        /// Where the segment that is tried begins.
        tried_begin: L::U<Q> = 0,
        /// How far the length is behind the beginning of the last segment that fitted.
        pub offset: L::U<Q> = 0,
        /// Segment and offset stand in this tick.
        pub done: L::Bit = 0,
    }
}

signals! {
    /// Nets.
    pub struct Net<L, const A: usize> {
        /// A start is taken.
        take: L::Bit,
        /// The segment that is tried: with the bit.
        tried: L::U<A>,
        /// The length is at or behind where it begins, and the path has it.
        fits: L::Bit,
        /// The last bit is decided.
        over: L::Bit,
        /// A start is not taken.
        pub busy: L::Bit,
    }
}

/// Search among up to 2^`A` segments, in lengths of `Q` bits.
///
/// `done` is high 2·`A` + 1 ticks after `start`.
#[derive(Debug, Clone, Default)]
pub struct SegmentSearch<const A: usize, const Q: usize>;

impl<const A: usize, const Q: usize> SegmentSearch<A, Q> {
    /// Ticks from `start` to `done`.
    pub const LATENCY: u64 = 2 * A as u64 + 1;
}

impl<const A: usize, const Q: usize> Circuit for SegmentSearch<A, Q> {
    const NAME: &'static str = "segment_search";
    const ABOUT: &'static str = "the segment of a path that holds a length, by bisection";
    type In<L: Logic> = In<L, A, Q>;
    type Reg<L: Logic> = Reg<L, A, Q>;
    type Net<L: Logic> = Net<L, A>;

    fn comb<L: Logic>(&self, q: &Reg<L, A, Q>, i: &In<L, A, Q>) -> Net<L, A> {
        let is = |state: u64| q.state.equals(state.into());
        let tried = q.segment | q.weight;
        let beyond = i.last.below(tried) | q.wanted.below(q.tried_begin);
        Net {
            take: i.start & is(IDLE),
            tried,
            fits: is(COMPARE) & !beyond,
            over: is(COMPARE) & q.weight.bit(0),
            busy: !is(IDLE),
        }
    }

    fn next<L: Logic>(&self, q: Reg<L, A, Q>, w: &Net<L, A>, i: &In<L, A, Q>) -> Reg<L, A, Q> {
        let is = |state: u64| q.state.equals(state.into());
        let to = |state: u64| -> L::U<2> { state.into() };
        let (reads, compares) = (is(READ), is(COMPARE));
        let decided = w.over.mux(to(IDLE), to(READ));
        let state = w.take.mux(to(READ), reads.mux(to(COMPARE), q.state));
        let wanted = w.take.mux(i.length, q.wanted);
        Reg {
            tried_begin: q.begins.read_when(reads, w.tried, q.tried_begin),
            begins: q.begins.write(i.write, i.write_segment, i.write_begin),
            state: compares.mux(decided, state),
            weight: w.take.mux(
                (1u64 << (A - 1)).into(),
                compares.mux(q.weight.shift_right(1), q.weight),
            ),
            segment: w.take.mux(0.into(), w.fits.mux(w.tried, q.segment)),
            offset: w
                .take
                .mux(i.length, w.fits.mux(q.wanted - q.tried_begin, q.offset)),
            wanted,
            done: w.over,
        }
    }
}
