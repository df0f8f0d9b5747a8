//! Scaling a drawing by multiplying the data in the memory (paragraph 0031).

use super::error::TableError;
use super::packed::PackedWords;
use super::words::{Table, Word};
use crate::circuits::pulse_interpolator::{AXIS_NAMES, counts::pulses};
use crate::settings::SettingError;
use serde::Serialize;

/// Ratio of two whole numbers above 0.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Ratio {
    pub num: u32,
    pub den: u32,
}

/// Scaled table.
#[derive(Debug, Clone, PartialEq)]
pub struct Scaled {
    /// Table with the unit times of the original.
    pub table: Table,
    /// Deviations of the axes, X first.
    pub axes: Vec<AxisScaling>,
}

/// Deviation of a scaled table's axis from the ideal, in which a unit of Y pulses scaled by r has
/// Y/r.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct AxisScaling {
    /// Greatest deviation in one unit, in pulses.
    #[serde(rename = "largest_deviation_pulses_per_unit")]
    pub largest_deviation: f64,
    /// Position at the end minus the ideal one, in steps.
    #[serde(rename = "drift_steps")]
    pub drift: f64,
    /// Number of units whose half-period times the ratio is not a whole number and was rounded.
    pub rounded_units: usize,
}

impl Table {
    /// Multiplies every half-period by `ratio` and leaves the unit times: the drawing becomes
    /// `1/ratio` times as large, in the same time.
    ///
    /// Half-periods are rounded to the nearest tick, to at least 1; one that reaches T gives no
    /// pulse and is stored as 0. The step and direction timing is not checked again.
    ///
    /// Since a unit's count is (T-1)/2n rounded, with r the ratio and n' the new half-period, the
    /// deviation of a unit
    /// - is at most 1/2 + 1/(2r) where n' = r·n exactly: within one pulse for r ≥ 1 (a smaller
    ///   drawing), but beyond it for r < 1, as in 1.5 pulses at r = 2/5. At k times the size
    ///   (r = 1/k) it is whole and reaches k/2 rounded down: one pulse at twice and three times;
    /// - may be larger by (T-1)/(4·r·n·n') where r·n was rounded, which has no bound of use where
    ///   the half-periods are short.
    ///
    /// So the "simply" of the text holds to one pulse per unit time for smaller drawings, and for
    /// those two or three times as large, provided that the half-periods stay whole. Deviations add
    /// up over the units: see [`AxisScaling::drift`].
    ///
    /// # Errors
    ///
    /// Returns [`TableError::Setting`] if the ratio has a 0, and [`TableError::ScaledHalfPeriod`]
    /// if a half-period below T exceeds the memory word.
    pub fn scaled(&self, ratio: Ratio) -> Result<Scaled, TableError> {
        let Ratio { num, den } = ratio;
        if num == 0 || den == 0 {
            let value = format!("{num}/{den}");
            return Err(SettingError::value("ratio", value, "both above 0").into());
        }
        let mut words = PackedWords::default();
        let mut sums = vec![Deviation::default(); self.axes];
        for (unit, (period, old)) in self.iter().enumerate() {
            for (k, word) in old.iter().enumerate() {
                let half_period = self.scale_word(ratio, period, unit, k, *word)?;
                words.push(Word::new(half_period, word.negative()));
                sums[k].add(ratio, *word, half_period, period);
            }
        }
        let per_pulse = |x: i128| x as f64 / f64::from(num);
        let axes = sums.iter().map(|sum| AxisScaling {
            largest_deviation: per_pulse(sum.largest),
            drift: per_pulse(sum.total),
            rounded_units: sum.rounded_units,
        });
        Ok(Scaled {
            axes: axes.collect(),
            table: Self {
                words,
                ..self.clone()
            },
        })
    }

    fn scale_word(
        &self,
        ratio: Ratio,
        period: u32,
        unit: usize,
        k: usize,
        word: Word,
    ) -> Result<u32, TableError> {
        if word.half_period() == 0 {
            return Ok(0);
        }
        let (num, den) = (u64::from(ratio.num), u64::from(ratio.den));
        // At most 2^63 + 2^31.
        let half_period = ((u64::from(word.half_period()) * num + den / 2) / den).max(1);
        if half_period >= u64::from(period) {
            return Ok(0);
        }
        let most = (1 << self.half_period_bits) - 1;
        u32::try_from(half_period)
            .ok()
            .filter(|&n| n <= most)
            .ok_or(TableError::ScaledHalfPeriod {
                unit,
                axis: AXIS_NAMES[k],
                half_period,
                most,
            })
    }
}

/// Sums of an axis, in pulses times the ratio's numerator, which keeps them exact.
#[derive(Debug, Clone, Copy, Default)]
struct Deviation {
    largest: i128,
    total: i128,
    rounded_units: usize,
}

impl Deviation {
    fn add(&mut self, ratio: Ratio, old: Word, half_period: u32, period: u32) {
        let before = i128::from(pulses(old.half_period(), period));
        let after = i128::from(pulses(half_period, period));
        let deviation = after * i128::from(ratio.num) - before * i128::from(ratio.den);
        self.largest = self.largest.max(deviation.abs());
        self.total += if old.negative() {
            -deviation
        } else {
            deviation
        };
        let product = u64::from(old.half_period()) * u64::from(ratio.num);
        self.rounded_units += usize::from(product % u64::from(ratio.den) != 0);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns one unit time of one axis.
    fn unit(half_period: u32, period: u32, negative: bool) -> Table {
        let mut table = Table::new(1000, 1, 16);
        table.open_unit(period).unwrap();
        table.push(Word::new(half_period, negative));
        table
    }

    fn words(table: &Table) -> Vec<Word> {
        table.words().collect()
    }

    /// Every unit time up to 160, every half-period, every ratio of small numbers: the reported
    /// deviation, compared with the bounds in the documentation.
    #[test]
    fn deviations_keep_the_stated_bounds_and_reach_beyond_one_pulse() {
        let (mut whole_shrunk, mut rounded_shrunk, mut two_fifths) = (0.0_f64, 0.0_f64, 0.0_f64);
        let mut enlarged = [0.0_f64; 7];
        for (num, den) in (1..=6).flat_map(|num| (1..=6).map(move |den| (num, den))) {
            let r = f64::from(num) / f64::from(den);
            for (period, n) in (1..=160).flat_map(|t| (1..=t).map(move |n| (t, n))) {
                let scaled = unit(n, period, false).scaled(Ratio { num, den }).unwrap();
                let axis = scaled.axes[0];
                let exact = n * num % den == 0;
                assert_eq!(axis.rounded_units, usize::from(!exact));
                assert_eq!(axis.drift.abs(), axis.largest_deviation);
                let after = scaled.table.word(0, 0).half_period();
                let counted = f64::from(pulses(after, period)) - f64::from(pulses(n, period)) / r;
                assert!((axis.drift - counted).abs() < 1e-9);
                let mut bound = 0.5 + 0.5 / r;
                if !exact {
                    let scaled_n = (f64::from(n) * r).round().max(1.0);
                    bound += f64::from(period - 1) / (4.0 * r * f64::from(n) * scaled_n);
                }
                // A half-period rounded up to 1 is off by more than half a tick.
                let clamped = 2 * n * num < den;
                assert!(
                    clamped || counted.abs() <= bound + 1e-9,
                    "{n}·{num}/{den}, T = {period}"
                );
                let largest = match (exact, num, den) {
                    (true, 1, _) => &mut enlarged[den as usize],
                    (true, 2, 5) => &mut two_fifths,
                    (true, _, _) if r > 1.0 => &mut whole_shrunk,
                    (false, _, _) if r > 1.0 => &mut rounded_shrunk,
                    _ => continue,
                };
                *largest = largest.max(counted.abs());
            }
        }
        assert!(whole_shrunk > 0.8 && whole_shrunk <= 1.0, "{whole_shrunk}");
        assert_eq!(enlarged, [0.0, 0.0, 1.0, 1.0, 2.0, 2.0, 3.0]);
        assert_eq!(two_fifths, 1.5);
        assert!(rounded_shrunk > 5.0, "{rounded_shrunk}");
    }

    #[test]
    fn direction_is_kept_and_signs_the_drift() {
        let scaled = unit(3, 10, true).scaled(Ratio { num: 3, den: 1 }).unwrap();
        // Two pulses become one; two thirds of one would be right.
        assert_eq!(words(&scaled.table), [Word::new(9, true)]);
        assert!((scaled.axes[0].drift + 1.0 / 3.0).abs() < 1e-12);
    }

    #[test]
    fn half_periods_that_leave_the_unit_or_the_word() {
        let twice = Ratio { num: 2, den: 1 };
        assert_eq!(
            words(&unit(5, 10, false).scaled(twice).unwrap().table),
            [Word::new(0, false)]
        );
        assert_eq!(
            words(&unit(0, 10, true).scaled(twice).unwrap().table),
            [Word::new(0, true)]
        );
        let error = unit(40_000, 100_000, false)
            .scaled(twice)
            .unwrap_err()
            .to_string();
        assert_eq!(
            error,
            "unit 0, x: scaled half-period 80000 is not from 1 to 65535"
        );
        let most = Ratio {
            num: u32::MAX,
            den: 1,
        };
        assert_eq!(
            words(&unit(5, 10, false).scaled(most).unwrap().table),
            [Word::new(0, false)]
        );
        assert!(unit(5, 10, false).scaled(Ratio { num: 1, den: 0 }).is_err());
    }
}
