use super::make::{MASTERS, RULES, at_most, choice, one_of, only, width};
use crate::circuits::linear_interpolator::{
    Accumulator, AxisSwitch, CommandSource, Controller, Conventional, CycleGate, Differentiator,
    Integrator, LineLaw, LinearInterpolator, LoopWidths, MasterAxis, PatternGenerator,
    PositionControl, PositionLoop, Rule, Sequencer, TargetData, Trapezoid, Widths,
};
use crate::hdl::Circuit;
use crate::registry::Entry;
use crate::registry::entry::{Field, Of, alone, entry, nothing};

/// Widths of the circuits around a pattern, from that of positions.
fn widths(position: usize) -> Widths {
    Widths {
        address: 2,
        position,
        time: position / 2,
    }
}

/// Widths of a position loop, from that of positions.
fn loop_widths(position: usize) -> LoopWidths {
    LoopWidths {
        position,
        gain: position,
        fraction: position / 2,
        converter: position,
    }
}

/// What is made from a width and the number of a rule.
fn ruled<C>(given: &[u64], circuit: impl FnOnce(usize, Rule) -> C) -> Option<C> {
    let rule = one_of(given, RULES)?;
    alone(given.get(..1)?, |width| circuit(width, rule))
}

fn integrator(position: usize, rule: Rule) -> Integrator {
    Integrator { position, rule }
}

/// A linear interpolator, from the width of positions, the number of a rule, and that of what leads.
fn interpolator(given: &[u64]) -> Option<LinearInterpolator> {
    let made = LinearInterpolator {
        widths: widths(width(given)?),
        ..LinearInterpolator::default()
    };
    kind(made, given.get(1..)?)
}

/// The same with other numbers than its width.
fn kind(circuit: LinearInterpolator, given: &[u64]) -> Option<LinearInterpolator> {
    at_most(given, 2)?;
    Some(LinearInterpolator {
        rule: choice(given, 0, RULES)?,
        master: choice(given, 1, MASTERS)?,
        ..circuit
    })
}

fn conventional(position: usize) -> Conventional {
    Conventional {
        widths: widths(position),
    }
}

/// A controller from the width of positions.
fn controller(scan: usize, source: CommandSource) -> Controller {
    Controller {
        loops: loop_widths(scan),
        scan,
        source,
    }
}

/// The widths of what makes a controller's commands.
fn source(circuit: &mut Controller) -> &mut Widths {
    match &mut circuit.source {
        CommandSource::Linear(source) => &mut source.widths,
        CommandSource::Conventional(source) => &mut source.widths,
    }
}

/// The widths of a controller: their names, and where they are.
const NAMES: &[&str] = &[
    "address",
    "position",
    "time",
    "gain",
    "fraction",
    "converter",
    "scan",
];

const FIELDS: &[Field<Controller>] = &[
    |circuit| &mut source(circuit).address,
    |circuit| &mut source(circuit).position,
    |circuit| &mut source(circuit).time,
    |circuit| &mut circuit.loops.gain,
    |circuit| &mut circuit.loops.fraction,
    |circuit| &mut circuit.loops.converter,
    |circuit| &mut circuit.scan,
];

/// The circuits of JP3608587B2.
pub(super) const CIRCUITS: &[Entry] = &[
    entry!(
        TargetData, "JP3608587B2 20",
        full: || LinearInterpolator::default().targets(),
        widths: [address, position, time in widths],
        by: "width of positions and times (addresses have two bits)",
        |width| TargetData {
            widths: Widths { time: width, ..widths(width) },
            settings: 1,
        },
        proved: 2,
    ),
    entry!(
        Sequencer, "JP3608587B2 ¶0005, ¶0014",
        full: || Sequencer { position: 32, master: MasterAxis::Longer },
        widths: [position],
        by: "width, 0 where the longer axis leads, 1 where X or 2 where Y does",
        |position, master of MASTERS| Sequencer { position, master },
        proved: 2,
    ),
    entry!(
        Trapezoid, "JP3608587B2 14, control",
        full: || Trapezoid { position: 32, time: 12 },
        widths: [position, time],
        by: "width of positions; times have half of it",
        |position| Trapezoid { position, time: position / 2 },
        proved: none,
    ),
    entry!(
        PatternGenerator, "JP3608587B2 14",
        full: || PatternGenerator { position: 32, time: 12 },
        widths: [position, time],
        by: "width of positions; times have half of it",
        |position| PatternGenerator { position, time: position / 2 },
        proved: none,
    ),
    entry!(
        Differentiator, "JP3608587B2 21 = 22 + 23",
        full: || Differentiator { position: 32 },
        widths: [position],
        by: "width", |position| Differentiator { position },
        proved: 3,
    ),
    entry!(
        Accumulator, "JP3608587B2 24, registers",
        full: || Accumulator { position: 32, rule: Rule::Floor },
        widths: [position],
        by: "width, 0 for floor, 1 for truncating or 2 for centred",
        |position, rule of RULES| Accumulator { position, rule },
        proved: none,
    ),
    entry!(
        Integrator, "JP3608587B2 24",
        full: || integrator(32, Rule::Floor),
        widths: [position],
        by: "width, 0 for floor, 1 for truncating or 2 for centred",
        |position, rule of RULES| Integrator { position, rule },
        proved: none,
    ),
    entry!(
        LineLaw, "JP3608587B2 24, with ghosts",
        full: || LineLaw { integrator: integrator(32, Rule::Floor) },
        widths: [position in integrator],
        from: "width, 0 for floor, 1 for truncating or 2 for centred",
        |given| Some(LineLaw { integrator: ruled(given, integrator)? }),
        with: |circuit, given| Some(LineLaw {
            integrator: integrator(circuit.integrator.position, only(given, RULES)?),
        }),
        proved: 3,
    ),
    entry!(
        AxisSwitch, "JP3608587B2 25, Figs 5 and 6",
        full: || AxisSwitch { position: 32 },
        widths: [position],
        by: "width", |position| AxisSwitch { position },
        proved: 2,
    ),
    entry!(
        CycleGate, "JP3608587B2, in-position check",
        full: || CycleGate,
        widths: [],
        from: "nothing", |given| (given.len() <= 1).then_some(CycleGate),
        with: nothing,
        proved: 2,
    ),
    entry!(
        LinearInterpolator, "JP3608587B2 14, 20, 21, 24, 25",
        full: LinearInterpolator::default,
        widths: [address, position, time in widths],
        from: "width of positions (times have half of it, addresses two bits), 0 for floor, 1 for \
               truncating or 2 for centred, 0 where the longer axis leads, 1 where X or 2 where Y does",
        interpolator,
        with: kind,
        proved: none,
    ),
    entry!(
        PositionControl, "JP3608587B2 10 + 11 + 12",
        full: PositionControl::default,
        widths: [position, gain, fraction, converter in widths],
        by: "width of positions, gain and D/A converter; half of the gain is its fraction",
        |width| PositionControl { widths: loop_widths(width) },
        proved: 3,
    ),
    entry!(
        PositionLoop, "JP3608587B2 10–13",
        full: PositionLoop::default,
        widths: [position, gain, fraction, converter in widths],
        by: "width of positions, gain and D/A converter; half of the gain is its fraction",
        |width| PositionLoop { widths: loop_widths(width) },
        proved: 2,
    ),
    entry!(
        Conventional, "JP3608587B2 14, 20, Fig. 3",
        full: Conventional::default,
        widths: [address, position, time in widths],
        from: "width of positions (times have half of it, addresses two bits)",
        |given| alone(given, conventional),
        with: nothing,
        proved: none,
    ),
    Entry {
        name: Controller::NAME,
        about: Controller::ABOUT,
        source: "JP3608587B2 1, Fig. 5",
        arguments: "width of positions, gains, references and the scan (times have half of it, \
                    addresses two bits), 0 for floor, 1 for truncating or 2 for centred, 0 where \
                    the longer axis leads, 1 where X or 2 where Y does",
        proof_width: None,
        maker: &Of::<Controller> {
            full: || Controller::new(CommandSource::Linear(LinearInterpolator::default())),
            from: |given| {
                let source = CommandSource::Linear(interpolator(given)?);
                Some(controller(width(given)?, source))
            },
            with: |circuit, given| {
                let made = LinearInterpolator {
                    widths: circuit.source.targets().widths,
                    ..LinearInterpolator::default()
                };
                let source = CommandSource::Linear(kind(made, given)?);
                Some(Controller { source, ..circuit })
            },
            names: NAMES,
            fields: FIELDS,
            proved: None,
        },
    },
    Entry {
        name: "conventional_controller",
        about: "a position pattern for each axis, with the position loops of X and Y",
        source: "JP3608587B2 1, Fig. 3",
        arguments: "width of positions, gains, references and the scan (times have half of it, \
                    addresses two bits)",
        proof_width: None,
        maker: &Of::<Controller> {
            full: || Controller::new(CommandSource::Conventional(Conventional::default())),
            from: |given| {
                alone(given, |width| {
                    controller(width, CommandSource::Conventional(conventional(width)))
                })
            },
            with: nothing,
            names: NAMES,
            fields: FIELDS,
            proved: None,
        },
    },
];
