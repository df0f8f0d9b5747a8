use crate::circuits::trajectory_controller::model_state::ModelWidths;
use crate::circuits::trajectory_controller::point_sequencer::RADIUS;
use crate::circuits::trajectory_controller::servo_arithmetic::ServoWidths;
use crate::circuits::trajectory_controller::vector_correction::Correction;
use crate::circuits::trajectory_controller::widths::FeedbackWidths;
use crate::circuits::trajectory_controller::widths::PointWidths;
use crate::circuits::trajectory_controller::{
    ArcAngle, AxisRow, ControlledAxis, ErrorFeedback, FeedbackSweep, LengthClamp, LengthPowers,
    ModelState, PathLength, PathPoint, PeriodJoin, PointSequencer, ReferenceModel, Rounding,
    SegmentSearch, SegmentStore, Servo, ServoArithmetic, TrajectoryController, VectorCorrection,
    Widths,
};
use crate::registry::Entry;
use crate::registry::entry::entry;

/// The circuit's own widths, for paths of up to 256 segments.
const FULL: Widths = Widths {
    segment: 8,
    ..Widths::FULL
};

/// Points, lengths, coefficients and angles of four bits, two bits more inside, and two segments.
const POINTS: PointWidths = PointWidths {
    point: 4,
    radius: 6,
    coefficient: 4,
    curvature: 4,
    angle: 4,
    data: 6,
    segment: 1,
    word: 4,
};

/// Positions and gains of four bits.
const MODEL: ModelWidths = ModelWidths {
    position: 4,
    gain: 4,
};

/// Counts, gains and torques of four bits, and two guard bits.
const SERVO: ServoWidths = ServoWidths {
    count: 4,
    position: 6,
    model_gain: 4,
    gain: 4,
    torque: 4,
};

/// Counts, gains and torques of four bits, and two segments.
const SMALL: Widths = Widths {
    position: 4,
    point: 6,
    radius: 8,
    coefficient: 6,
    curvature: 6,
    angle: 6,
    data: 12,
    segment: 1,
    fraction: 9,
    samples: 6,
    period: 8,
    gain: 4,
    servo_gain: 4,
    torque: 4,
};

fn feedback(count: usize) -> ErrorFeedback {
    let widths = FeedbackWidths {
        count,
        position: count + 2,
        gain: count,
    };
    ErrorFeedback { widths, axes: 2 }
}

fn servo(widths: ServoWidths) -> Servo {
    Servo {
        widths,
        rounding: Rounding::Nearest,
    }
}

/// The circuits of CN104204977.
pub(super) const CIRCUITS: &[Entry] = &[
    entry!(
        ModelState, "CN104204977 20, 22, 24, 25",
        full: ModelState { widths: FULL.model(), rounding: Rounding::Nearest },
        small: ModelState { widths: MODEL, rounding: Rounding::Nearest },
    ),
    entry!(
        ReferenceModel, "CN104204977 12, 50, 51, 52",
        full: ReferenceModel { widths: FULL.model(), rounding: Rounding::Nearest },
        small: ReferenceModel { widths: MODEL, rounding: Rounding::Nearest },
    ),
    entry!(
        SegmentSearch, "CN104204977 2, 3: segment",
        full: SegmentSearch { widths: FULL.point() },
        small: SegmentSearch { widths: PointWidths { segment: 2, ..POINTS } },
        uses: [segment, point],
    ),
    entry!(
        SegmentStore, "CN104204977 2, 3: segments",
        full: SegmentStore { widths: FULL.point() },
        small: SegmentStore { widths: PointWidths { data: 4, ..POINTS } }, uses: [segment, data],
    ),
    entry!(
        ArcAngle, "CN104204977 2, 3: arc",
        full: ArcAngle { widths: FULL.point() },
        small: ArcAngle { widths: POINTS }, uses: [point, curvature, angle],
    ),
    entry!(
        LengthPowers, "CN104204977 2, 3: spline",
        full: LengthPowers { widths: FULL.point() },
        small: LengthPowers { widths: POINTS }, uses: [point, radius],
    ),
    entry!(
        AxisRow, "CN104204977 (1), (5)",
        full: AxisRow { widths: FULL.point(), coordinate: 0 },
        small: AxisRow { widths: POINTS, coordinate: 0 }, uses: [point, radius, coefficient, data],
    ),
    entry!(
        PointSequencer, "CN104204977 2, 3",
        full: PointSequencer { widths: FULL.point(), radius_word: RADIUS },
        small: PointSequencer { widths: POINTS, radius_word: RADIUS },
        uses: [point, radius, curvature, data],
    ),
    entry!(
        PathPoint, "CN104204977 2, 3",
        full: PathPoint { widths: FULL.point(), axes: 3, radius_word: RADIUS },
        small: PathPoint { widths: POINTS, axes: 2, radius_word: RADIUS },
        uses: [segment, point, radius, coefficient, curvature, angle, data],
    ),
    entry!(
        LengthClamp, "CN104204977 2, ends",
        full: LengthClamp { width: FULL.point, back: 0 },
        small: LengthClamp { width: 4, back: 0 }, proved: true,
    ),
    entry!(
        PathLength, "CN104204977 1, qc",
        full: PathLength { width: FULL.point },
        small: PathLength { width: 4 }, proved: true,
    ),
    entry!(
        VectorCorrection, "CN104204977 4",
        full: VectorCorrection { width: FULL.point, correction: Correction::Vector },
        small: VectorCorrection { width: 3, correction: Correction::Vector }, proved: true,
    ),
    entry!(
        ErrorFeedback, "CN104204977 prior art: errors along and across the path",
        full: ErrorFeedback { widths: FULL.feedback(), axes: 2 },
        small: feedback(3),
        swept: FeedbackSweep::new, least: feedback(2),
    ),
    entry!(
        PeriodJoin, "CN104204977 Fig. 1, order",
        full: PeriodJoin { wait: 200 },
        small: PeriodJoin { wait: 2 }, proved: true,
    ),
    entry!(
        ServoArithmetic, "CN104204977 26 to 31",
        full: ServoArithmetic { widths: FULL.servo() },
        small: ServoArithmetic { widths: SERVO }, uses: [count, position, gain, torque],
    ),
    entry!(
        Servo, "CN104204977 11",
        full: servo(FULL.servo()),
        small: servo(SERVO),
    ),
    entry!(
        ControlledAxis, "CN104204977 4, 11, 51",
        full: ControlledAxis { servo: servo(FULL.servo()), correction: Correction::Vector },
        small: ControlledAxis { servo: servo(SERVO), correction: Correction::Vector },
    ),
    entry!(
        TrajectoryController, "CN104204977 10",
        full: TrajectoryController::new(FULL, 2, Correction::Vector, Rounding::Nearest),
        small: TrajectoryController {
            waits: false,
            ..TrajectoryController::new(SMALL, 2, Correction::Vector, Rounding::Nearest)
        },
    ),
];
