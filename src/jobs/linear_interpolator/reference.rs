//! Reference model: the ideal formulas as a plain program, with which the circuit is compared.
//!
//! Positions come from closed forms in integers. Nothing is accumulated, so that a fault of the
//! circuit's accumulators cannot be repeated here. The motors are of first order.

use super::measure::{Cycle, Played, ScanRecord};
use super::profile::{Profile, SPEED_ONE};
use super::settings::{AxisSettings, Settings};
use super::targets::Target;
use crate::circuits::linear_interpolator::{MasterAxis, Rule};

/// Position pattern generator 14: x(n) of one cycle.
///
/// In units of Δ/W the position grows by (2k − 1)·Td in scan k of the acceleration, by 2·Ta·Td in
/// each of the Tc steady scans, and by (2k − 1)·Ta in scan k from the end of the deceleration;
/// their sum is W = Ta·Td·(Ta + 2·Tc + Td).
#[derive(Debug, Clone)]
pub struct Pattern {
    from: i64,
    distance: i128,
    acceleration: i128,
    steady: i128,
    deceleration: i128,
    /// Number of scans so far.
    scan: i128,
    stop: Option<Stop>,
}

/// Deceleration started by an abort.
#[derive(Debug, Clone, Copy)]
struct Stop {
    /// Scan after which it came.
    scan: i128,
    /// Distance at that time.
    way: i128,
    /// Speed at that time.
    level: i128,
}

impl Pattern {
    /// Creates a cycle of `distance` from `from`; a speed and times of 0 count as 1.
    #[must_use]
    pub fn new(from: i64, distance: i64, profile: &Profile) -> Self {
        let distance = i128::from(distance);
        let speed = i128::from(profile.speed.max(1));
        let acceleration = i128::from(profile.acceleration_scans.max(1));
        let deceleration = i128::from(profile.deceleration_scans.max(1));
        let twice = 2 * distance.abs() * i128::from(SPEED_ONE);
        let rest = twice - speed * (acceleration + deceleration);
        let steady = match rest > 0 {
            true => (rest + 2 * speed - 1) / (2 * speed),
            false => 0,
        };
        let steady = steady.min(i128::from(i32::MAX));
        Pattern {
            from,
            distance,
            acceleration,
            steady,
            deceleration,
            scan: 0,
            stop: None,
        }
    }

    /// Returns the number of scans from start to end, including an abort.
    #[must_use]
    pub fn scans(&self) -> i128 {
        match (self.distance, self.stop) {
            (0, _) => 0,
            (_, None) => self.acceleration + self.steady + self.deceleration,
            (_, Some(stop)) => {
                let step = 2 * self.acceleration;
                stop.scan + (stop.level + step - 1) / step
            }
        }
    }

    /// True if more positions follow.
    #[must_use]
    pub fn is_active(&self) -> bool {
        self.scan < self.scans()
    }

    /// Returns the next position; `None` after the end of the cycle.
    pub fn advance(&mut self) -> Option<i64> {
        if !self.is_active() {
            return None;
        }
        self.scan += 1;
        Some(self.position())
    }

    /// Returns the position after the scans so far.
    #[must_use]
    pub fn position(&self) -> i64 {
        let (ta, tc, td) = (self.acceleration, self.steady, self.deceleration);
        let whole = ta * td * (ta + 2 * tc + td);
        let way = self.distance.abs() * self.way(self.scan) / whole;
        self.from + (self.distance.signum() * way) as i64
    }

    /// Decelerates from the current speed to rest, along the same line.
    pub fn abort(&mut self) {
        if self.is_active() && self.stop.is_none() {
            self.stop = Some(Stop {
                scan: self.scan,
                way: self.way(self.scan),
                level: self.level(self.scan),
            });
        }
    }

    /// Returns the speed at the end of a scan, without an abort.
    fn level(&self, scan: i128) -> i128 {
        let (ta, tc, td) = (self.acceleration, self.steady, self.deceleration);
        let left = ta + tc + td - scan;
        (2 * td * scan).min(2 * ta * td).min(2 * ta * left)
    }

    /// Returns the distance at the end of a scan, in units of Δ/W.
    fn way(&self, scan: i128) -> i128 {
        let (ta, tc, td) = (self.acceleration, self.steady, self.deceleration);
        if let Some(stop) = self.stop {
            let (since, whole) = (scan - stop.scan, stop.level / (2 * ta));
            let steps = since.min(whole);
            let rest = stop.level - 2 * ta * whole;
            let last = if since > whole { rest / 2 } else { 0 };
            return stop.way + steps * stop.level - steps * steps * ta + last;
        }
        let left = ta + tc + td - scan;
        if scan <= ta {
            scan * scan * td
        } else if left >= td {
            ta * ta * td + 2 * ta * td * (scan - ta)
        } else {
            ta * td * (ta + 2 * tc + td) - left * left * ta
        }
    }
}

/// Integrator 24: distance of the slave axis from that of the master axis.
#[derive(Debug, Clone)]
pub struct Integrator {
    rule: Rule,
    master: i128,
    slave: i128,
    travelled: i128,
}

impl Integrator {
    /// Creates a cycle with the distances of the master axis, which is not 0, and the slave axis.
    #[must_use]
    pub fn new(rule: Rule, master: i64, slave: i64) -> Self {
        Integrator {
            rule,
            master: master.into(),
            slave: slave.into(),
            travelled: 0,
        }
    }

    /// Returns the slave's increment for an increment of the master axis.
    pub fn advance(&mut self, increment: i64) -> i64 {
        let before = self.way();
        self.travelled += i128::from(increment);
        (self.way() - before) as i64
    }

    /// Returns the slave's distance since the cycle began: Δs·(m − m0)/Δm, rounded.
    fn way(&self) -> i128 {
        let sign = if self.master < 0 { -1 } else { 1 };
        let (product, divisor) = (sign * self.slave * self.travelled, sign * self.master);
        match (self.rule, divisor) {
            (_, 0) => 0,
            (Rule::Floor, _) => product.div_euclid(divisor),
            (Rule::Truncating, _) => product / divisor,
            (Rule::Centred, _) => (product + divisor / 2).div_euclid(divisor),
        }
    }
}

/// Commands of one cycle.
enum Commands {
    Interpolated {
        pattern: Pattern,
        integrator: Integrator,
        master: usize,
    },
    Separate([Pattern; 2]),
}

impl Commands {
    /// Creates the commands. With one setting the master axis has a pattern and the slave axis the
    /// integrator (Figs 5 and 6); with two each axis has a pattern (Fig. 3, ¶0005).
    fn new<const N: usize>(
        settings: &Settings,
        from: [i64; 2],
        target: &Target<N>,
    ) -> (Self, usize) {
        let delta = [target.x - from[0], target.y - from[1]];
        let leads = match N {
            1 => settings.master,
            _ => MasterAxis::Longer,
        };
        let master = leads.of(delta);
        let pattern = |axis: usize, profile| Pattern::new(from[axis], delta[axis], profile);
        let commands = match target.profiles.as_slice() {
            [x, y] => Commands::Separate([pattern(0, x), pattern(1, y)]),
            profiles => Commands::Interpolated {
                pattern: pattern(master, &profiles[0]),
                integrator: Integrator::new(settings.rule, delta[master], delta[1 - master]),
                master,
            },
        };
        (commands, master)
    }

    /// Returns the next command after `at`; `None` after the end of the cycle.
    fn advance(&mut self, at: [i64; 2]) -> Option<[i64; 2]> {
        let mut to = at;
        match self {
            Commands::Interpolated {
                pattern,
                integrator,
                master,
            } => {
                to[*master] = pattern.advance()?;
                to[1 - *master] += integrator.advance(to[*master] - at[*master]);
            }
            Commands::Separate(patterns) => {
                if !patterns.iter().any(Pattern::is_active) {
                    return None;
                }
                for (to, pattern) in to.iter_mut().zip(patterns) {
                    *to = pattern.advance().unwrap_or(*to);
                }
            }
        }
        Some(to)
    }
}

/// Position loop, driver and motor of one axis.
#[derive(Debug, Clone, Copy, Default)]
struct Motor {
    /// Position in counts.
    position: f64,
    /// Speed in counts per second.
    speed: f64,
    saturated_scans: u64,
}

impl Motor {
    /// Advances by a scan of `seconds` under its command; the speed follows with a lag.
    fn advance(&mut self, axis: &AxisSettings, command: i64, seconds: f64) {
        let most = axis.rated_counts_per_s();
        let wanted = axis.position_gain_per_s * self.error(command) as f64;
        self.saturated_scans += u64::from(wanted.abs() > most);
        let wanted = wanted.clamp(-most, most);
        let lag = axis.velocity_loop_ms / 1e3;
        let left = (-seconds / lag).exp();
        let missing = self.speed - wanted;
        self.position += wanted * seconds + missing * lag * (1.0 - left);
        self.speed = wanted + missing * left;
    }

    /// Returns the command minus the count of the encoder.
    fn error(&self, command: i64) -> i64 {
        command - self.position.round() as i64
    }
}

/// Number of scans after which an axis that does not reach its position is given up.
const PATIENCE: u64 = 100_000;

/// Plays the cycles scan by scan: on the interpolator if targets have one setting, on the
/// conventional system if they have one for each axis. `each` receives the tick of every scan.
pub fn play<const N: usize>(
    targets: &[Target<N>],
    settings: &Settings,
    each: &mut dyn FnMut(u64),
) -> Played {
    let mut played = Played::default();
    let mut motors = [Motor::default(); 2];
    let mut at = [0; 2];
    let (scan_ticks, scan_s) = (u64::from(settings.scan_ticks), settings.scan_s());
    let mut scan = |played: &mut Played, at: [i64; 2]| {
        played.ticks += scan_ticks;
        each(played.ticks);
        played.records.push(ScanRecord {
            tick: played.ticks,
            command: at,
            motor: motors.map(|motor| motor.position),
        });
        for axis in 0..2 {
            motors[axis].advance(&settings.axis(axis), at[axis], scan_s);
        }
        let most = i64::from(settings.in_position_counts);
        played.saturated_scans = motors.map(|motor| motor.saturated_scans);
        (0..2).all(|axis| motors[axis].error(at[axis]).abs() <= most)
    };
    for (number, target) in targets.iter().enumerate() {
        let (mut commands, master) = Commands::new(settings, at, target);
        let (from, start) = (at, played.records.len());
        let mut in_position = true;
        while let Some(to) = commands.advance(at) {
            at = to;
            in_position = scan(&mut played, at);
        }
        played.cycles.push(Cycle {
            from,
            to: [target.x, target.y],
            master,
            scans: start..played.records.len(),
            end: at,
        });
        let wait = settings.exact_stop || number + 1 == targets.len();
        for _ in 0..PATIENCE {
            if in_position || !wait {
                break;
            }
            in_position = scan(&mut played, at);
        }
    }
    played
}
