//! Path length: qc, the position of the command along the path, for an interpolation period.
//!
//! ```text
//!             ┌─────────────┐
//!  sample ───▶│             ├──▶ length
//!  present ──▶│ path_length ├──▶ preset, fresh
//!  profile ──▶│             ├──▶ held
//!  restart ──▶│             │
//!             └─────────────┘
//! ```
//!
//! From power-on, and from `restart`, until the first length there is no path: its segments may be
//! written, and no point is computed.

use crate::prelude::*;

/// Register of a length.
///
/// `fresh` or `held` is high 2 ticks after `sample`.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PathLength {
    /// Width of a length in bits.
    pub width: usize,
}

signals! { for PathLength as c;
    /// Input ports.
    pub struct In {
        /// An interpolation period begins.
        pub sample: Bit,
        /// The profile has a length for the period.
        pub present: Bit,
        /// Length along the path, from the profile.
        pub profile: I(c.width),
        /// Selects another path: there is no path until its first length. A period that has begun
        /// is completed, so segments may be written from the next start of a period on.
        pub restart: Bit,
    }
    /// Flip-flops.
    pub struct Reg {
        /// qc: length along the path, in guard units.
        pub length: I(c.width) as Analog = 0,
        /// There is no path.
        pub waiting: Bit = 1,
        /// A period has begun in the tick before.
        begun: Bit = 0,
        /// The length is the first of a path: the tangential response is set to it.
        pub preset: Bit = 0,
        /// A period begins with the present length.
        pub fresh: Bit = 0,
        /// A period begins without a path: the commands keep their values.
        pub held: Bit = 0,
    }
    /// Nets.
    pub struct Net {
        /// There is no path in this tick.
        none: Bit,
    }
}

impl Circuit for PathLength {
    const NAME: &'static str = "path_length";
    const ABOUT: &'static str = "length of the command along the path";
    records!(In, Reg, Net);

    fn tick(&self, i: In, q: Reg, _: Nothing) -> (Net, Reg<Edge>) {
        let none = i.restart | (q.waiting & !i.present);
        let next = Reg {
            length: (i.present & !i.restart).mux(i.profile, q.length),
            waiting: none,
            begun: i.sample,
            preset: i.present & q.waiting & !i.restart,
            fresh: q.begun & !none,
            held: q.begun & none,
        };
        (Net { none }, next)
    }

    fn properties(&self, now: &Moment<Self>) -> Vec<Property> {
        let (i, q, next) = (&now.i, &now.q, &now.next.q);
        let taken = i.present & !i.restart;
        let waits = i.restart | (q.waiting & !i.present);
        vec![
            Property::step(
                "the length is the profile's latest, except one in the tick of restart",
                &["length"],
                next.length.equals(taken.mux(i.profile, q.length)),
            ),
            Property::step(
                "after power-on or restart, a path begins with the first length",
                &["waiting", "preset"],
                next.waiting.equals(waits) & next.preset.equals(taken & q.waiting),
            ),
            Property::step(
                "two ticks after a period begins, fresh is high if there is a path, otherwise held",
                &["fresh", "held", "begun"],
                Bit::all([
                    next.fresh.equals(q.begun & !next.waiting),
                    next.held.equals(q.begun & next.waiting),
                    next.begun.equals(i.sample),
                ]),
            ),
        ]
    }
}

impl Specified for PathLength {}
