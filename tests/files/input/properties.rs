//! Properties of any input.

use std::fmt::Write as _;

use motion_rtl::input::{Course, Drawing, Fault, Options, REACH_MM, gcode, hpgl};
use proptest::collection::vec;
use proptest::prelude::*;

use super::common::{Reader, accept, near};

const READERS: [Reader; 3] = [hpgl::read, gcode::read, lenient];

fn lenient(file: &str, text: &[u8]) -> Result<Drawing, Fault> {
    hpgl::read_with(file, text, &Options::lenient())
}

/// An accepted drawing keeps its promises; so does a fault.
fn check(result: Result<Drawing, Fault>) -> Result<(), TestCaseError> {
    let drawing = match result {
        Ok(drawing) => drawing,
        Err(fault) => {
            prop_assert!(!fault.field.is_empty() && !fault.problem.is_empty());
            prop_assert!(!fault.allowed.is_empty());
            return Ok(());
        }
    };
    prop_assert!(!drawing.moves.is_empty());
    let within = |values: &[f64]| values.iter().all(|value| value.abs() <= REACH_MM);
    let mut from = drawing.start;
    for step in &drawing.moves {
        prop_assert!(within(&step.to), "{step:?}");
        prop_assert!(
            step.feed_mm_per_min
                .is_none_or(|feed| feed.is_finite() && feed > 0.0)
        );
        match step.course {
            Course::Line => prop_assert_ne!(step.to, from),
            Course::Arc { centre, .. } => prop_assert!(within(&centre), "{step:?}"),
            Course::Spline { controls } => {
                prop_assert!(within(controls.as_flattened()), "{step:?}")
            }
        }
        from = step.to;
    }
    Ok(())
}

/// Text close to what the readers know: it gets further into them than noise does.
fn near_text(words: &'static [&'static str]) -> impl Strategy<Value = String> {
    let number = prop_oneof![
        (-2000i32..2000).prop_map(|n| n.to_string()),
        (-50.0..50.0).prop_map(|x: f64| format!("{x:.3}")),
        any::<i64>().prop_map(|n| n.to_string()),
    ];
    let piece = (
        proptest::sample::select(words),
        proptest::option::of(number),
    )
        .prop_map(|(word, number)| format!("{word}{}", number.unwrap_or_default()));
    vec(piece, 0..30).prop_map(|pieces| pieces.concat())
}

const HPGL: &[&str] = &[
    "PU",
    "PD",
    "PA",
    "PR",
    "SC0,7,0,9",
    "SC",
    "IP",
    "IN;",
    "DF",
    "SP",
    ",",
    ";",
    " ",
    "LB",
    "\x03",
    "DT",
    "\x1b%",
    "\x1b.",
    "\x1b*b",
    "PE",
    "AA",
    "AR5,6,",
    "AT1,2,3,",
    "CI",
    "BZ1,2,3,4,5,",
    "CT1",
    "EA9,",
    "RR99,",
    "WG99,1,",
    "PM",
    "PM1;",
    "PM2;",
    "EP",
    "FP",
    "FT3,",
    "FT4,9,",
    "PT",
    "IW0,0,99,",
    "RO90",
    "IR",
    "PS9,",
    "LBab\x03",
    "SI1,",
    "DI1,",
    "LO",
    "CP",
    "SM",
    "UC",
    "XT",
    "!PG",
    "QQ",
    "\"",
    "\n",
    "@",
];

const GCODE: &[&str] = &[
    "G",
    "M",
    "T",
    "X",
    "Y",
    "Z",
    "I",
    "J",
    "R",
    "F",
    "G0",
    "G1X",
    "G2X",
    "G3X",
    "G91",
    "G20",
    "\n",
    "\n",
    "\r",
    "(",
    ")",
    ";",
    "%",
    "N",
    "O",
    " ",
    "-",
    ".",
    "P",
    "S",
    "/",
    "#",
    "#1=",
    "#<a>=",
    "[",
    "]",
    "+",
    "**",
    "SIN[",
    "\no1 sub\n",
    "\no1 endsub\n",
    "\no1 call",
    "\no2 repeat[3]\n",
    "\no2 endrepeat\n",
    "\no3 if[1]\n",
    "\no3 else\n",
    "\no3 endif\n",
    "\no4 while[#1 LT 3]\n",
    "\no4 endwhile\n",
    "G81R0Z",
    "G83R1Z-5Q",
    "G18",
    "G92X",
    "G10L2P1X",
    "G28",
    "G5I1J1P1Q1X",
    "G5.2X1Y2P",
    "\nG5.3\n",
    "G6.2X1Y2R1P2K",
    "M98P1",
    "M99",
    "Q",
    "L",
    "K",
];

/// A straight program as both kinds of programming write it.
fn write_both(points: &[(i32, i32)], word: impl Fn(i32, i32) -> String) -> [String; 2] {
    let (mut absolute, mut relative, mut last) = (String::new(), String::new(), (0, 0));
    for &(x, y) in points {
        absolute += &word(x, y);
        relative += &word(x - last.0, y - last.1);
        last = (x, y);
    }
    [absolute, relative]
}

fn points() -> impl Strategy<Value = Vec<(i32, i32)>> {
    vec((-9999..9999, -9999..9999), 1..40).prop_filter("must move", |points| {
        points.iter().any(|point| *point != (0, 0))
    })
}

proptest! {
    #[test]
    fn any_bytes(bytes in vec(any::<u8>(), 0..200)) {
        for read in READERS {
            check(read("t", &bytes))?;
        }
    }

    #[test]
    fn any_text(text in "\\PC{0,80}") {
        for read in READERS {
            check(read("t", text.as_bytes()))?;
        }
    }

    #[test]
    fn anything_like_hpgl(text in near_text(HPGL)) {
        check(hpgl::read("t", text.as_bytes()))?;
        check(lenient("t", text.as_bytes()))?;
    }

    #[test]
    fn anything_like_gcode(text in near_text(GCODE)) {
        let options = Options {
            most_lines: 1000,
            ..Options::default()
        };
        check(gcode::read_with("t", text.as_bytes(), &options))?;
    }

    #[test]
    fn hpgl_absolute_equals_relative(points in points()) {
        let [absolute, relative] = write_both(&points, |x, y| format!("{x},{y} "));
        for scale in ["", "SC0,777,-5,333;", "IP40,40,900,700;SC0,7,0,7,1;"] {
            let absolute = accept(hpgl::read, &format!("{scale}PD0,0;PA{absolute};"));
            let relative = accept(hpgl::read, &format!("{scale}PD0,0;PR{relative};"));
            prop_assert_eq!(ends(&absolute), ends(&relative));
        }
    }

    #[test]
    fn gcode_absolute_equals_relative(points in points()) {
        let [absolute, relative] = write_both(&points, |x, y| format!("X{x}Y{y}\n"));
        let absolute = accept(gcode::read, &format!("G90 G0\n{absolute}"));
        let relative = accept(gcode::read, &format!("G91 G0\n{relative}"));
        prop_assert_eq!(ends(&absolute), ends(&relative));
    }

    #[test]
    fn an_inch_is_25_4_mm(points in points()) {
        let text = |scale: f64| points.iter().fold(String::new(), |mut text, &(x, y)| {
            let [x, y] = [x, y].map(|n| f64::from(n) * scale / 1000.0);
            writeln!(text, "X{x:.7}Y{y:.7}").unwrap();
            text
        });
        let inch = accept(gcode::read, &format!("G20 G1 F10\n{}", text(1.0)));
        let mm = accept(gcode::read, &format!("G21 G1 F254\n{}", text(25.4)));
        prop_assert_eq!(inch.moves.len(), mm.moves.len());
        for (inch, mm) in inch.moves.iter().zip(&mm.moves) {
            prop_assert!(near(inch.to, mm.to), "{:?} {:?}", inch, mm);
            prop_assert_eq!(inch.feed_mm_per_min, mm.feed_mm_per_min);
        }
    }

    #[test]
    fn an_arc_by_radius_is_that_by_centre(
        radius in 1.0..70.0f64,
        at in 0.0..std::f64::consts::TAU,
        turn in prop_oneof![0.1..3.04f64, 3.24..6.1f64],
        clockwise: bool,
    ) {
        let (i, j) = (radius * at.cos(), radius * at.sin());
        let sense = if clockwise { -turn } else { turn };
        let (sin, cos) = sense.sin_cos();
        let (x, y) = (i - i * cos + j * sin, j - i * sin - j * cos);
        let code = if clockwise { 2 } else { 3 };
        let signed = if turn > std::f64::consts::PI { -radius } else { radius };
        let read = |form: String| accept(gcode::read, &format!("G{code} X{x} Y{y} {form} F60"));
        let centre = |drawing: &Drawing| match drawing.moves.get(0).unwrap().course {
            Course::Arc { centre: [x, y], clockwise: way } => (way, [x, y, 0.0]),
            Course::Line | Course::Spline { .. } => panic!("{drawing:?}"),
        };
        let (one_way, one) = centre(&read(format!("I{i} J{j}")));
        let (other_way, other) = centre(&read(format!("R{signed}")));
        prop_assert_eq!((one_way, other_way), (clockwise, clockwise));
        let off = (one[0] - other[0]).hypot(one[1] - other[1]);
        prop_assert!(off < 1e-6, "{one:?} {other:?}");
    }
}

fn ends(drawing: &Drawing) -> Vec<[f64; 3]> {
    drawing.moves.iter().map(|step| step.to).collect()
}

#[test]
fn a_million_points_are_read_to_their_end() {
    let count = 1_000_000;
    let mut list = String::from("PD");
    let mut single = String::new();
    let mut program = String::from("F600\n");
    for n in 1..=count {
        let (x, y) = (n % 1000, n / 1000);
        write!(list, "{x} {y} ").unwrap();
        write!(single, "PU{x},{y};").unwrap();
        writeln!(program, "N{n} G1 X{x} Y{y}").unwrap();
    }
    for (read, text, end) in [
        (hpgl::read as Reader, list, [0.0, 25.0, 0.0]),
        (hpgl::read, single, [0.0, 25.0, 0.0]),
        (gcode::read, program, [0.0, 1000.0, 0.0]),
    ] {
        let drawing = read("t", text.as_bytes()).unwrap();
        assert_eq!(drawing.moves.len(), count);
        assert_eq!(drawing.moves.get(count - 1).unwrap().to, end);
    }
}
