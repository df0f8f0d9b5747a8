//! What makes the circuits of a catalogue entry from the numbers given.

use crate::circuits::lead_angle::{
    Comparing, Compensator, Correction, Detector, Division, Form, Function, LeadForm, LeadFrom,
    LeadTable, Memory, Placement, Sign, TableLead, TimeData, TimeLead, Variant, Widths,
};
use crate::hdl::Image;
use crate::registry::circuits::make::{FLAGS, at_most, choice, width, words};

/// Stages of history where positions have `width` bits.
pub(super) const fn stages(width: usize) -> usize {
    match width {
        0..=2 => 2,
        3 | 4 => 3,
        _ => 15,
    }
}

pub(super) const PLACEMENTS: &[Placement] =
    &[Placement::Position, Placement::Target, Placement::Halves];
pub(super) const COMPARINGS: &[Comparing] = &[Comparing::Crossing, Comparing::Equal];
const DIVISIONS: &[Division] = &[Division::Logic, Division::Beforehand, Division::One];
const FORMS: &[Form] = &[Form::Difference, Form::Products, Form::EarlyDifference];
const DETECTORS: &[Detector] = &[
    Detector::Incremental,
    Detector::Absolute,
    Detector::PhaseShift,
    Detector::Resolver,
];
pub(super) const SIGNS: &[Sign] = &[Sign::Converging, Sign::Literal];

/// Either sign to first order, then to second order, then by the exact relation.
const LEARNINGS: &[(Sign, Function)] = &[
    (Sign::Converging, Function::FirstOrder),
    (Sign::Literal, Function::FirstOrder),
    (Sign::Converging, Function::SecondOrder),
    (Sign::Literal, Function::SecondOrder),
    (Sign::Converging, Function::Exact),
    (Sign::Literal, Function::Exact),
];

/// The numbers of placement, comparing, learning, detector and form, then the times of the ROM, one in
/// each word from step 0 up.
pub(super) fn chosen(circuit: Compensator, given: &[u64]) -> Option<Compensator> {
    let form = choice(given, 4, LeadForm::ALL)?;
    let lead_from = match circuit.lead_from {
        LeadFrom::Time(memory, _) => LeadFrom::Time(memory, form),
        other => other,
    };
    varied(
        Compensator {
            lead_from,
            ..circuit
        },
        given,
    )
}

/// The same with any lead.
fn varied(circuit: Compensator, given: &[u64]) -> Option<Compensator> {
    let (sign, function) = choice(given, 2, LEARNINGS)?;
    let variant = Variant {
        placement: choice(given, 0, PLACEMENTS)?,
        comparing: choice(given, 1, COMPARINGS)?,
        sign,
        function,
        detector: choice(given, 3, DETECTORS)?,
    };
    let rom = rom(circuit.rom.address(), circuit.rom.width(), given, 5)?;
    Some(Compensator {
        variant,
        rom,
        ..circuit
    })
}

/// The times from a place on, one in each word from step 0 up.
pub(super) fn rom(step: usize, time: usize, given: &[u64], place: usize) -> Option<Image> {
    let times = words(given, place, 1 << step, time)?;
    Some(Image::of(step, time, times.iter().copied()))
}

/// A correction with the sign that converges.
pub(super) fn correction(function: Function, stages: usize, position: usize) -> Correction {
    Correction {
        stages,
        position,
        sign: Sign::Converging,
        function,
        division: Division::Logic,
    }
}

/// A compensator without any time.
pub(super) fn compensator(lead_from: LeadFrom, widths: Widths) -> Compensator {
    Compensator {
        widths,
        lead_from,
        variant: Variant::default(),
        rom: Image::new(widths.step, widths.time()),
    }
}

/// A compensator with positions, speeds, times and CK of the width that is given.
pub(super) fn small(lead_from: LeadFrom, given: &[u64]) -> Option<Compensator> {
    let width = width(given)?;
    let widths = Widths {
        stages: stages(width),
        position: width,
        step: 2,
        speed: width,
        cks: width,
        ck_period: width,
        code: (width - 1).max(1),
        converter: (width - 1).max(1),
    };
    Some(compensator(lead_from, widths))
}

/// The numbers of [`chosen`], with 0 for a product as the lead, or 1 for a memory that leads by two
/// gates, in place of the form.
pub(super) fn conventional(circuit: Compensator, given: &[u64]) -> Option<Compensator> {
    let position = circuit.widths.position;
    let lead_from = match choice(given, 4, FLAGS)? {
        true => LeadFrom::Table(table(position, |speed| 2 * speed)?),
        false => LeadFrom::Speed,
    };
    let circuit = Compensator {
        lead_from,
        ..circuit
    };
    varied(circuit, given)
}

/// A memory of leads for positions of so many bits: of 8 words at 8 bits, of 256 at 24.
fn table(position: usize, lead: impl Fn(i64) -> i64) -> Option<LeadTable> {
    let (address, fraction) = match position {
        0 | 1 => return None,
        2 | 3 => (1, 1),
        4..8 => (2, 1),
        8..16 => (3, 2),
        _ => (8, 5),
    };
    Some(LeadTable::new(address, position, fraction, lead))
}

/// A lead from a memory, of positions and gates of the width that is given, and the words from a
/// speed of 0 up: a lead and what it grows by to the next; without them two gates, and more than
/// that the faster it is.
pub(super) fn table_lead(given: &[u64]) -> Option<TableLead> {
    let width = width(given)?;
    let circuit = TableLead {
        position: width,
        gate: width,
        table: table(width, |speed| 2 * speed + speed * speed.abs() / 4)?,
    };
    filled(circuit, &given[1..])
}

/// The words of a memory of leads.
pub(super) fn filled(circuit: TableLead, given: &[u64]) -> Option<TableLead> {
    if given.is_empty() {
        return Some(circuit);
    }
    let TableLead {
        position,
        table: LeadTable {
            leads, fraction, ..
        },
        ..
    } = &circuit;
    let given = words(given, 0, 2 * leads.words(), *position)?;
    let every_second = |from: usize| {
        let words = given.iter().copied().skip(from).step_by(2);
        Image::of(leads.address(), *position, words)
    };
    let table = LeadTable {
        leads: every_second(0),
        increments: every_second(1),
        fraction: *fraction,
    };
    Some(TableLead { table, ..circuit })
}

/// Times of steps, as wide as is given, and those of the ROM.
pub(super) fn time_data(given: &[u64]) -> Option<TimeData> {
    let (step, time) = (2, width(given)?);
    let rom = rom(step, time, given, 1)?;
    Some(TimeData { step, time, rom })
}

/// A time lead of positions of the width that is given, and what follows.
pub(super) fn time_lead(memory: Memory, given: &[u64]) -> Option<TimeLead> {
    let position = width(given)?;
    formed(
        TimeLead::new(stages(position), position, memory),
        &given[1..],
    )
}

/// The numbers of where N comes from and of how the prediction is worked out.
pub(super) fn formed(circuit: TimeLead, given: &[u64]) -> Option<TimeLead> {
    at_most(given, 2)?;
    let division = choice(given, 0, DIVISIONS)?;
    let form = choice(given, 1, FORMS)?;
    Some(TimeLead {
        division,
        form,
        ..circuit
    })
}

pub(super) const SHIFT: LeadFrom = LeadFrom::Time(Memory::ShiftRegister, LeadForm::Embodiment);
pub(super) const RAM: LeadFrom = LeadFrom::Time(Memory::Ram, LeadForm::Embodiment);
