//! Jolts of successive commands, and what they make of an elastic mechanism.

use super::Job;
use motion_rtl::input::Point;
use motion_rtl::jobs::arc_generator::mechanism::{SpeedChange, Vibrating, Vibration};

/// Jolts that the commands of a path give to the machine.
#[derive(Debug, Clone, Copy, Default)]
pub struct Jolt {
    /// Largest change of speed from one sample to the next in mm/s.
    pub speed_change: f64,
    /// Vibration of the mechanism, if there is one.
    pub vibration: Vibration,
}

impl Jolt {
    /// The worst of two paths.
    pub fn max(self, other: Self) -> Self {
        let (own, others) = (self.vibration, other.vibration);
        Jolt {
            speed_change: self.speed_change.max(other.speed_change),
            vibration: Vibration {
                moving_mm: own.moving_mm.max(others.moving_mm),
                rest_mm: own.rest_mm.max(others.rest_mm),
            },
        }
    }
}

/// Measures a [`Jolt`] on successive commands.
#[derive(Debug)]
pub struct Jolting {
    sample_s: f64,
    change: SpeedChange,
    vibrating: Option<Vibrating>,
}

impl Jolting {
    /// One before the first command of a path of the job.
    pub fn new(job: &Job) -> Self {
        let sample_s = job.prepared.timing.sample_s;
        let mechanism = job.mechanism.as_ref();
        Jolting {
            sample_s,
            change: SpeedChange::default(),
            vibrating: mechanism.map(|mechanism| Vibrating::new(mechanism, sample_s)),
        }
    }

    /// Takes the next command in mm.
    pub fn take(&mut self, point: Point) {
        self.change.take(point);
        if let Some(vibrating) = &mut self.vibrating {
            vibrating.take(point);
        }
    }

    /// Result of the whole path.
    pub fn finish(self) -> Jolt {
        Jolt {
            speed_change: self.change.finish(self.sample_s),
            vibration: self.vibrating.map(Vibrating::finish).unwrap_or_default(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_two_paths_each_figure_is_the_worse() {
        let jolt = |speed_change, moving_mm, rest_mm| Jolt {
            speed_change,
            vibration: Vibration { moving_mm, rest_mm },
        };
        for (one, other) in [
            (jolt(3.0, 1.0, 4.0), jolt(2.0, 5.0, 1.0)),
            (jolt(2.0, 5.0, 4.0), jolt(3.0, 1.0, 1.0)),
        ] {
            let worst = one.max(other);
            assert_eq!(worst.speed_change, 3.0);
            let vibration = Vibration {
                moving_mm: 5.0,
                rest_mm: 4.0,
            };
            assert_eq!(worst.vibration, vibration);
        }
    }
}
