//! The whole compensator (Figs 1 and 6): position detector 10, control 22, target setter 18, time
//! data supply 21, completion detector 26, correction 23, and the sequencer that runs the steps.
//!
//! ```text
//!                                     ┌─────────────┐
//!  a, b, clear ──────────────────────▶│             ├──▶ drive, reverse, speed, brake
//!  run, halt, learn, common ─────────▶│             ├──▶ position, predicted, target, lead_time
//!  write_target, write_time, … ──────▶│ compensator ├──▶ fire, complete, timed_out
//!  ck_period, standstill, time_out ──▶│             ├──▶ error, overrun, learned
//!  rest, last_step, seed ────────────▶│             ├──▶ busy, refused, lost
//!                                     └─────────────┘
//! ```
//!
//! Where the lead comes from is a parameter: from the time Δt with the history as a shift register
//! or as a RAM, or from the speed as in Fig. 7. `brake` is the control signal; it holds from the
//! crossing through the rest up to the next step.

use super::lead_source::{LeadSource, SourceIn};
use super::{
    Comparator, Comparing, CompletionDetector, Correction, LeadPlacement, Placement,
    PositionHistory, RamHistory, RatioLogic, Sign, StepSequencer, TargetSetter, TimeData, TimeLead,
    comparator, completion_detector, correction, placement, ratio_logic, step_sequencer,
    target_setter, time_data,
};
use crate::blocks::{EnableCounter, QuadratureCounter, enable_counter, quadrature_counter};
use crate::check::SamePorts;
use crate::kernel::{Circuit, Instance, Nothing};
use crate::logic::{Image, Logic, Sim};
use crate::signals;

signals! {
    /// Ports in: encoder, control computer, settings.
    pub struct In<
        L,
        const C: usize,
        const W: usize,
        const A: usize,
        const D: usize,
        const N: usize,
        const S: usize,
    > {
        /// Encoder, channel A.
        pub a: L::Bit,
        /// Encoder, channel B.
        pub b: L::Bit,
        /// Between two steps: the position becomes 0, the history begins anew, the flags go.
        pub clear: L::Bit,
        /// Steps run one after the other; when it goes low the running one is the last.
        pub run: L::Bit,
        /// Ends the move of this step at once; nothing is learned from it.
        pub halt: L::Bit,
        /// Times are learned.
        pub learn: L::Bit,
        /// All steps share the time of step 0.
        pub common: L::Bit,
        /// The step after which step 0 comes.
        pub last_step: L::U<A>,
        /// Ticks of CK; 0 counts as 1.
        pub ck_period: L::U<S>,
        /// CKs without a change that are a standstill.
        pub standstill: L::U<N>,
        /// CKs from the control signal on after which a positioning is complete anyway.
        pub time_out: L::U<N>,
        /// CKs between two steps.
        pub rest: L::U<N>,
        /// The time that a step begins to learn with that has none.
        pub seed: L::U<C>,
        /// a of Fig. 7: lead time in gates, in 1/256.
        pub lead_parameter: L::U<14>,
        /// CKs of a gate of Fig. 7.
        pub gate: L::U<N>,
        /// A target and its speed are written.
        pub write_target: L::Bit,
        /// A time is written; off the grid it is refused.
        pub write_time: L::Bit,
        /// The step that is written.
        pub write_step: L::U<A>,
        /// The target that is written.
        pub step_target: L::I<W>,
        /// The speed that is written.
        pub step_speed: L::U<D>,
        /// The time that is written, in CKs.
        pub step_time: L::U<C>,
    }
}

signals! {
    /// Registers of the blocks.
    pub struct Reg<
        L,
        type P: Circuit,
        const C: usize,
        const W: usize,
        const A: usize,
        const D: usize,
        const R: usize,
        const N: usize,
        const S: usize,
    > {
        /// CK.
        pub ck_counter: enable_counter::Reg<L, S>,
        /// 10.
        pub detector: quadrature_counter::Reg<L, W>,
        /// What makes the lead.
        pub lead_source: P::Reg<L>,
        /// 18.
        pub target_setter: target_setter::Reg<L, A, W, D>,
        /// 21.
        pub time_data: time_data::Reg<L, A, C>,
        /// 19.
        pub comparator: comparator::Reg<L>,
        /// 26.
        pub completion: completion_detector::Reg<L, W, N>,
        /// 23.
        pub correction: correction::Reg<L, C, W, R>,
        /// The steps.
        pub sequencer: step_sequencer::Reg<L, A, N>,
    }
}

signals! {
    /// Nets of the blocks, and the ports out.
    pub struct Net<
        L,
        type P: Circuit,
        const K: usize,
        const T: usize,
        const C: usize,
        const W: usize,
        const A: usize,
        const D: usize,
        const R: usize,
        const N: usize,
        const S: usize,
    > {
        /// CK.
        pub ck_counter: Instance<EnableCounter<S>, L>,
        /// 10.
        pub detector: Instance<QuadratureCounter<W>, L>,
        /// What makes the lead.
        pub lead_source: Instance<P, L>,
        /// 18.
        pub target_setter: Instance<TargetSetter<A, W, D>, L>,
        /// Whether a time that is written is on the grid.
        pub write_check: Instance<RatioLogic<K, T, C>, L>,
        /// 21.
        pub time_data: Instance<TimeData<A, C>, L>,
        /// 17 or 20.
        pub placement: Instance<LeadPlacement<W>, L>,
        /// 19.
        pub comparator: Instance<Comparator<W>, L>,
        /// 26.
        pub completion: Instance<CompletionDetector<W, N>, L>,
        /// 23.
        pub correction: Instance<Correction<K, T, C, W, R>, L>,
        /// The steps.
        pub sequencer: Instance<StepSequencer<A, W, N>, L>,
        /// CK: a sample is taken.
        pub ck: L::Bit,
        /// Dx: the present sample.
        pub position: L::I<W> as Analog,
        /// What is compared with the target: Dx(+Δt) where all of the lead is put on the position.
        pub predicted: L::I<W> as Analog,
        /// Sx: the target of this step.
        pub target: L::I<W> as Analog,
        /// Δt1: the lead time of this step.
        pub lead_time: L::U<C> as Analog,
        /// The step that runs, or is next.
        pub step: L::U<A>,
        /// A step runs.
        pub busy: L::Bit,
        /// The motor is on.
        pub drive: L::Bit,
        /// The motor turns downwards.
        pub reverse: L::Bit,
        /// Speed of this step, for the drive.
        pub speed: L::U<D>,
        /// The control signal begins.
        pub fire: L::Bit,
        /// The control signal.
        pub brake: L::Bit,
        /// The positioning is complete.
        pub complete: L::Bit,
        /// It was complete because its time was over.
        pub timed_out: L::Bit,
        /// d1: the way since the control signal.
        pub overrun: L::I<W>,
        /// d2: the way past the target.
        pub error: L::I<W>,
        /// A time is learned in this tick.
        pub learned: L::Bit,
        /// Δt2: the time that is learned.
        pub learned_time: L::U<C>,
        /// A written time was refused since `clear`.
        pub refused: L::Bit,
        /// The encoder was too fast since `clear`.
        pub lost: L::Bit,
    }
}

/// What is chosen when a compensator is built.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Variant {
    /// What the lead is put on.
    pub placement: Placement,
    /// When the target is reached.
    pub comparing: Comparing,
    /// Which way the error counts.
    pub sign: Sign,
}

/// Compensator whose lead comes from `P`, with `K` stages of history, taps of `T` bits, times of
/// `C`, positions of `W`, 2^`A` steps, speeds of `D` bits, `R` = `W` + `C`, times counted in CKs of
/// `N` bits, a CK of up to 2^`S` − 1 ticks.
///
/// From the tick of CK, in which a position stands, to `fire` it is one tick, to `brake` two.
#[derive(Debug, Clone, Default)]
pub struct Compensator<
    P,
    const K: usize = 199,
    const T: usize = 8,
    const C: usize = 11,
    const W: usize = 24,
    const A: usize = 4,
    const D: usize = 16,
    const R: usize = 35,
    const N: usize = 16,
    const S: usize = 24,
> {
    /// CK.
    pub ck_counter: EnableCounter<S>,
    /// 10.
    pub detector: QuadratureCounter<W>,
    /// What makes the lead.
    pub lead_source: P,
    /// 18.
    pub target_setter: TargetSetter<A, W, D>,
    /// Whether a time that is written is on the grid.
    pub write_check: RatioLogic<K, T, C>,
    /// 21.
    pub time_data: TimeData<A, C>,
    /// 17 or 20.
    pub placement: LeadPlacement<W>,
    /// 19.
    pub comparator: Comparator<W>,
    /// 26.
    pub completion: CompletionDetector<W, N>,
    /// 23.
    pub correction: Correction<K, T, C, W, R>,
    /// The steps.
    pub sequencer: StepSequencer<A, W, N>,
}

impl<
    P: LeadSource<C, W, N>,
    const K: usize,
    const T: usize,
    const C: usize,
    const W: usize,
    const A: usize,
    const D: usize,
    const R: usize,
    const N: usize,
    const S: usize,
> Compensator<P, K, T, C, W, A, D, R, N, S>
{
    /// A compensator of this variant, with the ROM's times of its steps in CKs.
    pub fn new(variant: Variant, rom: Image<A, C>) -> Self {
        Compensator {
            time_data: TimeData { rom },
            placement: LeadPlacement {
                placement: variant.placement,
            },
            comparator: Comparator {
                comparing: variant.comparing,
            },
            correction: Correction::new(variant.sign),
            ..Self::default()
        }
    }
}

impl<
    P: LeadSource<C, W, N>,
    const K: usize,
    const T: usize,
    const C: usize,
    const W: usize,
    const A: usize,
    const D: usize,
    const R: usize,
    const N: usize,
    const S: usize,
> Circuit for Compensator<P, K, T, C, W, A, D, R, N, S>
{
    const NAME: &'static str = P::COMPENSATOR;
    const ABOUT: &'static str = P::COMPENSATOR_ABOUT;
    type In<L: Logic> = In<L, C, W, A, D, N, S>;
    type Reg<L: Logic> = Reg<L, P, C, W, A, D, R, N, S>;
    type Net<L: Logic> = Net<L, P, K, T, C, W, A, D, R, N, S>;

    fn comb<L: Logic>(&self, q: &Self::Reg<L>, i: &Self::In<L>) -> Self::Net<L> {
        let ck_counter = Instance::settle(
            &self.ck_counter,
            &q.ck_counter,
            enable_counter::In {
                period: i.ck_period,
            },
        );
        let ck = ck_counter.w.enable;
        let detector = Instance::settle(
            &self.detector,
            &q.detector,
            quadrature_counter::In {
                a: i.a,
                b: i.b,
                clear: i.clear,
            },
        );
        let sequence = &q.sequencer;
        let target_setter = Instance::settle(
            &self.target_setter,
            &q.target_setter,
            target_setter::In {
                write: i.write_target,
                write_step: i.write_step,
                write_target: i.step_target,
                write_speed: i.step_speed,
                load: sequence.load,
                step: sequence.step,
            },
        );
        let target = q.target_setter.target;
        let time = q.time_data.lead_time;
        let lead_source: Instance<P, L> = Instance::settle(
            &self.lead_source,
            &q.lead_source,
            P::ports(SourceIn {
                ck,
                restart: i.clear,
                position: q.detector.position,
                time,
                parameter: i.lead_parameter,
                gate: i.gate,
            }),
        );
        let lead = P::outputs(&q.lead_source, &lead_source.w);
        let placement = Instance::settle(
            &self.placement,
            &Nothing::new(),
            placement::In {
                position: lead.present,
                target,
                lead: lead.lead,
            },
        );
        let comparator = Instance::settle(
            &self.comparator,
            &q.comparator,
            comparator::In {
                evaluate: lead.fresh,
                valid: lead.enough,
                position: placement.w.compared_position,
                target: placement.w.compared_target,
                arm: sequence.arm,
                halt: sequence.halting,
            },
        );
        let completion = Instance::settle(
            &self.completion,
            &q.completion,
            completion_detector::In {
                evaluate: lead.fresh,
                position: lead.present,
                active: sequence.braking,
                standstill: i.standstill,
                time_out: i.time_out,
            },
        );
        let correction = Instance::settle(
            &self.correction,
            &q.correction,
            correction::In {
                fire: comparator.w.fire,
                complete: q.completion.complete,
                position: lead.present,
                target,
                lead_time: time,
                learn: i.learn,
                missed: sequence.missed,
                seed: i.seed,
            },
        );
        let write_check = Instance::settle(
            &self.write_check,
            &Nothing::new(),
            ratio_logic::In {
                lead_time: i.step_time,
            },
        );
        let time_data = Instance::settle(
            &self.time_data,
            &q.time_data,
            time_data::In {
                load: sequence.load,
                step: sequence.step,
                common: i.common,
                learned: correction.w.learned,
                learned_time: correction.w.learned_time,
                write: i.write_time,
                write_step: i.write_step,
                write_time: i.step_time,
                write_on_grid: write_check.w.on_grid,
                clear: i.clear,
            },
        );
        let sequencer = Instance::settle(
            &self.sequencer,
            &q.sequencer,
            step_sequencer::In {
                run: i.run,
                halt: i.halt,
                last_step: i.last_step,
                position: lead.present,
                target,
                evaluate: lead.fresh,
                control: q.comparator.control,
                complete: q.completion.complete,
                corrected: correction.w.corrected,
                ck,
                rest: i.rest,
            },
        );
        Net {
            ck,
            position: lead.present,
            predicted: placement.w.compared_position,
            target,
            lead_time: time,
            step: sequence.step,
            busy: sequence.busy,
            drive: sequence.drive,
            reverse: sequence.reverse,
            speed: q.target_setter.speed,
            fire: comparator.w.fire,
            brake: q.comparator.control,
            complete: q.completion.complete,
            timed_out: q.completion.timed_out,
            overrun: correction.w.overrun,
            error: correction.w.error,
            learned: correction.w.learned,
            learned_time: correction.w.learned_time,
            refused: q.time_data.refused,
            lost: q.detector.lost,
            ck_counter,
            detector,
            lead_source,
            target_setter,
            write_check,
            time_data,
            placement,
            comparator,
            completion,
            correction,
            sequencer,
        }
    }

    fn next<L: Logic>(&self, q: Self::Reg<L>, w: &Self::Net<L>, _: &Self::In<L>) -> Self::Reg<L> {
        Reg {
            ck_counter: w.ck_counter.next(&self.ck_counter, q.ck_counter),
            detector: w.detector.next(&self.detector, q.detector),
            lead_source: w.lead_source.next(&self.lead_source, q.lead_source),
            target_setter: w.target_setter.next(&self.target_setter, q.target_setter),
            time_data: w.time_data.next(&self.time_data, q.time_data),
            comparator: w.comparator.next(&self.comparator, q.comparator),
            completion: w.completion.next(&self.completion, q.completion),
            correction: w.correction.next(&self.correction, q.correction),
            sequencer: w.sequencer.next(&self.sequencer, q.sequencer),
        }
    }

    fn power_on(&self) -> Reg<Sim, P, C, W, A, D, R, N, S> {
        Reg {
            ck_counter: self.ck_counter.power_on(),
            detector: self.detector.power_on(),
            lead_source: self.lead_source.power_on(),
            target_setter: self.target_setter.power_on(),
            time_data: self.time_data.power_on(),
            comparator: self.comparator.power_on(),
            completion: self.completion.power_on(),
            correction: self.correction.power_on(),
            sequencer: self.sequencer.power_on(),
        }
    }
}

impl<
    const K: usize,
    const T: usize,
    const C: usize,
    const W: usize,
    const A: usize,
    const D: usize,
    const R: usize,
    const N: usize,
    const S: usize,
> SamePorts<Compensator<TimeLead<PositionHistory<K, T, W>, K, T, C, W>, K, T, C, W, A, D, R, N, S>>
    for Compensator<TimeLead<RamHistory<K, T, W>, K, T, C, W>, K, T, C, W, A, D, R, N, S>
{
    fn ports<L: Logic>(i: &In<L, C, W, A, D, N, S>) -> &In<L, C, W, A, D, N, S> {
        i
    }
}
