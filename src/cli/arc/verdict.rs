//! Verdict on a run: its commands against the path.

use super::Job;
use super::figures::Figures;
use motion_rtl::circuits::arc_generator::Widths;
use motion_rtl::jobs::arc_generator::job::Played;

/// Returns the complaints about a run; empty if there are none.
pub fn complaints(job: &Job, played: &Played, figures: &Figures) -> Vec<String> {
    let mut all = Vec::new();
    if played.late {
        all.push("a sampling time began before its point was ready".to_owned());
    }
    if played.starved {
        all.push("the path ended in motion".to_owned());
    }
    let (sampled, wanted) = (played.samples, job.prepared.samples());
    if sampled != wanted {
        all.push(format!("{sampled} samples where the path has {wanted}"));
        return all;
    }
    all.extend(end(job, played));
    for arc in figures.measured.iter().flat_map(|own| &own.arcs) {
        let [least, most] = arc.radius_error_um;
        let (error, bound) = (most.max(-least), arc.bound_um);
        if error > bound {
            let piece = arc.piece;
            all.push(format!(
                "piece {piece}: the radius is {error:.3} um off, its bound is {bound:.3} um"
            ));
        }
    }
    all.extend(figures.astray.clone());
    let both = [
        (&figures.beside, "by the conventional method"),
        (&figures.even, "by the conventional method without ramps"),
    ];
    all.extend(both.iter().flat_map(|(beside, how)| beside.complaints(how)));
    all
}

/// Checks that the last command is the end of the path, rounded to guard units and then to counts.
fn end(job: &Job, played: &Played) -> Option<String> {
    let (last, piece) = (played.last?, job.prepared.pieces.last()?);
    let wanted = piece.to.map(|mm| mm * job.settings.counts_per_mm);
    let tolerance = 0.5 + (-(Widths::FULL.guard() as f64)).exp2();
    let mut pairs = last.counts.iter().zip(wanted);
    // Written so that NaN fails.
    let exact = pairs.all(|(counts, wanted)| (*counts as f64 - wanted).abs() <= tolerance);
    let counts = last.counts;
    (!exact).then(|| format!("ends at {counts:?} counts, the path at {wanted:.3?}"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cli::arc::figures::UnderWay;
    use crate::cli::source::{Input, Source};
    use motion_rtl::jobs::arc_generator::job::Command;
    use motion_rtl::jobs::arc_generator::reference;
    use motion_rtl::scenario::Scenario;

    /// The weld seam that ships, and what its records say.
    fn seam() -> (Job, Played) {
        let input = Input {
            input: Some("waves/weld.toml".into()),
            ..Input::default()
        };
        let source = Source::read(&input).unwrap();
        let Scenario::ArcGenerator(scenario) = source.loaded.scenario.clone() else {
            panic!("another circuit");
        };
        let job = Job::prepare(source, scenario.settings).unwrap();
        let commands = reference::commands(&job.records, &Widths::FULL, job.settings.rounding);
        let commands = commands.into_iter().zip(0..);
        let commands = commands.map(|(counts, tick)| Command { tick, counts });
        let played = Played {
            commands: commands.collect(),
            ..Played::default()
        };
        (job, played)
    }

    fn judged(job: &Job, played: &Played) -> Vec<String> {
        let mut under_way = UnderWay::new(job);
        let commands = &played.commands;
        commands.iter().for_each(|command| under_way.take(*command));
        let played = Played {
            samples: commands.len() as u64,
            last: commands.last().copied(),
            ..played.clone()
        };
        let figures = under_way.finish();
        complaints(job, &played, &figures)
    }

    #[test]
    fn every_kind_is_complained_of() {
        let (job, good) = seam();
        assert_eq!(judged(&job, &good), [""; 0]);
        let flags = Played {
            late: true,
            starved: true,
            ..good.clone()
        };
        assert_eq!(
            judged(&job, &flags),
            [
                "a sampling time began before its point was ready",
                "the path ended in motion"
            ]
        );
        let samples = good.commands.len();
        let mut short = good.clone();
        short.commands.pop();
        let text = format!("{} samples where the path has {samples}", samples - 1);
        assert_eq!(judged(&job, &short), [text]);

        // A count beside the end is also farther off than rounding.
        let mut beside = good.clone();
        beside.commands[samples - 1].counts[2] += 1;
        assert_eq!(
            judged(&job, &beside),
            [
                "ends at [3648000, 1864000, 2640001] counts, the path at [3648000.000, \
                 1864000.000, 2640000.000]"
                    .to_owned(),
                format!(
                    "sample {} is 0.100 um off its exact point, its bound is 0.087 um",
                    samples - 1
                ),
            ]
        );
        // Two counts outwards, and two across the plane, which no radius shows.
        for (by, radius) in [([0, 0, -2], true), ([1, 1, 2], false)] {
            let mut off = good.clone();
            let counts = &mut off.commands[700].counts;
            *counts = std::array::from_fn(|k| counts[k] + by[k]);
            let texts = judged(&job, &off);
            let kinds = ["piece 0: the radius is 0.", "sample 700 is 0."];
            let kinds = &kinds[usize::from(!radius)..];
            assert_eq!(texts.len(), kinds.len(), "{texts:?}");
            for (text, kind) in texts.iter().zip(kinds) {
                assert!(text.starts_with(kind), "{text}");
            }
        }
        let mut many = good;
        for command in &mut many.commands[100..110] {
            command.counts[0] += 5;
        }
        let texts = judged(&job, &many);
        assert!(
            texts.last().unwrap().ends_with(" (and 9 more like it)"),
            "{texts:?}"
        );
    }
}
