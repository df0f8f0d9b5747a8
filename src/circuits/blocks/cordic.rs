//! CORDIC: rotates a vector by an angle, one iteration per tick. Gives the point of an arc relative
//! to its centre.
//!
//! ```text
//!           ┌──────────────────────────┐
//!  start ──▶│ cordic_state             ├──▶ along, across
//!  radius ─▶│   ◀▶ shifters of along   ├──▶ done, busy
//!  offset ─▶│        and across        │
//!  angle ──▶│                          │
//!  halt ───▶│                          │
//!           └──────────────────────────┘
//! ```

use super::{CordicState, Shifter, cordic_state, shifter};
use crate::prelude::*;

/// CORDIC.
///
/// `done` is high H + 1 ticks after `start`, with as many iterations as the angle has bits.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Cordic {
    /// R: width of a coordinate in bits.
    pub radius: usize,
    /// H: width of an angle, in units of 2^−H turn.
    pub angle: usize,
}

impl Cordic {
    /// Ticks from `start` to `done`.
    pub const fn latency(&self) -> u64 {
        self.angle as u64 + 1
    }
}

signals! { for Cordic as c;
    /// Input ports. Values given with `start` are taken in that tick and need not be held.
    pub struct In {
        /// Starts a rotation; ignored while `busy`.
        pub start: Bit,
        /// Aborts; a start in the same tick is ignored.
        pub halt: Bit,
        /// First coordinate of the vector. The width leaves room for the length of the vector times
        /// [`GAIN`](cordic_state::GAIN). For a point of a circle: the radius divided by GAIN.
        pub radius: I(c.radius),
        /// Second coordinate of the vector; 0 for a point of a circle.
        pub offset: I(c.radius),
        /// Angle of the rotation, in units of 2^−H turn.
        pub angle: U(c.angle),
    }
    /// The blocks.
    pub struct Parts {
        /// Vector and remaining angle.
        pub turning: Part<CordicState>(CordicState { radius: c.radius, angle: c.angle }),
        /// `along` times 2^−iteration, rounded down.
        pub shift_along: Part<Shifter>(Shifter { width: c.radius }),
        /// `across` times 2^−iteration, rounded down.
        pub shift_across: Part<Shifter>(Shifter { width: c.radius }),
    }
    /// Output ports.
    pub struct Net {
        /// GAIN · (radius · cos angle − offset · sin angle); valid from `done` on.
        pub along: I(c.radius) as Analog,
        /// GAIN · (radius · sin angle + offset · cos angle); valid from `done` on.
        pub across: I(c.radius) as Analog,
        /// The point is valid in this tick.
        pub done: Bit,
        /// A rotation is running; a start is ignored.
        pub busy: Bit,
    }
}

impl Circuit for Cordic {
    const NAME: &'static str = "cordic";
    const ABOUT: &'static str = "rotates a vector by an angle, one iteration per tick";
    records!(In, Nothing, Net, Parts);

    fn tick(&self, i: In, _: Nothing, p: Parts) -> (Net, Nothing) {
        let cordic_state::Reg {
            iteration: by,
            along,
            across,
            ..
        } = p.turning.q;
        let small = |part: Part<Shifter>, word| part.settle(shifter::In { word, by }).w.shifted;
        let turning = p.turning.settle(cordic_state::In {
            start: i.start,
            halt: i.halt,
            radius: i.radius,
            offset: i.offset,
            angle: i.angle,
            small_along: small(p.shift_along, along),
            small_across: small(p.shift_across, across),
        });
        let net = Net {
            along,
            across,
            done: turning.q.done,
            busy: turning.q.busy,
        };
        (net, Nothing)
    }
}
