use std::fmt;

/// Femtoseconds in a second.
const FS: u64 = 1_000_000_000_000_000;

/// Reference clock of a run, and its time unit in a VCD.
///
/// The time unit is the coarsest of 100, 10 and 1 times s, ms, µs, ns, ps, fs in which both the
/// period and half the period are whole numbers. If there is none (at 3 MHz: a third of a
/// microsecond), it is 1 fs and the period is rounded to an even number of it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Clock {
    hz: u64,
    /// Half a period in time units.
    half: u64,
    /// Time unit in femtoseconds, a power of ten.
    unit: u64,
    exact: bool,
}

/// Clock rate that a VCD cannot express.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("a clock of {hz} Hz cannot be written; allowed: 1 Hz to {max} Hz", max = Clock::MAX_HZ)]
pub struct ClockError {
    /// Requested rate in Hz.
    pub hz: u64,
}

impl Default for Clock {
    /// Returns a clock of 1 MHz.
    fn default() -> Self {
        Clock {
            hz: 1_000_000,
            half: 5,
            unit: 100_000_000,
            exact: true,
        }
    }
}

impl Clock {
    /// Greatest clock rate in Hz: a period of two femtoseconds.
    pub const MAX_HZ: u64 = FS / 2;

    /// Creates a clock of `hz` periods per second.
    ///
    /// # Errors
    /// Returns an error for 0 Hz, or a period below two femtoseconds.
    pub fn from_hz(hz: u64) -> Result<Clock, ClockError> {
        if hz == 0 || hz > Self::MAX_HZ {
            return Err(ClockError { hz });
        }
        let edges = 2 * hz;
        let half = FS / edges;
        if !FS.is_multiple_of(edges) {
            let half = half + u64::from(FS % edges >= hz);
            return Ok(Clock {
                hz,
                half,
                unit: 1,
                exact: false,
            });
        }
        let mut unit = 1;
        while half.is_multiple_of(unit * 10) {
            unit *= 10;
        }
        Ok(Clock {
            hz,
            half: half / unit,
            unit,
            exact: true,
        })
    }

    /// Returns the clock rate in Hz.
    pub fn hz(self) -> u64 {
        self.hz
    }

    /// Returns the period in time units; always even.
    pub fn period(self) -> u64 {
        2 * self.half
    }

    /// True if [`period`](Clock::period) is exact, not rounded.
    pub fn is_exact(self) -> bool {
        self.exact
    }

    /// Returns the start of `tick` in time units; `None` beyond 2⁶⁴.
    pub fn rise(self, tick: u64) -> Option<u64> {
        tick.checked_mul(self.period())
    }

    /// Returns the falling edge of `clk` in `tick`, in time units; `None` beyond 2⁶⁴.
    pub fn fall(self, tick: u64) -> Option<u64> {
        self.rise(tick)?.checked_add(self.half)
    }

    /// Returns the time unit as a power of ten of a second.
    pub(super) fn exponent(self) -> i8 {
        self.unit.ilog10() as i8 - 15
    }

    /// Returns the time unit in VCD terms: a factor of 1, 10 or 100, and its unit, `s` to `fs`.
    pub fn timescale(self) -> (u32, &'static str) {
        let units = [
            (1, "fs"),
            (1_000, "ps"),
            (1_000_000, "ns"),
            (1_000_000_000, "us"),
            (1_000_000_000_000, "ms"),
            (FS, "s"),
        ];
        let mut best = (1, "fs");
        for (size, name) in units {
            if self.unit >= size {
                best = ((self.unit / size) as u32, name);
            }
        }
        best
    }
}

impl fmt::Display for Clock {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (factor, unit) = self.timescale();
        write!(
            f,
            "clk {} Hz, period {} x {factor} {unit}",
            self.hz,
            self.period()
        )?;
        if !self.exact {
            write!(f, " (rounded to an even number)")?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_unit_is_the_coarsest_that_fits() {
        let cases = [
            (1, 10, "100 ms", true),
            (1_000, 10, "100 us", true),
            (3_000_000, 333_333_334, "1 fs", false),
            (50_000_000, 2, "10 ns", true),
            (1_000_000_000, 10, "100 ps", true),
            (33_333_333, 30_000_000, "1 fs", false),
            (16_000_000, 6250, "10 ps", true),
            (Clock::MAX_HZ, 2, "1 fs", true),
        ];
        for (hz, period, unit, exact) in cases {
            let clock = Clock::from_hz(hz).unwrap();
            let (factor, name) = clock.timescale();
            assert_eq!(
                (clock.period(), format!("{factor} {name}"), clock.is_exact()),
                (period, unit.to_owned(), exact),
                "{hz} Hz"
            );
        }
    }

    #[test]
    fn rates_without_a_period_are_refused() {
        for hz in [0, Clock::MAX_HZ + 1, u64::MAX] {
            assert_eq!(Clock::from_hz(hz), Err(ClockError { hz }));
        }
    }

    #[test]
    fn time_does_not_wrap() {
        let clock = Clock::from_hz(50_000_000).unwrap();
        assert_eq!(clock.rise(3), Some(6));
        assert_eq!(clock.fall(3), Some(7));
        assert_eq!(clock.rise(u64::MAX), None);
    }
}
