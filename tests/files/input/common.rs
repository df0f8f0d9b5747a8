//! Short forms for what the tests compare.

use motion_rtl::input::{Course, Drawing, Fault, Point};

/// A reader of either kind.
pub type Reader = fn(&str, &[u8]) -> Result<Drawing, Fault>;

/// Reads a text that must be accepted.
pub fn accept(read: Reader, text: &str) -> Drawing {
    read("t", text.as_bytes()).unwrap_or_else(|fault| panic!("{text:?}: {fault}"))
}

/// The fault of a text that must be refused, as it is shown.
pub fn refuse(read: Reader, text: &str) -> String {
    match read("t", text.as_bytes()) {
        Ok(drawing) => panic!("{text:?} was accepted: {drawing:?}"),
        Err(fault) => fault.to_string(),
    }
}

/// The warnings, as they are shown.
pub fn warnings(drawing: &Drawing) -> Vec<String> {
    drawing.warnings.iter().map(ToString::to_string).collect()
}

/// The moves, one a line: how, where to, with what feed.
pub fn moves(drawing: &Drawing) -> Vec<String> {
    let show = |step: motion_rtl::input::Move| {
        let [x, y, z] = step.to;
        let how = match (step.rapid, step.course) {
            (true, Course::Line) => "rapid".to_owned(),
            (false, Course::Line) => "line".to_owned(),
            (_, Course::Spline { .. }) => "spline".to_owned(),
            (
                _,
                Course::Arc {
                    centre: [x, y],
                    clockwise,
                },
            ) => {
                format!("{} about {x} {y}", if clockwise { "cw" } else { "ccw" })
            }
        };
        let feed = step
            .feed_mm_per_min
            .map_or(String::new(), |feed| format!(" F{feed}"));
        format!("{how} to {x} {y} {z}{feed}")
    };
    drawing.moves.iter().map(show).collect()
}

/// Returns true if the coordinates agree but for rounding.
pub fn near(a: Point, b: Point) -> bool {
    a.iter()
        .zip(b)
        .all(|(a, b)| (a - b).abs() <= 1e-9 * a.abs().max(1.0))
}
