mod makers;

use super::make::FLAGS;
use crate::circuits::lead_angle::{
    AbsoluteDetector, Comparator, Comparing, Compensator, CompletionDetector, Correction,
    CorrectionArithmetic, DifferenceHistory, DividedTime, ExactRelation, Function, GrayReceiver,
    Lead, LeadFrom, LeadPlacement, LeadProducts, LeadTable, Memory, PhaseCounter, PhaseDetector,
    Placement, PositionHistory, RamHistory, RatioLogic, Refinement, ResolverDetector, Sign,
    SpeedDetector, SpeedLead, StepSequencer, StopError, TableLead, TargetSetter, TimeData,
    TimeLead, TimeLimit, TouchProbe, TrackingConverter, TrackingLoop, Unwrapper, Widths,
};
use crate::registry::Entry;
use crate::registry::entry::entry;
use makers::{
    COMPARINGS, PLACEMENTS, RAM, SHIFT, SIGNS, chosen, compensator, conventional, correction,
    filled, formed, rom, small, stages, table_lead, time_data, time_lead,
};

/// The circuits of JPH0646367B2.
pub(super) const CIRCUITS: &[Entry] = &[
    entry!(
        AbsoluteDetector, "JPH0646367B2 10, an absolute encoder of a turn",
        full: || AbsoluteDetector { code: 17, position: 24 },
        widths: [code, position],
        by: "width of the position, a word being one bit narrower",
        |position| AbsoluteDetector { code: position.saturating_sub(1), position },
        proved: none,
    ),
    entry!(
        GrayReceiver, "JPH0646367B2 10, words of an absolute encoder",
        full: || GrayReceiver { code: 17 },
        widths: [code],
        by: "width of a word", |code| GrayReceiver { code },
        proved: 3,
    ),
    entry!(
        Unwrapper, "JPH0646367B2 10, places of a turn or a pitch",
        full: || Unwrapper { place: 17, position: 24 },
        widths: [place, position],
        by: "width of the position, a place being one bit narrower",
        |position| Unwrapper { place: position.saturating_sub(1), position },
        proved: 4,
    ),
    entry!(
        PhaseDetector, "JPH0646367B2 10, a phase-shift transducer",
        full: || PhaseDetector { phase: 17, position: 24 },
        widths: [phase, position],
        by: "width of the position, a phase being one bit narrower",
        |position| PhaseDetector { phase: position.saturating_sub(1), position },
        proved: none,
    ),
    entry!(
        PhaseCounter, "JPH0646367B2 10, carrier and crossings",
        full: || PhaseCounter { phase: 17 },
        widths: [phase],
        by: "width of a phase", |phase| PhaseCounter { phase },
        proved: 3,
    ),
    entry!(
        ResolverDetector, "JPH0646367B2 10, a resolver",
        full: || ResolverDetector { converter: TrackingConverter::new(12, 17), position: 24 },
        widths: [
            converter = converter.converter, angle = converter.tracking.angle,
            smoothing = converter.tracking.smoothing, settling = converter.tracking.settling,
            position,
        ],
        by: "width of an angle and of the A/D words, the position being one bit wider", |angle| {
            ResolverDetector { converter: TrackingConverter::new(angle, angle), position: angle + 1 }
        },
        proved: none,
    ),
    entry!(
        TrackingConverter, "JPH0646367B2 10, windings of a resolver",
        full: || TrackingConverter::new(12, 17),
        widths: [converter; angle, smoothing, settling in tracking],
        by: "width of an angle and of the A/D words", |angle| TrackingConverter::new(angle, angle),
        proved: none,
    ),
    entry!(
        TrackingLoop, "JPH0646367B2 10, error of an angle",
        full: || TrackingLoop::new(17),
        widths: [angle, smoothing, settling],
        by: "width of an angle", |angle| TrackingLoop { angle, smoothing: 1, settling: 1 },
        proved: 4,
    ),
    entry!(
        RatioLogic, "JPH0646367B2 13",
        full: || RatioLogic { stages: 199 },
        widths: [stages],
        by: "4 for 3 stages, 8 for 15", |width| RatioLogic { stages: stages(width) },
        proved: 4,
    ),
    entry!(
        PositionHistory, "JPH0646367B2 11 + 14",
        full: || PositionHistory { stages: 199, position: 24 },
        widths: [stages, position],
        by: "width: 2 stages for 2, 3 for 4, 15 for 8",
        |position| PositionHistory { stages: stages(position), position },
        proved: 2,
    ),
    entry!(
        RamHistory, "JPH0646367B2 11 + 14, as a RAM",
        full: || RamHistory { stages: 199, position: 24 },
        widths: [stages, position],
        by: "width: 2 stages for 2, 3 for 4, 15 for 8",
        |position| RamHistory { stages: stages(position), position },
        proved: 2,
    ),
    entry!(
        DifferenceHistory, "JPH0646367B2 11 + 15 + 14",
        full: || DifferenceHistory { stages: 199, position: 24 },
        widths: [stages, position],
        by: "width: 2 stages for 2, 3 for 4, 15 for 8",
        |position| DifferenceHistory { stages: stages(position), position },
        proved: 2,
    ),
    entry!(
        DividedTime, "JPH0646367B2, without 13",
        full: || DividedTime { stages: 199, one: false },
        widths: [stages],
        by: "4 for 3 stages, 8 for 15, then 0 for N above Δt/N or 1 for N = 1",
        |width, one of FLAGS| DividedTime { stages: stages(width), one },
        proved: 4,
    ),
    entry!(
        TimeLimit, "JPH0646367B2, without 13",
        full: || TimeLimit { stages: 1990 },
        widths: [stages],
        by: "4 for 30 stages, 8 for 150", |width| TimeLimit { stages: 10 * stages(width) },
        proved: 4,
    ),
    entry!(
        Lead, "JPH0646367B2 15 + 16",
        full: || Lead { position: 24, one: false },
        widths: [position],
        by: "width, 0 for N or 1 for N = 1", |position, one of FLAGS| Lead { position, one },
        proved: 4,
    ),
    entry!(
        LeadProducts, "JPH0646367B2 17, without 15",
        full: || LeadProducts { position: 24, one: false },
        widths: [position],
        by: "width, 0 for N or 1 for N = 1",
        |position, one of FLAGS| LeadProducts { position, one },
        proved: 4,
    ),
    entry!(
        TimeLead, "JPH0646367B2 11, 13–16",
        full: || TimeLead::new(199, 24, Memory::ShiftRegister),
        widths: [stages, position],
        from: "width of positions (3 stages for 4, 15 for 8), 0 for N by 13, 1 beforehand or 2 for \
               N = 1, 0 for 15 behind 14, 1 for the products or 2 for 15 before 14",
            |given| time_lead(Memory::ShiftRegister, given),
        with: formed,
        proved: none,
    ),
    entry!(
        TimeLead, "JPH0646367B2 11, 13–16, with a RAM",
        full: || TimeLead::new(199, 24, Memory::Ram),
        widths: [stages, position],
        from: "width of positions (3 stages for 4, 15 for 8), 0 for N by 13, 1 beforehand or 2 for \
               N = 1, 0 for 15 behind 14 or 1 for the products",
            |given| time_lead(Memory::Ram, given),
        with: formed,
        proved: none,
        named: "ram_time_lead", "the lead of a time, from a RAM of samples",
    ),
    entry!(
        SpeedDetector, "JPH0646367B2 2 of Fig. 7",
        full: || SpeedDetector { position: 24, gate: 16 },
        widths: [position, gate],
        by: "width", |width| SpeedDetector { position: width, gate: width },
        proved: 2,
    ),
    entry!(
        SpeedLead, "JPH0646367B2 1 + 2 of Fig. 7",
        full: || SpeedLead { position: 24, gate: 16 },
        widths: [position, gate],
        by: "width", |width| SpeedLead { position: width, gate: width },
        proved: 2,
    ),
    entry!(
        TableLead, "JPH0646367B2 1 + 2 of Fig. 7, from a memory",
        full: || TableLead {
            position: 24,
            gate: 16,
            table: LeadTable::new(8, 24, 5, |speed| 2 * speed + speed * speed.abs() / 64),
        },
        widths: [position, gate],
        from: "width (2 words for 3, 4 for 4, 8 for 8), then each word's lead and what it grows by",
            table_lead,
        with: filled,
        proved: 3,
    ),
    entry!(
        LeadPlacement, "JPH0646367B2 17, 20",
        full: || LeadPlacement { position: 24, placement: Placement::Position },
        widths: [position],
        by: "width, 0 for the position, 1 for the target or 2 for halves",
        |position, placement of PLACEMENTS| LeadPlacement { position, placement },
        proved: 4,
    ),
    entry!(
        Comparator, "JPH0646367B2 19",
        full: || Comparator { position: 24, comparing: Comparing::Crossing },
        widths: [position],
        by: "width, 0 for crossing or 1 for equal",
        |position, comparing of COMPARINGS| Comparator { position, comparing },
        proved: 4,
    ),
    entry!(
        TargetSetter, "JPH0646367B2 18",
        full: || TargetSetter { step: 4, position: 24, speed: 16 },
        widths: [step, position, speed],
        by: "width of positions and speeds (steps have two bits)",
        |width| TargetSetter { step: 2, position: width, speed: width },
        proved: 2,
    ),
    entry!(
        TimeData, "JPH0646367B2 21 = 24 + 25, 29",
        full: || TimeData::new(4, 11),
        widths: [step, time],
        from: "width (steps have two bits), and the times of the ROM", time_data,
        with: |circuit, given| {
            Some(TimeData { rom: rom(circuit.step, circuit.time, given, 0)?, ..circuit })
        },
        proved: 2,
    ),
    entry!(
        CompletionDetector, "JPH0646367B2 26",
        full: || CompletionDetector { position: 24, time: 16 },
        widths: [position, time],
        by: "width", |width| CompletionDetector { position: width, time: width },
        proved: 2,
    ),
    entry!(
        TouchProbe, "JPH0646367B2, any operation",
        full: || TouchProbe { position: 24 },
        widths: [position],
        by: "width", |position| TouchProbe { position },
        proved: 4,
    ),
    entry!(
        StopError, "JPH0646367B2 27, 30, 31",
        full: || StopError { position: 24, sign: Sign::Converging },
        widths: [position],
        by: "width, 0 for the converging sign or 1 for the literal one",
        |position, sign of SIGNS| StopError { position, sign },
        proved: 4,
    ),
    entry!(
        CorrectionArithmetic, "JPH0646367B2 28",
        full: || CorrectionArithmetic { stages: 199, position: 24 },
        widths: [stages, position],
        by: "width of positions: 3 stages for 4, 15 for 8",
        |position| CorrectionArithmetic { stages: stages(position), position },
        proved: none,
    ),
    entry!(
        Refinement, "JPH0646367B2 28, second order",
        full: || Refinement { time: 11, position: 24 },
        widths: [time, position],
        by: "width", |width| Refinement { time: width, position: width },
        proved: 2,
    ),
    entry!(
        ExactRelation, "JPH0646367B2 28, exact relation",
        full: || ExactRelation { position: 24 },
        widths: [position],
        by: "width", |position| ExactRelation { position },
        proved: 4,
    ),
    entry!(
        Correction, "JPH0646367B2 23 = 27, 28, 30, 31",
        full: || correction(Function::FirstOrder, 199, 24),
        widths: [stages, position],
        by: "width of positions (3 stages for 4, 15 for 8), 0 for the converging sign or 1 for \
             the literal one",
        |position, sign of SIGNS| Correction {
            sign,
            ..correction(Function::FirstOrder, stages(position), position)
        },
        proved: none,
    ),
    entry!(
        Correction, "JPH0646367B2 23 = 27, 28, 30, 31, second order",
        full: || correction(Function::SecondOrder, 199, 24),
        widths: [stages, position],
        by: "width of positions (3 stages for 4, 15 for 8), 0 for the converging sign or 1 for \
             the literal one",
        |position, sign of SIGNS| Correction {
            sign,
            ..correction(Function::SecondOrder, stages(position), position)
        },
        proved: none,
        named: "second_order_correction", "learns the lead time of a step to second order",
    ),
    entry!(
        Correction, "JPH0646367B2 23 = 27, 28, 30, 31, exact relation",
        full: || correction(Function::Exact, 199, 24),
        widths: [stages, position],
        by: "width of positions (3 stages for 4, 15 for 8), 0 for the converging sign or 1 for \
             the literal one",
        |position, sign of SIGNS| Correction {
            sign,
            ..correction(Function::Exact, stages(position), position)
        },
        proved: none,
        named: "exact_correction", "learns the lead time of a step by the exact relation",
    ),
    entry!(
        StepSequencer, "JPH0646367B2, step numbers",
        full: || StepSequencer { step: 4, position: 24, rest: 16 },
        widths: [step, position, rest],
        by: "width of positions and times (steps have two bits)",
        |width| StepSequencer { step: 2, position: width, rest: width },
        proved: 2,
    ),
    entry!(
        Compensator, "JPH0646367B2, Figs 1, 5 and 6",
        full: || compensator(SHIFT, Widths::default()),
        widths: [stages, position, step, speed, cks, ck_period, code, converter in widths],
        from: "width of positions, speeds and CK (3 stages for 4, 15 for 8; steps have two bits), \
               placement, comparing and learning as 0, 1 and so on, 0 for an incremental, 1 for an \
               absolute encoder, 2 for a phase-shift detector, 3 for a resolver, the form as 0 to 5, times \
               of the ROM",
            |given| chosen(small(SHIFT, given)?, &given[1..]),
        with: chosen,
        proved: none,
    ),
    entry!(
        Compensator, "JPH0646367B2, Figs 1, 5 and 6, with a RAM",
        full: || compensator(RAM, Widths::default()),
        widths: [stages, position, step, speed, cks, ck_period, code, converter in widths],
        from: "width of positions, speeds and CK (3 stages for 4, 15 for 8; steps have two bits), \
               placement, comparing and learning as 0, 1 and so on, 0 for an incremental, 1 for an \
               absolute encoder, 2 for a phase-shift detector, 3 for a resolver, the form as 0 to 5, times \
               of the ROM",
            |given| chosen(small(RAM, given)?, &given[1..]),
        with: chosen,
        proved: none,
        named: "ram_compensator", "lead-angle compensator with its history in a RAM",
    ),
    entry!(
        Compensator, "JPH0646367B2, Fig. 7",
        full: || compensator(LeadFrom::Speed, Widths::default()),
        widths: [stages, position, step, speed, cks, ck_period, code, converter in widths],
        from: "width of positions, speeds and CK (steps have two bits), placement, comparing and \
               learning as 0, 1 and so on, 0 for an incremental, 1 for an absolute encoder, 2 for a \
               phase-shift detector, 3 for a resolver, 0 for a product as the lead or 1 for a memory \
               of it, times of the ROM",
            |given| conventional(small(LeadFrom::Speed, given)?, &given[1..]),
        with: conventional,
        proved: none,
        named: "conventional_compensator",
            "compensator whose lead is measured speed times a parameter",
    ),
];
