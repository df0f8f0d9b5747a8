//! Whether the runs did what the path says.

use super::Job;
use super::runs::{Run, Runs};
use motion_rtl::trajectory_controller::settings::Correction;

/// What is wrong with the runs; empty where nothing is.
pub fn complaints(job: &Job, runs: &Runs) -> Vec<String> {
    let each = runs.runs.iter().flat_map(|run| {
        let own = of_run(job, run).into_iter();
        own.map(|text| format!("{}: {text}", run.correction.name()))
    });
    each.collect()
}

fn of_run(job: &Job, run: &Run) -> Vec<String> {
    let count_mm = 1.0 / job.settings.counts_per_mm;
    let flags = [
        (run.late, "a period began before that before it was over"),
        (run.starved, "the path ended in motion"),
        (run.lost, "an encoder was too fast"),
        (!run.settled, "models and motors did not settle at the end"),
    ];
    let flags = flags.into_iter().filter(|(wrong, _)| *wrong);
    let mut all: Vec<_> = flags.map(|(_, text)| text.to_owned()).collect();
    let mut keep = |what: &str, mm: f64, bound: f64| {
        // Written so that NaN fails.
        let within = mm <= bound;
        if !within {
            let (um, bound) = (mm * 1e3, bound * 1e3);
            all.push(format!(
                "{what}: {um:.3} um, where {bound:.3} um are allowed"
            ));
        }
    };
    keep(
        "a command beside the path",
        run.command_error_mm,
        0.5 * count_mm,
    );
    keep(
        "the last command beside the path's end",
        run.end_mm,
        0.5 * count_mm,
    );
    // On a widened arc the path ends beside its end.
    if run.correction != Correction::Steady {
        // Half a count of each axis.
        let (model, bound) = (run.measured.model.final_mm, 3f64.sqrt() / 2.0 * count_mm);
        keep("the models beside the path's end", model, bound);
    }
    all
}
