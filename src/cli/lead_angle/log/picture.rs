//! The picture of a log: its way with the signals, and how far the predictions were off.

use crate::cli::lead_angle::Job;
use motion_rtl::input::position_log::PositionLog;
use motion_rtl::jobs::lead_angle::replay::Replayed;
use motion_rtl::jobs::lead_angle::settings::Settings;
use motion_rtl::picture::{Curve, Panel, Picture};

const AXIS: &str = "time in s";
const WITH: &str = "#0072b2";
const WITHOUT: &str = "#8c8c8c";
const SIGNAL: &str = "#d55e00";

/// The picture as SVG.
pub fn draw(job: &Job, log: &PositionLog, settings: &Settings, replayed: &Replayed) -> String {
    let samples = log.samples.iter();
    let path = samples.map(|at| (at.seconds, at.counts as f64)).collect();
    let mut position =
        Panel::new("position", AXIS, "counts").curve(Curve::new("log", path).colour(WITHOUT));
    let mut marks = Vec::new();
    for signal in &replayed.signals {
        let at = signal.tick as f64 / settings.clock_hz as f64;
        let later = at + signal.lead_ms / 1e3;
        let (from, target) = (signal.position as f64, signal.target as f64);
        marks.extend([(at, from), (later, target), (f64::NAN, target)]);
    }
    if !marks.is_empty() {
        let marks = Curve::new("from each signal to its target", marks);
        position = position.curve(marks.colour(SIGNAL).width(4.0));
    }
    let width = log.seconds() / replayed.parts.len().max(1) as f64;
    let errors = |index: usize| -> Vec<(f64, f64)> {
        let parts = replayed.parts.iter().enumerate();
        let point =
            |(part, errors): (usize, &[f64; 2])| ((part as f64 + 0.5) * width, errors[index]);
        parts.map(point).collect()
    };
    let errors = Panel::new("largest prediction error", AXIS, "counts")
        .curve(Curve::new("without the lead", errors(1)).colour(WITHOUT))
        .curve(Curve::new("with the lead", errors(0)).colour(WITH));
    Picture::new(format!("{}: lead-angle compensator on a log", job.stem))
        .panel(position)
        .panel(errors)
        .render()
}
