//! Path point: the point at a length along the path (equations (1) and (5)).
//!
//! ```text
//!                      ┌──────────────────────────────┐
//!  start, length ─────▶│ search ▶ store ▶ sequencer   ├──▶ points, segment
//!  last ──────────────▶│   ▶ arc_angle ▶ cordic       ├──▶ done, busy
//!  write, write_… ────▶│   ▶ rows of x, y, z          │
//!                      └──────────────────────────────┘
//! ```
//!
//! Axis distribution 3 is this circuit with the length q_c that interpolation and acceleration 1 has
//! come to; reference point 2 is the same circuit, with the same segments, with the length q_s of the
//! tangential servo response. It knows nothing of the lengths before.

use super::{
    ArcAngle, AxisRow, Cordic, PointSequencer, SegmentSearch, SegmentStore, arc_angle, axis_row,
    cordic, point_sequencer, segment_search, segment_store,
};
use crate::blocks::{CoefficientControl, coefficient_control};
use crate::kernel::{Circuit, Instance};
use crate::logic::Logic;
use crate::signals;
use std::array::from_fn;

/// Names of the axes.
pub const AXIS_NAMES: [&str; 3] = ["x", "y", "z"];
const POINT: &[&str] = &["point_x", "point_y", "point_z"];

signals! {
    /// Ports in.
    pub struct In<L, const A: usize, const P: usize, const D: usize, const K: usize> {
        /// Begins, unless a point is under way.
        pub start: L::Bit,
        /// The length along the path, 0 up to its end; constant until the search has begun, in the
        /// tick after `start`.
        pub length: L::U<P>,
        /// The path's last segment.
        pub last: L::U<A>,
        /// Writes where a segment begins.
        pub write_begin: L::Bit,
        /// The segment.
        pub begin_segment: L::U<A>,
        /// The length at which it begins.
        pub begin_length: L::U<P>,
        /// Writes a word of a segment.
        pub write: L::Bit,
        /// The segment, and in the lower four bits the number of its word.
        pub write_address: L::U<K> as Hex,
        /// Its data.
        pub write_data: L::U<D> as Hex,
    }
}

signals! {
    /// Registers of the blocks.
    pub struct Reg<
        L,
        const AXES: usize,
        const A: usize,
        const P: usize,
        const R: usize,
        const C: usize,
        const S: usize,
        const M: usize,
        const H: usize,
        const X: usize,
        const D: usize,
        const K: usize,
    > {
        /// Which segment.
        pub search: segment_search::Reg<L, A, P>,
        /// The segments.
        pub store: segment_store::Reg<L, K, D>,
        /// One after the other.
        pub sequencer: point_sequencer::Reg<L, M, R>,
        /// Length to angle.
        pub measure: arc_angle::Reg<L, P, M, H, X>,
        /// Angle to point.
        pub cordic: cordic::Reg<L, R, H>,
        /// Which bit the axes are at.
        pub control: coefficient_control::Reg<L>,
        /// The axes.
        pub axes: [axis_row::Reg<L, P, C, S>; AXES] as Elements(&AXIS_NAMES),
    }
}

signals! {
    /// Nets of the blocks, and the ports out.
    pub struct Net<
        L,
        const AXES: usize,
        const A: usize,
        const P: usize,
        const R: usize,
        const C: usize,
        const S: usize,
        const M: usize,
        const H: usize,
        const X: usize,
        const D: usize,
        const K: usize,
    > {
        /// Which segment.
        pub search: Instance<SegmentSearch<A, P>, L>,
        /// The segments.
        pub store: Instance<SegmentStore<A, K, D>, L>,
        /// One after the other.
        pub sequencer: Instance<PointSequencer<P, R, M, D>, L>,
        /// Length to angle.
        pub measure: Instance<ArcAngle<P, M, H, X>, L>,
        /// Angle to point.
        pub cordic: Instance<Cordic<R, H>, L>,
        /// Which bit the axes are at.
        pub control: Instance<CoefficientControl<C>, L>,
        /// The axes.
        pub axes: [Instance<AxisRow<P, R, C, S, D>, L>; AXES] as Elements(&AXIS_NAMES),
        /// The point.
        pub points: [L::I<P>; AXES] as Elements(POINT),
        /// The segment that it is on.
        pub segment: L::U<A>,
        /// The point stands in this tick.
        pub done: L::Bit,
        /// A point is under way.
        pub busy: L::Bit,
    }
}

/// Path point of `AXES` axes on up to 2^`A` segments; for the other widths see the note.
#[derive(Debug, Clone)]
pub struct PathPoint<
    const AXES: usize,
    const A: usize,
    const P: usize,
    const R: usize,
    const C: usize,
    const S: usize,
    const M: usize,
    const H: usize,
    const X: usize,
    const D: usize,
    const K: usize,
> {
    /// Which segment.
    pub search: SegmentSearch<A, P>,
    /// The segments.
    pub store: SegmentStore<A, K, D>,
    /// One after the other.
    pub sequencer: PointSequencer<P, R, M, D>,
    /// Length to angle.
    pub measure: ArcAngle<P, M, H, X>,
    /// Angle to point.
    pub cordic: Cordic<R, H>,
    /// Which bit the axes are at.
    pub control: CoefficientControl<C>,
    /// The axes.
    pub axes: [AxisRow<P, R, C, S, D>; AXES],
}

impl<
    const AXES: usize,
    const A: usize,
    const P: usize,
    const R: usize,
    const C: usize,
    const S: usize,
    const M: usize,
    const H: usize,
    const X: usize,
    const D: usize,
    const K: usize,
> PathPoint<AXES, A, P, R, C, S, M, H, X, D, K>
{
    /// Ticks from `start` to `done` on a line: search, segment, projection, and a register after
    /// each.
    pub const LINE_LATENCY: u64 = SegmentSearch::<A, P>::LATENCY
        + SegmentStore::<A, K, D>::LATENCY
        + CoefficientControl::<C>::LATENCY
        + 4;

    /// The same on the smallest arc, whose angle is shifted most: it is measured and turned besides.
    pub const LATENCY: u64 = Self::LINE_LATENCY
        + ArcAngle::<P, M, H, X>::LATENCY
        + (H as u64 - 3)
        + Cordic::<R, H>::LATENCY
        + 2;

    /// Points on a path whose arcs have the radius that stands in a word of their segments.
    pub fn new(radius_word: u64) -> Self {
        PathPoint {
            search: SegmentSearch,
            store: SegmentStore,
            sequencer: PointSequencer { radius_word },
            measure: ArcAngle,
            cordic: Cordic::default(),
            control: CoefficientControl,
            axes: from_fn(|axis| AxisRow {
                coordinate: axis as u64,
            }),
        }
    }
}

impl<
    const AXES: usize,
    const A: usize,
    const P: usize,
    const R: usize,
    const C: usize,
    const S: usize,
    const M: usize,
    const H: usize,
    const X: usize,
    const D: usize,
    const K: usize,
> Default for PathPoint<AXES, A, P, R, C, S, M, H, X, D, K>
{
    fn default() -> Self {
        Self::new(point_sequencer::RADIUS)
    }
}

impl<
    const AXES: usize,
    const A: usize,
    const P: usize,
    const R: usize,
    const C: usize,
    const S: usize,
    const M: usize,
    const H: usize,
    const X: usize,
    const D: usize,
    const K: usize,
> Circuit for PathPoint<AXES, A, P, R, C, S, M, H, X, D, K>
{
    const NAME: &'static str = "path_point";
    const ABOUT: &'static str = "the point at a length along a path of lines and arcs";
    type In<L: Logic> = In<L, A, P, D, K>;
    type Reg<L: Logic> = Reg<L, AXES, A, P, R, C, S, M, H, X, D, K>;
    type Net<L: Logic> = Net<L, AXES, A, P, R, C, S, M, H, X, D, K>;

    fn comb<L: Logic>(&self, q: &Self::Reg<L>, i: &Self::In<L>) -> Self::Net<L> {
        const { assert!(AXES >= 1 && AXES <= 3, "a segment has words for three axes") };
        let search = Instance::settle(
            &self.search,
            &q.search,
            segment_search::In {
                start: q.sequencer.search,
                length: i.length,
                last: i.last,
                write: i.write_begin,
                write_segment: i.begin_segment,
                write_begin: i.begin_length,
            },
        );
        let store = Instance::settle(
            &self.store,
            &q.store,
            segment_store::In {
                write: i.write,
                write_address: i.write_address,
                write_data: i.write_data,
                fetch: q.sequencer.fetch,
                segment: q.search.segment,
            },
        );
        let (load, word, data) = (q.store.load, q.store.word, q.store.data);
        let measure = Instance::settle(
            &self.measure,
            &q.measure,
            arc_angle::In {
                start: q.sequencer.measure,
                offset: q.search.offset,
                curvature: q.sequencer.curvature,
                shift: q.sequencer.shift,
            },
        );
        let cordic = Instance::settle(
            &self.cordic,
            &q.cordic,
            cordic::In {
                start: q.sequencer.turn,
                radius: q.sequencer.radius,
                angle: q.measure.angle,
            },
        );
        let control = Instance::settle(
            &self.control,
            &q.control,
            coefficient_control::In {
                step: q.sequencer.project,
                halt: false.into(),
            },
        );
        let sequencer = Instance::settle(
            &self.sequencer,
            &q.sequencer,
            point_sequencer::In {
                start: i.start,
                found: q.search.done,
                loaded: q.store.loaded,
                measured: q.measure.done,
                turned: cordic.w.done,
                projected: q.control.done,
                load,
                word,
                data,
                offset: q.search.offset,
                arc_along: cordic.w.along,
                arc_across: cordic.w.across,
            },
        );
        let axes = Instance::settle_each(
            &self.axes,
            &q.axes,
            from_fn(|_| axis_row::In {
                load,
                word,
                data,
                copy: control.w.copy,
                fraction: control.w.fraction,
                top: control.w.top,
                commit: control.w.commit,
                along: sequencer.w.along,
                across: sequencer.w.across,
            }),
        );
        Net {
            points: from_fn(|axis| q.axes[axis].point),
            segment: q.search.segment,
            done: q.sequencer.done,
            busy: sequencer.w.busy,
            search,
            store,
            sequencer,
            measure,
            cordic,
            control,
            axes,
        }
    }

    fn next<L: Logic>(&self, q: Self::Reg<L>, w: &Self::Net<L>, _: &Self::In<L>) -> Self::Reg<L> {
        Reg {
            search: w.search.next(&self.search, q.search),
            store: w.store.next(&self.store, q.store),
            sequencer: w.sequencer.next(&self.sequencer, q.sequencer),
            measure: w.measure.next(&self.measure, q.measure),
            cordic: w.cordic.next(&self.cordic, q.cordic),
            control: w.control.next(&self.control, q.control),
            axes: Instance::next_each(&w.axes, &self.axes, q.axes),
        }
    }
}
