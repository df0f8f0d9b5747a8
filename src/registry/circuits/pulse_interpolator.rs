use crate::circuits::pulse_interpolator::pattern_memory::Contents;
use crate::circuits::pulse_interpolator::{
    AddressSequencer, Axis, CircularInterpolator, CommandPort, Conventional, ConventionalWidths,
    Group, Groups, MotorController, PatternMemory, PulseGenerator, PulseTrain, SyncStage, UnitLaw,
    UnitTimeRegister, Variant, Widths,
};
use crate::hdl::Image;
use crate::registry::Entry;
use crate::registry::entry::entry;

/// A memory of the full widths.
fn memory() -> PatternMemory {
    let widths = Widths::default();
    PatternMemory::new(widths.half_period, widths.address, 0)
}

/// Half-periods 1 and 2 in turn, the second downwards.
fn two_words() -> Contents {
    Contents {
        half_periods: Image::of(1, 2, [1, 2]),
        directions: Image::of(1, 1, [0, 1]),
    }
}

/// Words of `width` bits, and memories of two words.
fn widths(width: usize) -> Widths {
    Widths {
        half_period: width,
        period: width,
        address: 1,
    }
}

/// The conventional device with words of `width` bits, but for distances, which have a bit less.
fn conventional(width: usize) -> Conventional {
    let widths = ConventionalWidths {
        distance: width - 1,
        units: width,
        half_period: width,
        period: width,
    };
    Conventional {
        axes: 2,
        widths,
        period: 5,
        arcs: false,
    }
}

/// Returns the conventional device in full.
fn full_conventional() -> Conventional {
    Conventional {
        period: 1000,
        widths: ConventionalWidths::default(),
        ..conventional(16)
    }
}

/// The circuits of JP3640909B2.
pub(super) const CIRCUITS: &[Entry] = &[
    entry!(
        UnitTimeRegister, "JP3640909B2 ¶0016",
        full: UnitTimeRegister { width: 24, period: 1000 },
        small: UnitTimeRegister { width: 3, period: 1 }, proved: true,
    ),
    entry!(
        PulseGenerator, "JP3640909B2 20 = 201 + 202",
        full: PulseGenerator { width: 16, variant: Variant::Safe },
        small: PulseGenerator { width: 3, variant: Variant::Safe }, proved: true,
    ),
    entry!(
        SyncStage, "JP3640909B2 40",
        full: SyncStage {},
        small: SyncStage {}, proved: true,
    ),
    entry!(
        PatternMemory, "JP3640909B2 10",
        full: memory(),
        small: PatternMemory::new(3, 1, 0), proved: true,
    ),
    entry!(
        AddressSequencer, "JP3640909B2 50",
        full: AddressSequencer { width: 12 },
        small: AddressSequencer { width: 3 }, proved: true,
    ),
    entry!(
        CommandPort, "JP3640909B2 ¶0018, ¶0026",
        full: CommandPort { address: 12, period: 24, free_running: None },
        small: CommandPort { address: 3, period: 3, free_running: None }, proved: true,
    ),
    entry!(
        Axis, "JP3640909B2 10 + 20 + 40",
        full: Axis { memory: memory(), variant: Variant::Safe },
        small: Axis { memory: PatternMemory::new(3, 1, 0), variant: Variant::Safe }, proved: true,
    ),
    entry!(
        UnitLaw, "JP3640909B2 30 + 20 + 40, with ghosts",
        full: UnitLaw { width: 16, variant: Variant::Safe },
        small: UnitLaw { width: 3, variant: Variant::Safe }, proved: true,
    ),
    entry!(
        Group, "JP3640909B2 1",
        full: Group {
            memories: Vec::new(),
            ..Group::new(2, Widths::default(), Variant::Safe, 1000)
        },
        small: Group { memories: vec![two_words()], ..Group::new(1, widths(2), Variant::Safe, 3) },
        proved: true,
    ),
    entry!(
        Groups, "JP3640909B2 1, several groups: ¶0032",
        full: Groups {
            first_axes: 2,
            second_axes: 2,
            widths: Widths::default(),
            variant: Variant::Safe,
            periods: [1000; 2],
            memories: [Vec::new(), Vec::new()],
        },
        small: Groups {
            first_axes: 1,
            second_axes: 1,
            widths: widths(3),
            variant: Variant::Safe,
            periods: [6; 2],
            memories: [vec![two_words()], vec![two_words()]],
        },
    ),
    entry!(
        PulseTrain, "JP3640909B2 6x, 6y, Fig. 5",
        full: PulseTrain { half_period: 16, pulses: 17 },
        small: PulseTrain { half_period: 3, pulses: 3 }, proved: true,
    ),
    entry!(
        MotorController, "JP3640909B2 5, Fig. 5",
        full: MotorController { axes: 2, widths: ConventionalWidths::default() },
        small: MotorController { axes: 2, widths: conventional(4).widths },
    ),
    entry!(
        CircularInterpolator, "JP3640909B2 5, Fig. 5: arcs",
        full: full_conventional().circular(),
        small: CircularInterpolator {
            controller: MotorController { axes: 2, widths: conventional(4).widths },
            angle: 4,
        },
        uses: [distance, units, period],
    ),
    entry!(
        Conventional, "JP3640909B2 Fig. 5",
        full: full_conventional(),
        small: conventional(3),
    ),
];
