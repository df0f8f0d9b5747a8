//! Law of the error feedback's arithmetic, which can be swept: the feedback for any error, along
//! any direction that is at most 1 in each axis.
//!
//! ```text
//!                   ┌────────────────┐
//!  error, way ─────▶│                ├──▶ sum
//!  gains ──────────▶│ feedback sweep ├──▶ done, early
//!                   └────────────────┘
//! ```
//!
//! A case gives errors and directions. The positions that lead to them wrap: the motor's position
//! is the direction, in counts, and the path begins at the command. The start is high until the
//! last tick; only its first tick has an effect.

use super::path_point::{AXIS_NAMES, of_axes};
use super::{ErrorFeedback, error_feedback};
use crate::check::Law;
use crate::prelude::*;

/// The law of the feedback from power-on.
#[derive(Debug, Clone)]
pub struct FeedbackSweep {
    /// The error feedback.
    pub feedback: ErrorFeedback,
}

impl FeedbackSweep {
    /// Creates the law of an error feedback.
    #[must_use]
    pub const fn new(feedback: ErrorFeedback) -> Self {
        FeedbackSweep { feedback }
    }
}

signals! { for FeedbackSweep as c;
    /// An axis of a case.
    pub struct AxisCase {
        /// Command minus motor position.
        pub error: I(c.feedback.widths.position),
        /// Direction: displacement in this axis along one count of the path.
        pub way: I(c.feedback.widths.direction()),
    }
    /// A case.
    pub struct In {
        /// Errors and directions of the axes.
        pub axes: [AxisCase(c); c.feedback.axes] as Elements(&AXIS_NAMES),
        /// T: gain of the tangential error.
        pub tangential_gain: U(c.feedback.widths.gain),
        /// N: gain of the normal error.
        pub normal_gain: U(c.feedback.widths.gain),
    }
    /// Flip-flops.
    pub struct Reg {
        /// Ticks since the case began.
        ticks: U(log2(c.ticks() as usize)),
        /// `done` was high in a tick before the last.
        was_done: Bit,
    }
    /// The circuit inside.
    pub struct Parts {
        /// The error feedback.
        pub feedback: Part<ErrorFeedback>(c.feedback.clone()),
    }
    /// Observed signals.
    pub struct Net {
        /// Feedback of this axis.
        pub sum: [I(c.feedback.widths.sum()); c.feedback.axes] as Elements(of_axes!("sum")),
        /// `done` in the last tick.
        pub done: Bit,
        /// `done` was high in an earlier tick.
        pub early: Bit,
    }
}

impl Circuit for FeedbackSweep {
    const NAME: &'static str = "feedback_sweep";
    const ABOUT: &'static str = "feedback of one calculation from power-on";
    records!(In, Reg, Net, Parts);

    fn tick(&self, i: In, q: Reg, p: Parts) -> (Net, Reg<Edge>) {
        let each = |of: &dyn Fn(&AxisCase) -> I| i.axes.iter().map(of).collect::<Vec<I>>();
        let widths = self.feedback.widths;
        let guard = widths.position - widths.count;
        let motor = |axis: &AxisCase| axis.way.resize(widths.count);
        let command = |axis: &AxisCase| {
            let motor = motor(axis).resize(widths.position);
            axis.error + motor.shift_left(guard)
        };
        let feedback = p.feedback.settle(error_feedback::In {
            start: q.ticks.below(self.feedback.latency()),
            command: each(&command),
            path: each(&|axis| command(axis) + axis.way.resize(widths.position)),
            behind: each(&command),
            position: each(&motor),
            gains: error_feedback::FeedbackGains {
                tangential_gain: i.tangential_gain,
                normal_gain: i.normal_gain,
            },
        });
        let done = feedback.q.done;
        let net = Net {
            sum: feedback.q.sum.clone(),
            done,
            early: q.was_done,
        };
        let next = Reg {
            ticks: q.ticks + 1,
            was_done: q.was_done | done,
        };
        (net, next)
    }
}

impl Law for FeedbackSweep {
    fn law(&self) -> &str {
        "both parts of the error, each times its gain, are fed back"
    }

    fn ticks(&self) -> u64 {
        self.feedback.latency() + 1
    }

    fn expected(&self, case: &In<Value>) -> Option<Net<Value>> {
        let widths = self.feedback.widths;
        let count = 1i64 << (widths.position - widths.count);
        let gain = 1i64 << widths.gain_fraction();
        // A count of the path is no longer than one.
        if case.axes.iter().any(|axis| axis.way.abs() > count) {
            return None;
        }
        let [tangential, normal] = [case.tangential_gain, case.normal_gain].map(|word| word as i64);
        let along: i64 = case.axes.iter().map(|axis| axis.error * axis.way).sum();
        let along = along.div_euclid(count);
        let fed = case.axes.iter().map(|axis| {
            let own = (along * axis.way).div_euclid(count);
            (normal * (axis.error - own) + tangential * own).div_euclid(gain)
        });
        Some(Net {
            sum: fed.collect(),
            done: true,
            early: false,
        })
    }
}
