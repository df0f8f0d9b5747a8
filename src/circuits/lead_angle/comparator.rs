//! Comparator 19: gives the control signal when the compared position reaches the compared target.
//!
//! ```text
//!                               ┌────────────┐
//!  evaluate, valid ────────────▶│            ├──▶ crossing, fire
//!  position, target ───────────▶│ comparator ├──▶ control
//!  arm, halt ──────────────────▶│            ├──▶ upward
//!                               └────────────┘
//! ```
//!
//! From the first `arm` on, the position is evaluated where `evaluate` and `valid` are high. A
//! *crossing* is the arrival at the target, or a step over it, from either side; it counts once.
//! The first crossing after `arm` is `fire`; it holds the control signal until the next `arm`.
//!
//! Departures: the text compares for equality, which hits only one target in v where the position
//! moves by v > 1 counts per CK. That is the variant [`Comparing::Equal`]. At the far side of the
//! ring the difference changes its sign too; to tell a crossing from that jump, moves must be below
//! a quarter of the range per CK. `arm`, the latch and `halt`, which gives the control signal
//! without a crossing, are additions.

use crate::prelude::*;
use serde::{Deserialize, Serialize};

/// When the comparator finds that the target is reached.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Comparing {
    /// The position arrives at the target or steps over it.
    #[default]
    Crossing,
    /// The position is the target, as the text has it.
    Equal,
}

/// Comparator 19; `control` shows in the tick after `fire`.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Comparator {
    /// Width of a position.
    pub position: usize,
    /// When the target is reached.
    pub comparing: Comparing,
}

/// Names of the sides.
const SIDES: &[&str] = &["unknown", "below", "at", "above"];
const UNKNOWN: u64 = 0;
const BELOW: u64 = 1;
const AT: u64 = 2;
const ABOVE: u64 = 3;

signals! { for Comparator as c;
    /// Input ports.
    pub struct In {
        /// Position and target are new in this tick.
        pub evaluate: Bit,
        /// Position and target are valid.
        pub valid: Bit,
        /// Position, plus the part of the lead that is added to it.
        pub position: I(c.position),
        /// Target, minus the part of the lead that is subtracted from it.
        pub target: I(c.position),
        /// Clears the control signal and forgets the side; has priority over all other inputs.
        pub arm: Bit,
        /// Makes `control` high from the next tick on, without a crossing.
        pub halt: Bit,
    }
    /// Flip-flops.
    pub struct Reg {
        /// Side of the target at the last evaluation since `arm`.
        side: U(2) as States(SIDES) = 0,
        /// Evaluation is enabled; high from the first `arm` on.
        armed: Bit = 0,
        /// Control signal: high from the first crossing, or a halt, until the next `arm`.
        pub control: Bit = 0,
        /// The crossing that fired came from below.
        pub upward: Bit = 0,
    }
    /// Nets.
    pub struct Net {
        /// Position minus target, the shorter way round the ring.
        pub difference: I(c.position) as Analog,
        /// The position is evaluated in this tick.
        look: Bit,
        /// Position and target are equal.
        equal: Bit,
        /// The difference is within a quarter of the range, in either direction.
        near: Bit,
        /// The position reaches or passes the target from below.
        upwards: Bit,
        /// The position reaches or passes the target from above.
        downwards: Bit,
        /// The target is reached.
        pub crossing: Bit,
        /// The target is reached for the first time since `arm`.
        pub fire: Bit,
    }
}

impl Comparator {
    /// High if a sample at this difference arrives at the target, or steps over it, from `side`.
    fn reached(&self, side: U, difference: I) -> Bit {
        let quarter = ((1u64 << (self.position - 1)) / 2) as i64;
        let near = !difference.below(-quarter) & difference.below(quarter);
        let (negative, equal) = (difference.is_negative(), difference.is_zero());
        match self.comparing {
            Comparing::Crossing => {
                let from_below = side.equals(BELOW) & near & !negative;
                let from_above = side.equals(ABOVE) & near & (negative | equal);
                from_below | from_above | (side.equals(UNKNOWN) & equal)
            }
            Comparing::Equal => equal & !side.equals(AT),
        }
    }
}

impl Circuit for Comparator {
    const NAME: &'static str = "comparator";
    const ABOUT: &'static str = "gives the control signal when the position reaches the target";
    records!(In, Reg, Net);

    fn tick(&self, i: In, q: Reg, _: Nothing) -> (Net, Reg<Edge>) {
        let difference = i.position - i.target;
        let (negative, equal) = (difference.is_negative(), difference.is_zero());
        let look = i.evaluate & i.valid & q.armed & !i.arm;
        let near = !(negative ^ difference.shift_left(1).is_negative());
        let upwards = q.side.equals(BELOW) & !negative & near;
        let downwards = q.side.equals(ABOVE) & (negative | equal) & near;
        let crossing = match self.comparing {
            Comparing::Crossing => {
                let at_once = q.side.equals(UNKNOWN) & equal;
                look & (upwards | downwards | at_once)
            }
            Comparing::Equal => look & equal & !q.side.equals(AT),
        };
        let fire = crossing & !q.control;
        let away = negative.mux(U::new(BELOW, 2), ABOVE);
        let side = equal.mux(AT, away);
        let edge = Reg {
            side: i.arm.mux(UNKNOWN, look.mux(side, q.side)),
            armed: q.armed | i.arm,
            control: (q.control | fire | i.halt) & !i.arm,
            upward: fire.mux(upwards, q.upward),
        };
        let net = Net {
            difference,
            look,
            equal,
            near,
            upwards,
            downwards,
            crossing,
            fire,
        };
        (net, edge)
    }

    fn properties(&self, now: &Moment<Self>) -> Vec<Property> {
        let (i, q, w, next) = (&now.i, &now.q, &now.w, &now.next.q);
        let looks = i.evaluate & i.valid & q.armed;
        let crosses = looks & !i.arm & self.reached(q.side, w.difference);
        let control = (w.fire | i.halt | q.control) & !i.arm;
        let upward = w.fire.mux(q.side.equals(BELOW), q.upward);
        let above = w.difference.is_negative().mux(U::new(BELOW, 2), ABOVE);
        let compared = w.difference.is_zero().mux(AT, above);
        let side = i.arm.mux(UNKNOWN, looks.mux(compared, q.side));
        vec![
            Property::always(
                "crossing is high if and only if a sample arrives at the target or steps over it",
                &["crossing", "difference", "side"],
                w.crossing.equals(crosses),
            ),
            Property::always(
                "fire is high if and only if crossing is high while control is low",
                &["fire"],
                w.fire.equals(w.crossing & !q.control),
            ),
            Property::step(
                "control is high from the tick after fire or halt until the next arm",
                &["control"],
                next.control.equals(control),
            ),
            Property::step(
                "fire sets upward if the position came from below, and nothing else changes upward",
                &["upward"],
                next.upward.equals(upward),
            ),
            Property::step(
                "armed is high from the tick after the first arm",
                &["armed"],
                next.armed.equals(q.armed | i.arm),
            ),
            Property::step(
                "side is that of the last comparison since arm, and unknown before the first",
                &["side"],
                next.side.equals(side),
            ),
        ]
    }
}

impl Specified for Comparator {}
