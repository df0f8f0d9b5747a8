//! Blends and lines as in the text: evaluates \[5\] and \[10\] at h by products, for every sample.
//!
//! ```text
//!                     ┌─────────────────────────────────────┐
//!  load, word, data ─▶│ share_step ▶ share ▶ weight ▶ row_x ├──▶ x, y, z
//!  modulus, step ────▶│                ▲▼           ▶ row_y ├──▶ done
//!  halt ─────────────▶│              control        ▶ row_z │
//!                     └─────────────────────────────────────┘
//! ```
//!
//! h = n/M is kept as whole and part, as in a [`DifferenceColumn`], so it is exact. It is rounded
//! only where it is used. So h is 1 at the end, and the point is A⁺.

use super::rotation_row::ROWS;
use super::{BlendRow, BlendWeight, Widths, blend_row, blend_weight};
use crate::circuits::blocks::difference_column::is_modulus;
use crate::circuits::blocks::{
    CoefficientControl, DifferenceColumn, RecordWord, coefficient_control, difference_column,
};
use crate::hdl::Opened;
use crate::prelude::*;

/// Number of the record word that holds h at the start of a segment; 1/M follows, as whole and
/// part.
pub const SHARE_WORD: u64 = 10;

/// Points of blends and lines by products.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BlendPoint {
    /// Widths of points, coefficients, moduli and records.
    pub widths: Widths,
}

impl BlendPoint {
    /// Ticks from `step` to the new point.
    pub const fn latency(&self) -> u64 {
        1 + 3 * self.control().latency()
    }

    const fn control(&self) -> CoefficientControl {
        let coefficient = self.widths.coefficient;
        CoefficientControl { coefficient }
    }

    /// The column of h.
    pub const fn share(&self) -> DifferenceColumn {
        self.column(SHARE_WORD, None)
    }

    const fn share_step(&self) -> DifferenceColumn {
        self.column(SHARE_WORD + 1, Some(SHARE_WORD + 2))
    }

    const fn column(&self, whole_word: u64, part_word: Option<u64>) -> DifferenceColumn {
        DifferenceColumn {
            widths: difference_column::Widths {
                whole: self.widths.coefficient,
                part: self.widths.fraction,
                data: self.widths.data,
            },
            whole_word,
            part_word,
        }
    }

    const fn row(&self, coordinate: u64) -> BlendRow {
        let widths = self.widths;
        BlendRow { widths, coordinate }
    }
}

signals! { for BlendPoint as c;
    /// Input ports.
    pub struct In {
        /// Word of a record.
        pub record: RecordWord(&c.widths.data) as Flat,
        /// M: number of samples of the segment.
        pub modulus: U(c.widths.fraction),
        /// Advances to the next point. Until `done`, `step` and `record` must be low.
        pub step: Bit,
        /// Aborts the point that is being computed.
        pub halt: Bit,
    }
    /// The blocks.
    pub struct Parts {
        /// h, in units of 2^−B.
        pub share: Part<DifferenceColumn>(c.share()),
        /// 1/M, in units of 2^−B.
        pub share_step: Part<DifferenceColumn>(c.share_step()),
        /// Counter of the bits of a product.
        pub control: Part<CoefficientControl>(c.control()),
        /// (2 − h)h³.
        pub weight: Part<BlendWeight>(BlendWeight { coefficient: c.widths.coefficient }),
        /// Coordinates X, Y and Z.
        pub rows: [Part<BlendRow>(c.row(k as u64)); k in 3] as Elements(ROWS),
    }
    /// Output ports.
    pub struct Net {
        /// X of the vector from A⁻ to the point.
        pub x: I(c.widths.point) as Analog,
        /// Y of the vector from A⁻ to the point.
        pub y: I(c.widths.point) as Analog,
        /// Z of the vector from A⁻ to the point.
        pub z: I(c.widths.point) as Analog,
        /// High for one tick, when a new point is valid.
        pub done: Bit,
    }
}

impl Circuit for BlendPoint {
    const NAME: &'static str = "blend_point";
    const ABOUT: &'static str = "next point of a blend or line, by products at h";
    records!(In, Nothing, Net, Parts);

    fn tick(&self, i: In, _: Nothing, p: Parts) -> (Net, Nothing) {
        let share = p.share.settle(difference_column::In {
            record: i.record.clone(),
            modulus: i.modulus,
            step: i.step,
            by_whole: p.share_step.q.whole,
            by_part: p.share_step.q.part,
        });
        // A constant: it is only loaded.
        p.share_step.settle(difference_column::In {
            record: i.record.clone(),
            modulus: i.modulus,
            ..difference_column::In::low(&self.share_step())
        });
        let control = p.control.settle(coefficient_control::In {
            step: p.weight.q.begins,
            halt: i.halt,
        });
        let weight = p.weight.settle(blend_weight::In {
            step: i.step,
            halt: i.halt,
            copy: control.w.copy,
            fraction: control.w.fraction,
            commit: control.w.commit,
            share: share.w.nearest,
        });
        let [x, y, z] = [0, 1, 2].map(|k: usize| p.rows[k].q.offset);
        settle_each(p.rows, |_| blend_row::In {
            record: i.record.clone(),
            copy: control.w.copy,
            fraction: control.w.fraction,
            commit: weight.w.point_commit,
            share_bit: weight.w.share_bit,
            weight_bit: weight.w.weight_bit,
        });
        let done = weight.q.done;
        (Net { x, y, z, done }, Nothing)
    }

    fn properties(&self, now: &Moment<Self>) -> Vec<Property> {
        let i = &now.i;
        let parts = "the parts of both columns are less than the modulus when step is high";
        let parts = (parts, are_parts(i.modulus, &now.p));
        difference_column::given(i.step, i.record.load, i.modulus, parts)
    }
}

/// High if the columns hold parts of a modulus.
fn are_parts(modulus: U, p: &Parts<Open>) -> Bit {
    let columns = [&p.share, &p.share_step];
    Bit::all(columns.map(|column| column.q.part.below(modulus)))
}

/// High if the block keeps its assumptions about modulus and parts, each on its own.
pub(crate) fn of_record(point: &Opened<BlendPoint>) -> [Bit; 2] {
    let (step, modulus) = (point.i.step, point.i.modulus);
    [
        !step | is_modulus(modulus),
        !step | are_parts(modulus, &point.p),
    ]
}
