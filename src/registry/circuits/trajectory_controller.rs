use super::make::{ROUNDINGS, at_most, one_of};
use crate::registry::Entry;
use crate::registry::entry::{Made, at_width, entry, proved_at, some_widths};
use crate::trajectory_controller::{
    ArcAngle, AxisRow, ControlledAxis, Cordic, CordicState, LengthClamp, ModelState, PathLength,
    PathPoint, PeriodJoin, PointSequencer, ReferenceModel, Rounding, Scaler, SegmentSearch,
    SegmentStore, Servo, ServoArithmetic, Shifter, TrajectoryController, VectorCorrection,
    vector_correction::Correction,
};

/// The corrections by their numbers.
const CORRECTIONS: &[Correction] = &[Correction::Vector, Correction::None, Correction::Steady];

/// A join that waits for so many ticks.
fn join(given: &[u64]) -> Option<PeriodJoin> {
    at_most(given, 1)?;
    let wait = given.first().copied().unwrap_or(0);
    Some(PeriodJoin { wait })
}

/// The circuits of CN104204977.
pub(super) const CIRCUITS: &[Entry] = &[
    entry!(
        Scaler<24, 58>, Scaler, Some(3), "CN104204977 21, 23, 27, 29, 30: a gain",
        ["K" = 24, "Q" = 58], "width of a gain; a value has as many bits",
        proved_at!([3]; [4 8], |W| Scaler::<W, { W + 1 }>)
    ),
    entry!(
        ModelState<47, 16, 64>, ModelState::default(), None, "CN104204977 20, 22, 24, 25",
        ["P" = 47, "K" = 16, "Q" = 64], "width of positions and gains, 1 for rounding down",
        some_widths!([4 8], |given, W| ModelState::<W, W, { 2 * W + 1 }> {
            rounding: one_of(given, ROUNDINGS)?,
        })
    ),
    entry!(
        ReferenceModel<47, 16, 64>, ReferenceModel::default(), None, "CN104204977 12, 50, 51, 52",
        ["P" = 47, "K" = 16, "Q" = 64], "width of positions and gains, 1 for rounding down",
        some_widths!([4 8], |given, W| {
            ReferenceModel::<W, W, { 2 * W + 1 }>::new(one_of(given, ROUNDINGS)?)
        })
    ),
    entry!(
        SegmentSearch<8, 47>, SegmentSearch, None, "CN104204977 2, 3: segment",
        ["A" = 8, "P" = 47], "width of lengths (four segments)",
        some_widths!([4 8], |W| SegmentSearch::<2, W>)
    ),
    entry!(
        SegmentStore<8, 12, 55>, SegmentStore, None, "CN104204977 2, 3: segments",
        ["A" = 8, "K" = 12, "D" = 55], "width of a word (two segments)",
        some_widths!([4 8], |W| SegmentStore::<1, 5, W>)
    ),
    entry!(
        ArcAngle<47, 44, 44, 52>, ArcAngle, None, "CN104204977 2, 3: arc",
        ["P" = 47, "M" = 44, "H" = 44, "X" = 52], "width of lengths, curvatures and angles",
        some_widths!([4 8], |W| ArcAngle::<W, W, W, { W + 5 }>)
    ),
    entry!(
        Shifter<55>,
        Shifter,
        Some(4),
        "CN104204977 2, 3: arc",
        ["R" = 55],
        "width",
        proved_at!([4]; [4 8], |W| Shifter::<W>)
    ),
    entry!(
        CordicState<55, 44>, CordicState::default(), None, "CN104204977 2, 3: arc",
        ["R" = 55, "H" = 44], "width of coordinates and angles",
        some_widths!([4 8], |W| CordicState::<W, W>::default())
    ),
    entry!(
        Cordic<55, 44>, Cordic::default(), None, "CN104204977 2, 3: arc",
        ["R" = 55, "H" = 44], "width of coordinates and angles",
        some_widths!([4 8], |W| Cordic::<W, W>::default())
    ),
    entry!(
        AxisRow<47, 55, 42, 57, 55>, AxisRow::default(), None, "CN104204977 (1), (5)",
        ["P" = 47, "R" = 55, "C" = 42, "S" = 57, "D" = 55],
        "width of points and coefficients; two bits more inside",
        some_widths!([4 8], |W| AxisRow::<W, { W + 2 }, W, { W + 4 }, { W + 2 }>::default())
    ),
    entry!(
        PointSequencer<47, 55, 44, 55>, PointSequencer::default(), None, "CN104204977 2, 3",
        ["P" = 47, "R" = 55, "M" = 44, "D" = 55], "width of lengths; two bits more inside",
        some_widths!([4 8], |W| PointSequencer::<W, { W + 2 }, W, { W + 2 }>::default())
    ),
    entry!(
        PathPoint<3, 8, 47, 55, 42, 57, 44, 44, 52, 55, 12>, PathPoint::default(), None,
        "CN104204977 2, 3",
        [
            "AXES" = 3, "A" = 8, "P" = 47, "R" = 55, "C" = 42, "S" = 57, "M" = 44, "H" = 44,
            "X" = 52, "D" = 55, "K" = 12
        ],
        "width of points, lengths, coefficients and angles (two axes, two segments)",
        some_widths!([4 8], |W| {
            PathPoint::<2, 1, W, { W + 2 }, W, { W + 4 }, W, W, { W + 5 }, { W + 2 }, 5>::default()
        })
    ),
    entry!(
        LengthClamp<47>,
        LengthClamp,
        Some(4),
        "CN104204977 2, ends",
        ["P" = 47],
        "width",
        proved_at!([4]; [4 8], |W| LengthClamp::<W>)
    ),
    entry!(
        PathLength<47>,
        PathLength,
        Some(4),
        "CN104204977 1, qc",
        ["P" = 47],
        "width",
        proved_at!([4]; [4 8], |W| PathLength::<W>)
    ),
    entry!(
        VectorCorrection<47>,
        VectorCorrection::default(),
        Some(3),
        "CN104204977 4",
        ["P" = 47],
        "width, 1 for no correction, 2 for the steady one",
        proved_at!([3]; [4 8], |given, W| VectorCorrection::<W> {
            correction: one_of(given, CORRECTIONS)?,
        })
    ),
    entry!(
        PeriodJoin,
        PeriodJoin { wait: 200 },
        Some(2),
        "CN104204977 Fig. 1, order",
        [],
        "ticks to wait",
        Made {
            make: |given| Some(Box::new(join(given)?)),
            model: |given| Some(Box::new(join(given)?)),
            offered: &[],
        }
    ),
    entry!(
        ServoArithmetic<31, 47, 24, 58, 16>, ServoArithmetic, None, "CN104204977 26 to 31",
        ["W" = 31, "P" = 47, "G" = 24, "Q" = 58, "T" = 16],
        "width of counts, gains and torques; two guard bits",
        some_widths!([4 8], |W| ServoArithmetic::<W, { W + 2 }, W, { W + 13 }, W>)
    ),
    entry!(
        Servo<31, 47, 16, 64, 24, 58, 16>, Servo::default(), None, "CN104204977 11",
        ["W" = 31, "P" = 47, "K" = 16, "M" = 64, "G" = 24, "Q" = 58, "T" = 16],
        "width of counts, gains and torques; two guard bits",
        some_widths!([4 8], |W| Servo::<W, { W + 2 }, W, { 2 * W + 3 }, W, { W + 13 }, W>::default())
    ),
    entry!(
        ControlledAxis<31, 47, 16, 64, 24, 58, 16>, ControlledAxis::default(), None,
        "CN104204977 4, 11, 51",
        ["W" = 31, "P" = 47, "K" = 16, "M" = 64, "G" = 24, "Q" = 58, "T" = 16],
        "width of counts, gains and torques, 1 for no correction, 2 for the steady one; two guard bits",
        some_widths!([4 8], |given, W| {
            ControlledAxis::<W, { W + 2 }, W, { 2 * W + 3 }, W, { W + 13 }, W>::new(one_of(given, CORRECTIONS)?, Rounding::Nearest)
        })
    ),
    entry!(
        TrajectoryController<2, 8, 31, 47, 55, 42, 57, 44, 52, 55, 12, 41, 20, 16, 64, 24, 58, 16, 24>,
        TrajectoryController::new(Correction::Vector, Rounding::Nearest),
        None,
        "CN104204977 10",
        [
            "AXES" = 2, "A" = 8, "W" = 31, "P" = 47, "R" = 55, "C" = 42, "S" = 57, "H" = 44,
            "X" = 52, "D" = 55, "E" = 12, "F" = 41, "N" = 20, "K" = 16, "M" = 64, "G" = 24,
            "Q" = 58, "T" = 16, "U" = 24
        ],
        "width of counts, gains and torques, 1 for no correction, 2 for the steady one (two axes, two segments; no wait)",
        some_widths!([4 8], |given, W| {
            TrajectoryController::<
                2, 1, W, { W + 2 }, { W + 4 }, { W + 2 }, { W + 6 }, { W + 2 }, { W + 7 },
                { 2 * W + 4 }, 5, { 2 * W + 1 }, { 2 * W - 2 }, W, { 2 * W + 3 }, W, { W + 13 },
                W,
                { 2 * W },
            >::new(one_of(given, CORRECTIONS)?, Rounding::Nearest)
            .waiting(0)
        })
    ),
];
