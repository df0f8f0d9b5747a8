//! The conventional system of Fig. 3 (¶0004–0005), for comparison: a position pattern for each
//! axis, each with a speed and times of its own.
//!
//! ```text
//!                       ┌────────────────────┐
//!  scan, hold ─────────▶│                    ├──▶ x, y
//!  push, target… ──────▶│ conventional       ├──▶ ready, busy
//!  halt, clear ────────▶│ interpolator       ├──▶ late, refused
//!                       └────────────────────┘
//! ```
//!
//! The ports are those of the linear interpolator, but X and Y each have their own speed and times.
//! Both patterns start together. An abort stops each axis on its own ramp. The settings choose
//! between the two methods of ¶0005: the same speed and times for both axes, or speeds in
//! proportion to the distances with times inverse to them.

use super::command_source::ports_out;
pub use super::command_source::{In, Net};
use super::*;
use crate::prelude::*;

/// Conventional system, with widths as those of the linear interpolator.
#[derive(Debug, Clone, Default, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Conventional {
    /// Word widths, by name.
    pub widths: Widths,
}

impl Conventional {
    /// The buffer of its targets, each with settings for X and for Y.
    #[must_use]
    pub const fn targets(&self) -> TargetData {
        TargetData {
            widths: self.widths,
            settings: 2,
        }
    }

    const fn commands(&self) -> AxisSwitch {
        AxisSwitch {
            position: self.widths.position,
        }
    }
}

signals! { for Conventional as c;
    /// The circuits inside.
    pub struct Parts {
        /// Target data 20.
        pub targets: Part<TargetData>(c.targets()),
        /// Sequencer.
        pub sequencer: Part<Sequencer>(Sequencer {
            position: c.widths.position,
            // No axis leads.
            master: MasterAxis::Longer,
        }),
        /// Position pattern generator 14 of X.
        pub pattern_x: Part<PatternGenerator>(c.widths.pattern()),
        /// Position pattern generator 14 of Y.
        pub pattern_y: Part<PatternGenerator>(c.widths.pattern()),
        /// Position commands.
        pub commands: Part<AxisSwitch>(c.commands()),
    }
}

impl Circuit for Conventional {
    const NAME: &'static str = "conventional_interpolator";
    const ABOUT: &'static str =
        "conventional system: an independent position pattern for each axis";
    records!(In, Nothing, Net, Parts);

    fn tick(&self, i: In, _: Nothing, p: Parts) -> (Net, Nothing) {
        let cycle = &p.sequencer.q;
        let at = &p.commands.q;
        let targets = p.targets.settle(i.orders.to_buffer(cycle.pop));
        let pattern = |part: Part<PatternGenerator>, axis: usize, from, distance| {
            part.settle(pattern_generator::In {
                start: cycle.start,
                from,
                distance,
                speed: targets.q.target_speed[axis],
                acceleration_time: targets.q.target_acceleration[axis],
                deceleration_time: targets.q.target_deceleration[axis],
                advance: cycle.advance,
                halt: i.orders.halt,
            })
        };
        let x = pattern(p.pattern_x, 0, at.x, cycle.delta_x).w;
        let y = pattern(p.pattern_y, 1, at.y, cycle.delta_y).w;
        // Both patterns take the same time for a scan; one of them may be at rest.
        let valid = x.valid | y.valid;
        let sequencer = p.sequencer.settle(sequencer::In {
            scan: i.scan,
            hold: i.hold,
            halt: i.orders.halt,
            clear: i.clear,
            available: targets.w.available,
            target_x: targets.q.target_x,
            target_y: targets.q.target_y,
            x: at.x,
            y: at.y,
            pattern_active: x.active | y.active,
            pattern_ready: (x.ready | !x.active) & (y.ready | !y.active),
            pattern_valid: valid,
            integrating: Bit::low(),
            load: valid,
        });
        let commands = p.commands.settle(axis_switch::In {
            load: valid,
            position: x.position,
            slave_from: y.position,
            clear: sequencer.w.home,
            ..axis_switch::In::low(&self.commands())
        });
        let net = ports_out(&targets, &sequencer, &commands, valid);
        (net, Nothing)
    }
}
