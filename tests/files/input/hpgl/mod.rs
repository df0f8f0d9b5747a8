//! HPGL: what is read, skipped and refused.

mod areas;
mod curves;
mod encoded;
mod labels;
mod lines;
mod refused;
mod scales;
mod skipped;

use motion_rtl::input::hpgl::read;

use super::common::accept;

/// Moves of a text, in plotter units rounded to a hundredth: U where the pen is up, D where it is
/// down.
fn path(text: &str) -> String {
    let drawing = accept(read, text);
    let shown = drawing.moves.iter().map(|step| {
        let [x, y, _] = step.to.map(|mm| (mm * 4000.0).round() / 100.0 + 0.0);
        format!("{}{x},{y}", if step.rapid { "U" } else { "D" })
    });
    shown.collect::<Vec<_>>().join(" ")
}
