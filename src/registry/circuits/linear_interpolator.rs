use crate::circuits::linear_interpolator::{
    Accumulator, AxisSwitch, CommandSource, Controller, Conventional, CycleGate, Differentiator,
    Integrator, LineLaw, LineSweep, LinearInterpolator, LoopWidths, MasterAxis, PatternGenerator,
    PositionControl, PositionLoop, Rule, Sequencer, TargetData, Trapezoid, Widths,
};
use crate::registry::Entry;
use crate::registry::entry::entry;

/// Widths of the small circuits around a pattern.
const SMALL: Widths = Widths {
    address: 2,
    position: 4,
    time: 2,
};

/// Widths of a position loop, from that of positions.
fn loop_widths(position: usize) -> LoopWidths {
    LoopWidths {
        position,
        gain: position,
        fraction: position / 2,
        converter: position,
    }
}

fn integrator(position: usize) -> Integrator {
    Integrator {
        position,
        rule: Rule::Floor,
    }
}

fn interpolator() -> LinearInterpolator {
    LinearInterpolator {
        widths: SMALL,
        ..LinearInterpolator::default()
    }
}

/// A small controller.
fn controller(source: CommandSource) -> Controller {
    Controller {
        loops: loop_widths(4),
        scan: 4,
        source,
    }
}

/// The circuits of JP3608587B2.
pub(super) const CIRCUITS: &[Entry] = &[
    entry!(
        TargetData, "JP3608587B2 20",
        full: LinearInterpolator::default().targets(),
        small: TargetData { widths: Widths { position: 2, ..SMALL }, settings: 1 }, proved: true,
    ),
    entry!(
        Sequencer, "JP3608587B2 ¶0005, ¶0014",
        full: Sequencer { position: 32, master: MasterAxis::Longer },
        small: Sequencer { position: 2, master: MasterAxis::Longer }, proved: true,
    ),
    entry!(
        Trapezoid, "JP3608587B2 14, control",
        full: Trapezoid { position: 32, time: 12 },
        small: Trapezoid { position: 4, time: 2 },
    ),
    entry!(
        PatternGenerator, "JP3608587B2 14",
        full: PatternGenerator { position: 32, time: 12 },
        small: PatternGenerator { position: 4, time: 2 },
    ),
    entry!(
        Differentiator, "JP3608587B2 21 = 22 + 23",
        full: Differentiator { position: 32 },
        small: Differentiator { position: 3 }, proved: true,
    ),
    entry!(
        Accumulator, "JP3608587B2 24, registers",
        full: Accumulator { position: 32, rule: Rule::Floor },
        small: Accumulator { position: 3, rule: Rule::Floor },
    ),
    entry!(
        Integrator, "JP3608587B2 24",
        full: integrator(32),
        small: integrator(6),
        swept: LineSweep::new, least: integrator(2),
    ),
    entry!(
        LineLaw, "JP3608587B2 24, with ghosts",
        full: LineLaw { integrator: integrator(32) },
        small: LineLaw { integrator: integrator(3) }, proved: true,
    ),
    entry!(
        AxisSwitch, "JP3608587B2 25, Figs 5 and 6",
        full: AxisSwitch { position: 32 },
        small: AxisSwitch { position: 2 }, proved: true,
    ),
    entry!(
        CycleGate, "JP3608587B2, in-position check",
        full: CycleGate {},
        small: CycleGate {}, proved: true,
    ),
    entry!(
        LinearInterpolator, "JP3608587B2 14, 20, 21, 24, 25",
        full: LinearInterpolator::default(),
        small: interpolator(),
    ),
    entry!(
        PositionControl, "JP3608587B2 10 + 11 + 12",
        full: PositionControl::default(),
        small: PositionControl { widths: loop_widths(3) }, proved: true,
    ),
    entry!(
        PositionLoop, "JP3608587B2 10–13",
        full: PositionLoop::default(),
        small: PositionLoop { widths: loop_widths(2) }, proved: true,
    ),
    entry!(
        Conventional, "JP3608587B2 14, 20, Fig. 3",
        full: Conventional::default(),
        small: Conventional { widths: SMALL },
    ),
    entry!(
        Controller, "JP3608587B2 1, Fig. 5",
        full: Controller::new(CommandSource::Linear(LinearInterpolator::default())),
        small: controller(CommandSource::Linear(interpolator())), idle: ["loops.position"],
    ),
    entry!(
        Controller, "JP3608587B2 1, Fig. 3",
        full: Controller::new(CommandSource::Conventional(Conventional::default())),
        small: controller(CommandSource::Conventional(Conventional { widths: SMALL })),
        idle: ["loops.position"],
        named: "conventional_controller",
            "a position pattern for each axis, with the position loops of X and Y",
    ),
];
