//! Whether both machines did the job.

use super::Job;
use super::rows;
use motion_rtl::machine::job::Played;
use motion_rtl::machine::measure::Ends;

/// What is wrong with the run; empty where nothing is.
pub fn complaints(job: &Job, played: &Played, ends: &Ends) -> Vec<String> {
    let mut all = Vec::new();
    if played.fault {
        all.push("fault: a circuit was late, or an encoder too fast".to_owned());
    }
    let (done, moves) = (played.moves.len(), job.program.moves.len());
    if !played.settled {
        all.push(format!(
            "the servos did not come to rest: {done} of {moves} moves"
        ));
    }
    let cut_off = steppers_cut_off(job, played);
    for end in rows::ends(ends) {
        let (position, wanted) = (end.position, end.wanted);
        let excused = cut_off && end.what == rows::STEPPERS;
        if position != wanted && !excused {
            let (what, unit) = (end.what, end.unit);
            all.push(format!("{what} end at {position:?} {unit}, not {wanted:?}"));
        }
    }
    all
}

/// Whether the run ended, by the servos' fault, before the steppers could.
pub fn steppers_cut_off(job: &Job, played: &Played) -> bool {
    !played.settled && played.ticks < job.program.table.total_ticks()
}
