//! Path point: computes the point at a length along the path (equations (1) and (5)).
//!
//! ```text
//!                      ┌──────────────────────────────┐
//!  start, length ─────▶│ search ▶ store ▶ sequencer   ├──▶ points, segment
//!  last ──────────────▶│   ▶ arc_angle ▶ cordic       ├──▶ done, busy
//!  write_path, … ─────▶│   ▶ length_powers            │
//!                      │   ▶ rows of x, y, z, w       │
//!                      └──────────────────────────────┘
//! ```
//!
//! Axis distribution 3 is this circuit with the length q_c from interpolation and acceleration 1.
//! Reference point 2 is this circuit with the length q_s of the tangential servo response, and the
//! same segments. The point does not depend on earlier lengths.

use super::widths::PointWidths;
use super::{
    ArcAngle, AxisRow, LengthPowers, PointSequencer, SegmentSearch, SegmentStore, arc_angle,
    axis_row, length_powers, point_sequencer, segment_search, segment_store,
};
use crate::circuits::blocks::{CoefficientControl, Cordic, coefficient_control, cordic};
use crate::prelude::*;

/// Names of the axes.
pub const AXIS_NAMES: [&str; 4] = ["x", "y", "z", "w"];
/// Largest number of axes.
pub const AXES: usize = AXIS_NAMES.len();

/// Names of a signal, one for each axis.
macro_rules! of_axes {
    ($name:literal) => {
        &[
            concat!($name, "_x"),
            concat!($name, "_y"),
            concat!($name, "_z"),
            concat!($name, "_w"),
        ]
    };
}
pub(super) use of_axes;

/// Path point.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PathPoint {
    /// Word widths, by name.
    pub widths: PointWidths,
    /// Number of axes, 1 to 4. A fourth axis has its own words in a segment.
    pub axes: usize,
    /// Number of the segment word that is the radius of an arc.
    pub radius_word: u64,
}

impl PathPoint {
    /// Ticks from `start` to `done` on a line: search, segment, projection, and a register after
    /// each.
    pub const fn line_latency(&self) -> u64 {
        let widths = self.inner();
        let (search, store) = (SegmentSearch { widths }, SegmentStore { widths });
        search.latency() + store.latency() + self.control().latency() + 4
    }

    /// Ticks from `start` to `done` in the worst case: the smallest arc, whose angle is shifted
    /// most, or the longest spline.
    pub const fn latency(&self) -> u64 {
        let widths = self.widths;
        let measure = ArcAngle { widths }.latency() + (widths.angle as u64 - 3);
        let arc = measure + self.cordic().latency() + 2;
        let spline = LengthPowers { widths }.latency() + 1;
        self.line_latency() + if arc > spline { arc } else { spline }
    }

    /// The widths of its blocks.
    const fn inner(&self) -> PointWidths {
        self.widths.of_axes(self.axes)
    }

    const fn cordic(&self) -> Cordic {
        Cordic {
            radius: self.widths.radius,
            angle: self.widths.angle,
        }
    }

    const fn control(&self) -> CoefficientControl {
        let coefficient = self.widths.coefficient;
        CoefficientControl { coefficient }
    }
}

signals! { for PointWidths as c;
    /// Segments of a path, as the control computer writes them.
    pub struct PathWrite {
        /// Writes the length at which a segment begins.
        pub write_begin: Bit,
        /// Number of the segment to write.
        pub begin_segment: U(c.segment),
        /// Length at which the segment begins, in guard units.
        pub begin_length: U(c.point),
        /// Writes a word of a segment.
        pub write_path: Bit,
        /// Number of the segment, with the number of the word in the lowest bits.
        pub path_address: U(c.address()) as Hex,
        /// Word to write.
        pub path_data: U(c.data) as Hex,
    }
}

signals! { for PathPoint as c;
    /// Input ports.
    pub struct In {
        /// Starts the computation of a point; ignored while `busy`.
        pub start: Bit,
        /// Length along the path, from 0 to its end, in guard units; sampled in the tick after
        /// `start`.
        pub length: U(c.widths.point),
        /// Number of the last segment of the path.
        pub last: U(c.widths.segment),
        /// Port through which segments of the path are written.
        pub path: PathWrite(&c.inner()) as Flat,
    }
    /// The blocks.
    pub struct Parts {
        /// Search for the segment.
        pub search: Part<SegmentSearch>(SegmentSearch { widths: c.widths }),
        /// Memory of the segments.
        pub store: Part<SegmentStore>(SegmentStore { widths: c.inner() }),
        /// Sequencer of the blocks.
        pub sequencer: Part<PointSequencer>(PointSequencer {
            widths: c.inner(),
            radius_word: c.radius_word,
        }),
        /// Length to angle.
        pub measure: Part<ArcAngle>(ArcAngle { widths: c.widths }),
        /// Angle to point.
        pub cordic: Part<Cordic>(c.cordic()),
        /// Length to powers.
        pub powers: Part<LengthPowers>(LengthPowers { widths: c.widths }),
        /// Bit counter of the coefficients.
        pub control: Part<CoefficientControl>(c.control()),
        /// Rows of the axes.
        pub axes: [Part<AxisRow>(AxisRow { widths: c.inner(), coordinate: k as u64 }); k in c.axes]
            as Elements(&AXIS_NAMES),
    }
    /// Output ports.
    pub struct Net {
        /// Coordinate of the point, in guard units.
        pub points: [I(c.widths.point); c.axes] as Elements(of_axes!("point")),
        /// Number of the segment of the point.
        pub segment: U(c.widths.segment),
        /// High for one tick: the point is valid.
        pub done: Bit,
        /// A point is being computed.
        pub busy: Bit,
    }
}

impl Circuit for PathPoint {
    const NAME: &'static str = "path_point";
    const ABOUT: &'static str = "point at a length along a path of lines, arcs and splines";
    records!(In, Nothing, Net, Parts);

    fn tick(&self, i: In, _: Nothing, p: Parts) -> (Net, Nothing) {
        let search = p.search.settle(segment_search::In {
            start: p.sequencer.q.search,
            length: i.length,
            last: i.last,
            write: i.path.write_begin,
            write_segment: i.path.begin_segment,
            write_begin: i.path.begin_length,
        });
        let store = p.store.settle(segment_store::In {
            write: i.path.write_path,
            write_address: i.path.path_address,
            write_data: i.path.path_data,
            fetch: p.sequencer.q.fetch,
            segment: search.q.segment,
        });
        let (load, word, data) = (store.q.load, store.q.word, store.q.data);
        let measure = p.measure.settle(arc_angle::In {
            start: p.sequencer.q.measure,
            offset: search.q.offset,
            curvature: p.sequencer.q.curvature,
            shift: p.sequencer.q.shift,
        });
        let cordic = p.cordic.settle(cordic::In {
            start: p.sequencer.q.turn,
            radius: p.sequencer.q.radius,
            angle: measure.q.angle,
            ..cordic::In::low(&self.cordic())
        });
        let powers = p.powers.settle(length_powers::In {
            start: p.sequencer.q.raise,
            offset: search.q.offset,
            shift: p.sequencer.q.shift,
        });
        let control = p.control.settle(coefficient_control::In {
            step: p.sequencer.q.project,
            halt: Bit::low(),
        });
        let sequencer = p.sequencer.settle(point_sequencer::In {
            start: i.start,
            found: search.q.done,
            loaded: store.q.loaded,
            measured: measure.q.done,
            turned: cordic.w.done,
            raised: powers.q.done,
            projected: control.q.done,
            load,
            word,
            data,
            offset: search.q.offset,
            arc_along: cordic.w.along,
            arc_across: cordic.w.across,
            square: powers.q.factor,
            cube: powers.q.product,
        });
        let axes = settle_each(p.axes, |_| axis_row::In {
            load,
            word,
            data,
            copy: control.w.copy,
            fraction: control.w.fraction,
            top: control.w.top,
            commit: control.w.commit,
            along: sequencer.w.along,
            across: sequencer.w.across,
            third: sequencer.w.third,
        });
        let net = Net {
            points: axes.iter().map(|axis| axis.q.point).collect(),
            segment: search.q.segment,
            done: sequencer.q.done,
            busy: sequencer.w.busy,
        };
        (net, Nothing)
    }

    fn objection(&self) -> Option<String> {
        let placed = (1..=4).contains(&self.axes);
        (!placed).then(|| "a segment has words for four axes".into())
    }
}
