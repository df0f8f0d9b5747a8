//! Verdict on a run: its result against its targets.

use super::Job;
use super::runs::Runs;
use crate::cli::report::first;
use motion_rtl::circuits::linear_interpolator::Rule;
use motion_rtl::jobs::linear_interpolator::measure::{Played, Segment};
use motion_rtl::jobs::linear_interpolator::settings::AXIS_NAMES;
use motion_rtl::jobs::linear_interpolator::targets::Target;
use motion_rtl::jobs::linear_interpolator::ways::Way;

/// Returns the complaints about a run; empty if it met its targets.
pub fn complaints(job: &Job, runs: &Runs) -> Vec<String> {
    let targets = &job.compiled.targets;
    let rule = Some(job.settings.rule);
    let mut all = of_system(
        &runs.interpolator.played,
        &runs.interpolator.segments,
        targets,
        rule,
    );
    if let (Some(run), Some(other)) = (&runs.other, &job.other) {
        let texts = of_system(&run.played, &run.segments, targets, rule);
        let name = other.settings.master.name();
        all.extend(
            texts
                .into_iter()
                .map(|text| format!("master {name}: {text}")),
        );
    }
    // A bent path is no fault of the conventional system: the comparison is there to show it.
    let ways = Way::ALL.iter().zip(runs.conventional.iter().flatten());
    for (way, run) in ways {
        let texts = of_system(&run.played, &run.segments, targets, None);
        let name = way.name();
        all.extend(
            texts
                .into_iter()
                .map(|text| format!("conventional, {name}: {text}")),
        );
    }
    all
}

fn of_system(
    played: &Played,
    segments: &[Segment],
    targets: &[Target],
    rule: Option<Rule>,
) -> Vec<String> {
    let mut complaints = Vec::new();
    if played.cycles.len() != targets.len() {
        complaints.push(format!(
            "{} cycles where there are {} targets",
            played.cycles.len(),
            targets.len()
        ));
    }
    let ends = |target: &Target| [target.x, target.y];
    let pairs = played.cycles.iter().zip(targets).enumerate();
    let astray = pairs.filter(|(_, (cycle, target))| cycle.to != ends(target));
    complaints.extend(first(astray.map(|(number, (cycle, target))| {
        let (to, wanted) = (cycle.to, ends(target));
        format!("segment {number} goes to {to:?}, its target is {wanted:?}")
    })));
    let numbered = segments.iter().enumerate();
    let missed = numbered
        .clone()
        .filter(|(_, segment)| segment.end_error != [0; 2]);
    complaints.extend(first(missed.map(|(number, segment)| {
        let error = segment.end_error;
        format!("segment {number} ends {error:?} counts off its target")
    })));
    if let Some(rule) = rule {
        let bent = numbered.filter(|(_, segment)| !segment.deviation.is_within(rule));
        complaints.extend(first(bent.map(|(number, segment)| {
            let (lsb, rule) = (segment.deviation.lsb(), rule.name());
            format!("segment {number} is {lsb:.3} LSB off its line, which {rule} does not allow")
        })));
    }
    if played.late {
        complaints.push("a scan came before the command of the one before was ready".into());
    }
    for (axis, name) in AXIS_NAMES.iter().enumerate() {
        if played.lost[axis] {
            complaints.push(format!("{name}: the feedback counter lost counts"));
        }
    }
    if played.unsettled {
        complaints.push("an axis did not come into position".into());
    }
    if played.refused > 0 {
        complaints.push(format!("{} targets were too far away", played.refused));
    }
    complaints
}

#[cfg(test)]
mod tests {
    use super::*;
    use motion_rtl::jobs::linear_interpolator::measure::{Cycle, ScanRecord};
    use motion_rtl::jobs::linear_interpolator::profile::Profile;

    fn target(x: i64, y: i64) -> Target {
        Target {
            x,
            y,
            profiles: [Profile {
                speed: 1,
                acceleration_scans: 1,
                deceleration_scans: 1,
            }],
            feed_mm_per_min: 1.0,
            line: 1,
            rapid: false,
        }
    }

    /// A cycle from the origin to (4, 2) through these commands.
    fn played(commands: &[[i64; 2]]) -> Played {
        let record = |(scan, command): (usize, &[i64; 2])| ScanRecord {
            tick: scan as u64,
            command: *command,
            motor: [0.0; 2],
        };
        Played {
            records: commands.iter().enumerate().map(record).collect(),
            cycles: vec![Cycle {
                from: [0, 0],
                to: [4, 2],
                master: 0,
                scans: 0..commands.len(),
                end: *commands.last().unwrap(),
            }],
            ..Played::default()
        }
    }

    fn complaints(played: &Played, rule: Rule) -> Vec<String> {
        let segments = played.segments([1.0; 2]);
        of_system(played, &segments, &[target(4, 2)], Some(rule))
    }

    #[test]
    fn every_kind_is_complained_of() {
        let good = played(&[[1, 0], [2, 1], [3, 1], [4, 2]]);
        assert_eq!(complaints(&good, Rule::Floor), [""; 0]);
        assert_eq!(complaints(&good, Rule::Centred), [""; 0]);

        let off = played(&[[2, 2], [4, 2]]);
        assert_eq!(
            complaints(&off, Rule::Floor),
            ["segment 0 is 1.000 LSB off its line, which floor does not allow"]
        );
        let short = played(&[[2, 1], [3, 1]]);
        assert_eq!(
            complaints(&short, Rule::Floor),
            ["segment 0 ends [-1, -1] counts off its target"]
        );
        let bad = Played {
            late: true,
            refused: 3,
            unsettled: true,
            lost: [false, true],
            ..good.clone()
        };
        assert_eq!(
            complaints(&bad, Rule::Floor),
            [
                "a scan came before the command of the one before was ready",
                "y: the feedback counter lost counts",
                "an axis did not come into position",
                "3 targets were too far away",
            ]
        );
        let segments = good.segments([1.0; 2]);
        assert_eq!(
            of_system(&good, &segments, &[target(4, 3), target(0, 0)], None),
            [
                "1 cycles where there are 2 targets",
                "segment 0 goes to [4, 2], its target is [4, 3]",
            ]
        );
        // The conventional system may be off its line.
        let segments = off.segments([1.0; 2]);
        let free = of_system(&off, &segments, &[target(4, 2)], None);
        assert_eq!(free, [""; 0]);
    }
}
