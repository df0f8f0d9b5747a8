//! Pulse generator 6x, 6y of the conventional device (¶0003–0004): a number of pulses of one length.
//!
//! ```text
//!                       ┌─────────────┐
//!  load ───────────────▶│             ├──▶ step
//!  half_period, pulses ▶│ pulse train ├──▶ dir
//!  down ───────────────▶│             ├──▶ spent
//!                       └─────────────┘
//! ```
//!
//! The first pulse rises n ticks after the tick of `load`, as in the pulse generator 20. Pulses are
//! counted at their falling edges. So Y pulses are output exactly if there is time for them, 2·Y·n
//! ticks.
//!
//! Departures: the text has no direction. Here `dir` changes in the first tick of a train; a train
//! of 0 pulses leaves `dir` as it is. A half-period of 0 gives no pulse.

use crate::prelude::*;

/// Pulse generator 6x, 6y.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PulseTrain {
    /// Width of a half-period in bits.
    pub half_period: usize,
    /// Width of a number of pulses.
    pub pulses: usize,
}

signals! { for PulseTrain as c;
    /// Input ports.
    pub struct In {
        /// Starts a new train in the next tick; the rest of the old one is dropped.
        pub load: Bit,
        /// Half-period of the new train, in ticks; 0 for no pulse.
        pub half_period: U(c.half_period),
        /// Number of pulses of the new train.
        pub pulses: U(c.pulses),
        /// Direction of the new train; high counts down.
        pub down: Bit,
    }
    /// Flip-flops.
    pub struct Reg {
        /// Half-period of the running train, in ticks.
        held: U(c.half_period),
        /// Pulses whose falling edge is still to come.
        left: U(c.pulses) as Analog,
        /// Ticks since the last toggle.
        count: U(c.half_period) as Analog,
        /// Step pulses; a step is a rising edge.
        pub step: Bit,
        /// Direction; high counts down.
        pub dir: Bit,
    }
    /// Nets.
    pub struct Net {
        /// `count + 1`: ticks since the last toggle, including this one.
        next: U(c.half_period),
        /// Pulses are left, and the half-period is not 0.
        active: Bit,
        /// The half-period ends with this tick.
        over: Bit,
        /// A pulse ends with this tick.
        falls: Bit,
        /// No pulse is left after this tick.
        pub spent: Bit,
    }
}

impl Circuit for PulseTrain {
    const NAME: &'static str = "pulse_train";
    const ABOUT: &'static str = "outputs a number of pulses of equal length";
    records!(In, Reg, Net);

    fn tick(&self, i: In, q: Reg, _: Nothing) -> (Net, Reg<Edge>) {
        let next = q.count + 1;
        let none = q.left.is_zero();
        let active = !none & !q.held.is_zero();
        let over = active & !next.below(q.held);
        let falls = over & q.step;
        let spent = none | (falls & q.left.equals(1));
        let net = Net {
            next,
            active,
            over,
            falls,
            spent,
        };
        let after = Reg {
            held: i.load.mux(i.half_period, q.held),
            left: i.load.mux(i.pulses, falls.mux(q.left - 1, q.left)),
            count: (i.load | over | !active).mux(0, next),
            step: !i.load & (q.step ^ over),
            dir: (i.load & !i.pulses.is_zero()).mux(i.down, q.dir),
        };
        (net, after)
    }

    fn properties(&self, now: &Moment<Self>) -> Vec<Property> {
        let (i, q, w, next) = (&now.i, &now.q, &now.w, &now.next.q);
        let taken = Bit::all([
            next.held.equals(i.half_period),
            next.left.equals(i.pulses),
            next.count.is_zero(),
            !next.step,
        ]);
        let begins = i.load & !i.pulses.is_zero();
        let over = !q.held.is_zero() & !q.count.below(q.held - 1);
        let due = !q.left.is_zero() & over;
        let fell = q.step & !next.step;
        let fewer = !q.left.is_zero() & next.left.equals(q.left - 1);
        vec![
            Property::step(
                "load starts the new train and drops the old one",
                &["held", "left", "count", "step"],
                i.load.implies(taken),
            ),
            Property::step(
                "a load of one or more pulses sets dir to down, and nothing else changes dir",
                &["dir"],
                next.dir.equals(begins.mux(i.down, q.dir)),
            ),
            Property::step(
                "while pulses are left, step toggles at the end of each half-period and only there",
                &["step", "count"],
                i.load | next.step.equals(q.step ^ due),
            ),
            Property::step(
                "left decreases by one at the end of each pulse",
                &["left", "step"],
                i.load | fell.mux(fewer, next.left.equals(q.left)),
            ),
            Property::step(
                "spent is high if and only if no pulse is left after this tick",
                &["spent", "left"],
                i.load | w.spent.equals(next.left.is_zero()),
            ),
            Property::always(
                "step is low if no pulse is left, and count is 0 or below the half-period",
                &["step", "count"],
                (q.count.is_zero() | q.count.below(q.held)) & !(q.left.is_zero() & q.step),
            ),
        ]
    }
}

impl Specified for PulseTrain {}
