//! Controller 1 (Fig. 5): scan, position commands, and a position loop for each axis.
//!
//! ```text
//!                             ┌────────────┐
//!  push, target… ────────────▶│            ├──▶ ready, busy
//!  halt, clear, exact_stop ──▶│            ├──▶ reference_x, reference_y
//!  scan_period ──────────────▶│ controller ├──▶ command_x, command_y
//!  gain_x, gain_y, window ───▶│            ├──▶ feedback_x, feedback_y
//!  a_x, b_x, a_y, b_y ───────▶│            ├──▶ late, refused, lost_x, lost_y
//!                             └────────────┘
//! ```
//!
//! The commands come from the linear interpolator or from the conventional system of Fig. 3.

use super::command_source::Orders;
use super::*;
use crate::circuits::blocks::{EnableCounter, enable_counter};
use crate::prelude::*;

/// Controller 1 around a source of commands.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Controller {
    /// Widths of the position loops; that of a position is given by the commands.
    pub loops: LoopWidths,
    /// Width of the scan counter in bits.
    pub scan: usize,
    /// Source of the commands.
    pub source: CommandSource,
}

impl Controller {
    /// Creates the controller around `source`, with the widths of the standard build.
    #[must_use]
    pub fn new(source: CommandSource) -> Self {
        Controller {
            loops: LoopWidths::FULL,
            scan: 24,
            source,
        }
    }

    fn loops(&self) -> LoopWidths {
        LoopWidths {
            position: self.source.targets().widths.position,
            ..self.loops
        }
    }
}

signals! { for Controller as c;
    /// Input ports: control computer, settings, encoders.
    pub struct In {
        /// Commands of the control computer.
        pub orders: Orders(&c.source.targets()) as Flat,
        /// Sets commands and feedback to 0 and clears the flags; effective only between two cycles.
        pub clear: Bit,
        /// High: a cycle begins only when both axes are in position.
        pub exact_stop: Bit,
        /// Scan period in ticks.
        pub scan_period: U(c.scan),
        /// Position gain of X, see [`position_loop::In::gain`].
        pub gain_x: U(c.loops().gain),
        /// Position gain of Y.
        pub gain_y: U(c.loops().gain),
        /// In-position window in counts.
        pub window: U(c.loops().position),
        /// Channel A of the encoder of X, asynchronous.
        pub a_x: Bit,
        /// Channel B of the encoder of X, asynchronous.
        pub b_x: Bit,
        /// Channel A of the encoder of Y, asynchronous.
        pub a_y: Bit,
        /// Channel B of the encoder of Y, asynchronous.
        pub b_y: Bit,
    }
    /// The circuits inside.
    pub struct Parts {
        /// Scan counter.
        pub scan_counter: Part<EnableCounter>(EnableCounter { width: c.scan }),
        /// Source of the commands.
        pub interpolator: CommandPart(&c.source),
        /// Position loop of X.
        pub loop_x: Part<PositionLoop>(PositionLoop { widths: c.loops() }),
        /// Position loop of Y.
        pub loop_y: Part<PositionLoop>(PositionLoop { widths: c.loops() }),
        /// Cycle gate.
        pub gate: Part<CycleGate>(CycleGate {}),
    }
    /// Output ports.
    pub struct Net {
        /// A scan begins.
        pub scan: Bit,
        /// Position command of X, in counts.
        pub command_x: I(c.loops().position) as Analog,
        /// Position command of Y, in counts.
        pub command_y: I(c.loops().position) as Analog,
        /// Position feedback of X, in counts.
        pub feedback_x: I(c.loops().position) as Analog,
        /// Position feedback of Y, in counts.
        pub feedback_y: I(c.loops().position) as Analog,
        /// Speed reference of X: word for the D/A converter.
        pub reference_x: I(c.loops().converter) as Analog,
        /// Speed reference of Y: word for the D/A converter.
        pub reference_y: I(c.loops().converter) as Analog,
        /// A cycle begins.
        pub start: Bit,
        /// New commands are valid from the next tick on.
        pub load: Bit,
        /// Ready: a target is accepted.
        pub ready: Bit,
        /// A cycle runs or is being prepared, a target is waiting, or an axis is not in position.
        pub busy: Bit,
        /// A scan has come before the previous one was computed; cleared by `clear`.
        pub late: Bit,
        /// A target was too far away and has been refused; cleared by `clear`.
        pub refused: Bit,
        /// Both encoder channels of X have changed at once: the feedback is wrong; cleared by
        /// `clear`.
        pub lost_x: Bit,
        /// Both encoder channels of Y have changed at once: the feedback is wrong; cleared by
        /// `clear`.
        pub lost_y: Bit,
    }
}

impl Circuit for Controller {
    const NAME: &'static str = "controller";
    const ABOUT: &'static str = "linear interpolator with the position loops of X and Y";
    records!(In, Nothing, Net, Parts);

    fn name(&self) -> &'static str {
        match self.source {
            CommandSource::Linear(_) => Self::NAME,
            CommandSource::Conventional(_) => "conventional_controller",
        }
    }

    fn about(&self) -> &'static str {
        match self.source {
            CommandSource::Linear(_) => Self::ABOUT,
            CommandSource::Conventional(_) => {
                "a position pattern for each axis, with the position loops of X and Y"
            }
        }
    }

    fn tick(&self, i: In, _: Nothing, p: Parts) -> (Net, Nothing) {
        let scan_counter = p.scan_counter.settle(enable_counter::In {
            period: i.scan_period,
        });
        let scan = scan_counter.w.enable;
        let given = command_source::In {
            scan,
            hold: p.gate.q.hold,
            orders: i.orders,
            clear: i.clear,
        };
        let commands = match p.interpolator {
            CommandPart::Linear(part) => part.settle(given).w,
            CommandPart::Conventional(part) => part.settle(given).w,
        };
        let position_loop = |part: Part<PositionLoop>, command, [a, b]: [Bit; 2], gain| {
            part.settle(position_loop::In {
                scan,
                command,
                a,
                b,
                clear: commands.home,
                gain,
                window: i.window,
            })
        };
        let x = position_loop(p.loop_x, commands.x, [i.a_x, i.b_x], i.gain_x).w;
        let y = position_loop(p.loop_y, commands.y, [i.a_y, i.b_y], i.gain_y).w;
        p.gate.settle(cycle_gate::In {
            exact_stop: i.exact_stop,
            in_position_x: x.in_position,
            in_position_y: y.in_position,
        });
        let net = Net {
            scan,
            command_x: commands.x,
            command_y: commands.y,
            feedback_x: x.feedback,
            feedback_y: y.feedback,
            reference_x: x.speed_ref,
            reference_y: y.speed_ref,
            start: commands.start,
            load: commands.load,
            ready: commands.ready,
            busy: commands.busy | !(x.in_position & y.in_position),
            late: commands.late,
            refused: commands.refused,
            lost_x: x.lost,
            lost_y: y.lost,
        };
        (net, Nothing)
    }
}
