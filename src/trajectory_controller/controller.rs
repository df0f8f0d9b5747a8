//! Trajectory controller 10 (Fig. 1): a path and its profile in, torques of all axes out.
//!
//! ```text
//!  profile ─▶ interpolation and acceleration 1 ─┬─ qc ─▶ axis distribution 3 ─ Pc ─┬─▶ responses 51, 52 ─ Ps ─┐
//!                                               │                                 │                         ▼
//!                                               │                                 └────────▶ vector correction 4 ─ Pd ─▶ servo controls 6, 7
//!                                               │                                                           ▲
//!                                               └─▶ tangential response 50 ─ qs ─▶ reference point 2 ─ Pr ──┘
//! ```

use super::point_sequencer::{RADIUS, STEADY_RADIUS};
use super::vector_correction::Correction;
use super::{
    ControlledAxis, LengthClamp, PathLength, PathPoint, PeriodJoin, ReferenceModel, Rounding,
    Servo, controlled_axis, length_clamp, path_length, path_point, period_join, reference_model,
};
use crate::blocks::{
    DifferenceEngine, EnableCounter, RecordMemory, RecordSequencer, difference_engine,
    enable_counter, record_memory, record_sequencer,
};
use crate::kernel::{Circuit, Instance, Nothing};
use crate::logic::{Bit, Logic};
use crate::signals;
use std::array::from_fn;

/// Records of the profile that wait, and the width of their address.
const RECORDS: usize = 4;
const ADDRESS: usize = RECORDS + 5;
const TORQUE: &[&str] = &["torque_x", "torque_y", "torque_z"];
const POSITION: &[&str] = &["position_x", "position_y", "position_z"];
const LOST: &[&str] = &["lost_x", "lost_y", "lost_z"];
const A_NAMES: &[&str] = &["a_x", "a_y", "a_z"];
const B_NAMES: &[&str] = &["b_x", "b_y", "b_z"];
const POSITION_GAIN: &[&str] = &["position_gain_x", "position_gain_y", "position_gain_z"];
const SPEED_GAIN: &[&str] = &["speed_gain_x", "speed_gain_y", "speed_gain_z"];
const INTEGRAL_GAIN: &[&str] = &["integral_gain_x", "integral_gain_y", "integral_gain_z"];
const INERTIA: &[&str] = &["inertia_x", "inertia_y", "inertia_z"];
const GIVEN_COMMAND: &[&str] = &["given_command_x", "given_command_y", "given_command_z"];
const LIMIT: &[&str] = &["limit_x", "limit_y", "limit_z"];

signals! {
    /// Ports in.
    pub struct In<
        L,
        const AXES: usize,
        const A: usize,
        const P: usize,
        const D: usize,
        const E: usize,
        const K: usize,
        const G: usize,
        const T: usize,
        const U: usize,
    > {
        /// Writes a word of the free profile record; not taken unless `ready`.
        pub write: L::Bit,
        /// Number of the word.
        pub write_word: L::U<5>,
        /// Its data.
        pub write_data: L::U<D> as Hex,
        /// The free profile record is complete; not taken unless `ready`.
        pub push: L::Bit,
        /// Begins to move along the path.
        pub start: L::Bit,
        /// Ends the movement where it is.
        pub halt: L::Bit,
        /// Another path, at rest: its segments may be written from the next beginning of a period
        /// up to `start`. The servo controls hold the machine meanwhile.
        pub restart: L::Bit,
        /// Writes where a segment of the path begins.
        pub write_begin: L::Bit,
        /// The segment.
        pub begin_segment: L::U<A>,
        /// The length at which it begins.
        pub begin_length: L::U<P>,
        /// Writes a word of a segment.
        pub write_path: L::Bit,
        /// The segment, and in the lower four bits the number of its word.
        pub path_address: L::U<E> as Hex,
        /// Its data.
        pub path_data: L::U<D> as Hex,
        /// The path's last segment.
        pub last: L::U<A>,
        /// L: the path's length.
        pub path_end: L::I<P>,
        /// Interpolation period in ticks.
        pub period: L::U<U>,
        /// K1 of all models.
        pub gain_1: L::U<K>,
        /// K2 of all models.
        pub gain_2: L::U<K>,
        /// Of the position controls 27.
        pub position_gain: [L::U<G>; AXES] as Elements(POSITION_GAIN),
        /// Of the speed controls 29, proportional.
        pub speed_gain: [L::U<G>; AXES] as Elements(SPEED_GAIN),
        /// Integral.
        pub integral_gain: [L::U<G>; AXES] as Elements(INTEGRAL_GAIN),
        /// Of the feed-forward 30.
        pub inertia: [L::U<G>; AXES] as Elements(INERTIA),
        /// Largest torques.
        pub limit: [L::U<T>; AXES] as Elements(LIMIT),
        /// Position commands come from elsewhere, and not from the axis distribution.
        pub given: L::Bit,
        /// These; they stay from one beginning of a period to the next.
        pub given_command: [L::I<P>; AXES] as Elements(GIVEN_COMMAND),
        /// Encoders, channel A.
        pub a: [L::Bit; AXES] as Elements(A_NAMES),
        /// Channel B.
        pub b: [L::Bit; AXES] as Elements(B_NAMES),
    }
}

signals! {
    /// Registers of the blocks.
    pub struct Reg<
        L,
        const AXES: usize,
        const A: usize,
        const W: usize,
        const P: usize,
        const R: usize,
        const C: usize,
        const S: usize,
        const H: usize,
        const X: usize,
        const D: usize,
        const E: usize,
        const F: usize,
        const N: usize,
        const K: usize,
        const M: usize,
        const G: usize,
        const Q: usize,
        const T: usize,
        const U: usize,
    > {
        /// Interpolation period.
        pub period_counter: enable_counter::Reg<L, U>,
        /// Records of the profile.
        pub memory: record_memory::Reg<L, RECORDS, ADDRESS, D>,
        /// Phase after phase.
        pub sequencer: record_sequencer::Reg<L, F, N>,
        /// Interpolation and acceleration 1.
        pub profile: difference_engine::Reg<L, P, F>,
        /// qc.
        pub progress: path_length::Reg<L, P>,
        /// Tangential servo response 50.
        pub tangential: reference_model::Reg<L, P, K, M>,
        /// Axis distribution 3.
        pub distribution: path_point::Reg<L, AXES, A, P, R, C, S, H, H, X, D, E>,
        /// Reference point 2.
        pub reference_point: path_point::Reg<L, AXES, A, P, R, C, S, H, H, X, D, E>,
        /// All points of a period.
        pub gather: period_join::Reg<L>,
        /// The axes.
        pub axes: [controlled_axis::Reg<L, W, P, K, M, G, Q, T>; AXES] as Elements(&path_point::AXIS_NAMES),
    }
}

signals! {
    /// Nets of the blocks, and the ports out.
    pub struct Net<
        L,
        const AXES: usize,
        const A: usize,
        const W: usize,
        const P: usize,
        const R: usize,
        const C: usize,
        const S: usize,
        const H: usize,
        const X: usize,
        const D: usize,
        const E: usize,
        const F: usize,
        const N: usize,
        const K: usize,
        const M: usize,
        const G: usize,
        const Q: usize,
        const T: usize,
        const U: usize,
    > {
        /// Interpolation period.
        pub period_counter: Instance<EnableCounter<U>, L>,
        /// Records of the profile.
        pub memory: Instance<RecordMemory<RECORDS, ADDRESS, D>, L>,
        /// Phase after phase.
        pub sequencer: Instance<RecordSequencer<F, N, D>, L>,
        /// Interpolation and acceleration 1.
        pub profile: Instance<DifferenceEngine<P, F, D>, L>,
        /// qc.
        pub progress: Instance<PathLength<P>, L>,
        /// qc on the path.
        pub clamp_command: Instance<LengthClamp<P>, L>,
        /// Tangential servo response 50.
        pub tangential: Instance<ReferenceModel<P, K, M>, L>,
        /// qs on the path.
        pub clamp_response: Instance<LengthClamp<P>, L>,
        /// Axis distribution 3.
        pub distribution: Instance<PathPoint<AXES, A, P, R, C, S, H, H, X, D, E>, L>,
        /// Reference point 2.
        pub reference_point: Instance<PathPoint<AXES, A, P, R, C, S, H, H, X, D, E>, L>,
        /// All points of a period.
        pub gather: Instance<PeriodJoin, L>,
        /// The axes.
        pub axes: [Instance<ControlledAxis<W, P, K, M, G, Q, T>, L>; AXES] as Elements(&path_point::AXIS_NAMES),
        /// Torques.
        pub torque: [L::I<T>; AXES] as Elements(TORQUE),
        /// Positions of the motors in counts.
        pub position: [L::I<W>; AXES] as Elements(POSITION),
        /// Encoders that were too fast.
        pub lost: [L::Bit; AXES] as Elements(LOST),
        /// There is a free profile record.
        pub ready: L::Bit,
        /// A movement is under way.
        pub busy: L::Bit,
        /// The profile gave a new length in the tick before.
        pub sampled: L::Bit,
        /// A period begins with the length that stands.
        pub fresh: L::Bit,
        /// A period began before the one before was over; until the next path.
        pub late: L::Bit,
        /// A period began before the profile had its length; until the next start.
        pub profile_late: L::Bit,
        /// The profile ended in motion.
        pub starved: L::Bit,
    }
}

/// Trajectory controller of `AXES` axes on paths of up to 2^`A` segments; for the other widths see
/// the note.
#[derive(Debug, Clone)]
pub struct TrajectoryController<
    const AXES: usize,
    const A: usize,
    const W: usize,
    const P: usize,
    const R: usize,
    const C: usize,
    const S: usize,
    const H: usize,
    const X: usize,
    const D: usize,
    const E: usize,
    const F: usize,
    const N: usize,
    const K: usize,
    const M: usize,
    const G: usize,
    const Q: usize,
    const T: usize,
    const U: usize,
> {
    /// What is added to the commands.
    pub correction: Correction,
    /// Interpolation period.
    pub period_counter: EnableCounter<U>,
    /// Records of the profile.
    pub memory: RecordMemory<RECORDS, ADDRESS, D>,
    /// Phase after phase.
    pub sequencer: RecordSequencer<F, N, D>,
    /// Interpolation and acceleration 1.
    pub profile: DifferenceEngine<P, F, D>,
    /// qc.
    pub progress: PathLength<P>,
    /// Lengths on the path.
    pub clamp: LengthClamp<P>,
    /// Tangential servo response 50.
    pub tangential: ReferenceModel<P, K, M>,
    /// Axis distribution 3.
    pub distribution: PathPoint<AXES, A, P, R, C, S, H, H, X, D, E>,
    /// Reference point 2.
    pub reference_point: PathPoint<AXES, A, P, R, C, S, H, H, X, D, E>,
    /// All points of a period.
    pub gather: PeriodJoin,
    /// The axes.
    pub axes: [ControlledAxis<W, P, K, M, G, Q, T>; AXES],
}

impl<
    const AXES: usize,
    const A: usize,
    const W: usize,
    const P: usize,
    const R: usize,
    const C: usize,
    const S: usize,
    const H: usize,
    const X: usize,
    const D: usize,
    const E: usize,
    const F: usize,
    const N: usize,
    const K: usize,
    const M: usize,
    const G: usize,
    const Q: usize,
    const T: usize,
    const U: usize,
> TrajectoryController<AXES, A, W, P, R, C, S, H, X, D, E, F, N, K, M, G, Q, T, U>
{
    /// Ticks that a period's correction waits for: those of the longest way, over the point of the
    /// command and the servo response to it.
    pub const WAIT: u64 = PathPoint::<AXES, A, P, R, C, S, H, H, X, D, E>::LATENCY
        + ReferenceModel::<P, K, M>::LATENCY;

    /// Ticks from the beginning of a period to its torques.
    pub const LATENCY: u64 = 2 + Self::WAIT + 3 + Servo::<W, P, K, M, G, Q, T>::LATENCY;

    /// Shortest interpolation period in ticks: the next one begins when the torques stand. A longer
    /// one is never late.
    pub const LEAST_PERIOD: u64 = Self::LATENCY - 1;

    /// The same, whose corrections wait for so many ticks.
    #[must_use]
    pub fn waiting(self, wait: u64) -> Self {
        let gather = PeriodJoin { wait };
        TrajectoryController { gather, ..self }
    }

    /// A controller whose commands are corrected so, and whose models round so.
    pub fn new(correction: Correction, rounding: Rounding) -> Self {
        let radius_word = match correction {
            Correction::Steady => STEADY_RADIUS,
            Correction::Vector | Correction::None => RADIUS,
        };
        TrajectoryController {
            correction,
            period_counter: EnableCounter,
            memory: RecordMemory,
            sequencer: RecordSequencer,
            profile: DifferenceEngine::new(0),
            progress: PathLength,
            clamp: LengthClamp,
            tangential: ReferenceModel::new(rounding),
            distribution: PathPoint::default(),
            reference_point: PathPoint::new(radius_word),
            gather: PeriodJoin { wait: Self::WAIT },
            axes: from_fn(|_| ControlledAxis::new(correction, rounding)),
        }
    }
}

impl<
    const AXES: usize,
    const A: usize,
    const W: usize,
    const P: usize,
    const R: usize,
    const C: usize,
    const S: usize,
    const H: usize,
    const X: usize,
    const D: usize,
    const E: usize,
    const F: usize,
    const N: usize,
    const K: usize,
    const M: usize,
    const G: usize,
    const Q: usize,
    const T: usize,
    const U: usize,
> Circuit for TrajectoryController<AXES, A, W, P, R, C, S, H, X, D, E, F, N, K, M, G, Q, T, U>
{
    const NAME: &'static str = "trajectory_controller";
    const ABOUT: &'static str = "a path and its profile in, torques that keep to the path out";
    type In<L: Logic> = In<L, AXES, A, P, D, E, K, G, T, U>;
    type Reg<L: Logic> = Reg<L, AXES, A, W, P, R, C, S, H, X, D, E, F, N, K, M, G, Q, T, U>;
    type Net<L: Logic> = Net<L, AXES, A, W, P, R, C, S, H, X, D, E, F, N, K, M, G, Q, T, U>;

    fn comb<L: Logic>(&self, q: &Self::Reg<L>, i: &Self::In<L>) -> Self::Net<L> {
        let period_counter = Instance::settle(
            &self.period_counter,
            &q.period_counter,
            enable_counter::In { period: i.period },
        );
        let memory = Instance::settle(
            &self.memory,
            &q.memory,
            record_memory::In {
                write: i.write,
                write_word: i.write_word,
                write_data: i.write_data,
                push: i.push,
                take: q.sequencer.take,
                kind: q.sequencer.kind,
                flush: i.halt,
            },
        );
        let sequencer = Instance::settle(
            &self.sequencer,
            &q.sequencer,
            record_sequencer::In {
                start: i.start,
                halt: i.halt,
                sample: period_counter.w.enable,
                available: memory.w.available,
                load: q.memory.load,
                word: q.memory.word,
                data: q.memory.data,
                loaded: q.memory.loaded,
                rotated: false.into(),
            },
        );
        let profile = Instance::settle(
            &self.profile,
            &q.profile,
            difference_engine::In {
                load: memory.w.load_engines,
                word: q.memory.word,
                data: q.memory.data,
                modulus: q.sequencer.modulus,
                step: sequencer.w.advance,
            },
        );
        let progress = Instance::settle(
            &self.progress,
            &q.progress,
            path_length::In {
                sample: period_counter.w.enable,
                present: sequencer.w.present,
                profile: profile.w.nearest,
                restart: i.restart,
            },
        );
        let clamp = |length| {
            let path_end = i.path_end;
            let i = length_clamp::In { length, path_end };
            Instance::settle(&self.clamp, &Nothing::new(), i)
        };
        let clamp_command = clamp(q.progress.length);
        let tangential = Instance::settle(
            &self.tangential,
            &q.tangential,
            reference_model::In {
                step: q.progress.fresh,
                preset: q.progress.preset,
                target: q.progress.length,
                gain_1: i.gain_1,
                gain_2: i.gain_2,
            },
        );
        let clamp_response = clamp(tangential.w.position);
        let point = |start, length| path_point::In {
            start,
            length,
            last: i.last,
            write_begin: i.write_begin,
            begin_segment: i.begin_segment,
            begin_length: i.begin_length,
            write: i.write_path,
            write_address: i.path_address,
            write_data: i.path_data,
        };
        let command = point(q.progress.fresh, clamp_command.w.clamped);
        let distribution = Instance::settle(&self.distribution, &q.distribution, command);
        // The prior art knows where the command is, not where the response is.
        let answer = match self.correction {
            Correction::Steady => point(q.progress.fresh, clamp_command.w.clamped),
            Correction::Vector | Correction::None => {
                point(tangential.w.fresh, clamp_response.w.clamped)
            }
        };
        let reference_point = Instance::settle(&self.reference_point, &q.reference_point, answer);
        let axes = Instance::settle_each(
            &self.axes,
            &q.axes,
            from_fn(|axis| controlled_axis::In {
                step: q.gather.step,
                preset: q.gather.preset,
                command: i
                    .given
                    .mux(i.given_command[axis], distribution.w.points[axis]),
                correct: q.gather.correct,
                target: reference_point.w.points[axis],
                a: i.a[axis],
                b: i.b[axis],
                gain_1: i.gain_1,
                gain_2: i.gain_2,
                position_gain: i.position_gain[axis],
                speed_gain: i.speed_gain[axis],
                integral_gain: i.integral_gain[axis],
                inertia: i.inertia[axis],
                limit: i.limit[axis],
            }),
        );
        let gather = Instance::settle(
            &self.gather,
            &q.gather,
            period_join::In {
                begins: q.progress.fresh,
                held: q.progress.held,
                placed: distribution.w.done,
                referred: reference_point.w.done,
                answered: axes[0].w.answered,
                driven: axes[0].w.driven,
                clear: i.restart,
            },
        );
        Net {
            torque: from_fn(|axis| axes[axis].w.torque),
            position: from_fn(|axis| axes[axis].w.position),
            lost: from_fn(|axis| axes[axis].w.lost),
            ready: memory.w.ready,
            busy: sequencer.w.busy,
            sampled: q.sequencer.sampled,
            fresh: q.progress.fresh,
            late: q.gather.late,
            profile_late: q.sequencer.late,
            starved: q.sequencer.starved,
            period_counter,
            memory,
            sequencer,
            profile,
            progress,
            clamp_command,
            tangential,
            clamp_response,
            distribution,
            reference_point,
            gather,
            axes,
        }
    }

    fn next<L: Logic>(&self, q: Self::Reg<L>, w: &Self::Net<L>, _: &Self::In<L>) -> Self::Reg<L> {
        Reg {
            period_counter: w
                .period_counter
                .next(&self.period_counter, q.period_counter),
            memory: w.memory.next(&self.memory, q.memory),
            sequencer: w.sequencer.next(&self.sequencer, q.sequencer),
            profile: w.profile.next(&self.profile, q.profile),
            progress: w.progress.next(&self.progress, q.progress),
            tangential: w.tangential.next(&self.tangential, q.tangential),
            distribution: w.distribution.next(&self.distribution, q.distribution),
            reference_point: w
                .reference_point
                .next(&self.reference_point, q.reference_point),
            gather: w.gather.next(&self.gather, q.gather),
            axes: Instance::next_each(&w.axes, &self.axes, q.axes),
        }
    }
}
