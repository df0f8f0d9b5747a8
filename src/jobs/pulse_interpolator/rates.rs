//! Step rates of a table, and their jumps between unit times.

use super::Table;
use crate::circuits::pulse_interpolator::counts::pulses;
use serde::Serialize;

/// Step rates of an axis in steps per second.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct StepRates {
    /// Greatest rate.
    #[serde(rename = "largest_per_s")]
    pub largest: f64,
    /// Greatest change from one unit time to the next; the axis is at rest before the first and
    /// after the last.
    #[serde(rename = "change_per_s")]
    pub change: f64,
    /// Unit time that begins with that change: the number of units for the change at the end.
    pub change_unit: usize,
}

/// Returns the step rates of each axis: in a unit time with pulses, the clock divided by twice the
/// half-period.
#[must_use]
pub fn step_rates(table: &Table) -> Vec<StepRates> {
    let (mut rates, mut last) = (
        vec![StepRates::default(); table.axes()],
        vec![0.0; table.axes()],
    );
    let mut change = |axis: usize, unit: usize, rate: f64| {
        let of = &mut rates[axis];
        of.largest = of.largest.max(rate.abs());
        let change = (rate - std::mem::replace(&mut last[axis], rate)).abs();
        if change > of.change {
            (of.change, of.change_unit) = (change, unit);
        }
    };
    for (unit, (period, words)) in table.iter().enumerate() {
        for (axis, word) in words.iter().enumerate() {
            let half = word.half_period();
            let rate = match pulses(half, period) {
                0 => 0.0,
                _ => table.clock_hz() as f64 / (2.0 * f64::from(half)),
            };
            change(axis, unit, if word.negative() { -rate } else { rate });
        }
    }
    for axis in 0..table.axes() {
        change(axis, table.units(), 0.0);
    }
    rates
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::jobs::pulse_interpolator::table::read::read;

    fn rates(rows: &str) -> Vec<StepRates> {
        let head = "unit,period_ticks,x_half_period_ticks,x_down,y_half_period_ticks,y_down\n";
        step_rates(&read("t.csv", &format!("{head}{rows}"), 100_000).unwrap())
    }

    #[test]
    fn rates_and_their_changes_are_signed_and_counted_from_rest() {
        // 500, 1000 up, 1000 down, none; Y reverses from 2500, its greatest change.
        let rows = "0,500,100,0,20,0\n1,500,50,0,20,1\n2,500,50,1,20,1\n3,500,0,0,20,1\n";
        let [x, y] = rates(rows)[..] else {
            panic!("two axes");
        };
        let expected = |largest, change, change_unit| StepRates {
            largest,
            change,
            change_unit,
        };
        assert_eq!(x, expected(1000.0, 2000.0, 2));
        assert_eq!(y, expected(2500.0, 5000.0, 1));
        // The greatest rate may be backwards.
        let [x, _] = rates("0,500,100,0,0,0\n1,500,50,1,0,0\n")[..] else {
            panic!("two axes");
        };
        assert_eq!(x, expected(1000.0, 1500.0, 1));
        // The end is a change too: to rest, from a rate that was reached in two changes.
        assert_eq!(
            rates("0,500,100,0,0,0\n1,500,50,0,0,0\n"),
            [expected(1000.0, 1000.0, 2), expected(0.0, 0.0, 0)]
        );
    }

    #[test]
    fn a_word_that_makes_no_pulse_is_no_rate() {
        // A half-period equal to T gives no pulse.
        let [x, y] = rates("0,500,500,0,499,0\n")[..] else {
            panic!("two axes");
        };
        assert_eq!(x, StepRates::default());
        assert_eq!(y.largest.to_bits(), (1e5f64 / 998.0).to_bits());
    }
}
