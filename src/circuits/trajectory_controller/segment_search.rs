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
//! down. The result depends on the length alone, not on earlier searches: "if q_s is less than l1,
//! on P0P1; if it is at least l1 and less than l1 + l2, on P1P2".

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
    /// Its widths.
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
        /// Starts a search, unless one is running.
        pub start: Bit,
        /// The length along the path; taken with `start`.
        pub length: U(c.widths.point),
        /// The path's last segment; constant during a search.
        pub last: U(c.widths.segment),
        /// Writes the beginning of a segment; not during a search.
        pub write: Bit,
        /// The segment.
        pub write_segment: U(c.widths.segment),
        /// The length at which it begins: 0 for segment 0, and growing.
        pub write_begin: U(c.widths.point),
    }
    /// Flip-flops and memory.
    pub struct Reg {
        /// Lengths at which the segments begin.
        begins: Ram(c.widths.segment, c.widths.point),
        /// State of the sequence.
        state: U(2) as States(STATES) = 0,
        /// The length that is looked for.
        wanted: U(c.widths.point) = 0,
        /// The bit of the number that is decided.
        weight: U(c.widths.segment) as Hex = 0,
        /// The bits that are decided; the segment, from `done` on.
        pub segment: U(c.widths.segment) = 0,
        /// Length at which the tried segment begins.
        tried_begin: U(c.widths.point) = 0,
        /// Length from the beginning of the last segment that fitted.
        pub offset: U(c.widths.point) = 0,
        /// Segment and offset are valid in this tick.
        pub done: Bit = 0,
    }
    /// Nets.
    pub struct Net {
        /// A start is taken.
        take: Bit,
        /// The segment that is tried: with the bit.
        tried: U(c.widths.segment),
        /// The length is at or beyond that beginning, and the path has the segment.
        fits: Bit,
        /// The last bit is decided.
        over: Bit,
        /// A start is not taken.
        pub busy: Bit,
    }
}

impl Circuit for SegmentSearch {
    const NAME: &'static str = "segment_search";
    const ABOUT: &'static str = "the segment of a path that holds a length, by bisection";
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
