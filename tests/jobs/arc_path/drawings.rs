//! Part programs, from their text to position commands.

use super::*;
use motion_rtl::circuits::arc_generator::{Rounding, Widths};
use motion_rtl::input::read_text;
use motion_rtl::jobs::arc_generator::prepare::prepare;
use motion_rtl::jobs::arc_generator::record::records;
use motion_rtl::jobs::arc_generator::reference::commands;
use motion_rtl::jobs::arc_generator::settings::Settings;
use motion_rtl::path::pieces::from_drawing;

const WIDTHS: Widths = Widths::FULL;

/// A slot with round ends, entered by a rapid move and left on a full circle; the second arc's
/// centre is off by a rounded digit.
const SLOT: &str = "G21 G90 G17\nG0 X20 Y0 Z0\nG1 X60 F1800\nG3 X60 Y20 I0 J10\nG1 X20\n\
                    G3 X20 Y0 I0.0004 J-10\nG2 X20 Y0 I0 J-15 F1200\nM2\n";

#[test]
fn a_part_program_becomes_commands() {
    let drawing = read_text("slot.ngc", SLOT.as_bytes()).unwrap();
    let settings = Settings::default();
    let timing = settings.timing(&WIDTHS).unwrap();
    let pieces = from_drawing(&drawing, &settings).unwrap();
    let path = prepare(drawing.start, &pieces, &timing).unwrap();
    let lines: Vec<_> = path.pieces.iter().map(|piece| piece.line).collect();
    assert_eq!(lines, [2, 3, 4, 5, 6, 7].map(Some));
    let wanted: Vec<_> = path.pieces.iter().map(|piece| piece.wanted).collect();
    assert_eq!(wanted, [200.0, 30.0, 30.0, 30.0, 30.0, 20.0]);
    // All joints are smooth: the whole circle leaves in the direction in which the slot ends.
    let stops = path.segments.iter().filter(|s| s.ends_at_rest).count();
    assert_eq!(stops, 1);
    let records = records(&path, 1000.0, &WIDTHS, Rounding::Nearest).unwrap();
    let commands = commands(&records, &WIDTHS, Rounding::Nearest).collect::<Vec<_>>();
    assert_eq!(commands.len() as u64, path.samples());
    assert_eq!(commands.last(), Some(&[20_000, 0, 0]));
    for piece in &path.pieces {
        // Every taught point is passed, at the latest after a blend's distance from it.
        let to = piece.to.map(|mm| 1000.0 * mm);
        let off = commands
            .iter()
            .map(|c| length(minus(c.map(|x| x as f64), to)));
        assert!(off.fold(f64::INFINITY, f64::min) < 300.0);
    }
    assert!(commands.iter().all(|command| command[2] == 0));
}

#[test]
fn a_refusal_names_the_line_of_the_program() {
    let drawing = read_text("slot.ngc", SLOT.replace("F1800", "F24000").as_bytes()).unwrap();
    let settings = Settings::default();
    let timing = settings.timing(&WIDTHS).unwrap();
    let pieces = from_drawing(&drawing, &settings).unwrap();
    let error = prepare(drawing.start, &pieces, &timing).unwrap_err();
    assert_eq!(
        (error.piece, error.line, error.reason.word()),
        (2, Some(4), "F")
    );
}
