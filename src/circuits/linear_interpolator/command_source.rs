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
        /// Gives a target; ignored unless `ready` or `halt`.
        pub push: Bit,
        /// X of the target, in counts.
        pub target_x: I(c.widths.position),
        /// Y of the target, in counts.
        pub target_y: I(c.widths.position),
        /// Speed and times of the move to the target.
        pub settings: Settings(c) as Flat,
        /// Ends the cycle and discards the waiting targets. The ramp down follows the line; in the
        /// conventional system each axis has its own. A target pushed in the same tick is kept and
        /// comes next.
        pub halt: Bit,
    }
}

signals! { for (LinearInterpolator, Conventional) as c;
    /// Input ports: scan and control computer.
    pub struct In {
        /// A scan begins.
        pub scan: Bit,
        /// Blocks the start of a new cycle.
        pub hold: Bit,
        /// Commands of the control computer.
        pub orders: Orders(&c.targets()) as Flat,
        /// Sets the commands to 0 and clears the flags; effective only between two cycles.
        pub clear: Bit,
    }
    /// Output ports.
    pub struct Net {
        /// Position command x(n), in counts.
        pub x: I(c.widths.position) as Analog,
        /// Position command y(n), in counts.
        pub y: I(c.widths.position) as Analog,
        /// A cycle begins.
        pub start: Bit,
        /// New commands are valid from the next tick on.
        pub load: Bit,
        /// Ready: a target is accepted.
        pub ready: Bit,
        /// A cycle runs or is being prepared, or a target is waiting.
        pub busy: Bit,
        /// A scan has come before the previous one was computed; cleared by `clear`.
        pub late: Bit,
        /// A target was too far away and has been refused; cleared by `clear`.
        pub refused: Bit,
        /// `clear` takes effect in this tick.
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
