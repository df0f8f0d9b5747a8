//! Labels, symbols and ticks.

use motion_rtl::input::hpgl::read;
use motion_rtl::input::{Drawing, Move};

use super::path;
use crate::input::common::{accept, refuse, warnings};

/// Letters of 100 by 200 plotter units, in cells of 150 by 400.
const SIZE: &str = "SI0.25,0.5;";

/// Where the pen is after a text: the end of a short stroke from there, less the stroke.
fn pen_after(text: &str) -> (f64, f64) {
    let drawing = accept(read, &format!("{SIZE}{text};PD;PR4000,0"));
    let [.., end] = drawing.moves.iter().collect::<Vec<_>>()[..] else {
        panic!("{text}");
    };
    let [x, y] = [end.to[0] * 40.0 - 4000.0, end.to[1] * 40.0].map(|units| units.round());
    (x + 0.0, y + 0.0)
}

/// The least and the greatest X and Y that a text draws, in plotter units.
fn bounds(text: &str) -> [f64; 4] {
    let drawing = accept(read, &format!("{SIZE}{text}"));
    let mut bounds = [f64::MAX, f64::MIN, f64::MAX, f64::MIN];
    let mut from = drawing.start;
    for Move { to, rapid, .. } in &drawing.moves {
        for end in [from, to].iter().filter(|_| !rapid) {
            let [x, y] = [end[0] * 40.0, end[1] * 40.0].map(|units| units.round() + 0.0);
            bounds = [
                bounds[0].min(x),
                bounds[1].max(x),
                bounds[2].min(y),
                bounds[3].max(y),
            ];
        }
        from = to;
    }
    bounds
}

#[test]
fn the_pen_goes_on_at_the_next_cell() {
    for (text, pen) in [
        ("LBABC\x03", (450.0, 0.0)),
        ("PU100,50;LBA B\x03", (550.0, 50.0)),
        ("LBAB\x03LBC\x03", (450.0, 0.0)),
        ("LBAB\x08\x03", (150.0, 0.0)),
        ("LBA\tB\x03", (225.0, 0.0)),
        ("PU100,0;LBAB\r\nC\x03", (250.0, -400.0)),
        ("PU100,0;LBAB\r\n\r\nC\x03", (250.0, -800.0)),
        ("LBA\x0bB\x03", (300.0, 400.0)),
        ("PU100,0;LBAB\x03LB\rC\x03", (250.0, 0.0)),
        ("LBA\x07\x0e\x0f\x7fB\x03", (300.0, 0.0)),
        ("LB\x03", (0.0, 0.0)),
        ("PU7,7;LB  \x03", (307.0, 7.0)),
        ("DT#,1;LBAB#", (300.0, 0.0)),
        ("DT#;LBA\x03B#", (300.0, 0.0)),
        ("DT#;DT;LBAB#\x03", (450.0, 0.0)),
        ("BLABC\x03PB;PB", (900.0, 0.0)),
        ("CP2,1;", (300.0, 400.0)),
        ("LBAB\x03CP-1,-0.5", (150.0, -200.0)),
        ("PU100,0;LBAB\x03CP", (100.0, -400.0)),
        ("PU100,0;LBAB\x03CP;LBA\x03CP;", (100.0, -800.0)),
        // Sizes: of the corners, 10000 by 7200; the default; mirrored.
        ("SR1,2;LBA\x03", (150.0, 0.0)),
        ("SR;LBA\x03", (113.0, 0.0)),
        ("SI;LBA\x03", (112.0, 0.0)),
        ("SI-0.25,0.5;LBA\x03", (-150.0, 0.0)),
        ("ES0.5;LBA\x03", (225.0, 0.0)),
        ("ES0,0.5;LB\n\x03", (0.0, -600.0)),
        // Directions and paths.
        ("DI0,1;LBAB\x03", (0.0, 300.0)),
        ("DI-3,0;LBA\n\x03", (-150.0, 400.0)),
        ("DI0,1;DI;LBA\x03", (150.0, 0.0)),
        ("IP0,0,300,400;DR1,1;LBA\x03", (90.0, 120.0)),
        ("DV1;LBAB\x03", (0.0, -800.0)),
        ("DV3;LBA\x03", (0.0, 400.0)),
        ("DV2;LO7;LBA\x03", (-150.0, 0.0)),
        // A label placed by its middle or its right leaves the pen where it was.
        ("LO2;LBAB\x03", (300.0, 0.0)),
        ("LO13;LBAB\x03", (300.0, 0.0)),
        ("LO21;LBAB\x03", (300.0, 0.0)),
        ("PU70,0;LO5;LBAB\x03", (70.0, 0.0)),
        ("PU70,0;LO7;LBAB\x03", (70.0, 0.0)),
        ("PU70,0;LO19;LBAB\x03", (70.0, 0.0)),
        // Scaled: the pen's place is in user units.
        (
            "IP0,0,4000,4000;SC0,4000,0,4000;PU100,50;LBA\x03",
            (250.0, 50.0),
        ),
        // Defaults.
        ("DI0,1;LO5;ES1;SL1;DV1;DF;SI0.25,0.5;LBA\x03", (150.0, 0.0)),
    ] {
        assert_eq!(pen_after(text), pen, "{text:?}");
    }
}

#[test]
fn letters_fill_the_size_and_stand_where_the_origin_says() {
    // H is 14/16 of a width wide, in the middle.
    for (text, expected) in [
        ("LBH\x03", [6.0, 94.0, 0.0, 200.0]),
        ("LBHH\x03", [6.0, 244.0, 0.0, 200.0]),
        ("DI0,1;LBH\x03", [-200.0, 0.0, 6.0, 94.0]),
        ("SL1;LBH\x03", [6.0, 294.0, 0.0, 200.0]),
        ("DV1;LBHH\x03", [6.0, 94.0, -400.0, 200.0]),
        ("LO2;LBH\x03", [6.0, 94.0, -100.0, 100.0]),
        ("LO3;LBH\x03", [6.0, 94.0, -200.0, 0.0]),
        ("LO4;LBHH\x03", [-119.0, 119.0, 0.0, 200.0]),
        ("LO5;LBH\x03", [-44.0, 44.0, -100.0, 100.0]),
        ("LO7;LBHH\x03", [-244.0, -6.0, 0.0, 200.0]),
        ("LO9;LBH\x03", [-94.0, -6.0, -200.0, 0.0]),
        ("LO11;LBH\x03", [56.0, 144.0, 100.0, 300.0]),
        ("LO19;LBH\x03", [-144.0, -56.0, -300.0, -100.0]),
        ("LO14;LBH\x03", [-44.0, 44.0, 100.0, 300.0]),
        // Every line of a label by itself.
        ("LO4;LBHH\r\nHH\x03", [-119.0, 119.0, -400.0, 200.0]),
        ("SMH;PU1000,0", [956.0, 1044.0, -100.0, 100.0]),
        ("SI-0.25,0.5;LBH\x03", [-94.0, -6.0, 0.0, 200.0]),
    ] {
        assert_eq!(bounds(text), expected, "{text:?}");
    }
}

#[test]
fn a_label_draws_its_letters_with_the_pen_down_and_keeps_its_state() {
    let drawing = accept(read, "SI0.32,0.5;PD;LBL\x03PA0,0");
    let shown = path("SI0.32,0.5;PD;LBL\x03PA0,0");
    // Down the upright, along the foot.
    assert!(shown.starts_with("U16,200 D16,0 D112,0"), "{shown}");
    assert!(shown.ends_with("U192,0 D0,0"), "{shown}");
    let count = |drawing: &Drawing| drawing.moves.iter().filter(|step| !step.rapid).count();
    assert_eq!(count(&drawing), 3);
    // The letters of a label are no instructions.
    assert_eq!(path("LBPD9,9;PU\x03").matches("D9,9").count(), 0);
}

#[test]
fn labels_hold_any_bytes() {
    let drawing = read("t", b"LB\xe4\xff\x00\x03PD40,0").unwrap();
    assert_eq!(
        warnings(&drawing),
        ["t:1: characters that are not in ASCII stay blank in labels (2 times)"]
    );
    let to = drawing.moves.get(drawing.moves.len() - 1).unwrap().to;
    assert_eq!(to, [1.0, 0.0, 0.0]);
}

#[test]
fn symbols_are_drawn_at_every_point() {
    // A dot would be the same; a bar is one stroke, in the middle of the letter.
    let shown = path("SI0.25,0.5;SM-;PU1000,0;PD1000,1000;SM;PD0,0");
    let strokes: Vec<&str> = shown.split(' ').collect();
    assert_eq!(strokes.len(), 9, "{shown}");
    assert_eq!((strokes[0], strokes[4]), ("U1000,0", "D1000,1000"));
    assert_eq!(*strokes.last().unwrap(), "D0,0");
    // Neither arcs nor what SM ends have any; a missing one neither.
    assert_eq!(path("SM;PD9,9"), "D9,9");
    assert_eq!(path("SM*;SM ;PD9,9"), "D9,9");
}

#[test]
fn characters_of_ones_own_are_on_a_grid() {
    // 25 units to a grid's unit: letters of 100 by 200.
    assert_eq!(
        path("SI0.25,0.5;UC4,8,99,-4,0,0,-8,-99,1,1,99,1,0;PD0,0"),
        "U100,200 D0,200 D0,0 U25,25 D50,25 U150,0 D0,0"
    );
    assert_eq!(path("SI0.25,0.5;UC;PD0,0"), "U150,0 D0,0");
    assert_eq!(
        refuse(read, "UC1"),
        "t:1: UC: an X without its Y: an odd count of coordinates; allowed: pairs of X and Y"
    );
}

#[test]
fn ticks_are_parts_of_the_distance_of_p1_and_p2() {
    // 1000 by 2000 units.
    for (text, drawn) in [
        ("XT", "U100,110 D100,90 U100,100"),
        ("YT", "U105,100 D95,100 U100,100"),
        ("TL2,1;XT", "U100,140 D100,80 U100,100"),
        ("TL2;YT", "U120,100 D100,100"),
        ("TL2;TL;YT;PD0,0", "U105,100 D95,100 U100,100 D0,0"),
        ("TL-1;XT", "U100,80 D100,100"),
    ] {
        let shown = path(&format!("IP0,0,1000,2000;PU100,100;{text}"));
        assert_eq!(shown, format!("U100,100 {drawn}"), "{text}");
    }
}

#[test]
fn what_labels_cannot_be_is_refused() {
    for (text, fault) in [
        (
            "DI0,0",
            "t:1: DI: a direction without a run or a rise; allowed: a run and a rise, not both 0",
        ),
        (
            "SI0,1",
            "t:1: SI: letters without a size; allowed: a width and a height other than 0",
        ),
        ("SR1", "t:1: SR: 1 parameters; allowed: 0, 2 parameters"),
        (
            "LO10",
            "t:1: LO: 10 is no origin of labels; allowed: 1 to 9, 11 to 19 or 21",
        ),
        (
            "LO1.5",
            "t:1: LO: 1.5 is no origin of labels; allowed: 1 to 9, 11 to 19 or 21",
        ),
        ("DV4", "t:1: DV: 4 is no path of labels; allowed: 0 to 3"),
    ] {
        assert_eq!(refuse(read, text), fault, "{text}");
    }
}
