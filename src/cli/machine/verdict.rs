//! Verdict on a run of both machines.

use super::Job;
use motion_rtl::jobs::machine::job::Played;
use motion_rtl::jobs::machine::measure::Ends;
use motion_rtl::jobs::machine::program::Move;

/// Returns the complaints about the run; empty if both machines did the job.
pub fn complaints(job: &Job, played: &Played, ends: &Ends) -> Vec<String> {
    let mut all = Vec::new();
    all.extend(causes(job, played));
    if !played.settled {
        all.push(restless(job, played));
    }
    let cut_off = steppers_cut_off(job, played);
    let excused = [cut_off, false, ends.motor_at_rest];
    for (end, excused) in ends.ends.iter().zip(excused) {
        let (position, wanted) = (end.position, end.wanted);
        if position != wanted && !excused {
            let (what, unit) = (end.what, end.unit);
            all.push(format!("{what} end at {position:?} {unit}, not {wanted:?}"));
        }
    }
    all
}

/// Returns the causes of a late or too fast run, with the keys behind each.
fn causes(job: &Job, played: &Played) -> Vec<String> {
    let (settings, causes) = (&job.settings, played.causes);
    let motion = &settings.motion;
    let all = [
        (
            causes.scan,
            format!(
                "the linear interpolator was late; raise scan_ticks = {}",
                settings.scan_ticks
            ),
        ),
        (
            causes.sample,
            format!(
                "the arc generator or the trajectory controller was late; raise sample_ticks = {}",
                settings.sample_ticks
            ),
        ),
        (
            causes.servo,
            format!(
                "the encoder of a servo was too fast; raise clock_hz = {}, or lower counts_per_mm = \
                 {}, feed_mm_per_min = {}, rapid_mm_per_min = {} or, where the servo swings, \
                 position_gain_per_s = {} or speed_hz = {}",
                settings.clock_hz,
                settings.counts_per_mm,
                motion.feed_mm_per_min,
                motion.rapid_mm_per_min,
                settings.position_gain_per_s,
                settings.speed_hz
            ),
        ),
        (
            causes.lift,
            format!(
                "the encoder of the pen lift was too fast; raise clock_hz = {}, or lower \
                 lift_counts_per_s = {}",
                settings.clock_hz, settings.lift_counts_per_s
            ),
        ),
    ];
    let all = all.into_iter().filter(|(seen, _)| *seen);
    all.map(|(_, text)| format!("fault: {text}")).collect()
}

/// In which move the servos did not come to rest, and what helps.
fn restless(job: &Job, played: &Played) -> String {
    let (settings, moves) = (&job.settings, &job.program.moves);
    let begun = played.moves.len();
    let place = match begun.checked_sub(1).and_then(|last| moves.get(last)) {
        None => "before their first move".to_owned(),
        Some(Move { piece, line, .. }) => format!(
            "in move {begun} of {}, of piece {piece} in line {line}",
            moves.len()
        ),
    };
    format!(
        "the servos did not come to rest {place}: at Ts = {:.3} ms the gains may be too high; lower \
         position_gain_per_s = {}, speed_hz = {} or sample_ticks = {}",
        settings.sample_s() * 1e3,
        settings.position_gain_per_s,
        settings.speed_hz,
        settings.sample_ticks
    )
}

/// Returns true if a fault of the servos ended the run before the steppers finished.
pub fn steppers_cut_off(job: &Job, played: &Played) -> bool {
    !played.settled && played.ticks < job.program.table.total_ticks()
}
