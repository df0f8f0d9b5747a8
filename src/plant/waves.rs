//! What a plant shows in the waves of the circuit that drives it.

use super::{BrakedBody, ServoAxis, TwoMassAxis};
use crate::kernel::Beside;
use crate::logic::{Logic, Sim};
use crate::signals;
use fixed::types::I56F8;

signals! {
    /// One axis as it really is.
    pub struct AxisSignals<L> {
        /// True position in 1/256 of a count.
        pub position: L::I<48> as Analog,
        /// True speed in counts a second.
        pub speed: L::I<32> as Analog,
        /// The driver's torque in thousandths of a newton metre.
        pub torque: L::I<32> as Analog,
    }
}

signals! {
    /// The axes of an X-Y machine.
    pub struct Signals<L> {
        /// X.
        pub x: AxisSignals<L>,
        /// Y.
        pub y: AxisSignals<L>,
    }
}

/// The axes of an X-Y machine beside the circuit that drives them.
#[derive(Debug)]
pub struct Axes;

impl Beside for Axes {
    const SCOPE: &'static str = "plant";
    type Signals<L: Logic> = Signals<L>;
}

impl Signals<Sim> {
    /// The axes as they stand.
    pub fn of([x, y]: &[ServoAxis; 2]) -> Self {
        Signals {
            x: AxisSignals::of(x),
            y: AxisSignals::of(y),
        }
    }
}

impl AxisSignals<Sim> {
    fn of(axis: &ServoAxis) -> Self {
        // A cast to a whole number saturates.
        AxisSignals {
            position: fine(axis.position_counts()).into(),
            speed: (axis.speed_counts_per_s().round() as i64).into(),
            torque: ((axis.torque_nm() * 1e3).round() as i64).into(),
        }
    }
}

signals! {
    /// A braked body as it really is.
    pub struct BodySignals<L> {
        /// True position in 1/256 of a count.
        pub position: L::I<48> as Analog,
        /// True speed in counts a second.
        pub speed: L::I<32> as Analog,
        /// The brake is on: its signal has stood for the dead time.
        pub engaged: L::Bit,
        /// Friction torque of the bearings and of an engaged brake, in thousandths of a newton
        /// metre.
        pub friction: L::I<32> as Analog,
    }
}

/// A braked body beside the circuit that stops it.
#[derive(Debug)]
pub struct Body;

impl Beside for Body {
    const SCOPE: &'static str = "plant";
    type Signals<L: Logic> = BodySignals<L>;
}

impl BodySignals<Sim> {
    /// The body as it stands.
    pub fn of(body: &BrakedBody) -> Self {
        BodySignals {
            position: fine(body.position_counts()).into(),
            speed: (body.speed_counts_per_s().round() as i64).into(),
            engaged: body.engaged().into(),
            friction: ((body.friction_nm() * 1e3).round() as i64).into(),
        }
    }

    /// Something that goes its own way, at a position in counts and a speed in counts a second.
    pub fn at(position: f64, speed: f64) -> Self {
        BodySignals {
            position: fine(position).into(),
            speed: (speed.round() as i64).into(),
            engaged: false.into(),
            friction: 0.into(),
        }
    }
}

signals! {
    /// A motor with an elastic load as it really is.
    pub struct TwoMassSignals<L> {
        /// True position of the motor in 1/256 of a count.
        pub position: L::I<48> as Analog,
        /// True speed of the motor in counts a second.
        pub speed: L::I<32> as Analog,
        /// True position of the load in 1/256 of a count.
        pub load_position: L::I<48> as Analog,
        /// By how much the motor is ahead of the load, in millionths of a radian.
        pub twist: L::I<32> as Analog,
        /// The amplifier's torque in thousandths of a newton metre.
        pub torque: L::I<32> as Analog,
    }
}

signals! {
    /// The axes of a machine with elastic loads.
    pub struct MachineSignals<L, const AXES: usize> {
        /// X, Y and, of three axes, Z.
        pub axes: [TwoMassSignals<L>; AXES] as Elements(&["x", "y", "z"]),
    }
}

/// `AXES` motors with elastic loads beside the circuit that drives them.
#[derive(Debug)]
pub struct Machine<const AXES: usize>;

impl<const AXES: usize> Beside for Machine<AXES> {
    const SCOPE: &'static str = "plant";
    type Signals<L: Logic> = MachineSignals<L, AXES>;
}

impl<const AXES: usize> MachineSignals<Sim, AXES> {
    /// The axes as they stand.
    pub fn of(axes: &[TwoMassAxis; AXES]) -> Self {
        MachineSignals {
            axes: axes.each_ref().map(TwoMassSignals::of),
        }
    }
}

impl TwoMassSignals<Sim> {
    /// The axis as it stands.
    pub fn of(axis: &TwoMassAxis) -> Self {
        TwoMassSignals {
            position: fine(axis.position_counts()).into(),
            speed: (axis.speed_counts_per_s().round() as i64).into(),
            load_position: fine(axis.load_position_counts()).into(),
            twist: ((axis.twist_rad() * 1e6).round() as i64).into(),
            torque: ((axis.torque_nm() * 1e3).round() as i64).into(),
        }
    }
}

/// A position in 1/256 of a count.
fn fine(counts: f64) -> i64 {
    I56F8::saturating_from_num(counts).to_bits()
}
