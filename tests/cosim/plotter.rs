//! The plotter's job: what the controllers are driven with, encoders and all, applied to their
//! Verilog.

use super::tools::{Simulator, complete, write};
use motion_rtl::input::read_text;
use motion_rtl::kernel::{Declarations, Without};
use motion_rtl::linear_interpolator::job::{Plotter, conventional, play, plotter};
use motion_rtl::linear_interpolator::settings::{Rule, Settings};
use motion_rtl::linear_interpolator::targets::{LATENCY_TICKS, compile};
use motion_rtl::linear_interpolator::{CommandSource, Controller};
use motion_rtl::trace::{Clock, Options, StimulusFile, Vcd};
use motion_rtl::verilog::Verilog;
use std::fs::File;
use std::ops::Range;

/// Plays some cycles of the shipped drawing, and drives the Verilog with the same inputs.
fn hold<C: CommandSource<32, 12>>(
    circuit: &Plotter<C>,
    rule: Rule,
    cycles: Range<usize>,
    simulator: Simulator,
) where
    Controller<C>: motion_rtl::kernel::Circuit,
{
    let text = include_bytes!("../../waves/plotter.hpgl");
    let drawing = read_text("plotter.hpgl", text).unwrap();
    let mut settings = Settings {
        rule,
        clock_hz: 100_000,
        scan_ticks: LATENCY_TICKS,
        in_position_counts: 8,
        ..Settings::default()
    };
    for (axis, gain) in settings.axes.iter_mut().zip([80.0, 60.0]) {
        axis.rated_speed_rev_per_min = 1400.0;
        axis.position_gain_per_s = gain;
    }
    let targets = &compile(&drawing, &settings).unwrap().targets[cycles];
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path();
    let inner = &circuit.circuit;
    let verilog = Verilog::of(inner).unwrap();
    let modules = write(path, &verilog);
    let name = <Controller<C> as motion_rtl::kernel::Circuit>::NAME;
    let create = |extension: &str| File::create(path.join(format!("{name}.{extension}"))).unwrap();
    let mut vcd = Vcd::new(create("vcd"), inner, Clock::default(), &Options::default()).unwrap();
    let mut stimulus = StimulusFile::new(create("stimulus"));
    let observers = (Without(&mut vcd), Without(&mut stimulus));
    let played = play(circuit, targets, &settings, observers).unwrap();
    vcd.finish().unwrap();
    stimulus.finish().unwrap();
    assert_eq!(played.cycles.len(), targets.len());
    assert!(!played.late && !played.unsettled && played.lost == [false; 2]);
    let report = simulator.hold(path, name, &modules);
    complete(&report, played.ticks, Declarations::of(inner).leaves.len());
}

#[test]
#[ignore = "needs Verilator"]
fn the_whole_job_is_the_same_in_verilator() {
    hold(
        &plotter(Rule::Floor),
        Rule::Floor,
        0..65,
        Simulator::Verilator,
    );
}

#[test]
#[ignore = "needs Icarus Verilog"]
fn some_cycles_of_the_other_rules_are_the_same_in_icarus() {
    for rule in [Rule::Truncating, Rule::Centred] {
        hold(&plotter(rule), rule, 20..24, Simulator::Icarus);
    }
}

#[test]
#[ignore = "needs Icarus Verilog"]
fn some_cycles_of_the_conventional_system_are_the_same_in_icarus() {
    hold(&conventional(), Rule::Floor, 26..30, Simulator::Icarus);
}
