//! Segment search: finds the segment of the path that contains a length (¶0051).
//!
//! ```text
//!                      ┌────────────────┐
//!  start, length ─────▶│                ├──▶ segment, offset
//!  last ──────────────▶│ segment_search ├──▶ done, busy
//!  write, write_… ────▶│                │
//!                      └────────────────┘
//! ```
//!
//! A binary search among the lengths at which the segments begin, from the highest bit of the
//! segment's number down. The result depends on the length alone, not on earlier searches: "if q_s
//! is less than l1, on P0P1; if it is at least l1 and less than l1 + l2, on P1P2".

use super::widths::PointWidths;
use crate::prelude::*;

/// Names of the states.
const STATES: &[&str] = &["idle", "read", "compare"];
const IDLE: u64 = 0;
const READ: u64 = 1;
const COMPARE: u64 = 2;

/// Search among up to 2^A segments.
///
/// `done` is high 2·A + 1 ticks after `start`.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SegmentSearch {
    /// Word widths.
    pub widths: PointWidths,
}

impl SegmentSearch {
    /// Ticks from `start` to `done`.
    pub const fn latency(&self) -> u64 {
        2 * self.widths.segment as u64 + 1
    }
}

signals! { for SegmentSearch as c;
    /// Input ports.
    pub struct In {
        /// Starts a search; ignored while one is running.
        pub start: Bit,
        /// Length along the path in guard units; sampled with `start`.
        pub length: U(c.widths.point),
        /// Number of the last segment of the path; constant during a search.
        pub last: U(c.widths.segment),
        /// Writes the length at which a segment begins. Not allowed during a search.
        pub write: Bit,
        /// Number of the segment to write.
        pub write_segment: U(c.widths.segment),
        /// Length at which the segment begins: 0 for segment 0, increasing with the number.
        pub write_begin: U(c.widths.point),
    }
    /// Flip-flops and memory.
    pub struct Reg {
        /// Lengths at which the segments begin.
        begins: Ram(c.widths.segment, c.widths.point),
        /// State of the sequence.
        state: U(2) as States(STATES) = 0,
        /// Length that is searched for.
        wanted: U(c.widths.point) = 0,
        /// Bit of the number that is being decided, as a one-hot word.
        weight: U(c.widths.segment) as Hex = 0,
        /// Bits decided so far; from `done` on the number of the segment.
        pub segment: U(c.widths.segment) = 0,
        /// Length at which the tried segment begins.
        tried_begin: U(c.widths.point) = 0,
        /// Length from the start of the last segment that fitted.
        pub offset: U(c.widths.point) = 0,
        /// High for one tick: segment and offset are valid.
        pub done: Bit = 0,
    }
    /// Nets.
    pub struct Net {
        /// A start is accepted.
        take: Bit,
        /// Number of the segment that is tried: the bits decided so far, and the bit being decided.
        tried: U(c.widths.segment),
        /// The length is not before the start of the tried segment, and the path has this segment.
        fits: Bit,
        /// The last bit is decided.
        over: Bit,
        /// A search is running; a start is ignored.
        pub busy: Bit,
    }
}

impl Circuit for SegmentSearch {
    const NAME: &'static str = "segment_search";
    const ABOUT: &'static str = "finds the segment of a path that contains a length, by bisection";
    records!(In, Reg, Net);

    fn tick(&self, i: In, q: Reg, _: Nothing) -> (Net, Reg<Edge>) {
        let is = |state: u64| q.state.equals(state);
        let (idle, reads, compares) = (is(IDLE), is(READ), is(COMPARE));
        let take = i.start & idle;
        let tried = q.segment | q.weight;
        let beyond = i.last.below(tried) | q.wanted.below(q.tried_begin);
        let fits = compares & !beyond;
        let over = compares & q.weight.bit(0);
        let busy = !idle;

        let decided = over.mux(U::new(IDLE, 2), READ);
        let state = take.mux(READ, reads.mux(COMPARE, q.state));
        let highest = 1u64 << (self.widths.segment - 1);
        let lower = compares.mux(q.weight.shift_right(1), q.weight);
        let behind = fits.mux(q.wanted - q.tried_begin, q.offset);
        let next = Reg {
            tried_begin: q.begins.read_when(reads, tried, q.tried_begin),
            begins: q.begins.write(i.write, i.write_segment, i.write_begin),
            state: compares.mux(decided, state),
            wanted: take.mux(i.length, q.wanted),
            weight: take.mux(highest, lower),
            segment: take.mux(0, fits.mux(tried, q.segment)),
            offset: take.mux(i.length, behind),
            done: over,
        };
        (
            Net {
                take,
                tried,
                fits,
                over,
                busy,
            },
            next,
        )
    }
}
