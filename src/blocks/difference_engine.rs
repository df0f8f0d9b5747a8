//! Difference engine of one coordinate: equations \[5\] and \[10\] of JPH0743606B2
//! with four adders.
//!
//! ```text
//!                     ┌───────────────────┐
//!  load, word, data ─▶│ value ◀ d1 ◀ d2   │
//!  modulus ──────────▶│       ◀ d3 ◀ d4   ├──▶ value, nearest
//!  step ─────────────▶│                   │
//!                     └───────────────────┘
//! ```
//!
//! A polynomial of the fourth degree at equal distances has constant fourth differences. A step
//! adds each difference to what is above it, all from the values before the step, so the value of
//! the next sample costs four additions and no product. With the first difference alone it is a
//! line.

use super::{DifferenceColumn, difference_column};
use crate::kernel::{Circuit, Instance};
use crate::logic::Logic;
use crate::signals;

signals! {
    /// Ports in.
    pub struct In<L, const F: usize, const D: usize> {
        /// `data` is word `word` of a record.
        pub load: L::Bit,
        /// Number of the word.
        pub word: L::U<5>,
        /// Its data.
        pub data: L::U<D> as Hex,
        /// What the parts are parts of: M⁴ in a blend of M samples, the samples of a line.
        pub modulus: L::U<F>,
        /// On to the next sample; not with `load`.
        pub step: L::Bit,
    }
}

signals! {
    /// Registers of the columns.
    pub struct Reg<L, const P: usize, const F: usize> {
        /// The coordinate.
        pub value: difference_column::Reg<L, P, F>,
        /// First difference.
        pub d1: difference_column::Reg<L, P, F>,
        /// Second difference.
        pub d2: difference_column::Reg<L, P, F>,
        /// Third difference.
        pub d3: difference_column::Reg<L, P, F>,
        /// Fourth difference, constant.
        pub d4: difference_column::Reg<L, P, F>,
    }
}

signals! {
    /// Nets of the columns, and the port out.
    pub struct Net<L, const P: usize, const F: usize, const D: usize> {
        /// The coordinate.
        pub value: Instance<DifferenceColumn<P, F, D>, L>,
        /// First difference.
        pub d1: Instance<DifferenceColumn<P, F, D>, L>,
        /// Second difference.
        pub d2: Instance<DifferenceColumn<P, F, D>, L>,
        /// Third difference.
        pub d3: Instance<DifferenceColumn<P, F, D>, L>,
        /// Fourth difference.
        pub d4: Instance<DifferenceColumn<P, F, D>, L>,
        /// The coordinate, rounded to the nearest.
        pub nearest: L::I<P> as Analog,
    }
}

/// Difference engine with wholes of `P` bits and parts of `F`, for records with words of `D` bits.
///
/// The value of the next sample stands in the tick after `step`.
#[derive(Debug, Clone)]
pub struct DifferenceEngine<const P: usize, const F: usize, const D: usize> {
    /// The coordinate.
    pub value: DifferenceColumn<P, F, D>,
    /// First difference.
    pub d1: DifferenceColumn<P, F, D>,
    /// Second difference.
    pub d2: DifferenceColumn<P, F, D>,
    /// Third difference.
    pub d3: DifferenceColumn<P, F, D>,
    /// Fourth difference.
    pub d4: DifferenceColumn<P, F, D>,
}

impl<const P: usize, const F: usize, const D: usize> DifferenceEngine<P, F, D> {
    /// The engine of a coordinate: 0, 1, 2 for x, y, z. It decides which words of a record it
    /// takes.
    pub fn new(coordinate: u64) -> Self {
        let difference = |order: u64| DifferenceColumn {
            whole_word: 8 + 8 * coordinate + 2 * (order - 1),
            part_word: Some(9 + 8 * coordinate + 2 * (order - 1)),
        };
        DifferenceEngine {
            value: DifferenceColumn {
                whole_word: 2 + coordinate,
                part_word: None,
            },
            d1: difference(1),
            d2: difference(2),
            d3: difference(3),
            d4: difference(4),
        }
    }
}

impl<const P: usize, const F: usize, const D: usize> Default for DifferenceEngine<P, F, D> {
    fn default() -> Self {
        Self::new(0)
    }
}

/// The ports in of a column with `below` it.
fn column<L: Logic, const P: usize, const F: usize, const D: usize>(
    i: &In<L, F, D>,
    (by_whole, by_part): (L::I<P>, L::U<F>),
) -> difference_column::In<L, P, F, D> {
    difference_column::In {
        load: i.load,
        word: i.word,
        data: i.data,
        modulus: i.modulus,
        step: i.step,
        by_whole,
        by_part,
    }
}

impl<const P: usize, const F: usize, const D: usize> Circuit for DifferenceEngine<P, F, D> {
    const NAME: &'static str = "difference_engine";
    const ABOUT: &'static str = "quartic of one coordinate at equal distances, by four adders";
    type In<L: Logic> = In<L, F, D>;
    type Reg<L: Logic> = Reg<L, P, F>;
    type Net<L: Logic> = Net<L, P, F, D>;

    fn comb<L: Logic>(&self, q: &Reg<L, P, F>, i: &In<L, F, D>) -> Net<L, P, F, D> {
        let below = |of: &difference_column::Reg<L, P, F>| (of.whole, of.part);
        let nothing = (0.into(), 0.into());
        let value = Instance::settle(&self.value, &q.value, column(i, below(&q.d1)));
        Net {
            nearest: value.w.nearest,
            value,
            d1: Instance::settle(&self.d1, &q.d1, column(i, below(&q.d2))),
            d2: Instance::settle(&self.d2, &q.d2, column(i, below(&q.d3))),
            d3: Instance::settle(&self.d3, &q.d3, column(i, below(&q.d4))),
            d4: Instance::settle(&self.d4, &q.d4, column(i, nothing)),
        }
    }

    fn next<L: Logic>(
        &self,
        q: Reg<L, P, F>,
        w: &Net<L, P, F, D>,
        _: &In<L, F, D>,
    ) -> Reg<L, P, F> {
        Reg {
            value: w.value.next(&self.value, q.value),
            d1: w.d1.next(&self.d1, q.d1),
            d2: w.d2.next(&self.d2, q.d2),
            d3: w.d3.next(&self.d3, q.d3),
            d4: w.d4.next(&self.d4, q.d4),
        }
    }
}
