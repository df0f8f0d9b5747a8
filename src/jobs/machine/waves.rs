//! Signals of the plants in the machine's waves.

use crate::hdl::{Value, View, signals};
use crate::jobs::pulse_interpolator::step_dir::Driver;
use crate::plant::waves::{Body, BodySignals, Machine, TwoMassSignals};
use crate::plant::{BrakedBody, TwoMassAxis};
use crate::sim::Beside;

/// The servos.
const SERVOS: Machine = Machine { axes: 2 };

signals! { for Plants as _c;
    /// True motion of motors, loads and drivers.
    pub struct Signals {
        /// Servo of X.
        pub servo_x: TwoMassSignals(&SERVOS),
        /// Servo of Y.
        pub servo_y: TwoMassSignals(&SERVOS),
        /// Pen lift.
        pub lift: BodySignals(&Body),
        /// Steps that the driver of X has counted.
        pub stepper_x: I(32) as Analog,
        /// Steps that the driver of Y has counted.
        pub stepper_y: I(32) as Analog,
    }
}

/// Plants beside the machine.
#[derive(Debug, Clone)]
pub struct Plants;

impl Beside for Plants {
    const SCOPE: &'static str = "plant";
    type Signals<V: View> = Signals<V>;
}

impl Signals<Value> {
    /// Returns the current signals of the plants.
    #[must_use]
    pub fn of(
        [x, y]: &[TwoMassAxis; 2],
        lift: &BrakedBody,
        [step_x, step_y]: &[Driver; 2],
    ) -> Self {
        Signals {
            servo_x: TwoMassSignals::of(x),
            servo_y: TwoMassSignals::of(y),
            lift: BodySignals::of(lift),
            stepper_x: step_x.position(),
            stepper_y: step_y.position(),
        }
    }
}
