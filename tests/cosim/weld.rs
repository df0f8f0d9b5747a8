//! Paths of the arc generator: what the control computer writes, applied to its Verilog.

use super::tools::{Simulator, complete, write};
use motion_rtl::circuits::arc_generator::{Rounding, Widths};
use motion_rtl::hdl::Declarations;
use motion_rtl::input::Point;
use motion_rtl::jobs::arc_generator::job::{Played, arc_generator, play};
use motion_rtl::jobs::arc_generator::prepare::{Timing, prepare};
use motion_rtl::jobs::arc_generator::record::records;
use motion_rtl::jobs::arc_generator::reference::commands;
use motion_rtl::jobs::arc_generator::settings::{LEAST_SAMPLE_TICKS, Settings, ShortPieces};
use motion_rtl::path::pieces::{Taught, from_points};
use motion_rtl::trace::{Clock, Options, OutputFile, StimulusFile, Vcd};
use motion_rtl::verilog::Verilog;
use std::fs::File;

/// A line, two arcs in space of which the second is reached by a stop, a line; in mm.
const START: Point = [-40.0, 10.0, 5.0];
const PIECES: [(Point, Option<Point>); 4] = [
    ([0.0, 10.0, 5.0], None),
    ([12.0, 26.0, 17.0], Some([8.0, 14.0, 9.0])),
    ([-5.0, 30.0, -3.0], Some([3.0, 40.0, 8.0])),
    ([-60.0, -20.0, 0.0], None),
];

/// Plays the path at the shortest sampling time, and drives the Verilog with the same inputs.
fn hold(rounding: Rounding, simulator: Simulator) -> Played {
    let settings = Settings {
        feed_mm_per_min: Some(6000.0),
        ..Settings::default()
    };
    let timing = Timing {
        sample_s: 1e-2,
        blend_samples: 6,
        corner: 0.6,
        short_pieces: ShortPieces::Slower,
        most_samples: Widths::FULL.most_samples(),
    };
    let taught = PIECES.map(|(to, via)| Taught {
        to,
        via,
        spline: false,
        speed: None,
    });
    let pieces = from_points(START, &taught, &settings).unwrap();
    let prepared = prepare(START, &pieces, &timing).unwrap();
    let records = records(&prepared, 1000.0, &Widths::FULL, rounding).unwrap();
    assert!(records.len() > 9, "{} segments", records.len());

    let circuit = arc_generator(&Settings {
        rounding,
        ..Settings::default()
    });
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path();
    let modules = write(path, &Verilog::new(&circuit).unwrap());
    let create = |extension| File::create(path.join(format!("arc_generator.{extension}"))).unwrap();
    let (clock, options) = (Clock::default(), Options::default());
    let mut vcd = Vcd::new(create("vcd"), &circuit, clock, &options).unwrap();
    let mut stimulus = StimulusFile::new(create("stimulus"), &circuit);
    let mut expected = OutputFile::new(create("expected"), &circuit).unwrap();
    let mut observers = (&mut vcd, &mut stimulus, &mut expected);
    let played = play(
        &circuit,
        &records,
        LEAST_SAMPLE_TICKS as u32,
        &mut observers,
    )
    .unwrap();
    vcd.finish().unwrap();
    stimulus.finish().unwrap();
    expected.finish().unwrap();
    let seen: Vec<_> = played.commands.iter().map(|one| one.counts).collect();
    assert!(commands(&records, &Widths::FULL, rounding).eq(seen));
    let report = simulator.hold(path, "arc_generator", &modules);
    complete(
        &report,
        played.ticks,
        Declarations::of(&circuit).leaves.len(),
    );
    played
}

#[test]
#[ignore = "needs Verilator"]
fn a_path_is_the_same_in_verilator() {
    let played = hold(Rounding::Nearest, Simulator::Verilator);
    assert!(!played.late && !played.starved);
}

#[test]
#[ignore = "needs Icarus Verilog"]
fn a_path_that_rounds_down_is_the_same_in_icarus() {
    hold(Rounding::Floor, Simulator::Icarus);
}
