//! Rotation stage: GPi = R·GPi−1, step 2 of the text's section (ロ), with a matrix that is computed once.
//!
//! ```text
//!                     ┌───────────────────────┐
//!  load, word, data ─▶│ control ▶ row_x       ├──▶ x, y, z
//!  step ─────────────▶│         ▶ row_y       ├──▶ done
//!  halt ─────────────▶│         ▶ row_z       │
//!                     └───────────────────────┘
//! ```
//!
//! Nine products and six additions for each point, as a bit-serial multiply-accumulate in each
//! row. All three coordinates change at once.

use super::{RotationRow, Rounding, rotation_row};
use crate::blocks::{CoefficientControl, coefficient_control};
use crate::kernel::{Circuit, Instance};
use crate::logic::Logic;
use crate::signals;

signals! {
    /// Ports in.
    pub struct In<L, const D: usize> {
        /// `data` is word `word` of a record; not during a step.
        pub load: L::Bit,
        /// Number of the word.
        pub word: L::U<5>,
        /// Its data.
        pub data: L::U<D> as Hex,
        /// On to the next point.
        pub step: L::Bit,
        /// Gives a step up that is under way.
        pub halt: L::Bit,
    }
}

signals! {
    /// Registers of the blocks.
    pub struct Reg<L, const P: usize, const C: usize, const S: usize> {
        /// Which bit it is at.
        pub control: coefficient_control::Reg<L>,
        /// X.
        pub row_x: rotation_row::Reg<L, P, C, S>,
        /// Y.
        pub row_y: rotation_row::Reg<L, P, C, S>,
        /// Z.
        pub row_z: rotation_row::Reg<L, P, C, S>,
    }
}

signals! {
    /// Nets of the blocks, and the ports out.
    pub struct Net<L, const P: usize, const C: usize, const S: usize, const D: usize> {
        /// Which bit it is at.
        pub control: Instance<CoefficientControl<C>, L>,
        /// X.
        pub row_x: Instance<RotationRow<P, C, S, D>, L>,
        /// Y.
        pub row_y: Instance<RotationRow<P, C, S, D>, L>,
        /// Z.
        pub row_z: Instance<RotationRow<P, C, S, D>, L>,
        /// X of the vector from the centre to the point.
        pub x: L::I<P> as Analog,
        /// Y of it.
        pub y: L::I<P> as Analog,
        /// Z of it.
        pub z: L::I<P> as Analog,
        /// They are new in this tick.
        pub done: L::Bit,
    }
}

/// Rotation of vectors of `P` bits by coefficients of `C` bits; see [`RotationRow`].
///
/// The new point stands B + 4 ticks after `step`, B = `C` − 2.
#[derive(Debug, Clone, Default)]
pub struct Rotation<const P: usize, const C: usize, const S: usize, const D: usize> {
    /// Which bit it is at.
    pub control: CoefficientControl<C>,
    /// X.
    pub row_x: RotationRow<P, C, S, D>,
    /// Y.
    pub row_y: RotationRow<P, C, S, D>,
    /// Z.
    pub row_z: RotationRow<P, C, S, D>,
}

impl<const P: usize, const C: usize, const S: usize, const D: usize> Rotation<P, C, S, D> {
    /// Ticks from `step` to the new point.
    pub const LATENCY: u64 = CoefficientControl::<C>::LATENCY;

    /// A rotation that rounds by `rounding`.
    pub fn new(rounding: Rounding) -> Self {
        let row = |coordinate| RotationRow {
            coordinate,
            rounding,
        };
        Rotation {
            control: CoefficientControl,
            row_x: row(0),
            row_y: row(1),
            row_z: row(2),
        }
    }
}

impl<const P: usize, const C: usize, const S: usize, const D: usize> Circuit
    for Rotation<P, C, S, D>
{
    const NAME: &'static str = "rotation";
    const ABOUT: &'static str = "the next point of an arc: a constant matrix times a vector";
    type In<L: Logic> = In<L, D>;
    type Reg<L: Logic> = Reg<L, P, C, S>;
    type Net<L: Logic> = Net<L, P, C, S, D>;

    fn comb<L: Logic>(&self, q: &Reg<L, P, C, S>, i: &In<L, D>) -> Net<L, P, C, S, D> {
        let control = Instance::settle(
            &self.control,
            &q.control,
            coefficient_control::In {
                step: i.step,
                halt: i.halt,
            },
        );
        let row = || rotation_row::In {
            load: i.load,
            word: i.word,
            data: i.data,
            copy: control.w.copy,
            fraction: control.w.fraction,
            top: control.w.top,
            commit: control.w.commit,
            x: q.row_x.offset,
            y: q.row_y.offset,
            z: q.row_z.offset,
        };
        Net {
            row_x: Instance::settle(&self.row_x, &q.row_x, row()),
            row_y: Instance::settle(&self.row_y, &q.row_y, row()),
            row_z: Instance::settle(&self.row_z, &q.row_z, row()),
            x: q.row_x.offset,
            y: q.row_y.offset,
            z: q.row_z.offset,
            done: q.control.done,
            control,
        }
    }

    fn next<L: Logic>(
        &self,
        q: Reg<L, P, C, S>,
        w: &Net<L, P, C, S, D>,
        _: &In<L, D>,
    ) -> Reg<L, P, C, S> {
        Reg {
            control: w.control.next(&self.control, q.control),
            row_x: w.row_x.next(&self.row_x, q.row_x),
            row_y: w.row_y.next(&self.row_y, q.row_y),
            row_z: w.row_z.next(&self.row_z, q.row_z),
        }
    }
}
