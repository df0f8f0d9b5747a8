//! Circuits and their inputs during the jobs that ship with the crate, for comparisons of one run
//! with another.

use super::{Loaded, Scenario};
use crate::circuits::arc_generator::{self, ArcGenerator};
use crate::circuits::lead_angle::Compensator;
use crate::circuits::linear_interpolator::Controller;
use crate::circuits::machine::Machine;
use crate::circuits::pulse_interpolator::pattern_memory::WritePort;
use crate::circuits::pulse_interpolator::{Group, Variant, Widths, group};
use crate::circuits::trajectory_controller::{self, TrajectoryController};
use crate::hdl::{Circuit, zero};
use crate::input::{Drawing, read_path};
use crate::jobs;
use crate::jobs::arc_generator::job::arc_generator;
use crate::jobs::arc_generator::prepare::prepare;
use crate::jobs::arc_generator::record::records;
use crate::jobs::lead_angle::job::positioner;
use crate::jobs::linear_interpolator::job::plotter;
use crate::jobs::linear_interpolator::targets;
use crate::jobs::pulse_interpolator::compile;
use crate::jobs::taught::taught;
use crate::jobs::trajectory_controller::job as trajectory;
use crate::path::pieces::{Speeds, from_drawing, from_points};
use crate::plant::TwoMassAxis;
use crate::sim::{InputRecorder, RecordedInputs, Simulator, State};
use std::error::Error;
use std::path::Path;

/// Folder of the shipped scenarios.
const WAVES: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/waves");

/// Circuit, and its inputs during a job.
#[derive(Debug)]
pub struct Recorded<C> {
    /// Circuit at the widths of the job.
    pub circuit: C,
    /// Inputs from the start of the job.
    pub inputs: RecordedInputs,
}

/// Reference clock of a job.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Clock {
    /// Clock of the scenario, 10 to 400 kHz: slow enough for a dump of every tick.
    Shipped,
    /// Clock of 10 MHz, with all periods as long as in the scenario.
    Fast,
}

/// Reason why a shipped job cannot be recorded.
#[derive(Debug, thiserror::Error)]
#[error("{scenario}: {source}")]
pub struct ShippedError {
    /// Name of the scenario.
    scenario: &'static str,
    source: AnyError,
}

type AnyError = Box<dyn Error + Send + Sync>;

impl ShippedError {
    fn of(scenario: &'static str) -> impl FnOnce(AnyError) -> Self {
        move |source| ShippedError { scenario, source }
    }
}

/// Settings that give a scenario a clock of 10 MHz.
const FAST: [(&str, &[&str]); 4] = [
    (
        "bracket",
        &["line_unit_ticks=80000", "arc_unit_ticks=50000"],
    ),
    ("plotter", &["scan_ticks=20000"]),
    ("turntable", &["ck_ticks=1000"]),
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

fn scenario(name: &str, clock: Clock) -> Result<Scenario, AnyError> {
    let mut sets = Vec::new();
    if clock == Clock::Fast {
        sets.push("clock_hz=10000000".to_owned());
        let periods = FAST.iter().filter(|(of, _)| *of == name);
        sets.extend(periods.flat_map(|(_, sets)| sets.iter().map(|&set| set.to_owned())));
    }
    let path = Path::new(WAVES).join(name).with_extension("toml");
    Ok(Loaded::read(&path, &sets)?.scenario)
}

fn drawing(scenario: &Scenario) -> Result<Drawing, AnyError> {
    Ok(read_path(scenario.input().ok_or("has no input")?)?)
}

/// Runs a job and records the inputs of its first `ticks` ticks.
fn recorded<C: Circuit>(
    circuit: C,
    ticks: u64,
    play: impl FnOnce(&C, &mut InputRecorder) -> Result<(), AnyError>,
) -> Result<Recorded<C>, AnyError> {
    let mut recorder = InputRecorder::new(&circuit, ticks);
    play(&circuit, &mut recorder)?;
    let inputs = recorder.finish();
    Ok(Recorded { circuit, inputs })
}

/// Defines functions that record the start of a job.
macro_rules! shipped {
    ($( $(#[doc = $doc:literal])+ $job:ident($name:literal): $circuit:ty, $make:ident; )+) => {
        $(
            $(#[doc = $doc])+
            ///
            /// # Errors
            /// Returns an error if the scenario file is not there or was changed.
            pub fn $job(ticks: u64, clock: Clock) -> Result<Recorded<$circuit>, ShippedError> {
                let scenario = scenario($name, clock);
                let made = scenario.and_then(|scenario| $make(&scenario, ticks));
                made.map_err(ShippedError::of($name))
            }
        )+
    };
}

shipped! {
    /// Records the bracket on two stepping motors.
    bracket("bracket"): Group, pulse_interpolator;
    /// Records the plotter's drawing.
    plotting("plotter"): Controller, linear_interpolator;
    /// Records the turntable's positionings.
    turntable("turntable"): Compensator, lead_angle;
    /// Records the weld seam.
    weld("weld"): ArcGenerator, arcs;
    /// Records the pocket on three axes.
    pocket("pocket"): TrajectoryController, trajectory;
    /// Records the bracket on the machine of all five circuits.
    machine("machine"): Machine, whole_machine;
}

/// Message about a scenario file of another circuit.
const OTHER: &str = "is a scenario of another circuit";

fn pulse_interpolator(whole: &Scenario, ticks: u64) -> Result<Recorded<Group>, AnyError> {
    let Scenario::PulseInterpolator(scenario) = whole else {
        return Err(OTHER.into());
    };
    let drawn = drawing(whole)?;
    let (table, _) = compile(&drawn, &scenario.settings.settings(&drawn))?;
    let circuit = jobs::pulse_interpolator::job::group(&table, Variant::Safe);
    recorded(circuit, ticks, |circuit, recorder| {
        jobs::pulse_interpolator::job::play(circuit, &table, recorder)?;
        Ok(())
    })
}

fn linear_interpolator(whole: &Scenario, ticks: u64) -> Result<Recorded<Controller>, AnyError> {
    let Scenario::LinearInterpolator(scenario) = whole else {
        return Err(OTHER.into());
    };
    let settings = &scenario.settings;
    let targets = targets::compile(&drawing(whole)?, settings)?.targets;
    recorded(plotter(settings), ticks, |circuit, recorder| {
        jobs::linear_interpolator::job::play(circuit, &targets, settings, recorder)?;
        Ok(())
    })
}

fn lead_angle(whole: &Scenario, ticks: u64) -> Result<Recorded<Compensator>, AnyError> {
    let Scenario::LeadAngle(scenario) = whole else {
        return Err(OTHER.into());
    };
    let settings = &scenario.settings;
    recorded(positioner(settings), ticks, |circuit, recorder| {
        jobs::lead_angle::job::play(circuit, settings, recorder)?;
        Ok(())
    })
}

fn arcs(whole: &Scenario, ticks: u64) -> Result<Recorded<ArcGenerator>, AnyError> {
    let Scenario::ArcGenerator(scenario) = whole else {
        return Err(OTHER.into());
    };
    let (settings, widths) = (&scenario.settings, arc_generator::Widths::FULL);
    let pieces = taught(None, &settings.piece, false)?;
    let pieces = from_points(settings.start_mm, &pieces, Speeds::from(settings))?;
    let prepared = prepare(settings.start_mm, &pieces, &settings.timing(&widths)?)?;
    let (scale, rounding) = (settings.counts_per_mm, settings.rounding);
    let records = records(&prepared, scale, &widths, rounding)?;
    let sample_ticks = settings.sample_ticks(&widths)?;
    recorded(arc_generator(settings), ticks, |circuit, recorder| {
        jobs::arc_generator::job::play(circuit, &records, sample_ticks, recorder)?;
        Ok(())
    })
}

fn trajectory(whole: &Scenario, ticks: u64) -> Result<Recorded<TrajectoryController>, AnyError> {
    let Scenario::TrajectoryController(scenario) = whole else {
        return Err(OTHER.into());
    };
    let settings = &scenario.settings;
    let drawing = drawing(whole)?;
    let pieces = from_drawing(&drawing, Speeds::from(settings))?;
    let machines = settings.machines(3)?;
    let widths = trajectory_controller::Widths::FULL;
    let program = trajectory::Program::of(drawing.start, &pieces, settings, &machines, &widths)?;
    let tick_s = 1.0 / settings.clock_hz as f64;
    let plants = machines
        .iter()
        .map(|machine| TwoMassAxis::new(machine, tick_s));
    let plants = plants.collect::<Result<_, _>>()?;
    let circuit = trajectory::controller(3, settings.correction, settings.rounding);
    recorded(circuit, ticks, |circuit, recorder| {
        trajectory::play(circuit, &program, plants, recorder)?;
        Ok(())
    })
}

fn whole_machine(whole: &Scenario, ticks: u64) -> Result<Recorded<Machine>, AnyError> {
    let Scenario::Machine(scenario) = whole else {
        return Err(OTHER.into());
    };
    let settings = &scenario.settings;
    let program = jobs::machine::Program::of(&drawing(whole)?, settings)?;
    recorded(
        jobs::machine::job::machine(settings),
        ticks,
        |circuit, recorder| {
            jobs::machine::job::play(circuit, &program, settings, recorder)?;
            Ok(())
        },
    )
}

/// Records eight axes, each of which plays a pattern of its own of 64 unit times, both ways.
///
/// # Errors
/// Returns no error as long as the pattern fits the memories.
pub fn eight_axes(ticks: u64) -> Result<Recorded<Group>, ShippedError> {
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
    let recorded = recorded(circuit, ticks, |circuit, recorder| {
        Simulator::new(circuit)?.run(WRITTEN + 2, drive, recorder)?;
        Ok(())
    });
    let mut recorded = recorded.map_err(ShippedError::of("eight axes"))?;
    recorded.inputs.ticks = ticks;
    Ok(recorded)
}
