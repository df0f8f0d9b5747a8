//! The linear interpolator: 14, 20, 21, 24 and 25, from targets to the position commands of X and
//! Y (Figs 5 and 6).
//!
//! ```text
//!                       ┌─────────────────────┐
//!  scan, hold ─────────▶│                     ├──▶ x, y
//!  push, target… ──────▶│ linear interpolator ├──▶ ready, busy
//!  halt, clear ────────▶│                     ├──▶ late, refused
//!                       └─────────────────────┘
//! ```

use super::command_source::ports_out;
pub use super::command_source::{In, Net};
use super::*;
use crate::prelude::*;

/// Linear interpolator.
#[derive(Debug, Clone, Default, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LinearInterpolator {
    /// Word widths, by name.
    pub widths: Widths,
    /// Rounding of the integrator's quotients.
    pub rule: Rule,
    /// Choice of the master axis.
    pub master: MasterAxis,
}

impl LinearInterpolator {
    /// The buffer of its targets.
    #[must_use]
    pub const fn targets(&self) -> TargetData {
        TargetData {
            widths: self.widths,
            settings: 1,
        }
    }

    const fn integrator(&self) -> Integrator {
        Integrator {
            position: self.widths.position,
            rule: self.rule,
        }
    }

    const fn sequencer(&self) -> Sequencer {
        Sequencer {
            position: self.widths.position,
            master: self.master,
        }
    }

    /// Ticks from `scan` to the tick in which the commands of that scan are valid. A shorter scan
    /// is late.
    #[must_use]
    pub const fn latency(&self) -> u64 {
        1 + self.widths.pattern().scan_latency() + self.integrator().latency() + 1
    }

    /// Ticks from an end of a cycle with a target waiting to the tick from which on a `scan` is
    /// the first of the next.
    #[must_use]
    pub const fn turnaround(&self) -> u64 {
        6 + self.widths.pattern().prepare_latency()
    }
}

signals! { for LinearInterpolator as c;
    /// The circuits inside.
    pub struct Parts {
        /// Target data 20.
        pub targets: Part<TargetData>(c.targets()),
        /// Sequencer.
        pub sequencer: Part<Sequencer>(c.sequencer()),
        /// Position pattern generator 14.
        pub pattern: Part<PatternGenerator>(c.widths.pattern()),
        /// Differentiator 21.
        pub differentiator: Part<Differentiator>(Differentiator { position: c.widths.position }),
        /// Integrator 24.
        pub integrator: Part<Integrator>(c.integrator()),
        /// Adder 25 and axis switch.
        pub switch: Part<AxisSwitch>(AxisSwitch { position: c.widths.position }),
    }
}

impl Circuit for LinearInterpolator {
    const NAME: &'static str = "linear_interpolator";
    const ABOUT: &'static str = "targets in, position commands of X and Y on one straight line out";
    records!(In, Nothing, Net, Parts);

    fn tick(&self, i: In, _: Nothing, p: Parts) -> (Net, Nothing) {
        let cycle = &p.sequencer.q;
        let targets = p.targets.settle(i.orders.to_buffer(cycle.pop));
        let pattern = p.pattern.settle(pattern_generator::In {
            start: cycle.start,
            from: cycle.master_from,
            distance: cycle.master,
            speed: targets.q.target_speed[0],
            acceleration_time: targets.q.target_acceleration[0],
            deceleration_time: targets.q.target_deceleration[0],
            advance: cycle.advance,
            halt: i.orders.halt,
        });
        let differentiator = p.differentiator.settle(differentiator::In {
            load: cycle.start,
            from: cycle.master_from,
            valid: pattern.w.valid,
            position: pattern.w.position,
        });
        let integrator = p.integrator.settle(integrator::In {
            clear: cycle.start,
            master: cycle.master,
            slave: cycle.slave,
            start: pattern.w.valid,
            increment: differentiator.w.increment,
        });
        let sequencer = p.sequencer.settle(sequencer::In {
            scan: i.scan,
            hold: i.hold,
            halt: i.orders.halt,
            clear: i.clear,
            available: targets.w.available,
            target_x: targets.q.target_x,
            target_y: targets.q.target_y,
            x: p.switch.q.x,
            y: p.switch.q.y,
            pattern_active: pattern.w.active,
            pattern_ready: pattern.w.ready,
            pattern_valid: pattern.w.valid,
            integrating: integrator.w.busy,
            load: integrator.w.valid,
        });
        let switch = p.switch.settle(axis_switch::In {
            load: integrator.w.valid,
            swapped: sequencer.q.swapped,
            position: pattern.w.position,
            slave_from: sequencer.q.slave_from,
            integral: integrator.w.integral,
            clear: sequencer.w.home,
        });
        let net = ports_out(&targets, &sequencer, &switch, integrator.w.valid);
        (net, Nothing)
    }
}
