//! Point sequencer: runs search, segment, angle or powers, and point, one after the other.
//!
//! ```text
//!                        ┌─────────────────┐
//!  start ───────────────▶│                 ├──▶ search, fetch, measure, turn, raise, project
//!  found, loaded ───────▶│ point_sequencer ├──▶ curvature, shift, radius
//!  measured, turned ────▶│                 ├──▶ along, across, third
//!  raised, projected ───▶│                 ├──▶ done, busy
//!  load, word, data ────▶│                 │
//!  offset, arc_… ───────▶│                 │
//!  square, cube ────────▶│                 │
//!                        └─────────────────┘
//! ```

use super::widths::PointWidths;
use crate::prelude::*;

/// Names of the states.
const STATES: &[&str] = &[
    "idle", "search", "fetch", "measure", "turn", "project", "raise",
];
const IDLE: u64 = 0;
const SEARCH: u64 = 1;
const FETCH: u64 = 2;
const MEASURE: u64 = 3;
const TURN: u64 = 4;
const PROJECT: u64 = 5;
const RAISE: u64 = 6;

/// Number of the segment word that is the radius of an arc.
pub const RADIUS: u64 = 2;

/// Number of the segment word that is the radius with the steady correction.
pub const STEADY_RADIUS: u64 = 12;

/// Sequencer of the blocks of a path point.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PointSequencer {
    /// Word widths.
    pub widths: PointWidths,
    /// Number of the segment word that is the radius of an arc.
    pub radius_word: u64,
}

signals! { for PointSequencer as c;
    /// Input ports.
    pub struct In {
        /// Starts the computation of a point; ignored while `busy`.
        pub start: Bit,
        /// The search has found the segment.
        pub found: Bit,
        /// All words of the segment have been sent.
        pub loaded: Bit,
        /// The angle is valid.
        pub measured: Bit,
        /// The point on the arc is valid.
        pub turned: Bit,
        /// The powers of the length are valid.
        pub raised: Bit,
        /// The coordinates of the point are valid.
        pub projected: Bit,
        /// `data` is word `word` of the segment.
        pub load: Bit,
        /// Number of the word in `data`.
        pub word: U(c.widths.word),
        /// Word of the segment.
        pub data: U(c.widths.data) as Hex,
        /// Length from the start of the segment, in guard units.
        pub offset: U(c.widths.point),
        /// First coordinate of the point on the arc.
        pub arc_along: I(c.widths.radius),
        /// Second coordinate of the point on the arc.
        pub arc_across: I(c.widths.radius),
        /// Square of the length on a spline.
        pub square: U(c.widths.radius),
        /// Cube of the length on a spline.
        pub cube: U(c.widths.radius),
    }
    /// Flip-flops.
    pub struct Reg {
        /// State of the sequence.
        state: U(3) as States(STATES) = 0,
        /// The segment is an arc or a helix.
        arc: Bit = 0,
        /// The segment has a third coordinate: it is a helix or a spline.
        spatial: Bit = 0,
        /// Shift of the angle, or of the powers.
        pub shift: U(6) = 0,
        /// Curvature of the arc, from the segment.
        pub curvature: U(c.widths.curvature) as Hex = 0,
        /// Radius of the arc, divided by the gain of the CORDIC.
        pub radius: I(c.widths.radius) = 0,
        /// Starts the search.
        pub search: Bit = 0,
        /// Starts to fetch the segment.
        pub fetch: Bit = 0,
        /// Starts the computation of the angle.
        pub measure: Bit = 0,
        /// Starts the CORDIC.
        pub turn: Bit = 0,
        /// Starts the computation of the powers.
        pub raise: Bit = 0,
        /// Starts the rows of the axes.
        pub project: Bit = 0,
        /// High for one tick: the point is valid.
        pub done: Bit = 0,
    }
    /// Nets.
    pub struct Net {
        /// A start is accepted.
        take: Bit,
        /// The search ends.
        searched: Bit,
        /// The segment has been fetched.
        fetched: Bit,
        /// The word is the first of a segment.
        header: Bit,
        /// The segment has been fetched, and is an arc or a helix.
        on_arc: Bit,
        /// The segment has been fetched, and is a spline.
        on_spline: Bit,
        /// The coordinates within the segment are valid.
        placed: Bit,
        /// The angle is valid.
        angled: Bit,
        /// The point is complete.
        reached: Bit,
        /// Length on the segment, with R − P bits below the guard unit.
        ahead: I(c.widths.radius),
        /// First coordinate of the point within the segment.
        pub along: I(c.widths.radius),
        /// Second coordinate: on an arc that of its point, on a spline the square of the length, on
        /// a line 0.
        pub across: I(c.widths.radius),
        /// Third coordinate: on a helix the length, on a spline its cube, otherwise 0.
        pub third: I(c.widths.radius),
        /// A point is being computed.
        pub busy: Bit,
    }
}

impl Circuit for PointSequencer {
    const NAME: &'static str = "point_sequencer";
    const ABOUT: &'static str =
        "runs search, segment, angle or powers, and point, one after the other";
    records!(In, Reg, Net);

    fn tick(&self, i: In, q: Reg, _: Nothing) -> (Net, Reg<Edge>) {
        let (radius, curvature) = (self.widths.radius, self.widths.curvature);
        let is = |state: u64| q.state.equals(state);
        let take = i.start & is(IDLE);
        let searched = is(SEARCH) & i.found;
        let fetched = is(FETCH) & i.loaded;
        let on_arc = fetched & q.arc;
        let on_spline = fetched & !q.arc & q.spatial;
        let straight = fetched & !q.arc & !q.spatial;
        let placed = straight | (is(TURN) & i.turned) | (is(RAISE) & i.raised);
        let angled = is(MEASURE) & i.measured;
        let reached = is(PROJECT) & i.projected;
        let ahead = i
            .offset
            .resize(radius)
            .shift_left(self.widths.fine())
            .signed();

        let word = |number: u64| i.load & i.word.equals(number);
        let header = word(0);
        let state = take.mux(SEARCH, q.state);
        let state = searched.mux(FETCH, state);
        let state = on_arc.mux(MEASURE, state);
        let state = angled.mux(TURN, state);
        let state = on_spline.mux(RAISE, state);
        let state = placed.mux(PROJECT, state);
        let given = i.data.resize(radius).signed();
        let next = Reg {
            state: reached.mux(IDLE, state),
            arc: header.mux(i.data.bit(0), q.arc),
            spatial: header.mux(i.data.resize(8).bit(7), q.spatial),
            shift: header.mux(i.data.shift_right(1).resize(6), q.shift),
            curvature: word(1).mux(i.data.resize(curvature), q.curvature),
            radius: word(self.radius_word).mux(given, q.radius),
            search: take,
            fetch: searched,
            measure: on_arc,
            turn: angled,
            raise: on_spline,
            project: placed,
            done: reached,
        };
        let net = Net {
            take,
            searched,
            fetched,
            header,
            on_arc,
            on_spline,
            placed,
            angled,
            reached,
            ahead,
            along: q.arc.mux(i.arc_along, ahead),
            across: q.arc.mux(i.arc_across, q.spatial.mux(i.square.signed(), 0)),
            third: q.spatial.mux(q.arc.mux(ahead, i.cube.signed()), 0),
            busy: !is(IDLE),
        };
        (net, next)
    }

    fn objection(&self) -> Option<String> {
        let of = &self.widths;
        let radius = of.radius > of.point && of.data >= of.radius;
        let holds = radius && of.data >= of.curvature;
        (!holds).then(|| "a word holds a radius and a curvature".into())
    }
}
