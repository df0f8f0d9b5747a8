//! Verdict on the runs: their commands and ends against the path.

use super::Job;
use super::runs::{Run, Runs};
use motion_rtl::jobs::trajectory_controller::settings::Correction;

/// Complaint about a run that did not come to rest.
pub const NOT_SETTLED: &str = "models and motors did not settle at the end";

/// Returns the complaints about the runs; empty if there are none.
pub fn complaints(job: &Job, runs: &Runs) -> Vec<String> {
    let each = runs.runs.iter().flat_map(|run| {
        let own = of_run(job, run, compared(run, runs)).into_iter();
        own.map(|text| format!("{}: {text}", run.name()))
    });
    each.collect()
}

/// Returns true if a run is there to show its gains: a loop that they make unstable is no fault.
pub fn compared(run: &Run, runs: &Runs) -> bool {
    run.correction == Correction::Feedback && runs.traced != Correction::Feedback
}

fn of_run(job: &Job, run: &Run, compared: bool) -> Vec<String> {
    let count_mm = 1.0 / job.settings.counts_per_mm;
    let flags = [
        (run.late, "a period began before the last was over"),
        (run.starved, "the path ended in motion"),
        (run.lost && !compared, "an encoder was too fast"),
        (!run.settled && !compared, NOT_SETTLED),
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
    if run.correction != Correction::Steady && !compared {
        // Half a count of each axis; what is fed back moves it by less than the count that its motor is
        // off, and by the less the smaller the gain.
        let fed = match run.correction {
            Correction::Feedback => job.settings.tangential_gain.max(job.settings.normal_gain),
            _ => 0.0,
        };
        let axes = job.axes().max(3) as f64;
        let bound = axes.sqrt() * (0.5 + fed / (1.0 + fed)) * count_mm;
        let model = run.measured.model.end_um;
        keep("the models beside the path's end", model / 1e3, bound);
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cli::source::{Input, Source};
    use crate::cli::trajectory::CORRECTIONS;
    use motion_rtl::circuits::trajectory_controller::Widths;
    use motion_rtl::circuits::trajectory_controller::path_point::AXES;
    use motion_rtl::jobs::trajectory_controller::job::{Period, Played};
    use motion_rtl::jobs::trajectory_controller::profile_record::lengths;
    use motion_rtl::scenario::Scenario;

    /// Guard units of a count.
    const COUNT: i64 = 1 << 16;

    /// The corner that ships, and a run that is on its path all the time.
    fn corner() -> (Job, Played) {
        let input = Input {
            input: Some("waves/corner.toml".into()),
            ..Input::default()
        };
        let source = Source::read(&input).unwrap();
        let Scenario::TrajectoryController(scenario) = source.loaded.scenario.clone() else {
            panic!("another circuit");
        };
        let job = Job::prepare(source, scenario.settings).unwrap();
        let lengths = lengths(&job.program.records, &Widths::FULL);
        let periods = lengths.into_iter().zip(0..).map(|(length, tick)| {
            let exact = job.program.path.point(length as f64);
            let at = std::array::from_fn(|k| exact.get(k).map_or(0, |units| units.round() as i64));
            Period {
                tick,
                length,
                answered: length,
                command: at,
                reference: at,
                response: at,
                corrected: at,
                model: at,
                motor: at.map(|units| units / COUNT),
                load: at.map(|units| units as f64 / COUNT as f64),
                torque: [0; AXES],
                saturated: [false; AXES],
            }
        });
        let played = Played {
            axes: 2,
            periods: periods.collect(),
            settled: true,
            ..Played::default()
        };
        (job, played)
    }

    fn judged(job: &Job, played: &Played) -> Vec<String> {
        let run = |correction| Run::of(job, correction, played);
        let runs = Runs {
            runs: CORRECTIONS.into_iter().filter_map(run).collect(),
            traced: Correction::Vector,
        };
        complaints(job, &runs)
    }

    #[test]
    fn every_kind_is_complained_of() {
        let (job, good) = corner();
        assert_eq!(judged(&job, &good), [""; 0]);
        let flags = Played {
            late: true,
            starved: true,
            lost: true,
            settled: false,
            ..good.clone()
        };
        let texts = [
            "a period began before the last was over",
            "the path ended in motion",
            "an encoder was too fast",
            "models and motors did not settle at the end",
        ];
        let each = ["none", "steady", "feedback", "vector"];
        let texts = each.map(|name| texts.map(|text| format!("{name}: {text}")));
        // The effect of its gains is no fault of a run for comparison.
        let own = texts.iter().enumerate();
        let own = own.flat_map(|(k, texts)| texts[..if k == 2 { 2 } else { 4 }].to_vec());
        assert_eq!(judged(&job, &flags), own.collect::<Vec<_>>());

        // A count beside the path, on the way and at its end.
        let last = good.periods.len() - 1;
        for (at, kinds) in [(last / 2, 1), (last, 2)] {
            let mut beside = good.clone();
            beside.periods[at].command[0] -= COUNT;
            let text = |what: &str| format!("{what}: 1.000 um, where 0.500 um are allowed");
            let texts = [
                text("a command beside the path"),
                text("the last command beside the path's end"),
            ];
            let texts = each.map(|name| [0, 1].map(|k| format!("{name}: {}", texts[k])));
            let texts = texts.map(|own| own[..kinds].to_vec());
            assert_eq!(judged(&job, &beside), texts.concat());
        }
        // The widened path ends where it does.
        let mut short = good;
        short.periods[last].model[1] -= COUNT;
        let text = "the models beside the path's end: 1.000 um, where 0.866 um are allowed";
        let texts = ["none", "vector"].map(|name| format!("{name}: {text}"));
        assert_eq!(judged(&job, &short), texts);
    }
}
