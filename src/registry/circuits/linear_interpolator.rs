use super::make::{RULES, one_of};
use crate::linear_interpolator::{
    Accumulator, AxisSwitch, Controller, Conventional, CycleGate, Differentiator, Integrator,
    LineLaw, LinearInterpolator, PatternGenerator, PositionControl, PositionLoop, Sequencer,
    TargetData, Trapezoid,
};
use crate::registry::Entry;
use crate::registry::entry::{Made, alone, at_width, entry, proved_at, some_widths};

/// The circuits of JP3608587B2.
pub(super) const CIRCUITS: &[Entry] = &[
    entry!(
        TargetData<6, 32, 12>, TargetData, Some(2), "JP3608587B2 20", ["A" = 6, "P" = 32, "T" = 12],
        "width of positions and times (addresses have two bits)",
        proved_at!([2]; [3 8], |W| TargetData::<2, W, W>)
    ),
    entry!(
        Sequencer<32>,
        Sequencer,
        Some(2),
        "JP3608587B2 ¶0005, ¶0014",
        ["P" = 32],
        "width",
        proved_at!([2]; [4 8], |W| Sequencer::<W>)
    ),
    entry!(
        Trapezoid<32, 12, 25, 58>,
        Trapezoid,
        None,
        "JP3608587B2 14, control",
        ["P" = 32, "T" = 12, "M" = 25, "Q" = 58],
        "width of positions; times have half of it",
        some_widths!([4 8], |W| Trapezoid::<W, { W / 2 }, { W + 1 }, { 2 * W + 2 }>)
    ),
    entry!(
        PatternGenerator<32, 12, 25, 58>,
        PatternGenerator::default(),
        None,
        "JP3608587B2 14",
        ["P" = 32, "T" = 12, "M" = 25, "Q" = 58],
        "width of positions; times have half of it",
        some_widths!([2 4 8], |W| {
            PatternGenerator::<W, { W / 2 }, { W + 1 }, { 2 * W + 2 }>::default()
        })
    ),
    entry!(
        Differentiator<32>,
        Differentiator,
        Some(3),
        "JP3608587B2 21 = 22 + 23",
        ["P" = 32],
        "width",
        proved_at!([3]; [4 8], |W| Differentiator::<W>)
    ),
    entry!(
        Accumulator<32, 64>,
        Accumulator::default(),
        None,
        "JP3608587B2 24, registers",
        ["P" = 32, "R" = 64],
        "width, 0 for floor, 1 for truncating or 2 for centred",
        some_widths!([3 8], |given, W| Accumulator::<W, { 2 * W }> {
            rule: one_of(given, RULES)?
        })
    ),
    entry!(
        Integrator<32, 64>,
        Integrator::default(),
        None,
        "JP3608587B2 24",
        ["P" = 32, "R" = 64],
        "width, 0 for floor, 1 for truncating or 2 for centred",
        some_widths!([3 8], |given, W| Integrator::<W, { 2 * W }>::new(one_of(given, RULES)?))
    ),
    entry!(
        LineLaw<32, 64>,
        LineLaw::default(),
        Some(3),
        "JP3608587B2 24, with ghosts",
        ["P" = 32, "R" = 64],
        "width, 0 for floor, 1 for truncating or 2 for centred",
        proved_at!([3]; [3 8], |given, W| LineLaw::<W, { 2 * W }>::new(one_of(given, RULES)?))
    ),
    entry!(
        AxisSwitch<32>,
        AxisSwitch,
        Some(2),
        "JP3608587B2 25, Figs 5 and 6",
        ["P" = 32],
        "width",
        proved_at!([2]; [4 8], |W| AxisSwitch::<W>)
    ),
    entry!(
        CycleGate,
        CycleGate,
        Some(2),
        "JP3608587B2, in-position check",
        [],
        "nothing",
        Made {
            make: |given| Some(Box::new(alone(given, CycleGate)?)),
            model: |given| Some(Box::new(alone(given, CycleGate)?)),
            offered: &[],
        }
    ),
    entry!(
        LinearInterpolator<6>,
        LinearInterpolator::default(),
        None,
        "JP3608587B2 14, 20, 21, 24, 25",
        ["A" = 6, "P" = 32, "T" = 12, "M" = 25, "Q" = 58, "R" = 64],
        "width of positions (times have half of it, addresses two bits), 0 for floor, 1 for \
         truncating or 2 for centred",
        some_widths!([4 8], |given, W| LinearInterpolator::<
            2,
            W,
            { W / 2 },
            { W + 1 },
            { 2 * W + 2 },
            { 2 * W },
        >::new(one_of(given, RULES)?))
    ),
    entry!(
        PositionControl,
        PositionControl,
        Some(3),
        "JP3608587B2 10 + 11 + 12",
        ["P" = 32, "G" = 16, "F" = 8, "D" = 16, "R" = 48],
        "width of positions, gain and D/A converter; half of the gain is its fraction",
        proved_at!([3]; [4 8], |W| PositionControl::<W, W, { W / 2 }, W, { 2 * W }>)
    ),
    entry!(
        PositionLoop,
        PositionLoop::default(),
        Some(2),
        "JP3608587B2 10–13",
        ["P" = 32, "G" = 16, "F" = 8, "D" = 16, "R" = 48],
        "width of positions, gain and D/A converter; half of the gain is its fraction",
        proved_at!([2]; [4 8], |W| PositionLoop::<W, W, { W / 2 }, W, { 2 * W }>::default())
    ),
    entry!(
        Conventional<6>,
        Conventional::default(),
        None,
        "JP3608587B2 14, 20, Fig. 3",
        ["A" = 6, "P" = 32, "T" = 12, "M" = 25, "Q" = 58],
        "width of positions (times have half of it, addresses two bits)",
        some_widths!([4 8], |W| Conventional::<
            2,
            W,
            { W / 2 },
            { W + 1 },
            { 2 * W + 2 },
        >::default())
    ),
    entry!(
        Controller<LinearInterpolator>,
        Controller::new(LinearInterpolator::default()),
        None,
        "JP3608587B2 1, Fig. 5",
        [
            "P" = 32,
            "T" = 12,
            "G" = 16,
            "F" = 8,
            "D" = 16,
            "K" = 48,
            "S" = 24
        ],
        "width of positions, gains, references and the scan (times have half of it, addresses two \
         bits), 0 for floor, 1 for truncating or 2 for centred",
        some_widths!([4 8], |given, W| Controller::<
            LinearInterpolator<2, W, { W / 2 }, { W + 1 }, { 2 * W + 2 }, { 2 * W }>,
            W,
            { W / 2 },
            W,
            { W / 2 },
            W,
            { 2 * W },
            W,
        >::new(LinearInterpolator::new(one_of(given, RULES)?)))
    ),
    entry!(
        Controller<Conventional, 32, 12, 16, 8, 16, 48, 24, 2>,
        Controller::new(Conventional::default()),
        None,
        "JP3608587B2 1, Fig. 3",
        [
            "P" = 32,
            "T" = 12,
            "G" = 16,
            "F" = 8,
            "D" = 16,
            "K" = 48,
            "S" = 24
        ],
        "width of positions, gains, references and the scan (times have half of it, addresses two \
         bits)",
        some_widths!([4 8], |W| Controller::<
            Conventional<2, W, { W / 2 }, { W + 1 }, { 2 * W + 2 }>,
            W,
            { W / 2 },
            W,
            { W / 2 },
            W,
            { 2 * W },
            W,
            2,
        >::new(Conventional::default()))
    ),
];
