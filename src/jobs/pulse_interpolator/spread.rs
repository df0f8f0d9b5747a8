//! How evenly the pulses of a unit time are spread over it.

use super::StepTiming;
use super::step_dir::Driver;

/// An axis as it is seen: its motor driver, which asks for nothing, and how evenly its pulses come.
#[derive(Debug, Clone)]
pub struct Paced {
    /// The driver.
    pub driver: Driver,
    /// Its pulses against an even motion.
    pub spread: Spread,
}

impl Default for Paced {
    fn default() -> Self {
        Paced {
            driver: Driver::new(StepTiming::default()),
            spread: Spread::default(),
        }
    }
}

impl Paced {
    /// Sees the lines in a tick.
    pub fn sample(&mut self, tick: u64, step: bool, dir: bool) {
        let before = self.driver.pulses();
        // The driver asks for nothing, so it has nothing to complain of.
        let _ = self.driver.sample(tick, step, dir);
        if self.driver.pulses() > before {
            self.spread.rise(tick);
        }
    }
}

/// The pulses of an axis against those of an even motion: of Y pulses in a unit time of T ticks,
/// pulse k, counted from 0, is due (2k + 1)·T/2Y ticks into it.
#[derive(Debug, Clone, Default)]
pub struct Spread {
    /// Ticks of the rising edges of the unit time under way.
    rises: Vec<u64>,
    jitter: f64,
}

impl Spread {
    /// A pulse rises.
    pub fn rise(&mut self, tick: u64) {
        self.rises.push(tick);
    }

    /// The unit time ends that began with one tick and lasted until another, which is not its own.
    pub fn unit_ends(&mut self, begun: u64, end: u64) {
        let (period, twice) = (i128::from(end - begun), 2 * self.rises.len() as i128);
        for (k, rise) in (0..).zip(self.rises.drain(..)) {
            let off = twice * i128::from(rise - begun) - (2 * k + 1) * period;
            self.jitter = self.jitter.max(off.abs() as f64 / twice as f64);
        }
    }

    /// Largest distance of a pulse from where it is due, in ticks.
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
