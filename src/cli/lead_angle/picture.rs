//! The picture of a run: stop errors of all systems, those of learning in codes, and the lead times
//! with either sign.

use super::Job;
use super::summary::{code_travel, error_name, run_of};
use super::systems::{LEARNING, LITERAL, System};
use motion_rtl::jobs::lead_angle::job::{Played, Positioning};
use motion_rtl::jobs::lead_angle::settings::LeadBy;
use motion_rtl::picture::{Curve, Panel, Picture};

const COLOURS: [&str; 13] = [
    "#8c8c8c", "#8c564b", "#cc79a7", "#009e73", "#b5a900", "#0072b2", "#d55e00", "#e69f00",
    "#17becf", "#56b4e9", "#9467bd", "#444444", "#e377c2",
];
const TIMED_OUT: &str = "#000000";
const MARK: &str = "#b0b0b0";
const AXIS: &str = "positioning";
/// Errors in codes beyond this are drawn here: the first panel has them.
const CODES_SHOWN: f64 = 6.0;

/// The picture as SVG.
pub fn draw(job: &Job, played: &[(System, Played)]) -> String {
    let settings = &job.settings;
    let title = format!("{}: lead-angle compensator", job.stem);
    let mut picture = Picture::new(title).panel(all_errors(job, played));
    if let Some(learning) = run_of(played, LEARNING) {
        picture = picture.panel(errors_in_codes(job, learning));
    }
    // Without a comparison, only the scenario's own lead times are drawn.
    let alone = match played {
        [(own, _)] if own.settings.lead == LeadBy::Time => own.name,
        _ => LEARNING,
    };
    for name in [alone, LITERAL].into_iter().take(played.len()) {
        if let Some(run) = run_of(played, name) {
            let title = format!("lead time, {name}");
            let lead_ms = |one: &Positioning| settings.lead_ms(one.code);
            let panel = Panel::new(title, AXIS, "ms");
            let panel = by_step(panel, job, run, lead_ms);
            let most = run.positionings.iter().map(lead_ms).fold(0.0, f64::max);
            picture = picture.panel(load_change(panel, job, [0.0, most]));
        }
    }
    picture.render()
}

/// The stop errors of every system.
fn all_errors(job: &Job, played: &[(System, Played)]) -> Panel {
    let mut panel = Panel::new(
        error_name(job.settings.action),
        AXIS,
        "counts past the target",
    );
    let mut range = [0.0, 0.0_f64];
    for ((system, run), colour) in played.iter().zip(COLOURS) {
        let errors = run.positionings.iter().map(|one| one.error as f64);
        let points: Vec<_> = errors.enumerate().map(|(n, at)| (n as f64, at)).collect();
        for (_, error) in &points {
            range = [range[0].min(*error), range[1].max(*error)];
        }
        let width = if system.own { 1.8 } else { 0.9 };
        let curve = Curve::new(system.name, points).colour(colour);
        panel = panel.curve(curve.width(width));
    }
    for (_, run) in played.iter().filter(|(system, _)| system.own) {
        let marks = timed_out(run, (range[1] - range[0]) / 25.0);
        if !marks.is_empty() {
            let marks = Curve::new("its time was over", marks);
            panel = panel.curve(marks.colour(TIMED_OUT).width(2.4));
        }
    }
    load_change(panel, job, range)
}

/// A stroke through every error that is of no stop.
fn timed_out(run: &Played, half: f64) -> Vec<(f64, f64)> {
    let all = run.positionings.iter().enumerate();
    let over = all.filter(|(_, one)| one.timed_out);
    over.flat_map(|(number, one)| {
        let (at, error) = (number as f64, one.error as f64);
        [(at, error - half), (at, error + half), (f64::NAN, 0.0)]
    })
    .collect()
}

/// Panel of the stop errors of learning in units of a code's travel; they should end within one.
fn errors_in_codes(job: &Job, learning: &Played) -> Panel {
    let title = format!(
        "{} of learning, held at ±{CODES_SHOWN}",
        error_name(job.settings.action)
    );
    let last = learning.positionings.len().saturating_sub(1) as f64;
    let limits = [
        (0.0, 1.0),
        (last, 1.0),
        (f64::NAN, 0.0),
        (0.0, -1.0),
        (last, -1.0),
    ];
    let limits = Curve::new("± one code", limits.to_vec())
        .colour(MARK)
        .dashed();
    let panel = Panel::new(title, AXIS, "codes").curve(limits);
    let panel = by_step(panel, job, learning, |one| {
        let codes = one.error as f64 / code_travel(&job.settings, one);
        codes.clamp(-CODES_SHOWN, CODES_SHOWN)
    });
    load_change(panel, job, [-CODES_SHOWN, CODES_SHOWN])
}

/// A curve for each step, through its positionings.
fn by_step(
    mut panel: Panel,
    job: &Job,
    run: &Played,
    value: impl Fn(&Positioning) -> f64,
) -> Panel {
    for step in 0..job.settings.steps.len() {
        let all = run.positionings.iter().enumerate();
        let own = all.filter(|(_, one)| one.step == step);
        let points = own.map(|(number, one)| (number as f64, value(one)));
        panel = panel.curve(Curve::new(format!("step {step}"), points.collect()));
    }
    panel
}

/// A mark between the positionings between which the load changes.
fn load_change(panel: Panel, job: &Job, [least, most]: [f64; 2]) -> Panel {
    let settings = &job.settings;
    let change = settings
        .load_change_after
        .filter(|after| *after < settings.positionings);
    let Some(change) = change else {
        return panel;
    };
    let at = f64::from(change) - 0.5;
    let mark = vec![(at, least), (at, most)];
    panel.curve(Curve::new("load change", mark).colour(MARK).width(1.6))
}
