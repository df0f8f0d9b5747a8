use super::make::{FLAGS, VARIANTS, address_bits, at_most, choice, second, width, word, words};
use crate::circuits::pulse_interpolator::pattern_memory::Contents;
use crate::circuits::pulse_interpolator::{
    AddressSequencer, Axis, CircularInterpolator, CommandPort, Conventional, ConventionalWidths,
    Group, Groups, MotorController, Pattern, PatternMemory, PulseGenerator, PulseTrain, SyncStage,
    UnitLaw, UnitTimeRegister, Variant, Widths,
};
use crate::hdl::Cut;
use crate::registry::Entry;
use crate::registry::entry::{entry, nothing};

/// The full widths of a memory.
fn full_memory() -> PatternMemory {
    let widths = Widths::default();
    PatternMemory::new(widths.half_period, widths.address, 0)
}

/// Fills a memory from address 0 up; a word is a half-period, 2^its width more for the direction
/// down.
fn fill(contents: &mut Contents, words: impl Iterator<Item = u64>) {
    let width = contents.half_periods.width();
    for (address, word) in words.enumerate() {
        contents.half_periods.set(address, word.cut(width));
        let down = word.checked_shr(width as u32).unwrap_or(0);
        contents.directions.set(address, down);
    }
}

/// A memory of axis 0, or of the one that is given, with the words given after that.
fn memory(memory: PatternMemory, given: &[u64]) -> Option<PatternMemory> {
    let most = 1usize.checked_shl(memory.address as u32)?;
    let words = words(given, 1, most, memory.half_period + 1)?;
    let axis = word(given.first().copied().unwrap_or(0), 3)?;
    let mut memory = PatternMemory { axis, ..memory };
    fill(&mut memory.contents, words.iter().copied());
    Some(memory)
}

/// A group whose words have all that width, but for its addresses.
fn group(axes: usize, width: usize, address: usize) -> Group {
    let widths = Widths {
        half_period: width,
        period: width,
        address,
    };
    Group::new(axes, widths, Variant::Safe, 3)
}

/// A group as small as a proof needs: one axis whose memory holds half-periods 1 and 2 in turn, the
/// second downwards.
fn small_group(width: usize, given: &[u64]) -> Option<Group> {
    let mut small = group(1, width, 1);
    small.period = second(given, small.period, width)?;
    let down = 1u64.checked_shl(width as u32).unwrap_or(0);
    fill(&mut small.memories[0], [1, 2 | down].into_iter());
    Some(small)
}

/// A group with T at power-on, a variant, whether it plays by itself, and words of its axes in turn.
fn playing(group: Group, given: &[u64]) -> Option<Group> {
    let Widths {
        half_period,
        period: bits,
        address,
    } = group.widths;
    let period = word(given.first().copied().unwrap_or(group.period), bits)?;
    let variant = choice(given, 1, VARIANTS)?;
    let cyclic = choice(given, 2, &[None, Some(false), Some(true)])?;
    let words = words(given, 3, group.axes << address, half_period + 1)?;
    let mut memories = vec![Contents::new(half_period, address); group.axes];
    for (axis, contents) in memories.iter_mut().enumerate() {
        fill(
            contents,
            words.iter().skip(axis).step_by(group.axes).copied(),
        );
    }
    let last = words.len().div_ceil(group.axes) as u64;
    Some(Group {
        period,
        free_running: cyclic.map(|cyclic| Pattern {
            base: 0,
            last: last.saturating_sub(1),
            cyclic,
            period,
        }),
        variant,
        memories,
        ..group
    })
}

/// Widths of the conventional device, all that number but for distances, which have a bit less.
fn conventional_widths(width: usize) -> ConventionalWidths {
    ConventionalWidths {
        distance: width.saturating_sub(1).max(1),
        units: width,
        half_period: width,
        period: width,
    }
}

/// How many axes a motor controller has: the first number behind the width, or 1.
fn controller(given: &[u64]) -> Option<MotorController> {
    let widths = conventional_widths(width(given)?);
    at_most(given, 2)?;
    let axes = given.get(1).copied().unwrap_or(1) as usize;
    Some(MotorController { axes, widths })
}

/// The circuits of JP3640909B2.
pub(super) const CIRCUITS: &[Entry] = &[
    entry!(
        UnitTimeRegister, "JP3640909B2 ¶0016",
        full: || UnitTimeRegister { width: 24, period: 1000 },
        widths: [width],
        from: "width, T at power-on", |given| {
            at_most(given, 2)?;
            let width = width(given)?;
            Some(UnitTimeRegister { width, period: second(given, 1, width)? })
        },
        with: |circuit, given| {
            at_most(given, 1)?;
            let period = word(given.first().copied().unwrap_or(circuit.period), circuit.width)?;
            Some(UnitTimeRegister { period, ..circuit })
        },
        proved: 3,
    ),
    entry!(
        PulseGenerator, "JP3640909B2 20 = 201 + 202",
        full: || PulseGenerator { width: 16, variant: Variant::Safe },
        widths: [width],
        by: "width, 0 for safe or 1 for literal",
        |width, variant of VARIANTS| PulseGenerator { width, variant },
        proved: 3,
    ),
    entry!(
        SyncStage, "JP3640909B2 40",
        full: || SyncStage,
        widths: [],
        from: "nothing", |given| {
            at_most(given, 1)?;
            Some(SyncStage)
        },
        with: nothing,
        proved: 3,
    ),
    entry!(
        PatternMemory, "JP3640909B2 10",
        full: full_memory,
        widths: [half_period, address],
        from: "width of the half-period (addresses have one bit, above a width of 4 four), axis, \
               words at power-on (a half-period, 2^width more for down)",
        |given| {
            let width = width(given)?;
            memory(PatternMemory::new(width, address_bits(width), 0), &given[1..])
        },
        with: memory,
        proved: 3,
    ),
    entry!(
        AddressSequencer, "JP3640909B2 50",
        full: || AddressSequencer { width: 12 },
        widths: [width],
        by: "width", |width| AddressSequencer { width },
        proved: 3,
    ),
    entry!(
        CommandPort, "JP3640909B2 ¶0018, ¶0026",
        full: || CommandPort { address: 12, period: 24, free_running: None },
        widths: [address, period],
        by: "width", |width| CommandPort { address: width, period: width, free_running: None },
        proved: 3,
    ),
    entry!(
        Axis, "JP3640909B2 10 + 20 + 40",
        full: || Axis { memory: full_memory(), variant: Variant::Safe },
        widths: [half_period, address in memory],
        by: "width of the half-period (addresses have one bit, above a width of 4 four), 0 for \
             safe or 1 for literal",
        |width, variant of VARIANTS| Axis {
            memory: PatternMemory::new(width, address_bits(width), 0),
            variant,
        },
        proved: 3,
    ),
    entry!(
        UnitLaw, "JP3640909B2 30 + 20 + 40, with ghosts",
        full: || UnitLaw { width: 16, variant: Variant::Safe },
        widths: [width],
        by: "width, 0 for safe or 1 for literal",
        |width, variant of VARIANTS| UnitLaw { width, variant },
        proved: 3,
    ),
    entry!(
        Group, "JP3640909B2 1",
        full: || Group { memories: Vec::new(), ..Group::new(2, Widths::default(), Variant::Safe, 1000) },
        widths: [axes; half_period, period, address in widths],
        from: "width of half-period and T, T at power-on: one axis, two words of memory (1 up, 2 \
               down); then 0 for safe or 1 for literal, and 0 to wait, 1 to play once or 2 to loop \
               by itself: two axes of eight words (above a width of 4 always); then words of x and \
               y in turn (a half-period, 2^width more for down)",
        |given| match (width(given)?, given) {
            (width @ ..=4, [_] | [_, _]) => small_group(width, given),
            (width, _) => playing(group(2, width, 3), &given[1..]),
        },
        with: playing,
        proved: 2,
    ),
    entry!(
        Groups, "JP3640909B2 1, several groups: ¶0032",
        full: || Groups {
            first_axes: 2,
            second_axes: 2,
            widths: Widths::default(),
            variant: Variant::Safe,
            periods: [1000; 2],
            memories: [Vec::new(), Vec::new()],
        },
        widths: [first_axes, second_axes; half_period, period, address in widths],
        from: "width of half-period and T, T of the first and of the second at power-on: an axis \
               each, with two words of memory (1 up, 2 down)",
        |given| {
            at_most(given, 3)?;
            let width = width(given)?;
            let second = given.get(2).or(given.get(1)).copied();
            let small = |period: Option<u64>| match period {
                Some(period) => small_group(width, &[width as u64, period]),
                None => small_group(width, &[width as u64]),
            };
            let (first, second) = (small(given.get(1).copied())?, small(second)?);
            Some(Groups {
                first_axes: 1,
                second_axes: 1,
                widths: first.widths,
                variant: Variant::Safe,
                periods: [first.period, second.period],
                memories: [first.memories, second.memories],
            })
        },
        with: nothing,
        proved: none,
    ),
    entry!(
        PulseTrain, "JP3640909B2 6x, 6y, Fig. 5",
        full: || PulseTrain { half_period: 16, pulses: 17 },
        widths: [half_period, pulses],
        by: "width of both words", |width| PulseTrain { half_period: width, pulses: width },
        proved: 3,
    ),
    entry!(
        MotorController, "JP3640909B2 5, Fig. 5",
        full: || MotorController { axes: 2, widths: ConventionalWidths::default() },
        widths: [axes; distance, units, half_period, period in widths],
        from: "width of all words (distances have a bit less), axes", controller,
        with: nothing,
        proved: none,
    ),
    entry!(
        CircularInterpolator, "JP3640909B2 5, Fig. 5: arcs",
        full: || Conventional::circular(&Conventional {
            axes: 2,
            widths: ConventionalWidths::default(),
            period: 1000,
            arcs: true,
        }),
        widths: [
            axes = controller.axes, distance = controller.widths.distance,
            units = controller.widths.units, period = controller.widths.period, angle,
        ],
        from: "width of all words (distances have a bit less), axes", |given| {
            let controller = match given {
                [width] => controller(&[*width, 2])?,
                _ => controller(given)?,
            };
            Some(CircularInterpolator { controller, angle: width(given)? })
        },
        with: nothing,
        proved: none,
    ),
    entry!(
        Conventional, "JP3640909B2 Fig. 5",
        full: || Conventional {
            axes: 2,
            widths: ConventionalWidths::default(),
            period: 1000,
            arcs: false,
        },
        widths: [axes; distance, units, half_period, period in widths],
        from: "width of all words (distances have a bit less), axes, T at power-on, 1 for arcs too",
        |given| {
            at_most(given, 4)?;
            let MotorController { axes, widths } = controller(&given[..given.len().min(2)])?;
            let period = word(given.get(2).copied().unwrap_or(1), widths.period)?;
            Some(Conventional { axes, widths, period, arcs: choice(given, 3, FLAGS)? })
        },
        with: |circuit, given| {
            at_most(given, 2)?;
            let period = given.first().copied().unwrap_or(circuit.period);
            let (period, arcs) = (word(period, circuit.widths.period)?, choice(given, 1, FLAGS)?);
            Some(Conventional { period, arcs, ..circuit })
        },
        proved: none,
    ),
];
