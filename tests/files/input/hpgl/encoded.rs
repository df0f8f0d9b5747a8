//! Encoded polylines.

use motion_rtl::input::hpgl::read;
use proptest::prelude::*;

use crate::input::common::moves;

/// Encodes a number, in base 64 or 32.
fn number(value: i64, radix: u64) -> Vec<u8> {
    let last = if radix == 64 { 191 } else { 95 };
    let mut rest = value.unsigned_abs() * 2 + u64::from(value < 0);
    let mut text = Vec::new();
    while rest >= radix {
        text.push(63 + (rest % radix) as u8);
        rest /= radix;
    }
    text.push(last + rest as u8);
    text
}

fn text(parts: &[&dyn AsRef<[u8]>]) -> Vec<u8> {
    parts
        .iter()
        .flat_map(|part| part.as_ref().to_vec())
        .collect()
}

fn drawn(text: &[u8]) -> Vec<String> {
    moves(&read("t", text).unwrap_or_else(|fault| panic!("{fault}")))
}

#[test]
fn flags_hold_for_the_point_after_them() {
    for radix in [64, 32] {
        let n = |value| number(value, radix);
        let base: &[u8] = if radix == 32 { b"7" } else { b"" };
        let encoded = text(&[
            &"PA80,0;PU;PE",
            &base,
            &"<=",
            &n(40),
            &n(80),
            &n(40),
            &n(0),
            &"<",
            &n(0),
            &n(-40),
            &"=",
            &n(0),
            &n(0),
            &";PA40,0",
        ]);
        assert_eq!(
            drawn(&encoded),
            [
                "rapid to 2 0 0",
                "rapid to 1 2 0",
                "line to 2 2 0",
                "rapid to 2 1 0",
                "line to 0 0 0",
                // The pen is as it was last, and PA as before.
                "line to 1 0 0",
            ],
            "{radix}"
        );
    }
}

#[test]
fn fractions_and_pens_are_taken() {
    let n = |value| number(value, 64);
    let encoded = text(&[
        &"SP1;PE:",
        &n(2),
        &">",
        &n(3),
        &n(40 * 8 + 4),
        &n(0),
        &">",
        &n(-1),
        &n(20),
        &n(0),
        &";",
    ]);
    let drawing = read("t", &encoded).unwrap();
    assert_eq!(
        moves(&drawing),
        ["line to 1.0125 0 0", "line to 2.0125 0 0"]
    );
    assert!(
        drawing.warnings[0]
            .text
            .starts_with("SP: more than one pen")
    );
}

#[test]
fn user_units_and_polygons_take_them() {
    let n = |value| number(value, 64);
    let encoded = text(&[&"IP0,0,40,80;SC0,1,0,1;PE", &n(2), &n(3), &";"]);
    assert_eq!(drawn(&encoded), ["line to 2 6 0"]);
    let encoded = text(&[&"PM;PE", &n(40), &n(0), &n(0), &n(40), &";PM2;EP"]);
    assert_eq!(
        drawn(&encoded),
        ["line to 1 0 0", "line to 1 1 0", "line to 0 0 0"]
    );
}

#[test]
fn a_missing_semicolon_before_an_instruction_is_forgiven() {
    let n = |value| number(value, 64);
    let encoded = text(&[&"PE", &n(40), &n(0), &"PUSP0;PA0,0"]);
    let drawing = read("t", &encoded).unwrap();
    assert_eq!(moves(&drawing), ["line to 1 0 0", "rapid to 0 0 0"]);
    assert_eq!(drawing.warnings[0].text, "PE: ends without a semicolon");
}

#[test]
fn bytes_that_an_editor_made_utf8_of_are_bytes() {
    let n = |value| number(value, 64);
    let encoded = text(&[&"IN;\nPE", &n(40), &n(-80), &n(400), &n(0), &";"]);
    let as_text: String = encoded.iter().map(|&byte| char::from(byte)).collect();
    let drawing = read("t", as_text.as_bytes()).unwrap();
    assert_eq!(moves(&drawing), drawn(&encoded));
    assert_eq!(
        drawing.warnings[0].to_string(),
        "t:2: PE: characters are UTF-8, taken for the bytes they stand for"
    );
    // Bytes that are valid UTF-8 by chance, and right as they are, are left so: -1 and 0.
    assert_eq!(drawn(b"PE\xc2\xbf;"), ["line to -0.025 0 0"]);
    // The first fault is the one that is shown.
    let fault = read("t", "PE\u{f6}\u{f6}!;".as_bytes()).unwrap_err();
    assert!(fault.problem.starts_with("'\\u{b6}'"), "{fault}");
}

#[test]
fn what_is_not_encoded_is_refused() {
    let n = |value| number(value, 64);
    for (encoded, problem) in [
        (
            text(&[&"\nPE", &n(4), &"!;"]),
            "t:2: PE: '!' in place of an encoded digit",
        ),
        (text(&[&"PE", &n(4), &";"]), "t:1: PE: ends within a number"),
        (text(&[&"PE<=y?M;"]), "t:1: PE: ends within a number"),
        (
            text(&[&"PE>", &n(27), &";"]),
            "t:1: PE: 27 bits of fraction",
        ),
        (text(&[&"PE:", &n(-1), &";"]), "t:1: PE: -1 is not a pen"),
        (
            text(&[&"PE", &n(4)]),
            "t:1: PE: no semicolon after it, to the end of the file",
        ),
        (
            text(&[&"PE", &[b'?'; 90], &n(4), &";"]),
            "t:1: PE: a number of more than 60 bits",
        ),
        (
            text(&[&"PE", &n(1 << 50), &n(4), &";"]),
            "t:1: PE: X would be 28147497671065.6 mm",
        ),
    ] {
        let fault = read("t", &encoded).unwrap_err().to_string();
        assert!(fault.starts_with(problem), "{fault}");
    }
}

proptest! {
    /// A polyline encoded is the same as one in decimals.
    #[test]
    fn a_polyline_encoded_is_the_same(
        points in proptest::collection::vec((-9000..9000i64, -9000..9000i64, any::<bool>()), 1..30),
        bits in 0..9i64,
        radix in prop_oneof![Just(64), Just(32)],
    ) {
        prop_assume!(points.iter().any(|&(x, y, _)| (x, y) != (0, 0)));
        let unit = (1 << bits) as f64;
        let mut encoded = text(&[&"PE", &if radix == 32 { "7>" } else { ">" }, &number(bits, radix)]);
        let mut plain = "PR;".to_owned();
        for &(x, y, up) in &points {
            encoded.extend(text(&[&if up { "<" } else { "" }, &number(x, radix), &number(y, radix)]));
            let pen = if up { "PU" } else { "PD" };
            plain += &format!("{pen}{},{};", x as f64 / unit, y as f64 / unit);
        }
        encoded.push(b';');
        let fault = "t: file: no move in it";
        match (read("t", &encoded), read("t", plain.as_bytes())) {
            (Ok(encoded), Ok(plain)) => prop_assert_eq!(moves(&encoded), moves(&plain)),
            (Err(one), Err(other)) => {
                prop_assert_eq!(&one, &other);
                prop_assert!(one.to_string().starts_with(fault));
            }
            pair => prop_assert!(false, "{:?}", pair),
        }
    }
}
