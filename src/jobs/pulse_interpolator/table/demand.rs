//! Path in steps: the border between millimetres and the interpolator's counts.

use super::error::TableError;
use super::settings::Settings;
use crate::input::{COORDINATES, Point};
use crate::plan::{Plan, Sampler};
use fixed::types::I48F16;

/// Position in steps. Sixteen fraction bits are coarser than the rounding noise of the path's
/// floating-point numbers, so that an axis at rest on half a step does not flicker.
pub(super) type Steps = I48F16;

/// Names of the axes.
pub(super) const AXES: [&str; COORDINATES] = ["X", "Y", "Z"];

/// Demanded positions at a time.
#[derive(Debug, Clone, Copy)]
pub(super) struct Demand {
    /// Position per axis; 0 for axes that are not driven.
    pub(super) steps: [Steps; COORDINATES],
    /// True if the current move is an arc.
    pub(super) arc: bool,
    /// True if the current move is rapid.
    pub(super) rapid: bool,
    /// Current line of the input.
    pub(super) line: usize,
}

impl Demand {
    /// Returns the nearest whole step, which fits 32 bits.
    pub(super) fn rounded(&self, axis: usize) -> i64 {
        self.steps[axis].round().to_num()
    }
}

/// Demand over time in ticks.
#[derive(Debug)]
pub(super) struct Demands<'p, 'd> {
    sampler: Sampler<'p, 'd>,
    steps_per_mm: Vec<f64>,
    duration_s: f64,
    clock_hz: f64,
}

impl<'p, 'd> Demands<'p, 'd> {
    pub(super) fn new(plan: &'p Plan<'d>, settings: &Settings) -> Self {
        Self {
            sampler: plan.sampler(),
            steps_per_mm: settings.steps_per_mm.clone(),
            duration_s: plan.duration_s(),
            clock_hz: settings.clock_hz as f64,
        }
    }

    /// Converts ticks to seconds.
    pub(super) fn seconds(&self, ticks: u64) -> f64 {
        ticks as f64 / self.clock_hz
    }

    /// True if the path has ended.
    pub(super) fn ended(&self, ticks: u64) -> bool {
        self.seconds(ticks) >= self.duration_s
    }

    /// Returns the demand after `ticks` ticks; from the path's end on exactly the end.
    pub(super) fn at(&mut self, ticks: u64) -> Result<Demand, TableError> {
        self.at_time(self.seconds(ticks))
    }

    /// Finds the times within a span at which a coordinate may stop or reverse.
    pub(super) fn turns(&mut self, span_s: [f64; 2], turns: &mut Vec<f64>) {
        self.sampler.turns(span_s, turns);
    }

    pub(super) fn at_time(&mut self, time_s: f64) -> Result<Demand, TableError> {
        let sample = self.sampler.at(time_s);
        Ok(Demand {
            steps: self.convert(sample.position, sample.line)?,
            arc: sample.arc,
            rapid: sample.rapid,
            line: sample.line,
        })
    }

    fn convert(&self, position: Point, line: usize) -> Result<[Steps; COORDINATES], TableError> {
        let mut all = [Steps::ZERO; COORDINATES];
        for (axis, scale) in self.steps_per_mm.iter().enumerate() {
            let steps = position[axis] * scale;
            all[axis] = nearest(steps).ok_or(TableError::Position {
                line,
                axis: AXES[axis],
                steps,
            })?;
        }
        Ok(all)
    }
}

/// Returns the position nearest to `steps`, if it rounds to a step that fits 32 bits.
fn nearest(steps: f64) -> Option<Steps> {
    // Same result as `from_num`, but faster: a long path needs millions of conversions.
    if steps.abs() < f64::from(i32::MAX) {
        let parts = steps * f64::from(1_u32 << Steps::FRAC_NBITS);
        return Some(Steps::from_bits(parts.round_ties_even() as i64));
    }
    let fits = |steps: &Steps| {
        let round = steps.checked_round();
        round
            .and_then(|round| round.checked_to_num::<i32>())
            .is_some()
    };
    Steps::checked_from_num(steps).filter(fits)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn the_nearest_is_that_of_the_crate(
            steps in prop_oneof![-2.2e9..2.2e9, -2.0..2.0, -1e-4..1e-4],
            half in any::<i32>(),
        ) {
            // Halves of the least part, which are rounded to even.
            for steps in [steps, f64::from(half) / 131_072.0] {
                let fits = steps.round().abs() <= f64::from(i32::MAX) || steps.round() == f64::from(i32::MIN);
                prop_assert_eq!(nearest(steps), fits.then(|| Steps::from_num(steps)));
            }
        }
    }

    #[test]
    fn what_does_not_fit_is_none() {
        let most = f64::from(i32::MAX);
        assert_eq!(nearest(most), Some(Steps::from_num(most)));
        assert_eq!(nearest(most + 0.25), Some(Steps::from_num(most + 0.25)));
        assert_eq!(nearest(most + 0.75), None);
        assert_eq!(nearest(-most - 1.25), Some(Steps::from_num(-most - 1.25)));
        assert_eq!(nearest(-most - 2.0), None);
        assert_eq!(nearest(f64::NAN), None);
        assert_eq!(nearest(f64::INFINITY), None);
    }
}
