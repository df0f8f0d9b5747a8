use super::make::FLAGS;
use crate::circuits::blocks::{
    CoefficientControl, Cordic, CordicState, DifferenceColumn, DifferenceEngine, EnableCounter,
    MulDiv, QuadratureCounter, RecordMemory, RecordSequencer, Scaler, Shifter,
    difference_column::Widths,
};
use crate::registry::Entry;
use crate::registry::entry::entry;

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
        by: "width of the words; the multiplier has one bit less",
        |word| MulDiv { multiplier: word.saturating_sub(1), word },
        proved: 3,
    ),
    entry!(
        Scaler, "block: a gain, of CN104204977 and others",
        full: || Scaler { gain: 24, value: 58 },
        widths: [gain, value],
        by: "width of a gain; a value has as many bits", |gain| Scaler { gain, value: gain + 1 },
        proved: 3,
    ),
    entry!(
        EnableCounter, "block: scan and sample enables, 30 of JP3640909B2",
        full: || EnableCounter { width: 24 },
        widths: [width],
        by: "width", |width| EnableCounter { width },
        proved: 3,
    ),
    entry!(
        QuadratureCounter, "block: 13 of JP3608587B2 and others",
        full: || QuadratureCounter { width: 32 },
        widths: [width],
        by: "width", |width| QuadratureCounter { width },
        proved: 3,
    ),
    entry!(
        DifferenceColumn, "block: a difference of JPH0743606B2 [5], [10]",
        full: || column(Widths::default()),
        widths: [whole, part, data in widths],
        by: "width of wholes and parts",
        |width| column(Widths { whole: width, part: width, data: width }),
        proved: 3,
    ),
    entry!(
        DifferenceEngine, "block: polynomials of JPH0743606B2, CN104204977",
        full: || engine(Widths::default()),
        widths: [whole, part, data in widths],
        by: "width of points",
        |whole| engine(Widths { whole, part: 2 * whole + 1, data: 2 * whole + 1 }),
        proved: none,
    ),
    entry!(
        CoefficientControl, "block: which bit of a sequential product",
        full: || CoefficientControl { coefficient: 42 },
        widths: [coefficient],
        by: "width of a coefficient", |coefficient| CoefficientControl { coefficient },
        proved: 4,
    ),
    entry!(
        Shifter, "block: CORDIC",
        full: || Shifter { width: 55 },
        widths: [width],
        by: "width", |width| Shifter { width },
        proved: 4,
    ),
    entry!(
        CordicState, "block: sine and cosine",
        full: || CordicState { radius: 55, angle: 44 },
        widths: [radius, angle],
        by: "width of coordinates and angles", |width| CordicState { radius: width, angle: width },
        proved: none,
    ),
    entry!(
        Cordic, "block: sine and cosine",
        full: || Cordic { radius: 55, angle: 44 },
        widths: [radius, angle],
        by: "width of coordinates and angles", |width| Cordic { radius: width, angle: width },
        proved: none,
    ),
    entry!(
        RecordMemory, "block: records that wait",
        full: || RecordMemory { record: 4, data: 42 },
        widths: [record, data],
        by: "width of a word (two records)", |data| RecordMemory { record: 1, data },
        proved: none,
    ),
    entry!(
        RecordSequencer, "block: record after record",
        full: || RecordSequencer { modulus: 41, samples: 20, data: 42, waits: false },
        widths: [modulus, samples, data],
        by: "width of moduli (a word has three bits more), 1 to wait for every point",
        |width, waits of FLAGS| RecordSequencer {
            modulus: width,
            samples: width,
            data: width + 3,
            waits,
        },
        proved: 2,
    ),
];
