//! Command join: adds the position commands of an X-Y machine whose lines come from one circuit and
//! whose arcs come from another.
//!
//! ```text
//!                    ┌──────────────┐
//!  line_x, line_y ──▶│              ├──▶ counts_x, counts_y
//!  arc_x, arc_y ────▶│ command_join ├──▶ x, y
//!  take ────────────▶│              │
//!                    └──────────────┘
//! ```
//!
//! Each of the two circuits counts only its own distance and rests while the other moves, so the
//! sum is the whole path. The sum is sampled once per sampling time, so a circuit that computes
//! with it in between sees a constant value.

use crate::prelude::*;

/// Join of two distances. A command is valid one tick after `take`.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CommandJoin {
    /// Width of the distance on lines, and of a command.
    pub line: usize,
    /// Width of the distance on arcs, not wider.
    pub arc: usize,
}

signals! { for CommandJoin as c;
    /// Input ports.
    pub struct In {
        /// Loads the sums into the commands.
        pub take: Bit,
        /// Distance in X on lines, in counts.
        pub line_x: I(c.line),
        /// Distance in Y on lines, in counts.
        pub line_y: I(c.line),
        /// Distance in X on arcs, in counts.
        pub arc_x: I(c.arc),
        /// Distance in Y on arcs, in counts.
        pub arc_y: I(c.arc),
    }
    /// Flip-flops.
    pub struct Reg {
        /// Position command of X, in counts.
        pub x: I(c.line) as Analog = 0,
        /// Position command of Y, in counts.
        pub y: I(c.line) as Analog = 0,
    }
    /// Nets.
    pub struct Net {
        /// Sum of both distances in X, in this tick.
        pub counts_x: I(c.line) as Analog,
        /// Sum of both distances in Y, in this tick.
        pub counts_y: I(c.line) as Analog,
    }
}

impl Circuit for CommandJoin {
    const NAME: &'static str = "command_join";
    const ABOUT: &'static str = "one position command from that of the lines and that of the arcs";
    records!(In, Reg, Net);

    fn tick(&self, i: In, q: Reg, _: Nothing) -> (Net, Reg<Edge>) {
        let counts_x = i.line_x + i.arc_x.resize(self.line);
        let counts_y = i.line_y + i.arc_y.resize(self.line);
        let next = Reg {
            x: i.take.mux(counts_x, q.x),
            y: i.take.mux(counts_y, q.y),
        };
        (Net { counts_x, counts_y }, next)
    }

    fn objection(&self) -> Option<String> {
        let holds = self.line >= self.arc;
        (!holds).then(|| "the sum is as wide as the lines' way".into())
    }

    fn properties(&self, now: &Moment<Self>) -> Vec<Property> {
        let (i, q, next) = (&now.i, &now.q, &now.next.q);
        let x = i.take.mux(i.line_x + i.arc_x.resize(self.line), q.x);
        let y = i.take.mux(i.line_y + i.arc_y.resize(self.line), q.y);
        vec![Property::step(
            "take loads the sums of line and arc into the commands, which otherwise stay",
            &["x", "y", "take"],
            next.x.equals(x) & next.y.equals(y),
        )]
    }
}

impl Specified for CommandJoin {}
