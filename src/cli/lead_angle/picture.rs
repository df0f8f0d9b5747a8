//! The picture of a run: stop errors per positioning, those of learning magnified, and the codes.

use super::Job;
use super::summary::code_travel;
use super::systems::System;
use motion_rtl::lead_angle::job::Played;
use motion_rtl::picture::{Curve, Panel, Picture};

const COLOURS: [&str; 5] = ["#8c8c8c", "#cc79a7", "#e69f00", "#0072b2", "#d55e00"];
const STEP_COLOURS: [&str; 6] = [
    "#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9",
];
const BAND: &str = "#b0b0b0";

/// The picture as SVG.
pub fn draw(job: &Job, played: &[(System, Played)]) -> String {
    let settings = &job.settings;
    let axis = "positioning";
    let mut all = Panel::new("stop error", axis, "counts past the target");
    for ((system, run), colour) in played.iter().zip(COLOURS) {
        let curve = Curve::new(system.name, errors(run)).colour(colour);
        let width = if system.own { 1.6 } else { 0.9 };
        all = all.curve(curve.width(width));
    }
    let mut picture = Picture::new(format!("{}: lead-angle compensator", job.stem)).panel(all);
    let learner = played.iter().find(|(system, _)| system.name == "learning");
    if let Some((system, run)) = learner {
        let travel = |sign: f64| {
            let positionings = run.positionings.iter().enumerate();
            positionings
                .map(|(number, one)| (number as f64, sign * code_travel(settings, one)))
                .collect::<Vec<_>>()
        };
        let limit = travel(1.0).iter().fold(0.0, |most: f64, at| most.max(at.1));
        let near = |at: &(f64, f64)| at.1.abs() <= 6.0 * limit;
        // What is far outside is in the panel above.
        let shown = errors(run).into_iter();
        let shown = shown.map(|at| if near(&at) { at } else { (f64::NAN, f64::NAN) });
        let panel = Panel::new("stop error of learning, close", axis, "counts")
            .curve(
                Curve::new("a code's travel", travel(1.0))
                    .colour(BAND)
                    .dashed(),
            )
            .curve(Curve::new("and below", travel(-1.0)).colour(BAND).dashed())
            .curve(Curve::new(system.name, shown.collect()).colour(COLOURS[3]));
        picture = picture.panel(panel);
        let mut codes = Panel::new("lead time of each step", axis, "lead time in ms");
        for step in 0..settings.steps.len() {
            let of_step = |run: &Played| -> Vec<(f64, f64)> {
                let positionings = run.positionings.iter().enumerate();
                positionings
                    .filter(|(_, one)| one.step == step)
                    .map(|(number, one)| (number as f64, one.code as f64 * settings.ck_ms()))
                    .collect()
            };
            let colour = STEP_COLOURS[step % STEP_COLOURS.len()];
            let name = format!("step {step}");
            codes = codes.curve(Curve::new(name, of_step(run)).colour(colour));
            let literal = played
                .iter()
                .find(|(system, _)| system.name == "literal sign");
            if let Some((_, literal)) = literal {
                let name = format!("step {step}, literal");
                let curve = Curve::new(name, of_step(literal)).colour(colour);
                codes = codes.curve(curve.width(0.7).dashed());
            }
        }
        picture = picture.panel(codes);
    }
    picture.render()
}

fn errors(run: &Played) -> Vec<(f64, f64)> {
    let positionings = run.positionings.iter().enumerate();
    positionings
        .map(|(number, one)| (number as f64, one.error as f64))
        .collect()
}
