//! A ramp: from one speed to another, without acceleration at both ends.
//!
//! ```text
//!  acceleration   ___________
//!                /|         |\        T = |Δv| / a + t_j,   way = (v1 + v2) / 2 · T
//!               / |         | \
//!            __/  |         |  \__
//!              t_j           t_j
//! ```
//!
//! Below |Δv| = a·t_j there is no time for the whole acceleration: it rises as steeply, and falls at
//! once. With t_j = 0 it is constant. With a time constant τ a is the higher speed over τ, so from
//! rest every speed is reached in the same time.

/// Acceleration and jerk time: what ramps are made with.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Slope {
    /// a: largest acceleration, above 0.
    pub acceleration: f64,
    /// τ: time from rest to any speed, but for t_j, where `acceleration` allows it; 0 for a ramp with
    /// `acceleration` to all of them.
    pub time_constant: f64,
    /// t_j: time in which it comes and goes, 0 or more.
    pub jerk_time: f64,
}

/// A ramp. Lengths and times are in the units of its speeds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ramp {
    /// The lower of its speeds.
    pub low: f64,
    /// The higher.
    pub high: f64,
    /// Time in which the acceleration rises, and in which it falls.
    pub rise: f64,
    /// Time of constant acceleration.
    pub flat: f64,
    /// That acceleration, as a magnitude.
    pub peak: f64,
}

impl Slope {
    /// The ramp between two speeds, up or down.
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
    /// Its time.
    #[must_use]
    pub fn time(&self) -> f64 {
        2.0 * self.rise + self.flat
    }

    /// Its length.
    #[must_use]
    pub fn way(&self) -> f64 {
        f64::midpoint(self.low, self.high) * self.time()
    }

    /// Change of the acceleration in time, as a magnitude; 0 where the acceleration is constant.
    #[must_use]
    pub fn jerk(&self) -> f64 {
        match self.rise > 0.0 {
            true => self.peak / self.rise,
            false => 0.0,
        }
    }

    /// How far from its slow end it has a speed that is one of its own.
    #[must_use]
    pub fn reaches(&self, speed: f64) -> f64 {
        let bend = self.peak * self.rise / 2.0;
        let (above, below) = ((speed - self.low).max(0.0), (self.high - speed).max(0.0));
        // Whole lengths of the bends: those of their speeds, and a third of what comes to them.
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
