//! Signals of a plant in the waves of the circuit that drives it.

use super::{BrakedBody, ServoAxis, TwoMassAxis};
use crate::hdl::{Value, View, signals};
use crate::sim::Beside;
use fixed::types::I56F8;

/// Fraction bits of a position.
pub(crate) const FINE: usize = I56F8::FRAC_NBITS as usize;

signals! { for Axes as _c;
    /// True motion of one axis.
    pub struct AxisSignals {
        /// True position in counts.
        pub position: I(48, FINE) as Analog,
        /// True speed in counts a second.
        pub speed: I(32) as Analog,
        /// The driver's torque in thousandths of a newton metre.
        pub torque: I(32) as Analog,
    }
}

signals! { for Axes as _c;
    /// The axes of an X-Y machine.
    pub struct Signals {
        /// X.
        pub x: AxisSignals(_c),
        /// Y.
        pub y: AxisSignals(_c),
    }
}

/// The axes of an X-Y machine beside the circuit that drives them.
#[derive(Debug, Clone)]
pub struct Axes;

impl Beside for Axes {
    const SCOPE: &'static str = "plant";
    type Signals<V: View> = Signals<V>;
}

impl Signals<Value> {
    /// Returns the current signals of the axes.
    pub fn of([x, y]: &[ServoAxis; 2]) -> Self {
        Signals {
            x: AxisSignals::of(x),
            y: AxisSignals::of(y),
        }
    }
}

impl AxisSignals<Value> {
    fn of(axis: &ServoAxis) -> Self {
        AxisSignals {
            position: fine(axis.position_counts()),
            speed: whole(axis.speed_counts_per_s()),
            torque: whole(axis.torque_nm() * 1e3),
        }
    }
}

signals! { for Body as _c;
    /// True motion of a braked body.
    pub struct BodySignals {
        /// True position in counts.
        pub position: I(48, FINE) as Analog,
        /// True speed in counts a second.
        pub speed: I(32) as Analog,
        /// The brake is on: its signal has stood for the dead time.
        pub engaged: Bit,
        /// Friction torque of the bearings and of an engaged brake, in thousandths of a newton
        /// metre.
        pub friction: I(32) as Analog,
    }
}

/// A braked body beside the circuit that stops it.
#[derive(Debug, Clone)]
pub struct Body;

impl Beside for Body {
    const SCOPE: &'static str = "plant";
    type Signals<V: View> = BodySignals<V>;
}

impl BodySignals<Value> {
    /// Returns the current signals of the body.
    pub fn of(body: &BrakedBody) -> Self {
        BodySignals {
            position: fine(body.position_counts()),
            speed: whole(body.speed_counts_per_s()),
            engaged: body.engaged(),
            friction: whole(body.friction_nm() * 1e3),
        }
    }

    /// Returns the signals of a body at a position in counts, with a speed in counts per second.
    pub fn at(position: f64, speed: f64) -> Self {
        BodySignals {
            position: fine(position),
            speed: whole(speed),
            engaged: false,
            friction: 0,
        }
    }
}

signals! { for Machine as _c;
    /// True motion of a motor with an elastic load.
    pub struct TwoMassSignals {
        /// True position of the motor in counts.
        pub position: I(48, FINE) as Analog,
        /// True speed of the motor in counts a second.
        pub speed: I(32) as Analog,
        /// True position of the load in counts.
        pub load_position: I(48, FINE) as Analog,
        /// By how much the motor is ahead of the load, in millionths of a radian.
        pub twist: I(32) as Analog,
        /// The amplifier's torque in thousandths of a newton metre.
        pub torque: I(32) as Analog,
    }
}

signals! { for Machine as c;
    /// The axes of a machine with elastic loads.
    pub struct MachineSignals {
        /// X, Y and, of three and four axes, Z and W.
        pub axes: [TwoMassSignals(c); c.axes] as Elements(&["x", "y", "z", "w"]),
    }
}

/// Motors with elastic loads beside the circuit that drives them.
#[derive(Debug, Clone, Copy)]
pub struct Machine {
    /// Number of axes.
    pub axes: usize,
}

impl Beside for Machine {
    const SCOPE: &'static str = "plant";
    type Signals<V: View> = MachineSignals<V>;
}

impl MachineSignals<Value> {
    /// Returns the current signals of the axes.
    pub fn of(axes: &[TwoMassAxis]) -> Self {
        MachineSignals {
            axes: axes.iter().map(TwoMassSignals::of).collect(),
        }
    }
}

impl TwoMassSignals<Value> {
    /// Returns the current signals of the axis.
    pub fn of(axis: &TwoMassAxis) -> Self {
        TwoMassSignals {
            position: fine(axis.position_counts()),
            speed: whole(axis.speed_counts_per_s()),
            load_position: fine(axis.load_position_counts()),
            twist: whole(axis.twist_rad() * 1e6),
            torque: whole(axis.torque_nm() * 1e3),
        }
    }
}

/// Rounds to a word of 32 bits; what is beyond is its least or greatest.
fn whole(value: f64) -> i64 {
    i64::from(value.round() as i32)
}

/// Converts a position to 1/256 of a count.
pub(crate) fn fine(counts: f64) -> i64 {
    I56F8::saturating_from_num(counts).to_bits()
}
