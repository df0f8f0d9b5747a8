//! Positionings of the turntable: what the compensators are driven with, encoder and all, applied to
//! their Verilog.

use super::tools::{Simulator, complete, write};
use motion_rtl::hdl::{Circuit, Declarations};
use motion_rtl::jobs::lead_angle::job::{Played, play, positioner};
use motion_rtl::jobs::lead_angle::settings::{
    Comparing, Detector, History, LeadBy, LeadForm, Placement, Settings, Step,
};
use motion_rtl::sim::Without;
use motion_rtl::trace::{Clock, Options, OutputFile, StimulusFile, Vcd};
use motion_rtl::verilog::Verilog;
use std::fs::File;

/// Short ways, at a clock that is as slow as the encoder allows.
fn settings(positionings: u32) -> Settings {
    let step = |target, speed_counts_per_s, lead_ms| Step {
        target,
        speed_counts_per_s,
        lead_ms,
        ..Step::default()
    };
    let mut settings = Settings {
        clock_hz: 50_000,
        ck_ticks: 5,
        steps: vec![step(900, 20_000, 15.0), step(-700, 30_000, 30.0)],
        rest_ms: 2.0,
        standstill_ms: 2.0,
        positionings,
        ..Settings::default()
    };
    settings.body.acceleration_counts_per_s2 = 2e6;
    settings
}

/// Plays positionings, and drives the Verilog with the same inputs.
fn hold(settings: &Settings, simulator: Simulator) -> Played {
    let circuit = positioner(settings);
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path();
    let verilog = Verilog::new(&circuit).unwrap();
    let modules = write(path, &verilog);
    let name = circuit.name();
    let create = |extension: &str| File::create(path.join(format!("{name}.{extension}"))).unwrap();
    let (clock, all) = (Clock::default(), Options::default());
    let mut vcd = Vcd::new(create("vcd"), &circuit, clock, &all).unwrap();
    let mut stimulus = StimulusFile::new(create("stimulus"), &circuit);
    let mut expected = OutputFile::new(create("expected"), &circuit).unwrap();
    let mut observers = (Without(&mut vcd), &mut stimulus, Without(&mut expected));
    let played = play(&circuit, settings, &mut observers).unwrap();
    vcd.finish().unwrap();
    stimulus.finish().unwrap();
    expected.finish().unwrap();
    assert_eq!(played.positionings.len(), settings.positionings as usize);
    assert!(!played.lost && !played.unsettled);
    let report = simulator.hold(path, name, &modules);
    let leaves = Declarations::of(&circuit).leaves.len();
    complete(&report, played.ticks, leaves);
    played
}

#[test]
#[ignore = "needs Verilator"]
fn positionings_are_the_same_in_verilator() {
    let played = hold(&settings(6), Simulator::Verilator);
    assert!(played.positionings.iter().all(|one| one.learned.is_some()));
}

#[test]
#[ignore = "needs Icarus Verilog"]
fn other_variants_are_the_same_in_icarus() {
    let halves = Settings {
        placement: Placement::Halves,
        history: History::Ram,
        ..settings(2)
    };
    hold(&halves, Simulator::Icarus);
    let equal = Settings {
        comparing: Comparing::Equal,
        placement: Placement::Target,
        ..settings(2)
    };
    hold(&equal, Simulator::Icarus);
}

#[test]
#[ignore = "needs Icarus Verilog"]
fn an_absolute_encoder_is_the_same_in_icarus() {
    let absolute = Settings {
        detector: Detector::Absolute,
        ..settings(2)
    };
    hold(&absolute, Simulator::Icarus);
}

#[test]
#[ignore = "needs Icarus Verilog"]
fn a_phase_shift_detector_is_the_same_in_icarus() {
    let mut shifted = Settings {
        detector: Detector::PhaseShift,
        clock_hz: 400_000,
        ck_ticks: 40,
        ..settings(1)
    };
    shifted.steps.truncate(1);
    hold(&shifted, Simulator::Icarus);
}

#[test]
#[ignore = "needs Icarus Verilog"]
fn a_resolver_is_the_same_in_icarus() {
    let resolver = Settings {
        detector: Detector::Resolver,
        clock_hz: 200_000,
        ck_ticks: 20,
        ..settings(2)
    };
    hold(&resolver, Simulator::Icarus);
}

#[test]
#[ignore = "needs Icarus Verilog"]
fn the_equal_forms_are_the_same_in_icarus() {
    for &form in &LeadForm::ALL[1..] {
        let history = match form {
            LeadForm::FixedRatio | LeadForm::FixedRatioProducts => History::Ram,
            _ => History::ShiftRegister,
        };
        hold(
            &Settings {
                form,
                history,
                ..settings(2)
            },
            Simulator::Icarus,
        );
    }
}

#[test]
#[ignore = "needs Icarus Verilog"]
fn the_conventional_compensator_is_the_same_in_icarus() {
    for lead in [LeadBy::Speed, LeadBy::Table] {
        let conventional = Settings {
            lead,
            ..settings(2)
        };
        hold(&conventional, Simulator::Icarus);
    }
}
