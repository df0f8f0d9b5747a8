use super::make::{VARIANTS, address_bits, at_most, group, group_model, memory, one_of, second};
use crate::pulse_interpolator::{
    AddressSequencer, Axis, CommandPort, Group, PatternMemory, PulseGenerator, SyncStage, UnitLaw,
    UnitTimeCounter, UnitTimeRegister, Variant,
};
use crate::registry::Entry;
use crate::registry::entry::{Made, alone, at_width, entry, proved_at};

/// The circuits of JP3640909B2.
pub(super) const CIRCUITS: &[Entry] = &[
    entry!(
        UnitTimeCounter<24>,
        UnitTimeCounter,
        Some(3),
        "JP3640909B2 30",
        ["T" = 24],
        "width",
        proved_at!([2 3]; [2 3 4 8], |W| UnitTimeCounter::<W>)
    ),
    entry!(
        UnitTimeRegister<24>,
        UnitTimeRegister { period: 1000 },
        Some(3),
        "JP3640909B2 ¶0016",
        ["T" = 24],
        "width, T at power-on",
        proved_at!([3]; [4 8], |given, W| {
            at_most(given, 2)?;
            UnitTimeRegister::<W> {
                period: second(given, 1, W)?,
            }
        })
    ),
    entry!(
        PulseGenerator<16>,
        PulseGenerator::default(),
        Some(3),
        "JP3640909B2 20 = 201 + 202",
        ["N" = 16],
        "width, 0 for safe or 1 for literal",
        proved_at!([3]; [2 4 8 16], |given, W| PulseGenerator::<W> {
            variant: one_of(given, VARIANTS)?
        })
    ),
    entry!(
        SyncStage,
        SyncStage,
        Some(3),
        "JP3640909B2 40",
        [],
        "nothing",
        Made {
            make: |given| Some(Box::new(alone(given, SyncStage)?)),
            model: |given| Some(Box::new(alone(given, SyncStage)?)),
            offered: &[],
        }
    ),
    entry!(
        PatternMemory<16, 12>, PatternMemory::new(0), Some(3), "JP3640909B2 10", ["N" = 16, "A" = 12],
        "width of the half-period (addresses have one bit, above a width of 4 four), axis, words \
         at power-on (a half-period, 2^width more for down)",
        proved_at!([3]; [4 8], |given, W| memory::<W, { address_bits(W) }>(given)?)
    ),
    entry!(
        AddressSequencer<12>,
        AddressSequencer,
        Some(3),
        "JP3640909B2 50",
        ["A" = 12],
        "width",
        proved_at!([3]; [4 8], |W| AddressSequencer::<W>)
    ),
    entry!(
        CommandPort<12, 24>, CommandPort::default(), Some(3), "JP3640909B2 ¶0018, ¶0026", ["A" = 12, "T" = 24],
        "width",
        proved_at!([3]; [4 8], |W| CommandPort::<W, W>::default())
    ),
    entry!(
        Axis<16, 12>, Axis::new(0, Variant::Safe), Some(3), "JP3640909B2 10 + 20 + 40", ["N" = 16, "A" = 12],
        "width of the half-period (addresses have one bit, above a width of 4 four), 0 for safe or \
         1 for literal",
        proved_at!([3]; [4 8], |given, W| Axis::<W, { address_bits(W) }>::new(0, one_of(given, VARIANTS)?))
    ),
    entry!(
        UnitLaw<16>,
        UnitLaw::default(),
        Some(3),
        "JP3640909B2 30 + 20 + 40, with ghosts",
        ["W" = 16],
        "width, 0 for safe or 1 for literal",
        proved_at!([3 4]; [4 8 16], |given, W| UnitLaw::<W>::new(one_of(given, VARIANTS)?))
    ),
    entry!(
        Group<2>,
        Group::new(Variant::Safe, 1000),
        Some(2),
        "JP3640909B2 1",
        ["AXES" = 2, "N" = 16, "T" = 24, "A" = 12],
        "width of half-period and T, T at power-on: one axis, two words of memory (1 up, 2 down); \
         then 0 for safe or 1 for literal, and 0 to wait, 1 to play once or 2 to loop by itself: two \
         axes of eight words (width 8 always), without proofs; then words of x and y in turn (a \
         half-period, 2^width more for down)",
        Made {
            make: group,
            model: group_model,
            offered: &[4, 8],
        }
    ),
];
