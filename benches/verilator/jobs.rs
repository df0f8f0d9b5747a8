//! The circuits at the widths of jobs, and what goes into them during the jobs that ship with the
//! crate.

use super::stimulus::{Recorder, Stimulus};
use motion_rtl::circuits::arc_generator::{self, ArcGenerator};
use motion_rtl::circuits::lead_angle::Compensator;
use motion_rtl::circuits::linear_interpolator::Controller;
use motion_rtl::circuits::machine::Machine;
use motion_rtl::circuits::pulse_interpolator::pattern_memory::WritePort;
use motion_rtl::circuits::pulse_interpolator::{Group, Variant, Widths, group};
use motion_rtl::circuits::trajectory_controller::{self, TrajectoryController};
use motion_rtl::hdl::zero;
use motion_rtl::input::{Drawing, read_path};
use motion_rtl::jobs;
use motion_rtl::jobs::arc_generator::job::arc_generator;
use motion_rtl::jobs::arc_generator::prepare::prepare;
use motion_rtl::jobs::arc_generator::record::records;
use motion_rtl::jobs::lead_angle::job::positioner;
use motion_rtl::jobs::linear_interpolator::job::plotter;
use motion_rtl::jobs::linear_interpolator::targets;
use motion_rtl::jobs::pulse_interpolator::compile;
use motion_rtl::jobs::taught::taught;
use motion_rtl::jobs::trajectory_controller::job as trajectory;
use motion_rtl::path::pieces::{Speeds, from_drawing, from_points};
use motion_rtl::plant::TwoMassAxis;
use motion_rtl::scenario::{Loaded, Scenario};
use motion_rtl::sim::{Simulator, State};
use std::path::Path;

/// A circuit and what goes into it.
pub struct Job<C> {
    pub circuit: C,
    pub stimulus: Stimulus,
}

/// The reference clock of a job.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Clock {
    /// The scenario's own, slow enough for a dump of every tick of a job: of 10 to 400 kHz.
    Shipped,
    /// One of 10 MHz, with all periods as long as they were.
    Fast,
}

/// Settings that make the clock of a scenario a fast one.
const FAST: [(&str, &[&str]); 6] = [
    (
        "bracket",
        &["line_unit_ticks=80000", "arc_unit_ticks=50000"],
    ),
    ("plotter", &["scan_ticks=20000"]),
    ("turntable", &["ck_ticks=1000"]),
    ("weld", &[]),
    ("pocket", &[]),
    (
        "machine",
        &[
            "unit_ticks=50000",
            "scan_ticks=12500",
            "ck_ticks=2000",
            "sample_ticks=25000",
        ],
    ),
];

fn scenario(name: &str, clock: Clock) -> Scenario {
    let waves = Path::new(env!("CARGO_MANIFEST_DIR")).join("waves");
    let mut sets = Vec::new();
    if clock == Clock::Fast {
        let periods = FAST.iter().find(|(of, _)| *of == name).expect("listed").1;
        sets.extend(
            ["clock_hz=10000000"]
                .iter()
                .chain(periods)
                .map(|set| (*set).to_owned()),
        );
    }
    let loaded = Loaded::read(&waves.join(name).with_extension("toml"), &sets);
    loaded.expect("a good scenario").scenario
}

fn drawing(scenario: &Scenario) -> Drawing {
    let input = scenario.input().expect("it has an input");
    read_path(input).expect("a good drawing")
}

/// The bracket on two axes.
pub fn bracket(ticks: u64, clock: Clock) -> Job<Group> {
    let whole = scenario("bracket", clock);
    let Scenario::PulseInterpolator(scenario) = &whole else {
        unreachable!("the pulse interpolator's")
    };
    let drawn = drawing(&whole);
    let settings = scenario.settings.settings(&drawn);
    let (table, _) = compile(&drawn, &settings).expect("it fits");
    let circuit = jobs::pulse_interpolator::job::group(&table, Variant::Safe);
    let mut recorder = Recorder::new(&circuit, ticks);
    jobs::pulse_interpolator::job::play(&circuit, &table, &mut recorder).expect("nobody objects");
    let stimulus = recorder.finish();
    Job { circuit, stimulus }
}

/// Eight axes that play a pattern of 64 unit times, each its own, both ways.
pub fn eight_axes(ticks: u64) -> Job<Group> {
    const WORDS: u64 = 64;
    const WRITTEN: u64 = 8 * WORDS;
    let circuit = Group::new(8, Widths::default(), Variant::Safe, 1000);
    let idle = zero(&circuit);
    let drive = |tick, _: &State<'_, Group>| match tick {
        0..WRITTEN => {
            let (axis, unit) = (tick / WORDS, tick % WORDS);
            group::In {
                port: WritePort {
                    write: true,
                    write_axis: axis,
                    write_address: unit,
                    write_half_period: 10 + (unit * 37 + axis * 101) % 491,
                    write_direction: unit / 8 % 2 == 1,
                },
                ..idle.clone()
            }
        }
        WRITTEN => group::In {
            command: true,
            last: WORDS - 1,
            cyclic: true,
            run: true,
            period: 1000,
            ..idle.clone()
        },
        _ => idle.clone(),
    };
    let mut recorder = Recorder::new(&circuit, ticks);
    let mut simulator = Simulator::new(&circuit).expect("a netlist");
    let run = simulator.run(WRITTEN + 2, drive, &mut recorder);
    run.expect("nobody objects");
    let mut stimulus = recorder.finish();
    stimulus.ticks = ticks;
    Job { circuit, stimulus }
}

/// The plotter's drawing.
pub fn plotting(ticks: u64, clock: Clock) -> Job<Controller> {
    let whole = scenario("plotter", clock);
    let Scenario::LinearInterpolator(scenario) = &whole else {
        unreachable!("the linear interpolator's")
    };
    let settings = &scenario.settings;
    let targets = targets::compile(&drawing(&whole), settings).expect("it fits");
    let circuit = plotter(settings);
    let mut recorder = Recorder::new(&circuit, ticks);
    jobs::linear_interpolator::job::play(&circuit, &targets.targets, settings, &mut recorder)
        .expect("nobody objects");
    let stimulus = recorder.finish();
    Job { circuit, stimulus }
}

/// The turntable's positionings.
pub fn turntable(ticks: u64, clock: Clock) -> Job<Compensator> {
    let Scenario::LeadAngle(scenario) = &scenario("turntable", clock) else {
        unreachable!("the lead-angle compensator's")
    };
    let settings = &scenario.settings;
    let circuit = positioner(settings);
    let mut recorder = Recorder::new(&circuit, ticks);
    jobs::lead_angle::job::play(&circuit, settings, &mut recorder).expect("nobody objects");
    let stimulus = recorder.finish();
    Job { circuit, stimulus }
}

/// The weld seam.
pub fn weld(ticks: u64, clock: Clock) -> Job<ArcGenerator> {
    let Scenario::ArcGenerator(scenario) = scenario("weld", clock) else {
        unreachable!("the arc generator's")
    };
    let (settings, widths) = (scenario.settings, arc_generator::Widths::FULL);
    let pieces = taught(None, &settings.piece, false).expect("it is taught");
    let pieces = from_points(settings.start_mm, &pieces, Speeds::from(&settings));
    let timing = settings.timing(&widths).expect("it fits");
    let prepared = prepare(settings.start_mm, &pieces.expect("arcs"), &timing).expect("it fits");
    let (scale, rounding) = (settings.counts_per_mm, settings.rounding);
    let records = records(&prepared, scale, &widths, rounding).expect("it fits");
    let sample_ticks = settings.sample_ticks(&widths).expect("it fits");
    let circuit = arc_generator(&settings);
    let mut recorder = Recorder::new(&circuit, ticks);
    jobs::arc_generator::job::play(&circuit, &records, sample_ticks, &mut recorder)
        .expect("nobody objects");
    let stimulus = recorder.finish();
    Job { circuit, stimulus }
}

/// The pocket on three axes.
pub fn pocket(ticks: u64, clock: Clock) -> Job<TrajectoryController> {
    let whole = scenario("pocket", clock);
    let Scenario::TrajectoryController(scenario) = &whole else {
        unreachable!("the trajectory controller's")
    };
    let settings = &scenario.settings;
    let drawing = drawing(&whole);
    let pieces = from_drawing(&drawing, Speeds::from(settings)).expect("arcs");
    let machines = settings.machines(3).expect("three");
    let widths = trajectory_controller::Widths::FULL;
    let program = trajectory::Program::of(drawing.start, &pieces, settings, &machines, &widths);
    let tick_s = 1.0 / settings.clock_hz as f64;
    let plants = machines
        .iter()
        .map(|machine| TwoMassAxis::new(machine, tick_s).expect("slow enough"))
        .collect();
    let circuit = trajectory::controller(3, settings.correction, settings.rounding);
    let mut recorder = Recorder::new(&circuit, ticks);
    trajectory::play(&circuit, &program.expect("it fits"), plants, &mut recorder)
        .expect("nobody objects");
    let stimulus = recorder.finish();
    Job { circuit, stimulus }
}

/// The bracket on all five circuits.
pub fn machine(ticks: u64, clock: Clock) -> Job<Machine> {
    let whole = scenario("machine", clock);
    let Scenario::Machine(scenario) = &whole else {
        unreachable!("the machine's")
    };
    let settings = &scenario.settings;
    let program = jobs::machine::Program::of(&drawing(&whole), settings).expect("it fits");
    let circuit = jobs::machine::job::machine(settings);
    let mut recorder = Recorder::new(&circuit, ticks);
    jobs::machine::job::play(&circuit, &program, settings, &mut recorder).expect("nobody objects");
    let stimulus = recorder.finish();
    Job { circuit, stimulus }
}
