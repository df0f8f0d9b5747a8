//! Uniformity of the pulses over a unit time.

use super::StepTiming;
use super::step_dir::Driver;

/// Observed axis: a motor driver without requirements, and the uniformity of its pulses.
#[derive(Debug, Clone)]
pub struct Paced {
    pub driver: Driver,
    /// Pulses compared with uniform motion.
    pub spread: Spread,
}

impl Default for Paced {
    fn default() -> Self {
        Paced {
            driver: Driver::new(StepTiming::NONE),
            spread: Spread::default(),
        }
    }
}

impl Paced {
    /// Observes the lines in a tick.
    pub fn sample(&mut self, tick: u64, step: bool, dir: bool) {
        let before = self.driver.pulses();
        // The driver has no requirements, so it reports no error.
        let _ = self.driver.sample(tick, step, dir);
        if self.driver.pulses() > before {
            self.spread.rise(tick);
        }
    }
}

/// Pulses of an axis compared with uniform motion: of Y pulses in a unit time of T ticks, pulse k,
/// counted from 0, is due (2k + 1)·T/2Y ticks into it.
#[derive(Debug, Clone, Default)]
pub struct Spread {
    /// Ticks of the rising edges in the current unit time.
    rises: Vec<u64>,
    jitter: f64,
}

impl Spread {
    /// Records a rising edge.
    pub fn rise(&mut self, tick: u64) {
        self.rises.push(tick);
    }

    /// Ends the unit time from tick `begun` to before tick `end`.
    pub fn unit_ends(&mut self, begun: u64, end: u64) {
        let (period, twice) = (i128::from(end - begun), 2 * self.rises.len() as i128);
        for (k, rise) in (0..).zip(self.rises.drain(..)) {
            let off = twice * i128::from(rise - begun) - (2 * k + 1) * period;
            self.jitter = self.jitter.max(off.abs() as f64 / twice as f64);
        }
    }

    /// Returns the greatest distance of a pulse from its due time, in ticks.
    #[must_use]
    pub fn jitter(&self) -> f64 {
        self.jitter
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pulse_is_held_against_an_even_motion_through_its_unit_time() {
        let mut spread = Spread::default();
        // Two in 20 ticks are due after 5 and 15.
        for (rises, jitter) in [
            (&[105, 115][..], 0.0),
            (&[104, 113], 2.0),
            (&[], 2.0),
            // Three are due after 3 1/3, 10 and 16 2/3.
            (&[103, 109, 115], 2.0),
            (&[103, 109, 114], 20.0 * 5.0 / 6.0 - 14.0),
            (&[119], 9.0),
        ] {
            rises.iter().for_each(|rise| spread.rise(*rise));
            spread.unit_ends(100, 120);
            assert!((spread.jitter() - jitter).abs() < 1e-12, "{rises:?}");
        }
    }
}
