//! Step motors on the drivers of a group, in the waves beside it.

use crate::circuits::pulse_interpolator::AXIS_NAMES;
use crate::hdl::{Value, View, signals};
use crate::plant::waves::{FINE, fine};
use crate::plant::{StepMotor, StepMotorParameters};
use crate::settings::SettingError;
use crate::sim::Beside;
use serde::Serialize;

signals! { for StepMotors as _c;
    /// True motion of a step motor.
    pub struct StepMotorSignals {
        /// Position in steps of the driver.
        pub position: I(48, FINE) as Analog,
        /// Speed in steps of the driver a second.
        pub speed: I(32) as Analog,
        /// Lead of the field over the rotor, in full steps.
        pub ahead: I(48, FINE) as Analog,
    }
}

signals! { for StepMotors as c;
    /// Motors of all axes.
    pub struct StepMotorsSignals {
        /// Motors, X first.
        pub axes: [StepMotorSignals(c); c.axes] as Elements(&AXIS_NAMES),
    }
}

/// Step motors beside the circuit on whose drivers they are.
#[derive(Debug, Clone, Copy)]
pub struct StepMotors {
    /// Number of motors.
    pub axes: usize,
}

impl Beside for StepMotors {
    const SCOPE: &'static str = "plant";
    type Signals<V: View> = StepMotorsSignals<V>;
}

/// Result of a motor.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct MotorReport {
    /// Greatest distance between rotor and field, in full steps.
    pub off_full_steps: f64,
    /// First unit time of the table with that distance.
    pub off_unit: usize,
    /// Driver steps that are permanently lost: the motor is behind by these when it comes to rest.
    pub lost_steps: i64,
    /// First unit time in which the rotor was nearer to another tooth than to its own.
    pub lost_unit: Option<usize>,
}

/// Motor that is being observed.
#[derive(Debug, Clone)]
struct Followed {
    motor: StepMotor,
    commanded: i64,
    report: MotorReport,
}

/// Motors of all axes.
#[derive(Debug, Clone)]
pub struct Motors {
    axes: Vec<Followed>,
}

impl Motors {
    /// Creates equal motors on `axes` axes.
    ///
    /// # Errors
    /// Returns a [`SettingError`] that names the parameter that is out of range.
    pub fn new(
        parameters: &StepMotorParameters,
        axes: usize,
        clock_hz: u64,
    ) -> Result<Self, SettingError> {
        let motor = StepMotor::new(parameters, 1.0 / clock_hz as f64)?;
        let followed = Followed {
            motor,
            commanded: 0,
            report: MotorReport::default(),
        };
        Ok(Motors {
            axes: vec![followed; axes],
        })
    }

    /// Returns the current signals.
    pub fn signals(&self) -> StepMotorsSignals<Value> {
        let signals = |axis: &Followed| StepMotorSignals {
            position: fine(axis.motor.position_steps()),
            speed: axis.motor.speed_steps_per_s().round() as i64,
            ahead: fine(axis.motor.off_full_steps(axis.commanded)),
        };
        StepMotorsSignals {
            axes: self.axes.iter().map(signals).collect(),
        }
    }

    /// Advances one tick of unit time `unit`, with the drivers at `positions`.
    pub fn step(&mut self, unit: usize, positions: impl Iterator<Item = i64>) {
        for (axis, commanded) in self.axes.iter_mut().zip(positions) {
            axis.commanded = commanded;
            axis.motor.step(commanded);
            let off = axis.motor.off_full_steps(commanded).abs();
            let report = &mut axis.report;
            if off > report.off_full_steps {
                (report.off_full_steps, report.off_unit) = (off, unit);
            }
            if report.lost_unit.is_none() && axis.motor.lost_steps(commanded) != 0 {
                report.lost_unit = Some(unit);
            }
        }
    }

    /// Returns the reports of the motors, after they have come to rest.
    pub fn report(mut self) -> Vec<MotorReport> {
        let ended = self.axes.iter_mut().map(|axis| {
            axis.motor.settle(axis.commanded);
            MotorReport {
                lost_steps: axis.motor.lost_steps(axis.commanded),
                ..axis.report
            }
        });
        ended.collect()
    }
}
