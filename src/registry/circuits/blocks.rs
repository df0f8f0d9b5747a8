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

/// Blocks that several circuits share.
pub(super) const CIRCUITS: &[Entry] = &[
    entry!(
        MulDiv, "block: sequential arithmetic",
        full: MulDiv::new(25, 58),
        small: MulDiv::new(2, 3), proved: true,
    ),
    entry!(
        Scaler, "block: gains of CN104204977 and others",
        full: Scaler { gain: 24, value: 58 },
        small: Scaler { gain: 3, value: 4 }, proved: true,
    ),
    entry!(
        EnableCounter, "block: scan and sample enables, 30 of JP3640909B2",
        full: EnableCounter { width: 24 },
        small: EnableCounter { width: 3 }, proved: true,
    ),
    entry!(
        QuadratureCounter, "block: 13 of JP3608587B2 and others",
        full: QuadratureCounter { width: 32 },
        small: QuadratureCounter { width: 3 }, proved: true,
    ),
    entry!(
        DifferenceColumn, "block: differences of JPH0743606B2 [5], [10]",
        full: engine(Widths::default()).difference(1),
        small: engine(Widths { whole: 3, part: 3, data: 3 }).difference(1), proved: true,
    ),
    entry!(
        DifferenceEngine, "block: polynomials of JPH0743606B2, CN104204977",
        full: engine(Widths::default()),
        small: engine(Widths { whole: 4, part: 9, data: 9 }),
    ),
    entry!(
        CoefficientControl, "block: bit counter of sequential products",
        full: CoefficientControl { coefficient: 42 },
        small: CoefficientControl { coefficient: 4 }, proved: true,
    ),
    entry!(
        Shifter, "block: CORDIC",
        full: Shifter { width: 55 },
        small: Shifter { width: 4 }, proved: true,
    ),
    entry!(
        CordicState, "block: sine and cosine",
        full: CordicState { radius: 55, angle: 44 },
        small: CordicState { radius: 4, angle: 4 },
    ),
    entry!(
        Cordic, "block: sine and cosine",
        full: Cordic { radius: 55, angle: 44 },
        small: Cordic { radius: 8, angle: 8 },
    ),
    entry!(
        RecordMemory, "block: buffer of segment records",
        full: RecordMemory { record: 4, data: 42 },
        small: RecordMemory { record: 1, data: 4 },
    ),
    entry!(
        RecordSequencer, "block: sequence of segment records",
        full: RecordSequencer { modulus: 41, samples: 20, data: 42, waits: false },
        small: RecordSequencer { modulus: 2, samples: 2, data: 5, waits: false }, proved: true,
    ),
];
