//! Whether a run did what its table says and what its driver asks for.

use super::Job;
use super::summary::Minima;
use motion_rtl::circuits::pulse_interpolator::AXIS_NAMES;
use motion_rtl::circuits::pulse_interpolator::counts::pulses;
use motion_rtl::jobs::pulse_interpolator::job::Played;
use motion_rtl::jobs::pulse_interpolator::{Table, Word};

/// What is wrong with a run, axis by axis; empty where nothing is.
pub fn complaints(job: &Job, played: &Played) -> Vec<String> {
    let mut complaints = Vec::new();
    for (axis, name) in AXIS_NAMES.iter().enumerate().take(job.table.axes()) {
        complaints.extend(miscount(&job.table, played, axis).map(|text| format!("{name}: {text}")));
        let (demanded, ended) = (
            job.report.axes[axis].steps_demanded,
            played.axes[axis].position(),
        );
        if ended != demanded {
            complaints.push(format!(
                "{name}: {ended} steps where {demanded} are demanded"
            ));
        }
        let minima = Minima::from(played.axes[axis].minima);
        let short = minima.too_short(&job.settings.timing);
        complaints.extend(short.map(|text| format!("{name}: {text}")));
    }
    complaints
}

/// The first unit time with another count than its word makes.
pub fn miscount(table: &Table, played: &Played, axis: usize) -> Option<String> {
    let (mut before, mut tick) = (0, played.begun);
    let units = table
        .iter()
        .zip(played.positions.chunks_exact(table.axes()));
    for (unit, ((period, words), positions)) in units.enumerate() {
        let counted = i64::from(positions[axis]) - before;
        let due = count(words[axis], period);
        if counted != due {
            let n = words[axis].half_period();
            let end = tick + u64::from(period);
            let place = match played.idle_units {
                0 => format!(", ticks {tick} to {end}"),
                _ => String::new(),
            };
            return Some(format!(
                "unit time {unit}{place}: {counted} steps counted where half-period {n} and \
                 T = {period} make {due}"
            ));
        }
        before = i64::from(positions[axis]);
        tick += u64::from(period);
    }
    None
}

/// The steps that a word makes in `period` ticks.
pub fn count(word: Word, period: u32) -> i64 {
    let steps = i64::from(pulses(word.half_period(), period));
    if word.negative() { -steps } else { steps }
}
