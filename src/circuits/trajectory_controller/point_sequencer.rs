//! Point sequencer: search, segment, angle or powers, point, one after the other.
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

/// Word that is the radius of an arc.
pub const RADIUS: u64 = 2;

/// Word that is its radius with the steady correction.
pub const STEADY_RADIUS: u64 = 12;

/// Sequencer of the blocks of a path point.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PointSequencer {
    /// Its widths.
    pub widths: PointWidths,
    /// Word of a segment that is the radius of its arc.
    pub radius_word: u64,
}

signals! { for PointSequencer as c;
    /// Input ports.
    pub struct In {
        /// Starts, unless a point is being computed.
        pub start: Bit,
        /// The search has the segment.
        pub found: Bit,
        /// The segment is ready.
        pub loaded: Bit,
        /// The angle is ready.
        pub measured: Bit,
        /// The point on the arc is ready.
        pub turned: Bit,
        /// The powers of the length are ready.
        pub raised: Bit,
        /// The point is ready.
        pub projected: Bit,
        /// `data` is word `word` of the segment.
        pub load: Bit,
        /// Number of the word.
        pub word: U(c.widths.word),
        /// Its data.
        pub data: U(c.widths.data) as Hex,
        /// Length from the segment's beginning.
        pub offset: U(c.widths.point),
        /// First coordinate of the point on the arc.
        pub arc_along: I(c.widths.radius),
        /// Second coordinate.
        pub arc_across: I(c.widths.radius),
        /// The length's square on a spline.
        pub square: U(c.widths.radius),
        /// Its cube.
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
        /// Curvature of the arc.
        pub curvature: U(c.widths.curvature) as Hex = 0,
        /// Radius of the arc, divided by the gain of CORDIC.
        pub radius: I(c.widths.radius) = 0,
        /// The search begins.
        pub search: Bit = 0,
        /// The segment is fetched.
        pub fetch: Bit = 0,
        /// The angle is measured.
        pub measure: Bit = 0,
        /// The arc's radius is turned.
        pub turn: Bit = 0,
        /// The length is raised to its powers.
        pub raise: Bit = 0,
        /// The point is projected to the axes.
        pub project: Bit = 0,
        /// The point is valid in this tick.
        pub done: Bit = 0,
    }
    /// Nets.
    pub struct Net {
        /// A start is taken.
        take: Bit,
        /// The search is over.
        searched: Bit,
        /// The segment is ready.
        fetched: Bit,
        /// The word is a segment's first.
        header: Bit,
        /// The segment is ready, an arc or a helix.
        on_arc: Bit,
        /// The segment is ready, a spline.
        on_spline: Bit,
        /// A line, the point on an arc, or the powers are ready.
        placed: Bit,
        /// The angle is ready.
        angled: Bit,
        /// The point is ready.
        reached: Bit,
        /// The length on the segment, with the bits below the guard unit.
        ahead: I(c.widths.radius),
        /// First coordinate of the point in the segment.
        pub along: I(c.widths.radius),
        /// Second coordinate: the length's square on a spline, 0 on a line.
        pub across: I(c.widths.radius),
        /// Third coordinate: the length on a helix, its cube on a spline, else 0.
        pub third: I(c.widths.radius),
        /// A point is being computed.
        pub busy: Bit,
    }
}

impl Circuit for PointSequencer {
    const NAME: &'static str = "point_sequencer";
    const ABOUT: &'static str = "search, segment, angle or powers, point, one after the other";
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
