//! Search for a unit time with which every demand of a path is attainable.

use super::compile::{compile_plan, units_needed};
use super::count_table::{PulseLimits, choose_half_period};
use super::demand::Demands;
use super::error::TableError;
use super::report::Remedy;
use super::settings::Settings;
use super::words::MAX_UNITS;
use crate::plan::Plan;

/// Number of units examined before the search stops.
const WORK: u64 = 30_000_000;

/// Returns the greatest unit time, for lines and arcs alike and below the longer one set, with
/// which every demand is attainable.
///
/// Fewer ticks mean fewer steps per unit, but the possible counts are not monotonic, so the search
/// goes down one by one. It costs little, since a unit where one unit time fails usually fails for
/// the next one too.
pub(super) fn find(plan: &Plan<'_>, settings: &Settings) -> Result<Option<Remedy>, TableError> {
    let mut search = Search {
        demands: Demands::new(plan, settings),
        axes: settings.steps_per_mm.len(),
        limits: settings.pulse_limits(),
        last_failure: 0,
        work: 0,
    };
    let mut period = settings.line_unit_ticks.max(settings.arc_unit_ticks);
    if settings.line_unit_ticks == settings.arc_unit_ticks {
        period -= 1;
    }
    loop {
        let candidate = settings.with_period(period);
        if candidate.validate().is_err() || units_needed(plan, &candidate) > MAX_UNITS as f64 {
            return Ok(None);
        }
        let largest = search.work < WORK;
        if search.all_attainable(period)? && compiles_cleanly(plan, &candidate)? {
            return Ok(Some(Remedy { period, largest }));
        }
        period -= if largest { 1 } else { period.div_ceil(16) };
    }
}

fn compiles_cleanly(plan: &Plan<'_>, settings: &Settings) -> Result<bool, TableError> {
    match compile_plan(plan, settings) {
        Ok((_, report)) => Ok(report.unattainable_units == 0),
        Err(TableError::TooLong { .. }) => Ok(false),
        Err(error) => Err(error),
    }
}

struct Search<'p, 'd> {
    demands: Demands<'p, 'd>,
    axes: usize,
    limits: PulseLimits,
    /// Position at which the last unit time failed, in ticks.
    last_failure: u64,
    work: u64,
}

impl Search<'_, '_> {
    /// Examines every unit, beginning shortly before the last failure.
    fn all_attainable(&mut self, period: u32) -> Result<bool, TableError> {
        let first = (self.last_failure / u64::from(period)).saturating_sub(8);
        let ticks = |unit: u64| unit * u64::from(period);
        let mut here = self.demands.at(ticks(first))?;
        let mut unit = first;
        let mut wrapped = false;
        while !(wrapped && unit >= first) {
            if self.demands.ended(ticks(unit)) {
                if wrapped || first == 0 {
                    break;
                }
                (unit, wrapped) = (0, true);
                here = self.demands.at(0)?;
            }
            let next = self.demands.at(ticks(unit + 1))?;
            self.work += 1;
            for k in 0..self.axes {
                let count = (next.rounded(k) - here.rounded(k)).unsigned_abs() as u32;
                if choose_half_period(count, period, &self.limits).is_none() {
                    self.last_failure = ticks(unit);
                    return Ok(false);
                }
            }
            here = next;
            unit += 1;
        }
        Ok(true)
    }
}
