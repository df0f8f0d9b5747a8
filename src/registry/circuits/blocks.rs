use super::make::{FLAGS, one_of, only, width};
use crate::circuits::blocks::{
    CoefficientControl, Cordic, CordicState, DifferenceColumn, DifferenceEngine, EnableCounter,
    MulDiv, QuadratureCounter, RecordMemory, RecordSequencer, Shifter, difference_column::Widths,
};
use crate::registry::Entry;
use crate::registry::entry::{alone, entry, nothing};

/// The engine of x.
fn engine(widths: Widths) -> DifferenceEngine {
    DifferenceEngine {
        widths,
        coordinate: 0,
    }
}

/// Its first difference.
fn column(widths: Widths) -> DifferenceColumn {
    engine(widths).difference(1)
}

/// Blocks that more than one circuit is made of.
pub(super) const CIRCUITS: &[Entry] = &[
    entry!(
        MulDiv, "block: sequential arithmetic",
        full: || MulDiv { multiplier: 25, word: 58 },
        widths: [multiplier, word],
        from: "width of the words; the multiplier has one bit less",
        |given| alone(given, |word| MulDiv { multiplier: word.saturating_sub(1), word }),
        with: nothing,
        proved: 3,
    ),
    entry!(
        EnableCounter, "block: scan and sample enables, 30 of JP3640909B2",
        full: || EnableCounter { width: 24 },
        widths: [width],
        from: "width", |given| alone(given, |width| EnableCounter { width }),
        with: nothing,
        proved: 3,
    ),
    entry!(
        QuadratureCounter, "block: 13 of JP3608587B2 and others",
        full: || QuadratureCounter { width: 32 },
        widths: [width],
        from: "width", |given| alone(given, |width| QuadratureCounter { width }),
        with: nothing,
        proved: 3,
    ),
    entry!(
        DifferenceColumn, "block: a difference of JPH0743606B2 [5], [10]",
        full: || column(Widths::default()),
        widths: [whole = widths.whole, part = widths.part, data = widths.data],
        from: "width of wholes and parts", |given| alone(given, |width| {
            column(Widths { whole: width, part: width, data: width })
        }),
        with: nothing,
        proved: 3,
    ),
    entry!(
        DifferenceEngine, "block: polynomials of JPH0743606B2, CN104204977",
        full: || engine(Widths::default()),
        widths: [whole = widths.whole, part = widths.part, data = widths.data],
        from: "width of points", |given| alone(given, |whole| {
            engine(Widths { whole, part: 2 * whole + 1, data: 2 * whole + 1 })
        }),
        with: nothing,
        proved: none,
    ),
    entry!(
        CoefficientControl, "block: which bit of a sequential product",
        full: || CoefficientControl { coefficient: 42 },
        widths: [coefficient],
        from: "width of a coefficient",
        |given| alone(given, |coefficient| CoefficientControl { coefficient }),
        with: nothing,
        proved: 4,
    ),
    entry!(
        Shifter, "block: CORDIC",
        full: || Shifter { width: 55 },
        widths: [width],
        from: "width", |given| alone(given, |width| Shifter { width }),
        with: nothing,
        proved: 4,
    ),
    entry!(
        CordicState, "block: sine and cosine",
        full: || CordicState { radius: 55, angle: 44 },
        widths: [radius, angle],
        from: "width of coordinates and angles",
        |given| alone(given, |width| CordicState { radius: width, angle: width }),
        with: nothing,
        proved: none,
    ),
    entry!(
        Cordic, "block: sine and cosine",
        full: || Cordic { radius: 55, angle: 44 },
        widths: [radius, angle],
        from: "width of coordinates and angles",
        |given| alone(given, |width| Cordic { radius: width, angle: width }),
        with: nothing,
        proved: none,
    ),
    entry!(
        RecordMemory, "block: records that wait",
        full: || RecordMemory { record: 4, data: 42 },
        widths: [record, data],
        from: "width of a word (two records)",
        |given| alone(given, |data| RecordMemory { record: 1, data }),
        with: nothing,
        proved: none,
    ),
    entry!(
        RecordSequencer, "block: record after record",
        full: || RecordSequencer { modulus: 41, samples: 20, data: 42, waits: false },
        widths: [modulus, samples, data],
        from: "width of moduli (a word has three bits more), 1 to wait for every point", |given| {
            let (width, waits) = (width(given)?, one_of(given, FLAGS)?);
            Some(RecordSequencer { modulus: width, samples: width, data: width + 3, waits })
        },
        with: |sequencer, given| Some(RecordSequencer { waits: only(given, FLAGS)?, ..sequencer }),
        proved: 2,
    ),
];
