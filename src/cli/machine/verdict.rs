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
    for end in rows::ends(ends) {
        let (position, wanted) = (end.position, end.wanted);
        if position != wanted {
            let (what, unit) = (end.what, end.unit);
            all.push(format!("{what} end at {position:?} {unit}, not {wanted:?}"));
        }
    }
    all
}
