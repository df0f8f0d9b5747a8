use crate::circuits::lead_angle::{
    AbsoluteDetector, Comparator, Comparing, Compensator, CompletionDetector, Correction,
    CorrectionArithmetic, DifferenceHistory, DividedTime, Division, ExactRelation, Function,
    GrayReceiver, Lead, LeadForm, LeadFrom, LeadPlacement, LeadProducts, LeadTable, Memory,
    PhaseCounter, PhaseDetector, Placement, PositionHistory, RamHistory, RatioLogic, Refinement,
    ResolverDetector, Sign, SpeedDetector, SpeedLead, StepSequencer, StopError, TableLead,
    TargetSetter, TimeData, TimeLead, TimeLimit, TouchProbe, TrackingConverter, TrackingLoop,
    Unwrapper, Variant, Widths,
};
use crate::hdl::Image;
use crate::registry::Entry;
use crate::registry::entry::entry;

/// Positions, speeds, times and CK of four bits.
const SMALL: Widths = Widths {
    stages: 3,
    position: 4,
    step: 2,
    speed: 4,
    cks: 4,
    ck_period: 4,
    code: 3,
    converter: 3,
};

/// The lead of a time in the form of the figures.
fn time(memory: Memory) -> LeadFrom {
    LeadFrom::Time {
        memory,
        form: LeadForm::Embodiment,
    }
}

/// A compensator without any time.
fn compensator(lead_from: LeadFrom, widths: Widths) -> Compensator {
    let rom = Image::new(widths.step, widths.time());
    Compensator {
        widths,
        lead_from,
        variant: Variant::default(),
        rom,
    }
}

/// A correction with the sign that converges.
fn correction(function: Function, stages: usize, position: usize) -> Correction {
    Correction {
        stages,
        position,
        sign: Sign::Converging,
        function,
        division: Division::Logic,
    }
}

/// The circuits of JPH0646367B2.
pub(super) const CIRCUITS: &[Entry] = &[
    entry!(
        AbsoluteDetector, "JPH0646367B2 10, a single-turn absolute encoder",
        full: AbsoluteDetector { code: 17, position: 24 },
        small: AbsoluteDetector { code: 3, position: 4 },
    ),
    entry!(
        GrayReceiver, "JPH0646367B2 10, words of an absolute encoder",
        full: GrayReceiver { code: 17 },
        small: GrayReceiver { code: 3 }, proved: true,
    ),
    entry!(
        Unwrapper, "JPH0646367B2 10, places of a turn or a pitch",
        full: Unwrapper { place: 17, position: 24 },
        small: Unwrapper { place: 3, position: 4 }, proved: true,
    ),
    entry!(
        PhaseDetector, "JPH0646367B2 10, a phase-shift transducer",
        full: PhaseDetector { phase: 17, position: 24 },
        small: PhaseDetector { phase: 3, position: 4 },
    ),
    entry!(
        PhaseCounter, "JPH0646367B2 10, carrier and crossings",
        full: PhaseCounter { phase: 17 },
        small: PhaseCounter { phase: 3 }, proved: true,
    ),
    entry!(
        ResolverDetector, "JPH0646367B2 10, a resolver",
        full: ResolverDetector { converter: TrackingConverter::new(12, 17), position: 24 },
        small: ResolverDetector { converter: TrackingConverter::new(5, 5), position: 6 },
    ),
    entry!(
        TrackingConverter, "JPH0646367B2 10, windings of a resolver",
        full: TrackingConverter::new(12, 17),
        small: TrackingConverter::new(4, 4),
    ),
    entry!(
        TrackingLoop, "JPH0646367B2 10, error of an angle",
        full: TrackingLoop::new(17),
        small: TrackingLoop { angle: 4, smoothing: 1, settling: 1 }, proved: true,
    ),
    entry!(
        RatioLogic, "JPH0646367B2 13",
        full: RatioLogic { stages: 199 },
        small: RatioLogic { stages: 3 }, proved: true,
    ),
    entry!(
        PositionHistory, "JPH0646367B2 11 + 14",
        full: PositionHistory { stages: 199, position: 24 },
        small: PositionHistory { stages: 2, position: 2 }, proved: true,
    ),
    entry!(
        RamHistory, "JPH0646367B2 11 + 14, as a RAM",
        full: RamHistory { stages: 199, position: 24 },
        small: RamHistory { stages: 2, position: 2 }, proved: true,
    ),
    entry!(
        DifferenceHistory, "JPH0646367B2 11 + 15 + 14",
        full: DifferenceHistory { stages: 199, position: 24 },
        small: DifferenceHistory { stages: 2, position: 2 }, proved: true,
    ),
    entry!(
        DividedTime, "JPH0646367B2, without 13",
        full: DividedTime { stages: 199, one: false },
        small: DividedTime { stages: 3, one: false }, proved: true,
    ),
    entry!(
        TimeLimit, "JPH0646367B2, without 13",
        full: TimeLimit { stages: 1990 },
        small: TimeLimit { stages: 30 }, proved: true,
    ),
    entry!(
        Lead, "JPH0646367B2 15 + 16",
        full: Lead { position: 24, one: false },
        small: Lead { position: 4, one: false }, proved: true,
    ),
    entry!(
        LeadProducts, "JPH0646367B2 17, without 15",
        full: LeadProducts { position: 24, one: false },
        small: LeadProducts { position: 4, one: false }, proved: true,
    ),
    entry!(
        TimeLead, "JPH0646367B2 11, 13–16",
        full: TimeLead::new(199, 24, Memory::ShiftRegister),
        small: TimeLead::new(3, 4, Memory::ShiftRegister),
    ),
    entry!(
        TimeLead, "JPH0646367B2 11, 13–16, with a RAM",
        full: TimeLead::new(199, 24, Memory::Ram),
        small: TimeLead::new(3, 4, Memory::Ram),
        named: "ram_time_lead", "lead for a lead time, from a RAM of samples",
    ),
    entry!(
        SpeedDetector, "JPH0646367B2 2 of Fig. 7",
        full: SpeedDetector { position: 24, gate: 16 },
        small: SpeedDetector { position: 2, gate: 2 }, proved: true,
    ),
    entry!(
        SpeedLead, "JPH0646367B2 1 + 2 of Fig. 7",
        full: SpeedLead { position: 24, gate: 16 },
        small: SpeedLead { position: 2, gate: 2 }, proved: true,
    ),
    entry!(
        TableLead, "JPH0646367B2 1 + 2 of Fig. 7, from a memory",
        full: TableLead {
            position: 24,
            gate: 16,
            table: LeadTable::new(8, 24, 5, |speed| 2 * speed + speed * speed.abs() / 64),
        },
        small: TableLead {
            position: 3,
            gate: 3,
            table: LeadTable::new(1, 3, 1, |speed| 2 * speed + speed * speed.abs() / 4),
        },
        proved: true,
    ),
    entry!(
        LeadPlacement, "JPH0646367B2 17, 20",
        full: LeadPlacement { position: 24, placement: Placement::Position },
        small: LeadPlacement { position: 4, placement: Placement::Position }, proved: true,
    ),
    entry!(
        Comparator, "JPH0646367B2 19",
        full: Comparator { position: 24, comparing: Comparing::Crossing },
        small: Comparator { position: 4, comparing: Comparing::Crossing }, proved: true,
    ),
    entry!(
        TargetSetter, "JPH0646367B2 18",
        full: TargetSetter { step: 4, position: 24, speed: 16 },
        small: TargetSetter { step: 2, position: 2, speed: 2 }, proved: true,
    ),
    entry!(
        TimeData, "JPH0646367B2 21 = 24 + 25, 29",
        full: TimeData::new(4, 11),
        small: TimeData::new(2, 2), proved: true,
    ),
    entry!(
        CompletionDetector, "JPH0646367B2 26",
        full: CompletionDetector { position: 24, time: 16 },
        small: CompletionDetector { position: 2, time: 2 }, proved: true,
    ),
    entry!(
        TouchProbe, "JPH0646367B2, any operation",
        full: TouchProbe { position: 24 },
        small: TouchProbe { position: 4 }, proved: true,
    ),
    entry!(
        StopError, "JPH0646367B2 27, 30, 31",
        full: StopError { position: 24, sign: Sign::Converging },
        small: StopError { position: 4, sign: Sign::Converging }, proved: true,
    ),
    entry!(
        CorrectionArithmetic, "JPH0646367B2 28",
        full: CorrectionArithmetic { stages: 199, position: 24 },
        small: CorrectionArithmetic { stages: 3, position: 4 },
    ),
    entry!(
        Refinement, "JPH0646367B2 28, second order",
        full: Refinement { time: 11, position: 24 },
        small: Refinement { time: 2, position: 2 }, proved: true,
    ),
    entry!(
        ExactRelation, "JPH0646367B2 28, exact relation",
        full: ExactRelation { position: 24 },
        small: ExactRelation { position: 4 }, proved: true,
    ),
    entry!(
        Correction, "JPH0646367B2 23 = 27, 28, 30, 31",
        full: correction(Function::FirstOrder, 199, 24),
        small: correction(Function::FirstOrder, 3, 4),
    ),
    entry!(
        Correction, "JPH0646367B2 23 = 27, 28, 30, 31, second order",
        full: correction(Function::SecondOrder, 199, 24),
        small: correction(Function::SecondOrder, 3, 4),
        named: "second_order_correction", "learns the lead time of a step to second order",
    ),
    entry!(
        Correction, "JPH0646367B2 23 = 27, 28, 30, 31, exact relation",
        full: correction(Function::Exact, 199, 24),
        small: correction(Function::Exact, 3, 4),
        named: "exact_correction", "learns the lead time of a step by the exact relation",
    ),
    entry!(
        StepSequencer, "JPH0646367B2, step numbers",
        full: StepSequencer { step: 4, position: 24, rest: 16 },
        small: StepSequencer { step: 2, position: 2, rest: 2 }, proved: true,
    ),
    entry!(
        Compensator, "JPH0646367B2, Figs 1, 5 and 6",
        full: compensator(time(Memory::ShiftRegister), Widths::default()),
        small: compensator(time(Memory::ShiftRegister), SMALL),
    ),
    entry!(
        Compensator, "JPH0646367B2, Figs 1, 5 and 6, with a RAM",
        full: compensator(time(Memory::Ram), Widths::default()),
        small: compensator(time(Memory::Ram), SMALL),
        named: "ram_compensator", "lead-angle compensator with its history in a RAM",
    ),
    entry!(
        Compensator, "JPH0646367B2, Fig. 7",
        full: compensator(LeadFrom::Speed, Widths::default()),
        small: compensator(LeadFrom::Speed, SMALL),
        named: "conventional_compensator",
            "compensator whose lead is measured speed times a parameter",
    ),
];
