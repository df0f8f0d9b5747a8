//! Changes of speed in the summary, and what they make of an elastic mechanism.

use super::Job;
use super::beside::Beside;
use super::figures::Figures;
use super::jolt::Jolt;
use crate::cli::columns::Table;
use crate::cli::rows::{fixed, fixed_or_dash};
use serde::Serialize;
use std::fmt;

/// A way to make the commands.
#[derive(Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct SpeedChanges {
    /// Name of the method.
    pub method: &'static str,
    /// Largest change of speed from one sample to the next.
    pub speed_change_mm_per_s: f64,
    /// That change divided by the sample time.
    pub acceleration_mm_per_s2: f64,
    /// Largest distance of the mechanism from its command while the command moves.
    pub moving_um: Option<f64>,
    /// Largest distance after the command has ended.
    pub rest_um: Option<f64>,
}

/// Returns the path on the arc generator and, in a comparison, the worst of its arcs by the
/// conventional method with and without ramps, each from rest to rest. Empty without arcs.
pub fn rows(job: &Job, figures: &Figures) -> Vec<SpeedChanges> {
    let compared = job.loaded.scenario.beside();
    if figures.arcs.is_empty() || compared && figures.beside.arcs.is_empty() {
        return Vec::new();
    }
    let arcs = |beside: &Beside| beside.arcs.iter().map(|arc| arc.jolt).reduce(Jolt::max);
    let methods = [
        ("patent", Some(figures.jolt)),
        ("conventional", arcs(&figures.beside)),
        ("conventional, without ramps", arcs(&figures.even)),
    ];
    let methods = methods.into_iter();
    let methods = methods.filter_map(|(method, jolt)| Some(row(job, method, jolt?)));
    methods.collect()
}

fn row(job: &Job, method: &'static str, jolt: Jolt) -> SpeedChanges {
    let vibration = job.mechanism.map(|_| jolt.vibration);
    SpeedChanges {
        method,
        speed_change_mm_per_s: jolt.speed_change,
        acceleration_mm_per_s2: jolt.speed_change / job.prepared.timing.sample_s,
        moving_um: vibration.map(|of| of.moving_mm * 1e3),
        rest_um: vibration.map(|of| of.rest_mm * 1e3),
    }
}

/// Writes the rows as text.
pub fn write(rows: &[SpeedChanges], text: &mut String) -> fmt::Result {
    if rows.is_empty() {
        return Ok(());
    }
    Table::of(rows)
        .left("from sample to sample", 27, |row| row.method)
        .col("change of mm/s", 0, |row| {
            fixed(row.speed_change_mm_per_s, 3)
        })
        .col("mm/s2", 9, |row| fixed(row.acceleration_mm_per_s2, 3))
        .col("mechanism off its command um", 0, |row| {
            fixed_or_dash(row.moving_um, 3)
        })
        .col("at rest um", 0, |row| fixed_or_dash(row.rest_um, 3))
        .write_apart(text)
}
