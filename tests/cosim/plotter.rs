//! The plotter's job: what the controllers are driven with, encoders and all, applied to their
//! Verilog.

use super::tools::{Simulator, complete, write};
use motion_rtl::circuits::linear_interpolator::{Controller, MasterAxis, Rule};
use motion_rtl::hdl::{Circuit, Declarations};
use motion_rtl::input::read_text;
use motion_rtl::jobs::linear_interpolator::job::{conventional, play, plotter};
use motion_rtl::jobs::linear_interpolator::settings::Settings;
use motion_rtl::jobs::linear_interpolator::targets::{LATENCY_TICKS, Target, compile};
use motion_rtl::jobs::linear_interpolator::ways::Way;
use motion_rtl::sim::Without;
use motion_rtl::trace::{Clock, Options, OutputFile, StimulusFile, Vcd};
use motion_rtl::verilog::Verilog;
use std::fs::File;

fn settings(rule: Rule) -> Settings {
    let mut settings = Settings {
        rule,
        clock_hz: 100_000,
        scan_ticks: LATENCY_TICKS,
        in_position_counts: 8,
        ..Settings::default()
    };
    settings.rated_speed_rev_per_min = [1400.0; 2];
    settings.position_gain_per_s = [80.0, 60.0];
    settings
}

/// The cycles of the shipped drawing.
fn cycles(settings: &Settings) -> Vec<Target> {
    let text = include_bytes!("../../waves/plotter.hpgl");
    let drawing = read_text("plotter.hpgl", text).unwrap();
    compile(&drawing, settings).unwrap().targets
}

/// Plays some cycles, and drives the Verilog with the same inputs.
fn hold<const N: usize>(
    circuit: &Controller,
    targets: &[Target<N>],
    settings: &Settings,
    simulator: Simulator,
) {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path();
    let verilog = Verilog::new(circuit).unwrap();
    let modules = write(path, &verilog);
    let name = circuit.name();
    let create = |extension: &str| File::create(path.join(format!("{name}.{extension}"))).unwrap();
    let options = Options::default();
    let mut vcd = Vcd::new(create("vcd"), circuit, Clock::default(), &options).unwrap();
    let mut stimulus = StimulusFile::new(create("stimulus"), circuit);
    let mut expected = OutputFile::new(create("expected"), circuit).unwrap();
    let mut observers = (Without(&mut vcd), Without((&mut stimulus, &mut expected)));
    let played = play(circuit, targets, settings, &mut observers).unwrap();
    vcd.finish().unwrap();
    stimulus.finish().unwrap();
    expected.finish().unwrap();
    assert_eq!(played.cycles.len(), targets.len());
    assert!(!played.late && !played.unsettled && played.lost == [false; 2]);
    let report = simulator.hold(path, name, &modules);
    let leaves = Declarations::of(circuit).leaves.len();
    complete(&report, played.ticks, leaves);
}

#[test]
#[ignore = "needs Verilator"]
fn the_whole_job_is_the_same_in_verilator() {
    let settings = settings(Rule::Floor);
    let targets = cycles(&settings);
    assert_eq!(targets.len(), 65);
    let circuit = plotter(&settings);
    hold(&circuit, &targets, &settings, Simulator::Verilator);
}

#[test]
#[ignore = "needs Icarus Verilog"]
fn some_cycles_of_the_other_rules_and_masters_are_the_same_in_icarus() {
    for (rule, master) in [
        (Rule::Truncating, MasterAxis::X),
        (Rule::Centred, MasterAxis::Y),
    ] {
        let settings = Settings {
            master,
            ..settings(rule)
        };
        let targets = &cycles(&settings)[20..24];
        hold(&plotter(&settings), targets, &settings, Simulator::Icarus);
    }
}

#[test]
#[ignore = "needs Icarus Verilog"]
fn some_cycles_of_the_conventional_system_are_the_same_in_icarus() {
    let settings = settings(Rule::Floor);
    let targets = Way::InProportion.targets(&cycles(&settings), &settings);
    let targets = &targets[26..30];
    hold(&conventional(), targets, &settings, Simulator::Icarus);
}
