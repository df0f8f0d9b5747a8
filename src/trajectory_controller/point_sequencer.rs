//! Point sequencer: search, segment, angle, point, one after the other.
//!
//! ```text
//!                        ┌─────────────────┐
//!  start ───────────────▶│                 ├──▶ search, fetch, measure, turn, project
//!  found, loaded ───────▶│ point_sequencer ├──▶ curvature, shift, radius
//!  measured, turned ────▶│                 ├──▶ along, across
//!  projected ───────────▶│                 ├──▶ done, busy
//!  load, word, data ────▶│                 │
//!  offset, arc_… ───────▶│                 │
//!                        └─────────────────┘
//! ```

use crate::kernel::Circuit;
use crate::logic::{Bit, Logic, Unsigned};
use crate::signals;

/// Names of the states.
const STATES: &[&str] = &["idle", "search", "fetch", "measure", "turn", "project"];
const IDLE: u64 = 0;
const SEARCH: u64 = 1;
const FETCH: u64 = 2;
const MEASURE: u64 = 3;
const TURN: u64 = 4;
const PROJECT: u64 = 5;

signals! {
    /// Ports in.
    pub struct In<L, const P: usize, const R: usize, const D: usize> {
        /// Begins, unless a point is under way.
        pub start: L::Bit,
        /// The search has the segment.
        pub found: L::Bit,
        /// The segment is there.
        pub loaded: L::Bit,
        /// The angle is there.
        pub measured: L::Bit,
        /// The point on the arc is there.
        pub turned: L::Bit,
        /// The point is there.
        pub projected: L::Bit,
        /// `data` is word `word` of the segment.
        pub load: L::Bit,
        /// Number of the word.
        pub word: L::U<4>,
        /// Its data.
        pub data: L::U<D> as Hex,
        /// The length behind the segment's beginning.
        pub offset: L::U<P>,
        /// First coordinate of the point on the arc.
        pub arc_along: L::I<R>,
        /// Second coordinate.
        pub arc_across: L::I<R>,
    }
}

signals! {
    /// Flip-flops.
    pub struct Reg<L, const M: usize, const R: usize> {
        /// What it does.
        state: L::U<3> as States(STATES) = 0,
        /// The segment is an arc.
        arc: L::Bit = 0,
        /// Of the angle.
        pub shift: L::U<6> = 0,
        /// Of the arc.
        pub curvature: L::U<M> as Hex = 0,
        /// Of the arc, divided by the gain of CORDIC.
        pub radius: L::I<R> = 0,
        /// The search begins.
        pub search: L::Bit = 0,
        /// The segment is fetched.
        pub fetch: L::Bit = 0,
        /// The angle is measured.
        pub measure: L::Bit = 0,
        /// The arc's radius is turned.
        pub turn: L::Bit = 0,
        /// The point is projected to the axes.
        pub project: L::Bit = 0,
        /// The point stands in this tick.
        pub done: L::Bit = 0,
    }
}

signals! {
    /// Nets.
    pub struct Net<L, const R: usize> {
        /// A start is taken.
        take: L::Bit,
        /// The search is over.
        searched: L::Bit,
        /// The segment is there.
        fetched: L::Bit,
        /// The word is a segment's first.
        header: L::Bit,
        /// The segment is there, an arc.
        on_arc: L::Bit,
        /// The segment is there, a line, or the point on the arc is.
        placed: L::Bit,
        /// The angle is there.
        angled: L::Bit,
        /// The point is there.
        reached: L::Bit,
        /// The length on a line, with bits behind the guard unit.
        ahead: L::I<R>,
        /// First coordinate of the point in the segment.
        pub along: L::I<R>,
        /// Second coordinate: 0 on a line.
        pub across: L::I<R>,
        /// A point is under way.
        pub busy: L::Bit,
    }
}

/// Sequencer for lengths of `P` bits, coordinates of `R`, curvatures of `M`, words of `D`.
#[derive(Debug, Clone)]
pub struct PointSequencer<const P: usize, const R: usize, const M: usize, const D: usize> {
    /// Word of a segment that is the radius of its arc.
    pub radius_word: u64,
}

/// Word that is the radius of an arc.
pub const RADIUS: u64 = 2;

/// Word that is its radius with the steady correction.
pub const STEADY_RADIUS: u64 = 12;

impl<const P: usize, const R: usize, const M: usize, const D: usize> Default
    for PointSequencer<P, R, M, D>
{
    fn default() -> Self {
        let radius_word = RADIUS;
        PointSequencer { radius_word }
    }
}

impl<const P: usize, const R: usize, const M: usize, const D: usize> Circuit
    for PointSequencer<P, R, M, D>
{
    const NAME: &'static str = "point_sequencer";
    const ABOUT: &'static str = "search, segment, angle, point, one after the other";
    type In<L: Logic> = In<L, P, R, D>;
    type Reg<L: Logic> = Reg<L, M, R>;
    type Net<L: Logic> = Net<L, R>;

    fn comb<L: Logic>(&self, q: &Reg<L, M, R>, i: &In<L, P, R, D>) -> Net<L, R> {
        const {
            assert!(
                R > P && D >= R && D >= M,
                "a word holds a radius and a curvature"
            )
        };
        let is = |state: u64| q.state.equals(state.into());
        let fetched = is(FETCH) & i.loaded;
        let wide: L::U<R> = i.offset.resize();
        let ahead = wide.shift_left(R - P).signed();
        Net {
            take: i.start & is(IDLE),
            searched: is(SEARCH) & i.found,
            fetched,
            header: i.load & i.word.equals(0.into()),
            on_arc: fetched & q.arc,
            placed: (fetched & !q.arc) | (is(TURN) & i.turned),
            angled: is(MEASURE) & i.measured,
            reached: is(PROJECT) & i.projected,
            ahead,
            along: q.arc.mux(i.arc_along, ahead),
            across: q.arc.mux(i.arc_across, 0.into()),
            busy: !is(IDLE),
        }
    }

    fn next<L: Logic>(&self, q: Reg<L, M, R>, w: &Net<L, R>, i: &In<L, P, R, D>) -> Reg<L, M, R> {
        let to = |state: u64| -> L::U<3> { state.into() };
        let word = |number: u64| i.load & i.word.equals(number.into());
        let state = w.take.mux(to(SEARCH), q.state);
        let state = w.searched.mux(to(FETCH), state);
        let state = w.on_arc.mux(to(MEASURE), state);
        let state = w.angled.mux(to(TURN), state);
        let state = w.placed.mux(to(PROJECT), state);
        Reg {
            state: w.reached.mux(to(IDLE), state),
            arc: w.header.mux(i.data.bit(0), q.arc),
            shift: w.header.mux(i.data.shift_right(1).resize(), q.shift),
            curvature: word(1).mux(i.data.resize(), q.curvature),
            radius: word(self.radius_word).mux(i.data.resize().signed(), q.radius),
            search: w.take,
            fetch: w.searched,
            measure: w.on_arc,
            turn: w.angled,
            project: w.placed,
            done: w.reached,
        }
    }
}
