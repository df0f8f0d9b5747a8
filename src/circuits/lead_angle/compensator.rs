//! The whole compensator (Figs 1 and 6): position detector 10, control 22, target setter 18, time
//! data supply 21, completion detector 26, correction 23, and the sequencer that runs the steps.
//!
//! ```text
//!                                     ┌─────────────┐
//!  a, b; strobe, code, sine, cosine ──▶│             ├──▶ drive, reverse, speed, brake; carrier
//!  secondary, turn, clear, run, halt … ▶│             ├──▶ position, predicted, target, lead_time
//!  write_target, write_time, … ──────▶│ compensator ├──▶ fire, complete, timed_out
//!  ck_period, standstill, time_out ──▶│             ├──▶ error, overrun, learned
//!  rest, last_step, seed ────────────▶│             ├──▶ busy, refused, lost
//!  passing, effect ──────────────────▶│             ├──▶ operate
//!                                     └─────────────┘
//! ```
//!
//! The position comes from an incremental encoder, or from a detector of places in a turn or a
//! pitch whose clock is CK. The lead comes from the time Δt, with the history as a shift register
//! or as a RAM, in any of the equal [forms](super::LeadForm), or from the speed as in Fig. 7, by a
//! parameter or a memory. `brake` is the control signal; it holds from the crossing through the
//! rest up to the next step. With `passing` the body does not stop, and `operate` is the control
//! signal in place of `brake`: for an operation that is complete with its `effect`.

use super::detector::{Detected, DetectorPart, DetectorSource};
use super::grid::{self, Grid, GridPart};
use super::lead_source::{LeadFrom, LeadIn, LeadPart, LeadSource};
use super::{
    Comparator, CompletionDetector, Correction, Detector, Form, LeadPlacement, Placement,
    StepSequencer, TargetSetter, TimeData, TouchProbe, Variant, Widths, comparator,
    completion_detector, correction, placement, step_sequencer, target_setter, time_data,
    touch_probe,
};
use crate::circuits::blocks::{EnableCounter, enable_counter};
use crate::prelude::*;

/// Compensator.
///
/// `fire` is high one tick after the tick of CK in which a position is present, `brake` two.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Compensator {
    /// Its widths.
    pub widths: Widths,
    /// Source of the lead.
    pub lead_from: LeadFrom,
    /// Variants of the other circuits.
    pub variant: Variant,
    /// 25: the times of its steps at power-on, in CKs.
    pub rom: Image,
}

impl Compensator {
    /// The products are the place itself, on which no lead is put any more.
    fn placed(&self) -> bool {
        self.lead_from.form().form() != Form::Products
    }

    /// 21.
    fn time_data(&self) -> TimeData {
        let (division, stages) = (self.lead_from.form().division(), self.widths.stages);
        let (step, time) = (self.widths.step, grid::word(division, stages));
        let data = self
            .rom
            .iter()
            .map(|time| grid::data(division, stages, time));
        let rom = Image::of(step, time, data);
        TimeData { step, time, rom }
    }
}

signals! { for Compensator as c;
    /// Input ports: encoder, control computer, settings.
    pub struct In {
        /// Incremental encoder, channel A.
        pub a: Bit,
        /// Incremental encoder, channel B.
        pub b: Bit,
        /// Absolute encoder, its sampling clock; resolver, its words are new.
        pub strobe: Bit,
        /// Absolute encoder, its Gray word.
        pub code: U(c.widths.code) as Hex,
        /// Phase-shift transducer: its secondary is above zero.
        pub secondary: Bit,
        /// Resolver: its sine winding, at a peak of the carrier.
        pub sine: I(c.widths.converter),
        /// Resolver: its cosine winding.
        pub cosine: I(c.widths.converter),
        /// Counts of an absolute encoder's turn, of a resolver's pitch, or of a phase-shift
        /// transducer's, which are ticks of its carrier; 0 for all words.
        pub turn: U(c.widths.code),
        /// Between two steps: sets the position to 0, or to the next place in turn or pitch,
        /// restarts the history and clears the flags.
        pub clear: Bit,
        /// Steps run one after the other; when it goes low the running one is the last.
        pub run: Bit,
        /// Ends the move of this step immediately; nothing is learned from it.
        pub halt: Bit,
        /// The body does not stop: the control signal starts an operation in passing.
        pub passing: Bit,
        /// The operation takes effect; synchronised. Without `passing` it does nothing.
        pub effect: Bit,
        /// Times are learned.
        pub learn: Bit,
        /// All steps share the time of step 0.
        pub common: Bit,
        /// The step after which step 0 comes.
        pub last_step: U(c.widths.step),
        /// Ticks of CK; 0 counts as 1. Encoders of places have a CK of their own.
        pub ck_period: U(c.widths.ck_period),
        /// CKs without a change that are a standstill.
        pub standstill: U(c.widths.cks),
        /// CKs from the control signal on after which a positioning is complete anyway.
        pub time_out: U(c.widths.cks),
        /// CKs between two steps.
        pub rest: U(c.widths.cks),
        /// The time that a step begins to learn with that has none.
        pub seed: U(c.widths.time()),
        /// a of Fig. 7: lead time in gates, in 1/256.
        pub lead_parameter: U(14),
        /// CKs of a gate of Fig. 7.
        pub gate: U(c.widths.cks),
        /// A target and its speed are written.
        pub write_target: Bit,
        /// A time is written; off the grid it is refused.
        pub write_time: Bit,
        /// The step that is written.
        pub write_step: U(c.widths.step),
        /// The target that is written.
        pub step_target: I(c.widths.position),
        /// The speed that is written.
        pub step_speed: U(c.widths.speed),
        /// The time that is written, in CKs.
        pub step_time: U(c.widths.time()),
    }
    /// The circuits inside.
    pub struct Parts {
        /// CK.
        pub ck_counter: Part<EnableCounter>(EnableCounter { width: c.widths.ck_period }),
        /// 10.
        pub detector: DetectorPart(&DetectorSource::of(c.variant.detector, &c.widths)),
        /// Lead, by time or by speed.
        pub lead_source: LeadPart(&LeadSource::of(&c.lead_from, &c.widths)),
        /// 18.
        pub target_setter: Part<TargetSetter>(TargetSetter {
            step: c.widths.step, position: c.widths.position, speed: c.widths.speed,
        }),
        /// Check that a written time is on the grid.
        pub write_check: GridPart(&Grid::of(c.lead_from.form().division(), c.widths.stages)),
        /// 21.
        pub time_data: Part<TimeData>(c.time_data()),
        /// 17 or 20.
        pub placement: Part<LeadPlacement>(LeadPlacement {
            position: c.widths.position, placement: c.variant.placement,
        }) if c.placed(),
        /// 19.
        pub comparator: Part<Comparator>(Comparator {
            position: c.widths.position, comparing: c.variant.comparing,
        }),
        /// Position at which an operation took effect.
        pub probe: Part<TouchProbe>(TouchProbe { position: c.widths.position }),
        /// 26.
        pub completion: Part<CompletionDetector>(CompletionDetector {
            position: c.widths.position, time: c.widths.cks,
        }),
        /// 23.
        pub correction: Part<Correction>(Correction {
            stages: c.widths.stages, position: c.widths.position, sign: c.variant.sign,
            function: c.variant.function, division: c.lead_from.form().division(),
        }),
        /// The steps.
        pub sequencer: Part<StepSequencer>(StepSequencer {
            step: c.widths.step, position: c.widths.position, rest: c.widths.cks,
        }),
    }
    /// Output ports.
    pub struct Net {
        /// CK: a sample is taken.
        pub ck: Bit,
        /// Dx: the present sample.
        pub position: I(c.widths.position) as Analog,
        /// Position to compare with the target: Dx(+Δt) where all of the lead is added to the
        /// position.
        pub predicted: I(c.widths.position) as Analog,
        /// Sx: the target of this step.
        pub target: I(c.widths.position) as Analog,
        /// Δt1: the lead time of this step.
        pub lead_time: U(c.widths.time()) as Analog,
        /// The step that runs, or is next.
        pub step: U(c.widths.step),
        /// A step runs.
        pub busy: Bit,
        /// The motor is on.
        pub drive: Bit,
        /// The motor turns downwards.
        pub reverse: Bit,
        /// Speed of this step, for the drive.
        pub speed: U(c.widths.speed),
        /// The control signal begins.
        pub fire: Bit,
        /// The control signal, where it stops the body.
        pub brake: Bit,
        /// The control signal, where it starts an operation in passing.
        pub operate: Bit,
        /// The positioning is complete.
        pub complete: Bit,
        /// The positioning was completed by its time-out.
        pub timed_out: Bit,
        /// d1: distance since the control signal.
        pub overrun: I(c.widths.position),
        /// d2: distance past the target.
        pub error: I(c.widths.position),
        /// A time is learned in this tick.
        pub learned: Bit,
        /// Δt2: the time that is learned.
        pub learned_time: U(c.widths.time()),
        /// A written time was refused since `clear`.
        pub refused: Bit,
        /// The encoder was too fast since `clear`, or its signal wrong.
        pub lost: Bit,
        /// Phase of a phase-shift detector's carrier, for the D/A converters of the primaries.
        pub carrier: U(c.widths.code) if (c.variant.detector == Detector::PhaseShift),
    }
}

impl Circuit for Compensator {
    const NAME: &'static str = "compensator";
    const ABOUT: &'static str = "lead-angle compensator that learns its lead times";
    records!(In, Nothing, Net, Parts);

    fn name(&self) -> &'static str {
        self.lead_from.compensator().0
    }

    fn about(&self) -> &'static str {
        self.lead_from.compensator().1
    }

    fn objection(&self) -> Option<String> {
        let wrong = !self.placed() && self.variant.placement != Placement::Position;
        wrong.then(|| "the products are the place itself: no lead is put on a target".into())
    }

    fn tick(&self, i: In, _: Nothing, p: Parts) -> (Net, Nothing) {
        let ck_counter = p.ck_counter.settle(enable_counter::In {
            period: i.ck_period,
        });
        let Detected {
            ck,
            position,
            lost,
            carrier,
        } = p.detector.detect(&i, ck_counter.w.enable);
        let target = p.target_setter.q.target;
        let sequence = &p.sequencer.q;
        let target_setter = p.target_setter.settle(target_setter::In {
            write: i.write_target,
            write_step: i.write_step,
            write_target: i.step_target,
            write_speed: i.step_speed,
            load: sequence.load,
            step: sequence.step,
        });
        let lead = p.lead_source.settle(LeadIn {
            ck,
            restart: i.clear,
            position,
            data: p.time_data.q.lead_time,
            lead_parameter: i.lead_parameter,
            gate: i.gate,
        });
        let compared = placement::compared(p.placement, &lead, target);
        let comparator = p.comparator.settle(comparator::In {
            evaluate: lead.fresh,
            valid: lead.enough,
            position: compared.position,
            target: compared.target,
            arm: sequence.arm,
            halt: sequence.halting,
        });
        let control = comparator.q.control;
        let (brake, operate) = (control & !i.passing, control & i.passing);
        let probe = p.probe.settle(touch_probe::In {
            active: operate,
            effect: i.effect,
            position,
            present: lead.present,
        });
        let completion = p.completion.settle(completion_detector::In {
            evaluate: lead.fresh,
            position: lead.present,
            active: sequence.braking,
            effect: probe.q.taken,
            standstill: i.standstill,
            time_out: i.time_out,
        });
        let correction = p.correction.settle(correction::In {
            fire: comparator.w.fire,
            complete: completion.q.complete,
            position: probe.w.measured,
            target,
            lead_time: lead.time,
            learn: i.learn,
            // An operation without effect gives no distance to learn from.
            missed: sequence.missed | (i.passing & !probe.q.taken),
            seed: i.seed,
        });
        let write_check = p.write_check.settle(i.step_time);
        let learned = &correction.w;
        let time_data = p.time_data.settle(time_data::In {
            load: sequence.load,
            step: sequence.step,
            common: i.common,
            learned: correction.w.learned,
            learned_time: learned.learned_data.unwrap_or(learned.learned_time),
            write: i.write_time,
            write_step: i.write_step,
            write_time: write_check.divided.unwrap_or(i.step_time),
            write_on_grid: write_check.on_grid,
            clear: i.clear,
        });
        let sequencer = p.sequencer.settle(step_sequencer::In {
            run: i.run,
            halt: i.halt,
            last_step: i.last_step,
            position: lead.present,
            target,
            evaluate: lead.fresh,
            control,
            complete: completion.q.complete,
            corrected: correction.w.corrected,
            ck,
            passing: i.passing,
            rest: i.rest,
        });
        let net = Net {
            ck,
            position: lead.present,
            predicted: compared.position,
            target,
            lead_time: lead.time,
            step: sequencer.q.step,
            busy: sequencer.q.busy,
            drive: sequencer.q.drive,
            reverse: sequencer.q.reverse,
            speed: target_setter.q.speed,
            fire: comparator.w.fire,
            brake,
            operate,
            complete: completion.q.complete,
            timed_out: completion.q.timed_out,
            overrun: correction.w.overrun,
            error: correction.w.error,
            learned: correction.w.learned,
            learned_time: correction.w.learned_time,
            refused: time_data.q.refused,
            lost,
            carrier,
        };
        (net, Nothing)
    }
}
