//! What the plants of the machine show in its waves.

use crate::jobs::pulse_interpolator::step_dir::Driver;
use crate::kernel::Beside;
use crate::logic::{Logic, Sim};
use crate::plant::waves::{BodySignals, TwoMassSignals};
use crate::plant::{BrakedBody, TwoMassAxis};
use crate::signals;

signals! {
    /// Motors, loads and drivers as they really are.
    pub struct Signals<L> {
        /// Servo of X.
        pub servo_x: TwoMassSignals<L>,
        /// Servo of Y.
        pub servo_y: TwoMassSignals<L>,
        /// Pen lift.
        pub lift: BodySignals<L>,
        /// Steps that the driver of X has counted.
        pub stepper_x: L::I<32> as Analog,
        /// Steps that the driver of Y has counted.
        pub stepper_y: L::I<32> as Analog,
    }
}

/// The plants beside the machine.
#[derive(Debug)]
pub struct Plants;

impl Beside for Plants {
    const SCOPE: &'static str = "plant";
    type Signals<L: Logic> = Signals<L>;
}

impl Signals<Sim> {
    /// The plants as they stand.
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
            stepper_x: step_x.position().into(),
            stepper_y: step_y.position().into(),
        }
    }
}
