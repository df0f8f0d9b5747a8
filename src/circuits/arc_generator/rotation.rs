//! Rotation stage: computes GPi = R·GPi−1, step 2 of the text's section (ロ), with a matrix that is
//! computed once.
//!
//! ```text
//!                     ┌───────────────────────┐
//!  load, word, data ─▶│ control ▶ row_x       ├──▶ x, y, z
//!  step ─────────────▶│         ▶ row_y       ├──▶ done
//!  halt ─────────────▶│         ▶ row_z       │
//!                     └───────────────────────┘
//! ```
//!
//! Each point takes nine products and six additions, as a bit-serial multiply-accumulate in each
//! row. All three coordinates change at once.

use super::rotation_row::{self, ROWS};
use super::{RotationRow, Rounding, Widths};
use crate::circuits::blocks::{CoefficientControl, RecordWord, coefficient_control};
use crate::prelude::*;

/// Rotation of vectors by a matrix of coefficients; see [`RotationRow`].
///
/// The new point is valid B + 4 ticks after `step`, where B is the number of fraction bits of a
/// coefficient: all but two.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Rotation {
    /// Widths of points, coefficients and records.
    pub widths: Widths,
    /// Rounding of the points.
    pub rounding: Rounding,
}

impl Rotation {
    /// Ticks from `step` to the new point.
    pub const fn latency(&self) -> u64 {
        self.control().latency()
    }

    const fn control(&self) -> CoefficientControl {
        let coefficient = self.widths.coefficient;
        CoefficientControl { coefficient }
    }

    const fn row(&self, coordinate: u64) -> RotationRow {
        RotationRow {
            widths: self.widths,
            coordinate,
            rounding: self.rounding,
        }
    }
}

signals! { for Rotation as c;
    /// Input ports.
    pub struct In {
        /// Word of a record.
        pub record: RecordWord(&c.widths.data) as Flat,
        /// Advances to the next point. No record word may come before `done`.
        pub step: Bit,
        /// Aborts a running step.
        pub halt: Bit,
    }
    /// The blocks.
    pub struct Parts {
        /// Bit counter of the coefficients.
        pub control: Part<CoefficientControl>(c.control()),
        /// Coordinates X, Y and Z.
        pub rows: [Part<RotationRow>(c.row(k as u64)); k in 3] as Elements(ROWS),
    }
    /// Output ports.
    pub struct Net {
        /// X of the vector from the centre to the point.
        pub x: I(c.widths.point) as Analog,
        /// Y of the vector from the centre to the point.
        pub y: I(c.widths.point) as Analog,
        /// Z of the vector from the centre to the point.
        pub z: I(c.widths.point) as Analog,
        /// High for one tick, when a new point is valid.
        pub done: Bit,
    }
}

impl Circuit for Rotation {
    const NAME: &'static str = "rotation";
    const ABOUT: &'static str = "next point of an arc: a constant matrix times a vector";
    records!(In, Nothing, Net, Parts);

    fn tick(&self, i: In, _: Nothing, p: Parts) -> (Net, Nothing) {
        let control = p.control.settle(coefficient_control::In {
            step: i.step,
            halt: i.halt,
        });
        let [x, y, z] = [0, 1, 2].map(|k: usize| p.rows[k].q.offset);
        settle_each(p.rows, |_| rotation_row::In {
            record: i.record.clone(),
            copy: control.w.copy,
            fraction: control.w.fraction,
            top: control.w.top,
            commit: control.w.commit,
            x,
            y,
            z,
        });
        let done = control.q.done;
        (Net { x, y, z, done }, Nothing)
    }
}
