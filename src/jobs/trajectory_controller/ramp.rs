//! Ramp from one speed to another, without acceleration at both ends.
//!
//! ```text
//!  acceleration   ___________
//!                /|         |\        T = |Δv| / a + t_j,   way = (v1 + v2) / 2 · T
//!               / |         | \
//!            __/  |         |  \__
//!              t_j           t_j
//! ```
//!
//! Below |Δv| = a·t_j there is no time for the full acceleration: it rises with the same slope,
//! and falls at once. With t_j = 0 it is constant. With a time constant τ, a is the higher speed
//! divided by τ, so from rest every speed is reached in the same time.

/// Acceleration and jerk time of ramps.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Slope {
    /// Greatest acceleration a, above 0.
    pub acceleration: f64,
    /// Time τ from rest to any speed, without t_j, if `acceleration` allows it; 0 for ramps with
    /// constant `acceleration`.
    pub time_constant: f64,
    /// Time t_j in which the acceleration rises or falls, at least 0.
    pub jerk_time: f64,
}

/// Ramp. Lengths and times are in the units of its speeds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ramp {
    /// Lower speed.
    pub low: f64,
    /// Higher speed.
    pub high: f64,
    /// Time in which the acceleration rises, and in which it falls.
    pub rise: f64,
    /// Time of constant acceleration.
    pub flat: f64,
    /// Magnitude of the constant acceleration.
    pub peak: f64,
}

impl Slope {
    /// Returns the ramp between two speeds, up or down.
    #[must_use]
    pub fn ramp(&self, one: f64, other: f64) -> Ramp {
        let (low, high) = (one.min(other), one.max(other));
        let (change, t_j) = (high - low, self.jerk_time);
        let a = match self.time_constant > 0.0 && high > 0.0 {
            true => self.acceleration.min(high / self.time_constant),
            false => self.acceleration,
        };
        let (rise, flat, peak) = match change >= a * t_j {
            true => (t_j, change / a - t_j, a),
            false => {
                let rise = (change * t_j / a).sqrt();
                (rise, 0.0, a * (rise / t_j))
            }
        };
        Ramp {
            low,
            high,
            rise,
            flat,
            peak,
        }
    }
}

impl Ramp {
    /// Returns the time of the ramp.
    #[must_use]
    pub fn time(&self) -> f64 {
        2.0 * self.rise + self.flat
    }

    /// Returns the length of the ramp.
    #[must_use]
    pub fn way(&self) -> f64 {
        f64::midpoint(self.low, self.high) * self.time()
    }

    /// Returns the magnitude of the jerk; 0 if the acceleration is constant.
    #[must_use]
    pub fn jerk(&self) -> f64 {
        match self.rise > 0.0 {
            true => self.peak / self.rise,
            false => 0.0,
        }
    }

    /// Returns the distance from its slow end at which it has a given speed of its range.
    #[must_use]
    pub fn reaches(&self, speed: f64) -> f64 {
        let bend = self.peak * self.rise / 2.0;
        let (above, below) = ((speed - self.low).max(0.0), (self.high - speed).max(0.0));
        // Full lengths of the bends: of their speeds, plus a third of the increase.
        if above < bend {
            let time = (2.0 * above / self.jerk()).sqrt();
            return (self.low + above / 3.0) * time;
        }
        if below < bend {
            let time = (2.0 * below / self.jerk()).sqrt();
            return self.way() - (self.high - below / 3.0) * time;
        }
        let time = (above - bend) / self.peak;
        let start = (self.low + bend / 3.0) * self.rise;
        match self.peak > 0.0 {
            true => start + f64::midpoint(self.low + bend, speed) * time,
            false => 0.0,
        }
    }
}
