//! Trajectory controller 10 (Fig. 1): a path and its profile in, torques of all axes out.
//!
//! ```text
//!  profile ─▶ interpolation and acceleration 1 ─┬─ qc ─▶ axis distribution 3 ─ Pc ─┬─▶ responses 51, 52 ─ Ps ─┐
//!                                               │                                 │                         ▼
//!                                               │                                 └────────▶ vector correction 4 ─ Pd ─▶ servo controls 6, 7
//!                                               │                                                           ▲
//!                                               └─▶ tangential response 50 ─ qs ─▶ reference point 2 ─ Pr ──┘
//! ```

use super::error_feedback::FeedbackGains;
use super::model_state::ModelGains;
use super::path_point::{AXIS_NAMES, PathWrite, of_axes};
use super::point_sequencer::{RADIUS, STEADY_RADIUS};
use super::servo_arithmetic::ServoGains;
use super::vector_correction::Correction;
use super::{
    ControlledAxis, ErrorFeedback, LengthClamp, PathLength, PathPoint, PeriodJoin, ReferenceModel,
    Rounding, Servo, Widths, controlled_axis, error_feedback, length_clamp, path_length,
    path_point, period_join, reference_model,
};
use crate::circuits::blocks::record_sequencer::{given_of_records, sends_in_fetch};
use crate::circuits::blocks::{
    DifferenceEngine, EnableCounter, RecordMemory, RecordSequencer, RecordWrite, difference_column,
    difference_engine, enable_counter, record_memory, record_sequencer,
};
use crate::prelude::*;

/// Width of a profile record's number in bits: the buffer holds 2^`RECORDS` records.
const RECORDS: usize = 4;

/// Trajectory controller.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TrajectoryController {
    /// Word widths, by name.
    pub widths: Widths,
    /// Number of axes, up to 4.
    pub axes: usize,
    /// Correction added to the commands.
    pub correction: Correction,
    /// Rounding of the models.
    pub rounding: Rounding,
    /// True to delay each correction to the worst-case latency.
    pub waits: bool,
}

impl TrajectoryController {
    /// Creates a controller with this correction and this rounding of its models. Its corrections
    /// wait for the worst case of the command's point and of the servo response to it; an error
    /// feedback takes some of that time.
    #[must_use]
    pub const fn new(
        widths: Widths,
        axes: usize,
        correction: Correction,
        rounding: Rounding,
    ) -> Self {
        TrajectoryController {
            widths,
            axes,
            correction,
            rounding,
            waits: true,
        }
    }

    /// Ticks that a period's correction waits.
    const fn wait(&self) -> u64 {
        match self.waits {
            true => {
                let answered = self.point(RADIUS).latency() + self.model().latency();
                answered - self.correction_latency()
            }
            false => 0,
        }
    }

    /// Ticks from the beginning of a period to its torques.
    #[must_use]
    pub const fn latency(&self) -> u64 {
        2 + self.wait() + 3 + self.correction_latency() + self.axis().servo.latency()
    }

    /// Ticks that the correction takes besides.
    const fn correction_latency(&self) -> u64 {
        match self.routing().feedback {
            true => self.feedback().latency(),
            false => 0,
        }
    }

    /// Ticks before the motors are compared with their models at which the feedback looks at them.
    #[must_use]
    pub const fn feedback_lead(&self) -> u64 {
        self.feedback().latency() + 1 + self.model().latency()
    }

    /// Shortest interpolation period in ticks: the next one begins when the torques are valid. A
    /// longer one is never late.
    #[must_use]
    pub const fn least_period(&self) -> u64 {
        self.latency() - 1
    }

    const fn model(&self) -> ReferenceModel {
        ReferenceModel {
            widths: self.widths.model(),
            rounding: self.rounding,
        }
    }

    const fn point(&self, radius_word: u64) -> PathPoint {
        PathPoint {
            widths: self.widths.point().of_axes(self.axes),
            axes: self.axes,
            radius_word,
        }
    }

    const fn clamp(&self, back: u64) -> LengthClamp {
        let width = self.widths.point;
        LengthClamp { width, back }
    }

    /// Returns the connections of the correction.
    const fn routing(&self) -> Routing {
        let vector = Routing {
            feedback: false,
            radius_word: RADIUS,
            back: 0,
            begins_with_command: false,
            is_at_command: false,
        };
        match self.correction {
            Correction::Vector | Correction::None => vector,
            // The prior art knows where the command is, not where the response is.
            Correction::Steady => Routing {
                radius_word: STEADY_RADIUS,
                begins_with_command: true,
                is_at_command: true,
                ..vector
            },
            Correction::Feedback => Routing {
                feedback: true,
                back: 1 << self.widths.guard(),
                begins_with_command: true,
                ..vector
            },
        }
    }

    const fn feedback(&self) -> ErrorFeedback {
        ErrorFeedback {
            widths: self.widths.feedback(),
            axes: self.axes,
        }
    }

    const fn axis(&self) -> ControlledAxis {
        ControlledAxis {
            servo: Servo {
                widths: self.widths.servo(),
                rounding: self.rounding,
            },
            correction: self.correction,
        }
    }
}

/// Connections that differ between the corrections.
#[derive(Clone, Copy)]
struct Routing {
    /// There is an error feedback. It uses the motors' positions, not the predicted responses.
    feedback: bool,
    /// Word of a segment's record that is the radius of the reference point.
    radius_word: u64,
    /// Distance of the reference point behind the given length: a count where two points of the
    /// path give its direction.
    back: u64,
    /// The reference point is computed with the command's, not after the tangential response.
    begins_with_command: bool,
    /// The reference point is that of the command.
    is_at_command: bool,
}

signals! { for TrajectoryController as c;
    /// Input ports.
    pub struct In {
        /// Port through which records of the profile are written.
        pub record: RecordWrite(&c.widths.data) as Flat,
        /// Starts a motion along the path.
        pub start: Bit,
        /// Ends the motion. The commands keep their values.
        pub halt: Bit,
        /// Selects another path, at rest. Its segments may be written from the next start of a
        /// period until `start`. The servo controls hold the machine meanwhile.
        pub restart: Bit,
        /// Port through which segments of the path are written.
        pub path: PathWrite(&c.point(RADIUS).widths) as Flat,
        /// Number of the last segment of the path.
        pub last: U(c.widths.segment),
        /// L: length of the path, in guard units.
        pub path_end: I(c.widths.point, c.widths.guard()),
        /// Interpolation period in ticks; 0 counts as 1.
        pub period: U(c.widths.period),
        /// K1 and K2 of the tangential response.
        pub model_gains: ModelGains(&c.widths.model()) as Flat,
        /// Gains of the error feedback.
        pub feedback_gains: FeedbackGains(&c.widths.feedback()) as Flat,
        /// K1 of this axis, for its servo response and the model in its servo control; in the unit
        /// of `gain_1`.
        pub axis_gain_1: [U(c.widths.gain); c.axes] as Elements(of_axes!("gain_1")),
        /// K2 of this axis, in the unit of `gain_2`.
        pub axis_gain_2: [U(c.widths.gain); c.axes] as Elements(of_axes!("gain_2")),
        /// Gain of position control 27 of this axis.
        pub position_gain: [U(c.widths.servo_gain); c.axes] as Elements(of_axes!("position_gain")),
        /// Proportional gain of speed control 29 of this axis.
        pub speed_gain: [U(c.widths.servo_gain); c.axes] as Elements(of_axes!("speed_gain")),
        /// Integral gain of speed control 29 of this axis.
        pub integral_gain: [U(c.widths.servo_gain); c.axes] as Elements(of_axes!("integral_gain")),
        /// Gain of feed-forward 30 of this axis.
        pub inertia: [U(c.widths.servo_gain); c.axes] as Elements(of_axes!("inertia")),
        /// Largest torque of this axis.
        pub limit: [U(c.widths.torque); c.axes] as Elements(of_axes!("limit")),
        /// High: position commands come from `given_command`, not from the axis distribution.
        pub given: Bit,
        /// External position command of this axis, in guard units; constant during a period.
        pub given_command: [I(c.widths.point, c.widths.guard()); c.axes] as Elements(of_axes!("given_command")),
        /// Channel A of this axis' encoder, asynchronous.
        pub a: [Bit; c.axes] as Elements(of_axes!("a")),
        /// Channel B of this axis' encoder, asynchronous.
        pub b: [Bit; c.axes] as Elements(of_axes!("b")),
    }
    /// The blocks inside.
    pub struct Parts {
        /// Counter of the interpolation period.
        pub period_counter: Part<EnableCounter>(EnableCounter { width: c.widths.period }),
        /// Records of the profile.
        pub memory: Part<RecordMemory>(RecordMemory { record: RECORDS, data: c.widths.data }),
        /// Sequencer of the profile's records.
        pub sequencer: Part<RecordSequencer>(RecordSequencer {
            modulus: c.widths.fraction,
            samples: c.widths.samples,
            data: c.widths.data,
            waits: false,
        }),
        /// Interpolation and acceleration 1.
        pub profile: Part<DifferenceEngine>(DifferenceEngine {
            widths: difference_column::Widths {
                whole: c.widths.point,
                part: c.widths.fraction,
                data: c.widths.data,
            },
            coordinate: 0,
        }),
        /// qc: length of the command along the path.
        pub progress: Part<PathLength>(PathLength { width: c.widths.point }),
        /// qc, limited to the path.
        pub clamp_command: Part<LengthClamp>(c.clamp(0)),
        /// Tangential servo response 50.
        pub tangential: Part<ReferenceModel>(c.model()),
        /// qs, limited to the path; with the error feedback, one count less than qc.
        pub clamp_response: Part<LengthClamp>(c.clamp(c.routing().back)),
        /// Axis distribution 3.
        pub distribution: Part<PathPoint>(c.point(RADIUS)),
        /// Reference point 2.
        pub reference_point: Part<PathPoint>(c.point(c.routing().radius_word)),
        /// Join of all points of a period.
        pub gather: Part<PeriodJoin>(PeriodJoin { wait: c.wait() }),
        /// Error feedback, if it is used.
        pub feedback: Part<ErrorFeedback>(c.feedback()) if (c.routing().feedback),
        /// Controlled axes.
        pub axes: [Part<ControlledAxis>(c.axis()); c.axes] as Elements(&AXIS_NAMES),
    }
    /// Output ports.
    pub struct Net {
        /// Torque command of this axis.
        pub torque: [I(c.widths.torque); c.axes] as Elements(of_axes!("torque")),
        /// Position of this axis' motor, in counts.
        pub position: [I(c.widths.position); c.axes] as Elements(of_axes!("position")),
        /// Both encoder channels of this axis have changed at once: the position is wrong.
        pub lost: [Bit; c.axes] as Elements(of_axes!("lost")),
        /// A record of the profile is free to be written.
        pub ready: Bit,
        /// A motion is running.
        pub busy: Bit,
        /// The profile has output a new length in the tick before.
        pub sampled: Bit,
        /// A period begins with the present length.
        pub fresh: Bit,
        /// A period has begun before the previous one was complete; cleared by `restart`.
        pub late: Bit,
        /// A period has begun before the profile had its length; cleared by the next start.
        pub profile_late: Bit,
        /// The profile has ended in motion because no record was waiting; cleared by the next
        /// start.
        pub starved: Bit,
    }
}

impl Circuit for TrajectoryController {
    const NAME: &'static str = "trajectory_controller";
    const ABOUT: &'static str = "a path and its profile in, torques that follow the path out";
    records!(In, Nothing, Net, Parts);

    fn objection(&self) -> Option<String> {
        let named = (1..=4).contains(&self.axes);
        (!named).then(|| format!("1 to 4 axes have names, not {}", self.axes))
    }

    fn tick(&self, i: In, _: Nothing, p: Parts) -> (Net, Nothing) {
        let period = p
            .period_counter
            .settle(enable_counter::In { period: i.period });
        let memory = p.memory.settle(record_memory::In {
            record: i.record,
            take: p.sequencer.q.take,
            kind: p.sequencer.q.kind,
            flush: i.halt,
        });
        let sequencer = p.sequencer.settle(record_sequencer::In {
            start: i.start,
            halt: i.halt,
            sample: period.w.enable,
            available: memory.w.available,
            record: memory.q.record(memory.q.load),
            loaded: memory.q.loaded,
            rotated: Bit::low(),
        });
        let profile = p.profile.settle(difference_engine::In {
            record: memory.q.record(memory.w.load_engines),
            modulus: sequencer.q.modulus,
            step: sequencer.w.advance,
        });
        let progress = p.progress.settle(path_length::In {
            sample: period.w.enable,
            present: sequencer.w.present,
            profile: profile.w.nearest,
            restart: i.restart,
        });
        let (length, fresh) = (progress.q.length, progress.q.fresh);
        let path_end = i.path_end;
        let on_path = |length| length_clamp::In { length, path_end };
        let command = p.clamp_command.settle(on_path(length));
        let tangential = p.tangential.settle(reference_model::In {
            step: fresh,
            preset: progress.q.preset,
            target: length,
            gains: i.model_gains,
        });
        let routing = self.routing();
        let response = p.clamp_response.settle(on_path(match routing.feedback {
            true => command.w.clamped.signed(),
            false => tangential.w.position,
        }));
        let point = |start, length| path_point::In {
            start,
            length,
            last: i.last,
            path: i.path.clone(),
        };
        let distribution = p.distribution.settle(point(fresh, command.w.clamped));
        let begins = match routing.begins_with_command {
            true => fresh,
            false => tangential.w.fresh,
        };
        let length = match routing.is_at_command {
            true => command.w.clamped,
            false => response.w.clamped,
        };
        let reference_point = p.reference_point.settle(point(begins, length));
        let (placed, referred) = (distribution.w.points, reference_point.w.points);
        let command = |axis: usize| i.given.mux(i.given_command[axis], placed[axis]);
        let corrects = match &p.feedback {
            Some(feedback) => feedback.q.done,
            None => p.gather.q.correct,
        };
        let axes = settle_each(p.axes, |axis| controlled_axis::In {
            step: p.gather.q.step,
            preset: p.gather.q.preset,
            command: command(axis),
            correct: corrects,
            target: match &p.feedback {
                Some(feedback) => feedback.q.sum[axis].resize(self.widths.point),
                None => referred[axis],
            },
            a: i.a[axis],
            b: i.b[axis],
            model_gains: ModelGains {
                gain_1: i.axis_gain_1[axis],
                gain_2: i.axis_gain_2[axis],
            },
            gains: ServoGains {
                position_gain: i.position_gain[axis],
                speed_gain: i.speed_gain[axis],
                integral_gain: i.integral_gain[axis],
                inertia: i.inertia[axis],
                limit: i.limit[axis],
            },
        });
        if let Some(part) = p.feedback {
            part.settle(error_feedback::In {
                start: p.gather.q.correct,
                command: (0..self.axes).map(command).collect(),
                path: placed,
                behind: referred,
                position: axes.iter().map(|axis| axis.w.position).collect(),
                gains: i.feedback_gains,
            });
        }
        let gather = p.gather.settle(period_join::In {
            begins: fresh,
            held: progress.q.held,
            placed: distribution.w.done,
            referred: reference_point.w.done,
            answered: match routing.feedback {
                true => distribution.w.done,
                false => axes[0].w.answered,
            },
            driven: axes[0].w.driven,
            clear: i.restart,
        });
        let net = Net {
            torque: axes.iter().map(|axis| axis.w.torque).collect(),
            position: axes.iter().map(|axis| axis.w.position).collect(),
            lost: axes.iter().map(|axis| axis.w.lost).collect(),
            ready: memory.w.ready,
            busy: sequencer.w.busy,
            sampled: sequencer.q.sampled,
            fresh,
            late: gather.q.late,
            profile_late: sequencer.q.late,
            starved: sequencer.q.starved,
        };
        (net, Nothing)
    }

    fn properties(&self, now: &Moment<Self>) -> Vec<Property> {
        let p = &now.p;
        let mut all = given_of_records([difference_engine::of_record(&p.profile)]).to_vec();
        all.push(sends_in_fetch(&p.sequencer, &p.memory));
        all
    }
}
