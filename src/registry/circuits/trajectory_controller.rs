use super::make::{ROUNDINGS, at_most, second, width};
use crate::circuits::trajectory_controller::model_state::ModelWidths;
use crate::circuits::trajectory_controller::point_sequencer::RADIUS;
use crate::circuits::trajectory_controller::servo_arithmetic::ServoWidths;
use crate::circuits::trajectory_controller::vector_correction::Correction;
use crate::circuits::trajectory_controller::widths::PointWidths;
use crate::circuits::trajectory_controller::{
    ArcAngle, AxisRow, ControlledAxis, ErrorFeedback, LengthClamp, LengthPowers, ModelState,
    PathLength, PathPoint, PeriodJoin, PointSequencer, ReferenceModel, Rounding, SegmentSearch,
    SegmentStore, Servo, ServoArithmetic, TrajectoryController, VectorCorrection, Widths,
};
use crate::registry::Entry;
use crate::registry::entry::entry;

/// The corrections by their numbers.
const CORRECTIONS: &[Correction] = &[
    Correction::Vector,
    Correction::None,
    Correction::Steady,
    Correction::Feedback,
];

/// The circuit's own widths, for paths of up to 256 segments.
const FULL: Widths = Widths {
    segment: 8,
    ..Widths::FULL
};

/// Points, lengths, coefficients and angles of one width, two bits more inside, and two segments.
fn points(width: usize) -> PointWidths {
    PointWidths {
        point: width,
        radius: width + 2,
        coefficient: width,
        curvature: width,
        angle: width,
        data: width + 2,
        segment: 1,
        word: 4,
    }
}

/// Positions and gains of one width.
fn models(width: usize) -> ModelWidths {
    ModelWidths {
        position: width,
        gain: width,
    }
}

/// Counts, gains and torques of one width, and two guard bits.
fn servos(width: usize) -> ServoWidths {
    ServoWidths {
        count: width,
        position: width + 2,
        model_gain: width,
        gain: width,
        torque: width,
    }
}

/// The same for all of the controller, with two segments.
fn widths(width: usize) -> Widths {
    Widths {
        position: width,
        point: width + 2,
        radius: width + 4,
        coefficient: width + 2,
        curvature: width + 2,
        angle: width + 2,
        data: 2 * width + 4,
        segment: 1,
        fraction: 2 * width + 1,
        samples: (2 * width).saturating_sub(2),
        period: 2 * width,
        gain: width,
        servo_gain: width,
        torque: width,
    }
}

fn sequencer(widths: PointWidths) -> PointSequencer {
    PointSequencer {
        widths,
        radius_word: RADIUS,
    }
}

fn point(widths: PointWidths, axes: usize) -> PathPoint {
    PathPoint {
        widths,
        axes,
        radius_word: RADIUS,
    }
}

fn servo(widths: ServoWidths) -> Servo {
    Servo {
        widths,
        rounding: Rounding::Nearest,
    }
}

fn axis(widths: ServoWidths, correction: Correction) -> ControlledAxis {
    ControlledAxis {
        servo: servo(widths),
        correction,
    }
}

/// The circuits of CN104204977.
pub(super) const CIRCUITS: &[Entry] = &[
    entry!(
        ModelState, "CN104204977 20, 22, 24, 25",
        full: || ModelState { widths: FULL.model(), rounding: Rounding::Nearest },
        widths: [position, gain in widths],
        by: "width of positions and gains, 1 for rounding down",
        |width, rounding of ROUNDINGS| ModelState { widths: models(width), rounding },
        proved: none,
    ),
    entry!(
        ReferenceModel, "CN104204977 12, 50, 51, 52",
        full: || ReferenceModel { widths: FULL.model(), rounding: Rounding::Nearest },
        widths: [position, gain in widths],
        by: "width of positions and gains, 1 for rounding down",
        |width, rounding of ROUNDINGS| ReferenceModel { widths: models(width), rounding },
        proved: none,
    ),
    entry!(
        SegmentSearch, "CN104204977 2, 3: segment",
        full: || SegmentSearch { widths: FULL.point() },
        widths: [segment, point in widths],
        by: "width of lengths (four segments)",
        |width| {
            let widths = PointWidths { segment: 2, ..points(width) };
            SegmentSearch { widths }
        },
        proved: none,
    ),
    entry!(
        SegmentStore, "CN104204977 2, 3: segments",
        full: || SegmentStore { widths: FULL.point() },
        widths: [segment, data in widths],
        by: "width of a word (two segments)",
        |data| {
            let widths = PointWidths { data, ..points(data) };
            SegmentStore { widths }
        },
        proved: none,
    ),
    entry!(
        ArcAngle, "CN104204977 2, 3: arc",
        full: || ArcAngle { widths: FULL.point() },
        widths: [point, curvature, angle in widths],
        by: "width of lengths, curvatures and angles", |width| ArcAngle { widths: points(width) },
        proved: none,
    ),
    entry!(
        LengthPowers, "CN104204977 2, 3: spline",
        full: || LengthPowers { widths: FULL.point() },
        widths: [point, radius in widths],
        by: "width of lengths; two bits more inside",
        |width| LengthPowers { widths: points(width) },
        proved: none,
    ),
    entry!(
        AxisRow, "CN104204977 (1), (5)",
        full: || AxisRow { widths: FULL.point(), coordinate: 0 },
        widths: [point, radius, coefficient, data in widths],
        by: "width of points and coefficients; two bits more inside",
        |width| AxisRow { widths: points(width), coordinate: 0 },
        proved: none,
    ),
    entry!(
        PointSequencer, "CN104204977 2, 3",
        full: || sequencer(FULL.point()),
        widths: [point, radius, curvature, data in widths],
        by: "width of lengths; two bits more inside", |width| sequencer(points(width)),
        proved: none,
    ),
    entry!(
        PathPoint, "CN104204977 2, 3",
        full: || point(FULL.point(), 3),
        widths: [axes; segment, point, radius, coefficient, curvature, angle, data in widths],
        by: "width of points, lengths, coefficients and angles (two axes, two segments)",
        |width| point(points(width), 2),
        proved: none,
    ),
    entry!(
        LengthClamp, "CN104204977 2, ends",
        full: || LengthClamp { width: FULL.point, back: 0 },
        widths: [width],
        from: "width, what is taken off", |given| {
            let (width, back) = (width(given)?, second(given, 0, width(given)? - 1)?);
            Some(LengthClamp { width, back })
        },
        with: |clamp, given| {
            at_most(given, 1)?;
            let back = given.first().copied().unwrap_or(clamp.back);
            Some(LengthClamp { back, ..clamp })
        },
        proved: 4,
    ),
    entry!(
        PathLength, "CN104204977 1, qc",
        full: || PathLength { width: FULL.point },
        widths: [width],
        by: "width", |width| PathLength { width },
        proved: 4,
    ),
    entry!(
        VectorCorrection, "CN104204977 4",
        full: || VectorCorrection { width: FULL.point, correction: Correction::Vector },
        widths: [width],
        by: "width, 1 for no correction, 2 for the steady one, 3 for the feedback",
        |width, correction of CORRECTIONS| VectorCorrection { width, correction },
        proved: 3,
    ),
    entry!(
        ErrorFeedback, "CN104204977 prior art: errors along and across the path",
        full: || ErrorFeedback { widths: FULL.feedback(), axes: 2 },
        widths: [axes; count, position, gain in widths],
        by: "width of counts and gains (two axes, two guard bits)",
        |width| ErrorFeedback { widths: widths(width).feedback(), axes: 2 },
        proved: none,
    ),
    entry!(
        PeriodJoin, "CN104204977 Fig. 1, order",
        full: || PeriodJoin { wait: 200 },
        widths: [],
        from: "ticks to wait", |given| {
            at_most(given, 1)?;
            let wait = given.first().copied().unwrap_or(0);
            Some(PeriodJoin { wait })
        },
        with: |join, given| {
            at_most(given, 1)?;
            let wait = given.first().copied().unwrap_or(join.wait);
            Some(PeriodJoin { wait })
        },
        proved: 2,
    ),
    entry!(
        ServoArithmetic, "CN104204977 26 to 31",
        full: || ServoArithmetic { widths: FULL.servo() },
        widths: [count, position, gain, torque in widths],
        by: "width of counts, gains and torques; two guard bits",
        |width| ServoArithmetic { widths: servos(width) },
        proved: none,
    ),
    entry!(
        Servo, "CN104204977 11",
        full: || servo(FULL.servo()),
        widths: [count, position, model_gain, gain, torque in widths],
        by: "width of counts, gains and torques; two guard bits", |width| servo(servos(width)),
        proved: none,
    ),
    entry!(
        ControlledAxis, "CN104204977 4, 11, 51",
        full: || axis(FULL.servo(), Correction::Vector),
        widths: [
            count = servo.widths.count,
            position = servo.widths.position,
            model_gain = servo.widths.model_gain,
            gain = servo.widths.gain,
            torque = servo.widths.torque,
        ],
        by: "width of counts, gains and torques, 1 for no correction, 2 for the steady one, 3 for the \
             feedback; two guard bits",
        |width, correction of CORRECTIONS| axis(servos(width), correction),
        proved: none,
    ),
    entry!(
        TrajectoryController, "CN104204977 10",
        full: || TrajectoryController::new(FULL, 2, Correction::Vector, Rounding::Nearest),
        widths: [
            axes; segment, position, point, radius, coefficient, curvature, angle, data, fraction,
            samples, gain, servo_gain, torque, period in widths
        ],
        by: "width of counts, gains and torques, 1 for no correction, 2 for the steady one, 3 for the \
             feedback (two axes, two segments; no wait)",
        |width, correction of CORRECTIONS| TrajectoryController {
            widths: widths(width),
            axes: 2,
            correction,
            rounding: Rounding::Nearest,
            waits: false,
        },
        proved: none,
    ),
];
