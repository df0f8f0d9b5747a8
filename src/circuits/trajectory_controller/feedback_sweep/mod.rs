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
        /// Ticks since the case began; stays at the number of ticks of a case.
        ticks: U(log2(c.ticks() as usize + 1)),
        /// Ghost: the case one tick ago.
        before: In(c),
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
        let ended = q.ticks.equals(self.ticks());
        let axes = i.axes.iter().map(|axis| AxisCase {
            error: axis.error,
            way: axis.way,
        });
        let next = Reg {
            ticks: ended.mux(q.ticks, q.ticks + 1),
            before: In {
                axes: axes.collect(),
                tangential_gain: i.tangential_gain,
                normal_gain: i.normal_gain,
            },
            was_done: q.was_done | done,
        };
        (net, next)
    }

    fn properties(&self, now: &Moment<Self>) -> Vec<Property> {
        let (i, q, w) = (&now.i, &now.q, &now.w);
        let last = q.ticks.equals(self.ticks() - 1);
        let axes = i.axes.iter().zip(&q.before.axes);
        let axes = axes
            .map(|(axis, before)| axis.error.equals(before.error) & axis.way.equals(before.way));
        let constant = Bit::all(axes)
            & i.tangential_gain.equals(q.before.tangential_gain)
            & i.normal_gain.equals(q.before.normal_gain);
        let widths = self.feedback.widths;
        let count = U::new(1 << widths.guard(), widths.direction());
        let ways = i.axes.iter().map(|axis| !count.below(axis.way.magnitude()));
        let sums = w.sum.iter().zip(self.fed(i));
        let sums = Bit::all(sums.map(|(sum, fed)| sum.equals_any(fed)));
        vec![
            Property::given("a case does not change", q.ticks.is_zero() | constant),
            Property::given("a count of the path is no longer than one", Bit::all(ways)),
            Property::always(
                "done comes in its tick and not earlier",
                &["done", "early"],
                !last | (w.done & !w.early),
            ),
            Property::always(
                "the feedback is both parts of the error, each times its gain",
                &["sum"],
                !last | sums,
            ),
        ]
    }
}

impl FeedbackSweep {
    /// Returns the feedback of each axis.
    fn fed(&self, i: &In) -> Vec<I> {
        let widths = self.feedback.widths;
        // Wide enough for a sum of four products.
        let (error, way) = (widths.position, widths.direction());
        let wide = error + way + 2;
        let terms = i.axes.iter().map(|axis| axis.error.times(axis.way, wide));
        let along = terms.reduce(|sum, term| sum + term);
        let along = along
            .unwrap_or_else(|| I::new(0, wide))
            .shift_right(widths.guard());
        let gain = |gain: U| gain.resize(widths.gain + 1).signed();
        let (tangential, normal) = (gain(i.tangential_gain), gain(i.normal_gain));
        let fed = i.axes.iter().map(|axis| {
            let own = along
                .times(axis.way, wide + way)
                .shift_right(widths.guard());
            let rest = axis.error.minus(own);
            let sum = rest.width() + widths.gain + 2;
            let fed = normal.times(rest, sum) + tangential.times(own, sum);
            fed.shift_right(widths.gain_fraction())
        });
        fed.collect()
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

#[cfg(test)]
mod tests;
