//! Verdict on a run: its pulses against the table and the driver's timing.

use super::Job;
use motion_rtl::circuits::pulse_interpolator::AXIS_NAMES;
use motion_rtl::jobs::pulse_interpolator::Table;
use motion_rtl::jobs::pulse_interpolator::job::Played;
use motion_rtl::jobs::pulse_interpolator::positions::steps_of;

/// Returns the complaints about a run, axis by axis; empty if there are none.
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
        let short = played.axes[axis].minima.too_short(&job.settings.timing);
        complaints.extend(short.map(|text| format!("{name}: {text}")));
    }
    complaints
}

/// The first unit time with another count than its word makes.
pub fn miscount(table: &Table, played: &Played, axis: usize) -> Option<String> {
    let mut miscounts = played.positions.miscounts.iter();
    let other = miscounts.find(|other| usize::from(other.axis) == axis)?;
    let unit = other.unit as usize;
    let (mut tick, mut periods) = (played.begun, table.iter());
    let before = periods.by_ref().take(unit);
    before.for_each(|(period, _)| tick += u64::from(period));
    let (period, words) = periods.next()?;
    let due = steps_of(words[axis], period);
    let (n, counted) = (words[axis].half_period(), due + i64::from(other.steps));
    let end = tick + u64::from(period);
    let place = match played.idle_units {
        0 => format!(", ticks {tick} to {end}"),
        _ => String::new(),
    };
    Some(format!(
        "unit time {unit}{place}: {counted} steps counted where half-period {n} and \
         T = {period} make {due}"
    ))
}
