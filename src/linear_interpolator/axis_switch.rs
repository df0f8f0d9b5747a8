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
//! Fig. 5 has X as the master and makes y(n) of it, Fig. 6 the other way round.
//!
//! Departure: both commands change at the same edge, when y(n) is there, so that they always
//! belong together.

use crate::check::{Invariants, Specified, require};
use crate::kernel::Circuit;
use crate::logic::{Bit, Logic};
use crate::signals;

signals! {
    /// Ports in.
    pub struct In<L, const P: usize> {
        /// Position and integral of a scan are there.
        pub load: L::Bit,
        /// Y is the master axis (Fig. 6).
        pub swapped: L::Bit,
        /// Position command of the master axis.
        pub position: L::I<P>,
        /// Where the slave axis was when the cycle began.
        pub slave_from: L::I<P>,
        /// I: what the slave axis has moved since.
        pub integral: L::I<P>,
        /// Both commands become 0.
        pub clear: L::Bit,
    }
}

signals! {
    /// Flip-flops.
    pub struct Reg<L, const P: usize> {
        /// Position command x(n).
        pub x: L::I<P> as Analog = 0,
        /// Position command y(n).
        pub y: L::I<P> as Analog = 0,
    }
}

signals! {
    /// Nets.
    pub struct Net<L, const P: usize> {
        /// 25: position command of the slave axis.
        slave_position: L::I<P>,
    }
}

/// Axis switch of positions of `P` bits; a command shows in the tick after `load`.
#[derive(Debug, Clone, Default)]
pub struct AxisSwitch<const P: usize>;

impl<const P: usize> Circuit for AxisSwitch<P> {
    const NAME: &'static str = "axis_switch";
    const ABOUT: &'static str = "adds up the slave's command, brings both commands to their axes";
    type In<L: Logic> = In<L, P>;
    type Reg<L: Logic> = Reg<L, P>;
    type Net<L: Logic> = Net<L, P>;

    fn comb<L: Logic>(&self, _: &Reg<L, P>, i: &In<L, P>) -> Net<L, P> {
        Net {
            slave_position: i.slave_from + i.integral,
        }
    }

    fn next<L: Logic>(&self, q: Reg<L, P>, w: &Net<L, P>, i: &In<L, P>) -> Reg<L, P> {
        let to = |own: L::Bit, old: L::I<P>| {
            let new = own.mux(i.position, w.slave_position);
            i.clear.mux(0.into(), i.load.mux(new, old))
        };
        Reg {
            x: to(!i.swapped, q.x),
            y: to(i.swapped, q.y),
        }
    }
}

impl<const P: usize> Specified for AxisSwitch<P> {
    fn invariants(&self) -> Invariants<'_, Self> {
        let wrap = |sum: i64| (sum + (1 << (P - 1))).rem_euclid(1 << P) - (1 << (P - 1));
        Invariants::<Self>::new().step(
            "load brings master and slave to their axes",
            move |now, next| {
                let i = now.i;
                let slave = wrap(i.slave_from.get() + i.integral.get());
                let commands = match i.swapped.get() {
                    false => (i.position.get(), slave),
                    true => (slave, i.position.get()),
                };
                let expected = match (i.clear.get(), i.load.get()) {
                    (true, _) => (0, 0),
                    (false, true) => commands,
                    (false, false) => (now.q.x.get(), now.q.y.get()),
                };
                let right = (next.x.get(), next.y.get()) == expected;
                require(right, ["x", "y"], || format!("{expected:?} expected"))
            },
        )
    }
}
