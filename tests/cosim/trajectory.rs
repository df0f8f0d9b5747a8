//! Paths of the trajectory controller with motors and loads: what the control computer writes and
//! the encoders say, applied to its Verilog.

use super::tools::{Simulator, complete, write};
use motion_rtl::circuits::trajectory_controller::{Rounding, TrajectoryController, Widths};
use motion_rtl::hdl::Declarations;
use motion_rtl::input::Point;
use motion_rtl::jobs::trajectory_controller::job::{Program, play};
use motion_rtl::jobs::trajectory_controller::segments::FourthAxis;
use motion_rtl::jobs::trajectory_controller::settings::{Correction, LEAST_PERIOD_TICKS, Settings};
use motion_rtl::path::pieces::{Speeds, Taught, from_points};
use motion_rtl::plant::{TwoMassAxis, TwoMassParameters};
use motion_rtl::sim::Without;
use motion_rtl::trace::{Clock, Options, OutputFile, StimulusFile, Vcd};
use motion_rtl::verilog::Verilog;
use std::fs::File;

/// Lines and an arc that begins without a stop, in mm; flat, or in space.
fn pieces(z: f64) -> [(Point, Option<Point>); 3] {
    [
        ([0.5, 0.0, 0.0], None),
        ([1.0, 0.5, z], Some([0.85, 0.15, z / 2.0])),
        ([0.6, 0.9, 0.0], None),
    ]
}

/// Four segments in memory: of as many as a job has no simulator writes the waves in good time.
const WIDTHS: Widths = Widths {
    segment: 2,
    ..Widths::FULL
};

/// Plays the path in the shortest periods, and drives the Verilog with the same inputs.
fn hold(axes: usize, correction: Correction, rounding: Rounding, simulator: Simulator) {
    let settings = Settings {
        // Four axes take four ticks more, for their words.
        clock_hz: 1000 * (LEAST_PERIOD_TICKS + if axes == 4 { 4 } else { 0 }),
        feed_mm_per_min: Some(1800.0),
        jerk_time_ms: 4.0,
        corner_mm_per_min: 300.0,
        rounding,
        correction,
        ..Settings::default()
    };
    let taught = pieces(if axes >= 3 { 0.4 } else { 0.0 }).map(|(to, via)| Taught {
        to,
        via,
        spline: false,
        speed: None,
    });
    let start = [0.0; 3];
    let pieces = from_points(start, &taught, Speeds::from(&settings)).unwrap();
    let axis = TwoMassParameters {
        load_friction_nm: 0.1,
        ..TwoMassParameters::default()
    };
    let machine = vec![axis; axes];
    let fourth = (axes == 4).then(|| FourthAxis {
        from_mm: 0.0,
        to_mm: vec![0.3, 0.1, 0.1],
    });
    let fourth = fourth.as_ref();
    let program = Program::with_fourth(start, &pieces, fourth, &settings, &machine, &WIDTHS);
    let program = program.unwrap();
    assert_eq!(program.path.stretches.len(), 3);
    let tick_s = 1.0 / settings.clock_hz as f64;
    let plants = vec![TwoMassAxis::new(&axis, tick_s).unwrap(); axes];

    let circuit = TrajectoryController::new(WIDTHS, axes, correction, rounding);
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path();
    let modules = write(path, &Verilog::new(&circuit).unwrap());
    let name = "trajectory_controller";
    let create = |extension| File::create(path.join(format!("{name}.{extension}"))).unwrap();
    let (clock, options) = (Clock::default(), Options::default());
    let mut vcd = Vcd::new(create("vcd"), &circuit, clock, &options).unwrap();
    let mut stimulus = StimulusFile::new(create("stimulus"), &circuit);
    let mut expected = OutputFile::new(create("expected"), &circuit).unwrap();
    let mut observers = (Without(&mut vcd), Without((&mut stimulus, &mut expected)));
    let played = play(&circuit, &program, plants, &mut observers).unwrap();
    vcd.finish().unwrap();
    stimulus.finish().unwrap();
    expected.finish().unwrap();
    assert!(!played.late && !played.starved && !played.lost && played.settled);
    let moved = played
        .periods
        .iter()
        .any(|period| period.corrected != period.command);
    assert!(moved, "a correction");
    let report = simulator.hold(path, name, &modules);
    complete(
        &report,
        played.ticks,
        Declarations::of(&circuit).leaves.len(),
    );
}

#[test]
#[ignore = "needs Verilator"]
fn a_corrected_path_in_space_is_the_same_in_verilator() {
    hold(
        3,
        Correction::Vector,
        Rounding::Nearest,
        Simulator::Verilator,
    );
}

#[test]
#[ignore = "needs Icarus Verilog"]
fn a_path_of_four_axes_is_the_same_in_icarus() {
    hold(
        4,
        Correction::Feedback,
        Rounding::Nearest,
        Simulator::Icarus,
    );
}

#[test]
#[ignore = "needs Icarus Verilog"]
fn the_prior_art_that_rounds_down_is_the_same_in_icarus() {
    hold(2, Correction::Steady, Rounding::Floor, Simulator::Icarus);
}
