//! Surroundings of the machine: steppers, servos with their loads, and the pen lift.

use super::settings::Settings;
use super::waves::Signals;
use crate::circuits::machine::Machine;
use crate::circuits::machine::circuit::In;
use crate::hdl::{At, Value};
use crate::jobs::lead_angle::settings::SPEED_UNIT_COUNTS_PER_S;
use crate::jobs::pulse_interpolator::StepTiming;
use crate::jobs::pulse_interpolator::step_dir::Driver;
use crate::plant::{Ahead, BrakedBody, Plant, Plants, TwoMassAxis};
use crate::settings::SettingError;
use crate::sim::{State, Watcher};
use std::array::from_fn;

/// Signals that drive the plants.
pub(super) struct Drives {
    torque: [At<i64>; 2],
    speed: At<u64>,
    drive: At<bool>,
    reverse: At<bool>,
    brake: At<bool>,
}

impl Drives {
    pub(super) fn of(watch: &Watcher<'_, Machine>) -> Self {
        let axes = &watch.p.trajectory_controller.p.axes;
        let lift = &watch.p.lead_angle.p;
        Drives {
            torque: from_fn(|axis| watch.at(axes[axis].p.servo.p.arithmetic.q.torque)),
            speed: watch.at(lift.target_setter.q.speed),
            drive: watch.at(lift.sequencer.q.drive),
            reverse: watch.at(lift.sequencer.q.reverse),
            brake: watch.at(lift.comparator.q.control),
        }
    }
}

/// Everything around the circuit.
pub(super) struct Surroundings {
    drives: Drives,
    /// Motors with their loads, simulated ahead of the circuit while it does not change their
    /// inputs.
    pub(super) plants: Ahead<Bodies, [(bool, bool); 3]>,
    /// Drivers of the steppers X and Y.
    pub(super) drivers: [Driver; 2],
}

/// Motors with their loads.
pub(super) struct Bodies {
    pub(super) servos: [TwoMassAxis; 2],
    lift: BrakedBody,
}

/// Values that drive the plants in a tick.
#[derive(Clone, Copy)]
pub(super) struct Driven {
    torque: [i64; 2],
    speed: f64,
    drive: bool,
    reverse: bool,
    brake: bool,
}

impl Plants for Bodies {
    type State = (
        [<TwoMassAxis as Plant>::State; 2],
        <BrakedBody as Plant>::State,
    );

    #[inline]
    fn save(&self, states: &mut Vec<Self::State>) {
        let [x, y] = &self.servos;
        states.push(([x.state(), y.state()], self.lift.state()));
    }

    #[inline]
    fn restore(&mut self, states: &[Self::State]) {
        for (servos, lift) in states {
            self.servos.restore(servos);
            self.lift.set_state(lift);
        }
    }
}

impl Bodies {
    /// Advances one tick; returns the encoders' channels of X, of Y and of the lift.
    #[inline]
    pub(super) fn step(&mut self, by: &Driven) -> [(bool, bool); 3] {
        let [x, y] = &mut self.servos;
        [
            x.step(by.torque[0]),
            y.step(by.torque[1]),
            self.lift.step(by.drive, by.reverse, by.speed, by.brake),
        ]
    }
}

impl Surroundings {
    pub(super) fn new(settings: &Settings, drives: Drives) -> Result<Self, SettingError> {
        let tick_s = 1.0 / settings.clock_hz as f64;
        Ok(Surroundings {
            drives,
            plants: Ahead::new(Bodies {
                servos: [
                    TwoMassAxis::new(&settings.machine, tick_s)?,
                    TwoMassAxis::new(&settings.machine, tick_s)?,
                ],
                lift: BrakedBody::new(&settings.lift, tick_s)?,
            }),
            drivers: [0, 1].map(|_| Driver::new(StepTiming::NONE)),
        })
    }

    /// Returns the values of the registers that drive the plants.
    pub(super) fn driven(&self, now: &State<'_, Machine>) -> Driven {
        let drives = &self.drives;
        let speed = now.get(drives.speed) * u64::from(SPEED_UNIT_COUNTS_PER_S);
        Driven {
            torque: drives.torque.map(|torque| now.get(torque)),
            speed: speed as f64,
            drive: now.get(drives.drive),
            reverse: now.get(drives.reverse),
            brake: now.get(drives.brake),
        }
    }

    /// Steps the plants to the next tick, and sets the encoders' channels.
    pub(super) fn step(&mut self, by: &Driven, i: &mut In<Value>) {
        let [x, y, lift] = self.plants.step(|plants| plants.step(by));
        i.trajectory.a.copy_from_slice(&[x.0, y.0]);
        i.trajectory.b.copy_from_slice(&[x.1, y.1]);
        (i.lift.a, i.lift.b) = lift;
    }

    /// Returns the signals for the waves.
    pub(super) fn signals(&self) -> Signals<Value> {
        let Bodies { servos, lift } = &self.plants.plants;
        Signals::of(servos, lift, &self.drivers)
    }
}
