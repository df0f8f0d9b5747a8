//! Step of the angle by the conventional method: Δθi = θi − θi−1.
//!
//! ```text
//!          ┌────────────┐
//!  step ──▶│            ├──▶ difference
//!  halt ──▶│ angle_step ├──▶ turn
//!  angle ─▶│            │
//!          └────────────┘
//! ```
//!
//! The differences of rounded angles add up to the rounded angle itself, so rounding errors do not
//! add up.

use crate::prelude::*;

/// Step of the angle.
///
/// The difference is valid in the tick after `step`; `turn` is high in that tick.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct AngleStep {
    /// H: width of an angle, in units of 2^−H turn.
    pub width: usize,
}

signals! { for AngleStep as c;
    /// Input ports.
    pub struct In {
        /// Advances to the next angle, which is valid in the next tick.
        pub step: Bit,
        /// Aborts; a step in the same tick is ignored.
        pub halt: Bit,
        /// θ, in units of 2^−H turn.
        pub angle: I(c.width) as Analog,
    }
    /// Flip-flops.
    pub struct Reg {
        /// θi−1, in units of 2^−H turn.
        last: I(c.width) = 0,
        /// The difference is valid in this tick.
        pub turn: Bit = 0,
    }
    /// Net.
    pub struct Net {
        /// Δθi = θi − θi−1, in units of 2^−H turn.
        pub difference: U(c.width),
    }
}

impl Circuit for AngleStep {
    const NAME: &'static str = "angle_step";
    const ABOUT: &'static str = "increase of an angle since the previous sample";
    records!(In, Reg, Net);

    fn tick(&self, i: In, q: Reg, _: Nothing) -> (Net, Reg<Edge>) {
        let difference = (i.angle - q.last).unsigned();
        let next = Reg {
            last: i.step.mux(i.angle, q.last),
            turn: i.step & !i.halt,
        };
        (Net { difference }, next)
    }

    fn properties(&self, now: &Moment<Self>) -> Vec<Property> {
        let (i, q, next) = (&now.i, &now.q, &now.next.q);
        vec![
            Property::step(
                "a step stores its angle in last, and nothing else changes last",
                &["last"],
                next.last.equals(i.step.mux(i.angle, q.last)),
            ),
            Property::step(
                "turn is high one tick after a step without halt, and at no other time",
                &["turn"],
                next.turn.equals(i.step & !i.halt),
            ),
            Property::always(
                "last plus difference equals angle",
                &["difference"],
                (q.last + now.w.difference.signed()).equals(i.angle),
            ),
        ]
    }
}

impl Specified for AngleStep {}
