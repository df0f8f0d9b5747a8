//! Error feedback, the prior art of ¶0005: splits the motors' error by direction and multiplies
//! each part by its gain.
//!
//! ```text
//!                      ┌────────────────┐
//!  start ─────────────▶│                ├──▶ sum
//!  command, position ─▶│ error_feedback ├──▶ done, busy
//!  path, behind ──────▶│                │
//!  gains ─────────────▶│                │
//!                      └────────────────┘
//! ```
//!
//! e = Pc − motors is the error of the servo response in the text (¶0003). The direction t of the
//! path is the vector, in counts, from a point of the path to the point one count later. Lengths
//! are distances along the path, so no division is needed. With s = e·t, the tangential error is
//! s·t, the normal error is e − s·t, and the feedback is N·(e − s·t) + T·s·t. Two bits of a factor
//! are processed per tick, all axes at once. Each of the three products is rounded down.

use super::path_point::of_axes;
use super::widths::FeedbackWidths;
use crate::prelude::*;

/// Names of the states.
const STATES: &[&str] = &["idle", "project", "split", "scale"];
const IDLE: u64 = 0;
const PROJECT: u64 = 1;
const SPLIT: u64 = 2;
const SCALE: u64 = 3;

signals! { for FeedbackWidths as c;
    /// Gains of an error feedback.
    pub struct FeedbackGains {
        /// T: gain of the tangential error, in units of 2^−(K/2); constant from `start` to `done`.
        pub tangential_gain: U(c.gain),
        /// N: gain of the normal error, in units of 2^−(K/2); constant from `start` to `done`.
        pub normal_gain: U(c.gain),
    }
}

/// Feedback of the errors of all axes.
///
/// `done` is high [`latency`](ErrorFeedback::latency) ticks after `start`.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ErrorFeedback {
    /// Word widths.
    pub widths: FeedbackWidths,
    /// Number of axes, 1 to 4.
    pub axes: usize,
}

impl ErrorFeedback {
    /// Ticks from `start` to `done`.
    #[must_use]
    pub const fn latency(&self) -> u64 {
        (2 * self.widths.direction_pairs() + self.widths.gain_pairs()) as u64 + 1
    }
}

signals! { for ErrorFeedback as c;
    /// Input ports. Points and positions are taken with `start` and need not be held.
    pub struct In {
        /// Starts a calculation; ignored while `busy`.
        pub start: Bit,
        /// Pc: position command of this axis, in guard units.
        pub command: [I(c.widths.position); c.axes] as Elements(of_axes!("command")),
        /// Point of the path at the command, this coordinate.
        pub path: [I(c.widths.position); c.axes] as Elements(of_axes!("path")),
        /// Point of the path one count before the command, this coordinate.
        pub behind: [I(c.widths.position); c.axes] as Elements(of_axes!("behind")),
        /// Position of this axis' motor, in counts.
        pub position: [I(c.widths.count); c.axes] as Elements(of_axes!("position")),
        /// Gains of both directions.
        pub gains: FeedbackGains(&c.widths) as Flat,
    }
    /// Flip-flops.
    pub struct Reg {
        /// State of the sequence.
        state: U(2) as States(STATES) = 0,
        /// Pairs of bits that are done.
        pair: U(c.widths.pair()) = 0,
        /// e: command minus motor position, in guard units.
        error: [I(c.widths.error()); c.axes] as Elements(of_axes!("error")),
        /// t: direction of the path in this axis; rotated by one pair of bits per tick, until it is
        /// in place again.
        direction: [U(c.widths.direction()); c.axes] as Elements(of_axes!("direction")),
        /// Partial projection, in units of the weight of the next pair.
        projection: I(c.widths.sum()) = 0,
        /// s: tangential error as a distance along the path, in guard units.
        along: I(c.widths.error()) as Analog = 0,
        /// Partial sum of the tangential error, then of the feedback, in units of the weight of the
        /// next pair; the feedback from `done` on.
        pub sum: [I(c.widths.sum()); c.axes] as Elements(of_axes!("sum")),
        /// Tangential error of this axis.
        tangential: [I(c.widths.error()); c.axes] as Elements(of_axes!("tangential")),
        /// Remaining bits of T.
        tangential_bits: U(2 * c.widths.gain_pairs()) as Hex = 0,
        /// Remaining bits of N.
        normal_bits: U(2 * c.widths.gain_pairs()) as Hex = 0,
        /// High for one tick: the feedback is valid from this tick until the next start.
        pub done: Bit = 0,
    }
    /// Nets.
    pub struct Net {
        /// A start is accepted.
        take: Bit,
        /// Last pair of bits of a direction.
        last_of_direction: Bit,
        /// Last pair of bits of a gain.
        last_of_gain: Bit,
        /// Error to load with a start.
        off: [I(c.widths.position); c.axes] as Elements(of_axes!("off")),
        /// Normal error of this axis.
        normal: [I(c.widths.error()); c.axes] as Elements(of_axes!("normal")),
        /// Multiplicand: the error, then the distance along the path, then the normal error.
        word: [I(c.widths.error()); c.axes] as Elements(of_axes!("word")),
        /// Multiplicand, extended to the width of the sum.
        wide: [I(c.widths.sum()); c.axes] as Elements(of_axes!("wide")),
        /// Current pair of bits of the factor.
        bits: [U(2); c.axes] as Elements(of_axes!("bits")),
        /// Multiplicand at the weight of the lower bit.
        low: [I(c.widths.sum()); c.axes] as Elements(of_axes!("low")),
        /// Multiplicand at the weight of the upper bit, which is negative for a sign bit.
        high: [I(c.widths.sum()); c.axes] as Elements(of_axes!("high")),
        /// Term of the current pair of bits.
        term: [I(c.widths.sum()); c.axes] as Elements(of_axes!("term")),
        /// Tangential error at the weight of the lower bit of its gain.
        raised: [I(c.widths.sum()); c.axes] as Elements(of_axes!("raised")),
        /// Term of the lower bit of the tangential gain.
        own_low: [I(c.widths.sum()); c.axes] as Elements(of_axes!("own_low")),
        /// Term of the upper bit of the tangential gain.
        own_high: [I(c.widths.sum()); c.axes] as Elements(of_axes!("own_high")),
        /// A product of each axis begins in the next tick.
        begins: Bit,
        /// Projection plus the terms of the current pairs.
        projected: I(c.widths.sum()),
        /// Sum of this axis plus the terms of its current pairs.
        total: [I(c.widths.sum()); c.axes] as Elements(of_axes!("total")),
        /// A calculation is running; a start is ignored.
        pub busy: Bit,
    }
}

impl Circuit for ErrorFeedback {
    const NAME: &'static str = "error_feedback";
    const ABOUT: &'static str = "tangential and normal error of the motors, each times its gain";
    records!(In, Reg, Net);

    fn objection(&self) -> Option<String> {
        let FeedbackWidths {
            count,
            position,
            gain,
        } = self.widths;
        let fits = position > count && self.widths.direction() <= 32 && (2..=32).contains(&gain);
        let named = (1..=4).contains(&self.axes);
        let right = fits && named && self.widths.sum() <= 64;
        (!right).then(|| {
            format!(
                "1 to 4 axes, not {}; 1 to 30 guard bits behind counts of {count} in positions of \
                 {position}, and gains of 2 to 32 bits, not {gain}, whose sums have 64 at most",
                self.axes
            )
        })
    }

    fn tick(&self, i: In, q: Reg, _: Nothing) -> (Net, Reg<Edge>) {
        let (widths, sum) = (self.widths, self.widths.sum());
        let is = |state: u64| q.state.equals(state);
        let (projects, splits, scales) = (is(PROJECT), is(SPLIT), is(SCALE));
        let take = i.start & is(IDLE);
        let last = |pairs: usize| q.pair.equals(pairs as u64 - 1);
        let last_of_direction = (projects | splits) & last(widths.direction_pairs());
        let last_of_gain = scales & last(widths.gain_pairs());
        let each = |of: &dyn Fn(usize) -> I| (0..self.axes).map(of).collect::<Vec<I>>();
        let by_direction = widths.direction() - widths.guard();
        let by_gain = 2 * widths.gain_pairs() - widths.gain_fraction();
        let off = each(&|axis| {
            let position = i.position[axis].resize(widths.position);
            i.command[axis] - position.shift_left(widths.guard())
        });
        let normal = each(&|axis| q.error[axis] - q.tangential[axis]);
        let word = each(&|axis| projects.mux(q.error[axis], splits.mux(q.along, normal[axis])));
        let wide = each(&|axis| word[axis].resize(sum));
        let bits: Vec<U> = (q.direction.iter())
            .map(|direction| scales.mux(q.normal_bits.slice(0, 2), direction.slice(0, 2)))
            .collect();
        let low = each(&|axis| {
            let word = wide[axis];
            scales.mux(word.shift_left(by_gain), word.shift_left(by_direction))
        });
        let high = each(&|axis| {
            let twice = low[axis].shift_left(1);
            last_of_direction.mux(-twice, twice)
        });
        let term = each(&|axis| {
            let bits = bits[axis];
            bits.bit(0).mux(low[axis], 0) + bits.bit(1).mux(high[axis], 0)
        });
        let raised = each(&|axis| q.tangential[axis].resize(sum).shift_left(by_gain));
        let own_low = each(&|axis| q.tangential_bits.bit(0).mux(raised[axis], 0));
        let own_high = each(&|axis| q.tangential_bits.bit(1).mux(raised[axis].shift_left(1), 0));
        let projected = term.iter().fold(q.projection, |sum, term| sum + *term);
        let total = each(&|axis| {
            let own = own_low[axis] + own_high[axis];
            q.sum[axis] + term[axis] + scales.mux(own, 0)
        });

        let goes_on = !is(IDLE) & !last_of_direction & !last_of_gain;
        let state = take.mux(PROJECT, q.state);
        let state = last_of_direction.mux(projects.mux(U::new(SPLIT, 2), SCALE), state);
        let begins_split = projects & last_of_direction;
        let begins_scale = splits & last_of_direction;
        let gain =
            |bits: U, gain: U| begins_scale.mux(gain.resize(bits.width()), bits.shift_right(2));
        let quarter = |word: I| word.shift_right(2);
        let begins = begins_split | begins_scale;
        let direction = |axis: usize| {
            let (bits, width) = (q.direction[axis], widths.direction());
            let turned = bits.slice(0, 2).join(bits.slice(2, width - 2));
            let way = (i.path[axis] - i.behind[axis]).resize(width).unsigned();
            take.mux(way, (projects | splits).mux(turned, bits))
        };
        let error = |axis: usize| take.mux(off[axis].resize(widths.error()), q.error[axis]);
        let next = Reg {
            state: last_of_gain.mux(IDLE, state),
            pair: goes_on.mux(q.pair + 1, 0),
            error: each(&error),
            direction: (0..self.axes).map(direction).collect(),
            projection: take.mux(0, projects.mux(quarter(projected), q.projection)),
            along: begins_split.mux(quarter(projected).resize(widths.error()), q.along),
            sum: each(&|axis| {
                begins.mux(0, (splits | scales).mux(quarter(total[axis]), q.sum[axis]))
            }),
            tangential: each(&|axis| {
                let own = quarter(total[axis]).resize(widths.error());
                begins_scale.mux(own, q.tangential[axis])
            }),
            tangential_bits: gain(q.tangential_bits, i.gains.tangential_gain),
            normal_bits: gain(q.normal_bits, i.gains.normal_gain),
            done: last_of_gain,
        };
        let net = Net {
            take,
            last_of_direction,
            last_of_gain,
            off,
            normal,
            word,
            wide,
            bits,
            low,
            high,
            term,
            raised,
            own_low,
            own_high,
            begins,
            projected,
            total,
            busy: !is(IDLE),
        };
        (net, next)
    }
}
