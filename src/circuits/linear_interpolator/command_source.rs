//! Source of a controller's position commands: the linear interpolator, or the conventional system
//! for comparison. Both have the same ports.
//!
//! ```text
//!                  ┌────────────────┐
//!  scan, hold ────▶│                ├──▶ x, y
//!  push, target… ─▶│ command source ├──▶ ready, busy
//!  halt, clear ───▶│                ├──▶ late, refused
//!                  └────────────────┘
//! ```

use super::target_data::Settings;
use super::*;
use crate::prelude::*;

choice! {
    /// Source of the position commands.
    #[derive(serde::Serialize, serde::Deserialize)]
    #[serde(rename_all = "snake_case")]
    pub enum CommandSource as CommandPart {
        /// On a straight line.
        Linear(LinearInterpolator),
        /// With a pattern for each axis.
        Conventional(Conventional),
    }
}

impl CommandSource {
    /// The buffer of its targets.
    #[must_use]
    pub fn targets(&self) -> TargetData {
        match self {
            CommandSource::Linear(interpolator) => interpolator.targets(),
            CommandSource::Conventional(interpolator) => interpolator.targets(),
        }
    }
}

signals! { for TargetData as c;
    /// Commands of the control computer.
    pub struct Orders {
        /// A target is given; not taken unless `ready`, or with `halt`.
        pub push: Bit,
        /// Its X.
        pub target_x: I(c.widths.position),
        /// Its Y.
        pub target_y: I(c.widths.position),
        /// Speed and times of the move to it.
        pub settings: Settings(c) as Flat,
        /// Ends the cycle, along the line or each axis by its own ramp, and forgets the targets that
        /// wait; one that is pushed with it is kept, and is where the axes go next.
        pub halt: Bit,
    }
}

signals! { for (LinearInterpolator, Conventional) as c;
    /// Input ports: scan and control computer.
    pub struct In {
        /// A scan begins.
        pub scan: Bit,
        /// No new cycle begins.
        pub hold: Bit,
        /// Commands of the control computer.
        pub orders: Orders(&c.targets()) as Flat,
        /// Between two cycles: the commands become 0, the flags go.
        pub clear: Bit,
    }
    /// Output ports.
    pub struct Net {
        /// Position command x(n).
        pub x: I(c.widths.position) as Analog,
        /// Position command y(n).
        pub y: I(c.widths.position) as Analog,
        /// A cycle begins.
        pub start: Bit,
        /// New commands show from the next tick on.
        pub load: Bit,
        /// A push is taken.
        pub ready: Bit,
        /// A cycle runs or is prepared, or a target waits.
        pub busy: Bit,
        /// A scan came too early since the last `clear`.
        pub late: Bit,
        /// A target was too far since the last `clear`.
        pub refused: Bit,
        /// `clear` is taken.
        pub home: Bit,
    }
}

impl Orders {
    /// Input ports of the buffer of targets, with these orders.
    pub(super) fn to_buffer(&self, pop: Bit) -> target_data::In {
        target_data::In {
            push: self.push,
            x: self.target_x,
            y: self.target_y,
            settings: self.settings.clone(),
            pop,
            flush: self.halt,
        }
    }
}

/// Output ports of a source with these circuits inside; `load` is high when it has new commands.
pub(super) fn ports_out(
    targets: &Settled<TargetData>,
    sequencer: &Settled<Sequencer>,
    switch: &Settled<AxisSwitch>,
    load: Bit,
) -> Net {
    Net {
        x: switch.q.x,
        y: switch.q.y,
        start: sequencer.q.start,
        load,
        ready: targets.w.ready,
        busy: sequencer.w.busy | targets.w.available,
        late: sequencer.q.late,
        refused: sequencer.q.refused,
        home: sequencer.w.home,
    }
}
