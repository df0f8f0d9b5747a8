//! Complete compensator (Figs 1 and 6): position detector 10, control 22, target setter 18, time
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
//! The position comes from an incremental encoder, or from a detector of places in a turn or pitch,
//! which supplies CK. The lead comes from the time Δt, with the history as a shift register or as a
//! RAM, in any of the equal [forms](super::LeadForm); or from the speed as in Fig. 7, by a
//! parameter or a memory. `brake` is the control signal; it holds from the crossing through the
//! rest until the next step. With `passing` the body does not stop, and `operate` is the control
//! signal in place of `brake`: for an operation that is complete when it takes `effect`.

use super::detector::{Detected, DetectorPart, DetectorSource};
use super::grid::{self, Grid, GridPart};
use super::lead_source::{LeadFrom, LeadIn, LeadPart, LeadSource};
use super::step_sequencer::{BRAKE, CORRECT};
use super::{
    Comparator, CompletionDetector, Correction, Detector, Form, LeadPlacement, Placement,
    StepSequencer, TargetSetter, TimeData, TouchProbe, Variant, Widths, codes, comparator,
    completion_detector, correction, placement, step_sequencer, target_setter, time_data,
    touch_probe,
};
use crate::circuits::blocks::{EnableCounter, enable_counter};
use crate::prelude::*;

/// Compensator.
///
/// If a position that is present in the tick of CK reaches the target, `fire` is high one tick
/// later and `brake` two ticks later.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Compensator {
    /// Word widths.
    pub widths: Widths,
    /// Source of the lead.
    pub lead_from: LeadFrom,
    /// Variants of the other circuits.
    pub variant: Variant,
    /// Times of the steps at power-on, in CKs: the contents of 25.
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
        /// Channel A of the incremental encoder.
        pub a: Bit,
        /// Channel B of the incremental encoder.
        pub b: Bit,
        /// Absolute encoder: sampling clock. Resolver: its words are new.
        pub strobe: Bit,
        /// Absolute encoder: word in Gray code.
        pub code: U(c.widths.code) as Hex,
        /// Phase-shift transducer: the secondary is above zero.
        pub secondary: Bit,
        /// Resolver: sine winding, sampled at a peak of the carrier.
        pub sine: I(c.widths.converter),
        /// Resolver: cosine winding, sampled at a peak of the carrier.
        pub cosine: I(c.widths.converter),
        /// Counts of an absolute encoder's turn or of a resolver's pitch; ticks of a phase-shift
        /// transducer's carrier period. 0 for the full range of the word.
        pub turn: U(c.widths.code),
        /// Sets the position to 0, or to the next place in turn or pitch, restarts the history and
        /// clears the flags. For use between two steps.
        pub clear: Bit,
        /// Runs the steps one after the other; when it falls, the running step is the last.
        pub run: Bit,
        /// Ends the move of this step immediately; nothing is learned from it.
        pub halt: Bit,
        /// High: the body does not stop, and the control signal starts an operation in passing.
        pub passing: Bit,
        /// High when the operation takes effect; synchronous to the clock. Used with `passing`
        /// only.
        pub effect: Bit,
        /// Enables learning.
        pub learn: Bit,
        /// All steps share the time of step 0.
        pub common: Bit,
        /// Number of the last step; step 0 follows it.
        pub last_step: U(c.widths.step),
        /// Period of CK in ticks; 0 counts as 1. Detectors of places supply their own CK.
        pub ck_period: U(c.widths.ck_period),
        /// CKs without a change that count as a standstill; 0 counts as 1.
        pub standstill: U(c.widths.cks),
        /// CKs from the control signal after which a positioning is complete in any case; 0 counts
        /// as 1.
        pub time_out: U(c.widths.cks),
        /// Pause between two steps, in CKs.
        pub rest: U(c.widths.cks),
        /// Lead time, in CKs, that a step without one gets after its first stop error.
        pub seed: U(c.widths.time()),
        /// a of Fig. 7: lead time in units of 1/256 gate.
        pub lead_parameter: U(14),
        /// Length of the gate of Fig. 7, in CKs; 0 counts as 1.
        pub gate: U(c.widths.cks),
        /// Writes a target and its speed.
        pub write_target: Bit,
        /// Writes a time; a time off the grid is refused.
        pub write_time: Bit,
        /// Number of the step to write.
        pub write_step: U(c.widths.step),
        /// Target to write.
        pub step_target: I(c.widths.position),
        /// Speed to write.
        pub step_speed: U(c.widths.speed),
        /// Time to write, in CKs.
        pub step_time: U(c.widths.time()),
    }
    /// The circuits inside.
    pub struct Parts {
        /// Counter for CK.
        pub ck_counter: Part<EnableCounter>(EnableCounter { width: c.widths.ck_period }),
        /// Position detector 10.
        pub detector: DetectorPart(&DetectorSource::of(c.variant.detector, &c.widths)),
        /// Lead, by time or by speed.
        pub lead_source: LeadPart(&LeadSource::of(&c.lead_from, &c.widths)),
        /// Target setter 18.
        pub target_setter: Part<TargetSetter>(TargetSetter {
            step: c.widths.step, position: c.widths.position, speed: c.widths.speed,
        }),
        /// Check that a written time is on the grid.
        pub write_check: GridPart(&Grid::of(c.lead_from.form().division(), c.widths.stages)),
        /// Time data supply 21.
        pub time_data: Part<TimeData>(c.time_data()),
        /// Adder 17 or subtractor 20.
        pub placement: Part<LeadPlacement>(LeadPlacement {
            position: c.widths.position, placement: c.variant.placement,
        }) if c.placed(),
        /// Comparator 19.
        pub comparator: Part<Comparator>(Comparator {
            position: c.widths.position, comparing: c.variant.comparing,
        }),
        /// Position at which an operation took effect.
        pub probe: Part<TouchProbe>(TouchProbe { position: c.widths.position }),
        /// Completion detector 26.
        pub completion: Part<CompletionDetector>(CompletionDetector {
            position: c.widths.position, time: c.widths.cks,
        }),
        /// Correction 23.
        pub correction: Part<Correction>(Correction {
            stages: c.widths.stages, position: c.widths.position, sign: c.variant.sign,
            function: c.variant.function, division: c.lead_from.form().division(),
        }),
        /// Sequencer of the steps.
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
        /// Δt1: lead time of this step, in CKs.
        pub lead_time: U(c.widths.time()) as Analog,
        /// Number of the running step, or of the next one.
        pub step: U(c.widths.step),
        /// A step is running.
        pub busy: Bit,
        /// The motor is on.
        pub drive: Bit,
        /// Direction of the motor; high counts down.
        pub reverse: Bit,
        /// Speed of this step, for the drive.
        pub speed: U(c.widths.speed),
        /// High for one tick: the control signal begins.
        pub fire: Bit,
        /// Control signal that stops the body, without `passing`.
        pub brake: Bit,
        /// Control signal that starts an operation, with `passing`.
        pub operate: Bit,
        /// High for one tick: the positioning is complete.
        pub complete: Bit,
        /// The last positioning was completed by its time-out.
        pub timed_out: Bit,
        /// d1: distance since the control signal, positive upwards.
        pub overrun: I(c.widths.position),
        /// d2: distance past the target, positive upwards.
        pub error: I(c.widths.position),
        /// High for one tick: a time is learned.
        pub learned: Bit,
        /// Δt2: learned time, in CKs; valid with `learned`.
        pub learned_time: U(c.widths.time()),
        /// A written time was refused; cleared by `clear`.
        pub refused: Bit,
        /// The encoder was too fast, or its signal was wrong; cleared by `clear`.
        pub lost: Bit,
        /// Phase of the carrier of a phase-shift detector, for the D/A converters of the primaries.
        pub carrier: U(c.widths.code) if (c.variant.detector == Detector::PhaseShift),
    }
}

impl Compensator {
    /// High if a lead time is at most the largest code.
    pub(crate) fn is_code(&self, time: U) -> Bit {
        let largest = codes::largest(self.widths.stages);
        !U::new(largest, time.width()).below(time)
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

    fn properties(&self, now: &Moment<Self>) -> Vec<Property> {
        let (p, time) = (&now.p, now.w.lead_time);
        let state = p.sequencer.q.state;
        let divides = p.correction.p.arithmetic.q.dividing;
        let corrects = state.equals(CORRECT) & !time.is_zero();
        let completes = p.completion.q.complete.implies(state.equals(BRAKE));
        let mut all = vec![
            Property::given(
                "the lead time of a step is at most the largest code",
                self.is_code(time),
            ),
            Property::helper(
                "a division runs in the state correct only, and not for a lead time of 0",
                &["sequencer.state", "lead_time"],
                divides.implies(corrects) & completes,
            ),
        ];
        if self.variant.detector == Detector::PhaseShift {
            let turn = now.i.turn;
            all.push(Property::given(
                "turn is 0 or at least 4",
                turn.is_zero() | !turn.shift_right(2).is_zero(),
            ));
        }
        all
    }
}
