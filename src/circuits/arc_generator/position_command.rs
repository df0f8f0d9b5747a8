//! Position command of one coordinate: the point in whole counts, updated at the sampling time.
//!
//! ```text
//!                       ┌──────────────────┐
//!  load, word, data ───▶│                  │
//!  rotating ───────────▶│ position_command ├──▶ command
//!  polynomial, offset ─▶│                  │
//!  present ────────────▶│                  │
//!                       └──────────────────┘
//! ```
//!
//! Equation \[4\] of the text, OPi = OG + GPi. On a blend or a line the origin is 0, and the
//! difference engine gives the point itself.

use super::Widths;
use crate::circuits::blocks::RecordWord;
use crate::prelude::*;

/// Position command.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PositionCommand {
    /// Widths of commands, points and records.
    pub widths: Widths,
    /// 0, 1, 2 for x, y, z: selects the record word that is the origin.
    pub coordinate: u64,
}

impl PositionCommand {
    fn origin_word(&self) -> u64 {
        5 + self.coordinate
    }
}

signals! { for PositionCommand as c;
    /// Input ports.
    pub struct In {
        /// Word of a record.
        pub record: RecordWord(&c.widths.data) as Flat,
        /// The current segment is an arc.
        pub rotating: Bit,
        /// Coordinate from the difference engine, with guard bits.
        pub polynomial: I(c.widths.point),
        /// Coordinate of the vector from the centre, from the rotation, with guard bits.
        pub offset: I(c.widths.point),
        /// The point becomes the command.
        pub present: Bit,
    }
    /// Flip-flops.
    pub struct Reg {
        /// G: coordinate of the centre on an arc; 0 on blends and lines.
        origin: I(c.widths.point) = 0,
        /// Position command, in counts.
        pub command: I(c.widths.position) as Analog = 0,
    }
    /// Nets.
    pub struct Net {
        /// Coordinate with guard bits.
        point: I(c.widths.point) as Analog,
        /// Coordinate with its guard bits plus half a count.
        raised: I(c.widths.point),
        /// Coordinate, rounded to the nearest count; halves round up.
        nearest: I(c.widths.position),
    }
}

impl Circuit for PositionCommand {
    const NAME: &'static str = "position_command";
    const ABOUT: &'static str = "centre plus vector, rounded to counts, at the sampling time";
    records!(In, Reg, Net);

    fn tick(&self, i: In, q: Reg, _: Nothing) -> (Net, Reg<Edge>) {
        let guard = self.widths.guard();
        let point = q.origin + i.rotating.mux(i.offset, i.polynomial);
        let raised = point + (1i64 << (guard - 1));
        let nearest = raised.shift_right(guard).resize(self.widths.position);
        let own = i.record.is("origin_word", self.origin_word());
        let given = i.record.data.resize(self.widths.point).signed();
        let next = Reg {
            origin: own.mux(given, q.origin),
            command: i.present.mux(nearest, q.command),
        };
        (
            Net {
                point,
                raised,
                nearest,
            },
            next,
        )
    }

    fn objection(&self) -> Option<String> {
        let of = &self.widths;
        let holds = of.point > of.position && of.data >= of.point;
        (!holds).then(|| "there are guard bits, and a record holds them".into())
    }

    fn properties(&self, now: &Moment<Self>) -> Vec<Property> {
        let (i, q, next) = (&now.i, &now.q, &now.next.q);
        let (guard, width) = (self.widths.guard(), self.widths.point);
        let point = q.origin + i.rotating.mux(i.offset, i.polynomial);
        // Half a count off at most, a half upwards, and as far as a command reaches.
        let over = next.command.resize(width).shift_left(guard) - point;
        let half = I::new(1 << (guard - 1), width);
        let nearest = (-half).below(over) & !half.below(over);
        let record = &i.record;
        let own = record.is("origin_word", self.origin_word());
        let given = record.data.resize(width).signed();
        vec![
            Property::step(
                "present loads the point into the command, rounded to the nearest count",
                &["command"],
                i.present.implies(nearest),
            ),
            Property::step(
                "the command changes only with present",
                &["command"],
                i.present | next.command.equals(q.command),
            ),
            Property::step(
                "origin loads its own word of a record and no others",
                &["origin"],
                next.origin.equals(own.mux(given, q.origin)),
            ),
        ]
    }
}

impl Specified for PositionCommand {
    /// A word that is not its own does not differ from another such.
    fn applies(&self, i: &In<Value>) -> bool {
        i.record.is_among(&[0, self.origin_word()])
    }
}
