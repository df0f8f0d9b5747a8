//! Changes of speed in the summary, and what they make of an elastic mechanism.

use super::Job;
use super::beside::Beside;
use super::figures::Figures;
use crate::cli::rows::{fixed, or_dash, table};
use motion_rtl::input::Point;
use motion_rtl::jobs::arc_generator::mechanism::{Vibration, largest_speed_change};
use serde::Serialize;
use std::fmt;

/// A way to make the commands.
#[derive(Debug, Serialize)]
pub struct Row {
    /// Which.
    pub method: &'static str,
    /// Largest change of speed from one sample to the next.
    pub speed_change_mm_per_s: f64,
    /// The acceleration that it is.
    pub acceleration_mm_per_s2: f64,
    /// How far the mechanism is from its command at most, while that moves.
    pub moving_um: Option<f64>,
    /// The same after its end.
    pub rest_um: Option<f64>,
}

/// The path on the arc generator, and its arcs by the conventional method with and without ramps:
/// each from rest to rest, the worst of them, where they are compared; nothing where there are none.
pub fn rows(job: &Job, figures: &Figures) -> Vec<Row> {
    let compared = job.loaded.scenario.beside();
    if figures.arcs.is_empty() || compared && figures.beside.arcs.is_empty() {
        return Vec::new();
    }
    fn arcs(beside: &Beside) -> Vec<&[Point]> {
        let points = beside.arcs.iter().map(|arc| &arc.points[..]);
        points.collect()
    }
    let methods = [
        ("patent", vec![&figures.points[..]]),
        ("conventional", arcs(&figures.beside)),
        ("conventional, without ramps", arcs(&figures.even)),
    ];
    let methods = methods.into_iter().filter(|(_, paths)| !paths.is_empty());
    methods
        .map(|(method, paths)| row(job, method, &paths))
        .collect()
}

fn row(job: &Job, method: &'static str, paths: &[&[Point]]) -> Row {
    let sample_s = job.prepared.timing.sample_s;
    let most = |of: &dyn Fn(&[Point]) -> f64| paths.iter().map(|path| of(path)).fold(0.0, f64::max);
    let change = most(&|path| largest_speed_change(path, sample_s));
    let vibration = job.mechanism.map(|mechanism| {
        let each = paths.iter().map(|path| mechanism.vibration(path, sample_s));
        each.fold(Vibration::default(), |most, of| Vibration {
            moving_mm: most.moving_mm.max(of.moving_mm),
            rest_mm: most.rest_mm.max(of.rest_mm),
        })
    });
    Row {
        method,
        speed_change_mm_per_s: change,
        acceleration_mm_per_s2: change / sample_s,
        moving_um: vibration.map(|of| of.moving_mm * 1e3),
        rest_um: vibration.map(|of| of.rest_mm * 1e3),
    }
}

/// For people.
pub fn write(rows: &[Row], text: &mut String) -> fmt::Result {
    if rows.is_empty() {
        return Ok(());
    }
    let heads = [
        ("from sample to sample      ", 0),
        ("change of mm/s", 0),
        ("mm/s2", 9),
        ("mechanism off its command um", 0),
        ("at rest um", 0),
    ];
    let cells = rows.iter().map(|row| {
        [
            format!("{:<27}", row.method),
            fixed(row.speed_change_mm_per_s, 3),
            fixed(row.acceleration_mm_per_s2, 3),
            or_dash(row.moving_um.map(|um| fixed(um, 3))),
            or_dash(row.rest_um.map(|um| fixed(um, 3))),
        ]
    });
    table(text, heads, cells)?;
    text.push('\n');
    Ok(())
}
