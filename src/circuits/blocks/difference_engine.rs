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
//! A polynomial of the fourth degree, sampled at equal distances, has a constant fourth difference.
//! A step adds each difference to the one above, all with their values before the step. So the next
//! sample takes four additions and no multiplication. With the first difference alone, the
//! polynomial is a straight line.

use super::difference_column::{self, DifferenceColumn, Widths, is_modulus};
use super::record_memory::RecordWord;
use crate::hdl::Opened;
use crate::prelude::*;

/// Difference engine of a coordinate.
///
/// The value of the next sample is valid in the tick after `step`.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct DifferenceEngine {
    /// Widths of its numbers and of the records.
    pub widths: Widths,
    /// The coordinate: 0, 1, 2 for x, y, z. It decides which words of a record the engine takes.
    pub coordinate: u64,
}

impl DifferenceEngine {
    /// The column of the coordinate itself.
    pub fn value(&self) -> DifferenceColumn {
        DifferenceColumn {
            widths: self.widths,
            whole_word: 2 + self.coordinate,
            part_word: None,
        }
    }

    /// The column of the difference of that order, 1 to 4.
    pub fn difference(&self, order: u64) -> DifferenceColumn {
        let word = 8 + 8 * self.coordinate + 2 * (order - 1);
        DifferenceColumn {
            widths: self.widths,
            whole_word: word,
            part_word: Some(word + 1),
        }
    }
}

signals! { for DifferenceEngine as c;
    /// Input ports.
    pub struct In {
        /// Word of a record.
        pub record: RecordWord(&c.widths.data) as Flat,
        /// Modulus of the parts: M⁴ for a blend of M samples, the number of samples for a line.
        pub modulus: U(c.widths.part),
        /// Advances to the next sample. Not allowed together with `load`.
        pub step: Bit,
    }
    /// The columns.
    pub struct Parts {
        /// The coordinate.
        pub value: Part<DifferenceColumn>(c.value()),
        /// First difference.
        pub d1: Part<DifferenceColumn>(c.difference(1)),
        /// Second difference.
        pub d2: Part<DifferenceColumn>(c.difference(2)),
        /// Third difference.
        pub d3: Part<DifferenceColumn>(c.difference(3)),
        /// Fourth difference, constant.
        pub d4: Part<DifferenceColumn>(c.difference(4)),
    }
    /// Output port.
    pub struct Net {
        /// Coordinate, rounded to the nearest integer; halves round up.
        pub nearest: I(c.widths.whole) as Analog,
    }
}

impl Circuit for DifferenceEngine {
    const NAME: &'static str = "difference_engine";
    const ABOUT: &'static str = "samples of a quartic of one coordinate, by four adders";
    records!(In, Nothing, Net, Parts);

    fn tick(&self, i: In, _: Nothing, p: Parts) -> (Net, Nothing) {
        let column = |by_whole: I, by_part: U| difference_column::In {
            record: i.record.clone(),
            modulus: i.modulus,
            step: i.step,
            by_whole,
            by_part,
        };
        let value = p.value.settle(column(p.d1.q.whole, p.d1.q.part));
        p.d1.settle(column(p.d2.q.whole, p.d2.q.part));
        p.d2.settle(column(p.d3.q.whole, p.d3.q.part));
        p.d3.settle(column(p.d4.q.whole, p.d4.q.part));
        // The lowest one only is loaded.
        p.d4.settle(difference_column::In {
            record: i.record.clone(),
            modulus: i.modulus,
            ..difference_column::In::low(&self.difference(4))
        });
        let nearest = value.w.nearest;
        (Net { nearest }, Nothing)
    }

    fn properties(&self, now: &Moment<Self>) -> Vec<Property> {
        let i = &now.i;
        let parts = "the parts of all columns are less than the modulus when step is high";
        let parts = (parts, are_parts(i.modulus, &now.p));
        difference_column::given(i.step, i.record.load, i.modulus, parts)
    }
}

/// High if the columns hold parts of a modulus.
fn are_parts(modulus: U, p: &Parts<Open>) -> Bit {
    let columns = [&p.value, &p.d1, &p.d2, &p.d3, &p.d4];
    Bit::all(columns.map(|column| column.q.part.below(modulus)))
}

/// High if an engine keeps its assumptions about modulus and parts, each on its own.
pub(crate) fn of_record(engine: &Opened<DifferenceEngine>) -> [Bit; 2] {
    let (step, modulus) = (engine.i.step, engine.i.modulus);
    [
        !step | is_modulus(modulus),
        !step | are_parts(modulus, &engine.p),
    ]
}
