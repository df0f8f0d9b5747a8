//! Model of a stepper driver on one axis: counts steps and measures step/direction timing.
//!
//! Behavioural: observes the lines like a driver with a step and a direction input.

use super::StepTiming;
use crate::circuits::pulse_interpolator::{AXIS_NAMES, Group};
use crate::sim::{Observer, RunError, Sample};
use serde::Serialize;
use std::ops::ControlFlow;

/// Least times so far, in ticks; each is absent if there was no such pair of edges.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct TimingMinima {
    /// Step high.
    pub high: Option<u64>,
    /// Step low between two steps.
    pub low: Option<u64>,
    /// Time from a change of direction to the next step.
    pub setup: Option<u64>,
    /// Time from a step to the next change of direction.
    pub hold: Option<u64>,
}

impl TimingMinima {
    /// Returns a message for each time that is shorter than `timing` allows.
    pub fn too_short(&self, timing: &StepTiming) -> impl Iterator<Item = String> {
        [
            ("step high time", self.high, timing.step_high_ticks),
            ("step low time", self.low, timing.step_low_ticks),
            ("direction setup time", self.setup, timing.dir_setup_ticks),
            ("direction hold time", self.hold, timing.dir_hold_ticks),
        ]
        .into_iter()
        .filter_map(|(name, least, limit)| {
            let ticks = least.filter(|&ticks| ticks < u64::from(limit))?;
            Some(format!(
                "{name} of {ticks} ticks where the driver asks for {limit}"
            ))
        })
    }
}

/// Two edges that came too close.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct TooShort {
    /// Name of the time: "high", "low", "setup" or "hold".
    pub what: &'static str,
    /// Actual time in ticks.
    pub ticks: u64,
    /// Least allowed time in ticks.
    pub limit: u64,
}

/// Stepper driver on one axis: a step is a rising edge, its direction the level of the direction
/// line in that tick; high counts down.
#[derive(Debug, Clone, Default)]
pub struct Driver {
    limits: StepTiming,
    minima: TimingMinima,
    pulses: u64,
    position: i64,
    step: bool,
    dir: Option<bool>,
    rose: Option<u64>,
    fell: Option<u64>,
    /// Tick of a change of direction that no step has followed yet.
    turned: Option<u64>,
    /// Tick of the last step, if no change of direction has followed it.
    stepped: Option<u64>,
}

impl Driver {
    /// Creates a driver at position 0 with the requirements `limits`. Step is low before the first
    /// tick.
    pub fn new(limits: StepTiming) -> Self {
        Driver {
            limits,
            ..Driver::default()
        }
    }

    /// Returns the number of steps so far, in either direction.
    pub fn pulses(&self) -> u64 {
        self.pulses
    }

    /// Returns the position in steps from the start.
    pub fn position(&self) -> i64 {
        self.position
    }

    /// Returns the least times so far.
    pub fn minima(&self) -> TimingMinima {
        self.minima
    }

    /// Observes the lines of one tick.
    ///
    /// # Errors
    /// Returns an error if two edges came closer than the limits allow; minima and position
    /// include them nevertheless.
    pub fn sample(&mut self, tick: u64, step: bool, dir: bool) -> Result<(), TooShort> {
        if step == self.step && self.dir == Some(dir) {
            return Ok(());
        }
        self.edges(tick, step, dir)
    }

    fn edges(&mut self, tick: u64, step: bool, dir: bool) -> Result<(), TooShort> {
        let mut worst = Ok(());
        let mut judge = |what, from: Option<u64>, least: &mut Option<u64>, limit: u32| {
            let limit = u64::from(limit);
            if let Some(from) = from {
                let ticks = tick - from;
                *least = Some(least.map_or(ticks, |least| least.min(ticks)));
                if ticks < limit && worst.is_ok() {
                    worst = Err(TooShort { what, ticks, limit });
                }
            }
        };
        let (least, limits) = (&mut self.minima, self.limits);
        if self.dir.is_some_and(|before| before != dir) {
            judge(
                "hold",
                self.stepped.take(),
                &mut least.hold,
                limits.dir_hold_ticks,
            );
            self.turned = Some(tick);
        }
        self.dir = Some(dir);
        if step && !self.step {
            judge(
                "setup",
                self.turned.take(),
                &mut least.setup,
                limits.dir_setup_ticks,
            );
            judge("low", self.fell, &mut least.low, limits.step_low_ticks);
            self.pulses += 1;
            self.position += if dir { -1 } else { 1 };
            self.rose = Some(tick);
            self.stepped = Some(tick);
        }
        if !step && self.step {
            judge("high", self.rose, &mut least.high, limits.step_high_ticks);
            self.fell = Some(tick);
        }
        self.step = step;
        worst
    }
}

/// Drivers on all axes of a [`Group`]; a violated limit ends the run.
#[derive(Debug, Clone)]
pub struct Drivers(pub Vec<Driver>);

impl Drivers {
    /// Creates drivers on `axes` axes with the requirements `limits`.
    pub fn new(axes: usize, limits: StepTiming) -> Self {
        Drivers(vec![Driver::new(limits); axes])
    }
}

impl Observer<Group> for Drivers {
    fn sample(&mut self, now: &Sample<'_, Group>) -> Result<ControlFlow<()>, RunError> {
        let lines = now.w.step.iter().zip(&now.w.dir).zip(AXIS_NAMES);
        for (driver, ((step, dir), name)) in self.0.iter_mut().zip(lines) {
            driver
                .sample(now.tick, *step, *dir)
                .map_err(|short| RunError::Violation {
                    tick: now.tick,
                    signals: vec![format!("step_{name}"), format!("dir_{name}")],
                    message: format!(
                        "{} of {} ticks on axis {name}, the driver asks for {}",
                        short.what, short.ticks, short.limit
                    ),
                })?;
        }
        Ok(ControlFlow::Continue(()))
    }
}
