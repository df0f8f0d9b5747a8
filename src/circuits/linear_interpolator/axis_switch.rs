//! Axis switch (Figs 5 and 6, ¶0014) with the adder 25 and the position commands of X and Y.
//!
//! ```text
//!                        ┌─────────────┐
//!  load, swapped ───────▶│             ├──▶ x
//!  position ────────────▶│ axis switch │
//!  slave_from, integral ▶│             ├──▶ y
//!                        └─────────────┘
//! ```
//!
//! In Fig. 5 X is the master and y(n) is computed from it, in Fig. 6 the other way round.
//!
//! Departure: both commands change at the same edge, when y(n) is ready, so that they always
//! belong together.

use crate::prelude::*;

/// Axis switch; a command shows in the tick after `load`.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct AxisSwitch {
    /// Width of a position in bits.
    pub position: usize,
}

signals! { for AxisSwitch as c;
    /// Input ports.
    pub struct In {
        /// Loads both commands; position and integral of a scan are valid.
        pub load: Bit,
        /// Y is the master axis (Fig. 6).
        pub swapped: Bit,
        /// Position command of the master axis.
        pub position: I(c.position),
        /// Position of the slave axis at the start of the cycle.
        pub slave_from: I(c.position),
        /// I: distance moved by the slave axis since the start of the cycle.
        pub integral: I(c.position),
        /// Clears both commands to 0.
        pub clear: Bit,
    }
    /// Flip-flops.
    pub struct Reg {
        /// Position command x(n).
        pub x: I(c.position) as Analog = 0,
        /// Position command y(n).
        pub y: I(c.position) as Analog = 0,
    }
    /// Nets.
    pub struct Net {
        /// Adder 25: position command of the slave axis.
        slave_position: I(c.position),
    }
}

impl Circuit for AxisSwitch {
    const NAME: &'static str = "axis_switch";
    const ABOUT: &'static str =
        "adds up the slave's command and routes both commands to their axes";
    records!(In, Reg, Net);

    fn tick(&self, i: In, q: Reg, _: Nothing) -> (Net, Reg<Edge>) {
        let slave_position = i.slave_from + i.integral;
        let to = |is_master: Bit, old: I| {
            let new = is_master.mux(i.position, slave_position);
            i.clear.mux(0, i.load.mux(new, old))
        };
        let next = Reg {
            x: to(!i.swapped, q.x),
            y: to(i.swapped, q.y),
        };
        (Net { slave_position }, next)
    }

    fn properties(&self, now: &Moment<Self>) -> Vec<Property> {
        let (i, q, next) = (&now.i, &now.q, &now.next.q);
        let slave = i.slave_from + i.integral;
        let shows = |x: I, y: I| next.x.equals(x) & next.y.equals(y);
        let routed = i
            .swapped
            .mux(shows(slave, i.position), shows(i.position, slave));
        let cleared = next.x.is_zero() & next.y.is_zero();
        vec![Property::step(
            "load gives each axis its command, clear sets both to 0, and otherwise both stay",
            &["x", "y"],
            i.clear.mux(cleared, i.load.mux(routed, shows(q.x, q.y))),
        )]
    }
}

impl Specified for AxisSwitch {}
