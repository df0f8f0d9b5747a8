//! Times of a scenario that are taken as whole numbers of periods.

use motion_rtl::settings::{WholeTime, tidy};

/// Says what is taken for a time, which is a number of `period`s and holds `place`, where that is
/// not the time itself.
pub fn rounded(time: &WholeTime, period: &str, place: &str) -> Option<String> {
    time.is_rounded().then(|| {
        let (field, periods) = (time.field, time.periods);
        let [wanted, taken, length] = [time.wanted_ms, time.ms(), time.period_ms].map(tidy);
        format!(
            "{field}: {wanted} ms taken as {taken} ms{place} ({period} of {length} ms × {periods})"
        )
    })
}
