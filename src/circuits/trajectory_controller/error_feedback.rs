//! Error feedback, the prior art of ¶0005: the motors' error by its directions, each times its gain.
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
//! e = Pc − motors is what the text calls the error of the servo response (¶0003). The direction t
//! of the path is the vector to the point of the path from the point a count before it, in counts:
//! lengths are distances along the path, so no division is needed. Then s = e·t, the tangential
//! error is s·t, the normal error e − s·t, and the feedback N·(e − s·t) + T·s·t. Two bits of a
//! factor per tick, all axes at once, each of the three products rounded down.

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
        /// N: gain of the normal error, in the same units; constant from `start` to `done`.
        pub normal_gain: U(c.gain),
    }
}

/// Feedback of the errors of all axes.
///
/// `done` is high [`latency`](ErrorFeedback::latency) ticks after `start`.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ErrorFeedback {
    /// Its widths.
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
        /// Starts, unless one is running.
        pub start: Bit,
        /// Pc: the position command.
        pub command: [I(c.widths.position); c.axes] as Elements(of_axes!("command")),
        /// The point of the path there.
        pub path: [I(c.widths.position); c.axes] as Elements(of_axes!("path")),
        /// The point of the path a count before it.
        pub behind: [I(c.widths.position); c.axes] as Elements(of_axes!("behind")),
        /// Positions of the motors in counts.
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
        /// e: command minus motor.
        error: [I(c.widths.error()); c.axes] as Elements(of_axes!("error")),
        /// t: direction of the path, turned on by a pair a tick until it is as it was.
        direction: [U(c.widths.direction()); c.axes] as Elements(of_axes!("direction")),
        /// Partial projection, in units of the next pair's weight.
        projection: I(c.widths.sum()) = 0,
        /// s: the tangential error, as a distance along the path.
        along: I(c.widths.error()) as Analog = 0,
        /// The tangential error, then the feedback: partial sum, in units of the weight of the next
        /// pair; complete from `done` on.
        pub sum: [I(c.widths.sum()); c.axes] as Elements(of_axes!("sum")),
        /// The tangential error of each axis.
        tangential: [I(c.widths.error()); c.axes] as Elements(of_axes!("tangential")),
        /// Remaining bits of T.
        tangential_bits: U(2 * c.widths.gain_pairs()) as Hex = 0,
        /// Remaining bits of N.
        normal_bits: U(2 * c.widths.gain_pairs()) as Hex = 0,
        /// The feedback is valid from this tick on, until the next start.
        pub done: Bit = 0,
    }
    /// Nets.
    pub struct Net {
        /// A start is taken.
        take: Bit,
        /// The last pair of bits of a direction.
        last_of_direction: Bit,
        /// The last pair of bits of a gain.
        last_of_gain: Bit,
        /// The error as a start takes it.
        off: [I(c.widths.position); c.axes] as Elements(of_axes!("off")),
        /// The normal error of each axis.
        normal: [I(c.widths.error()); c.axes] as Elements(of_axes!("normal")),
        /// Multiplicand: the error, the distance along the path, the normal error.
        word: [I(c.widths.error()); c.axes] as Elements(of_axes!("word")),
        /// The multiplicand, as wide as a sum.
        wide: [I(c.widths.sum()); c.axes] as Elements(of_axes!("wide")),
        /// Bits of its factor.
        bits: [U(2); c.axes] as Elements(of_axes!("bits")),
        /// The multiplicand by the weight of the lower bit.
        low: [I(c.widths.sum()); c.axes] as Elements(of_axes!("low")),
        /// The multiplicand by the weight of the upper bit, which may be a sign.
        high: [I(c.widths.sum()); c.axes] as Elements(of_axes!("high")),
        /// Term of the pair of bits.
        term: [I(c.widths.sum()); c.axes] as Elements(of_axes!("term")),
        /// The tangential error by the weight of the lower bit of its gain.
        raised: [I(c.widths.sum()); c.axes] as Elements(of_axes!("raised")),
        /// Term of the lower bit of that gain.
        own_low: [I(c.widths.sum()); c.axes] as Elements(of_axes!("own_low")),
        /// Term of the upper bit.
        own_high: [I(c.widths.sum()); c.axes] as Elements(of_axes!("own_high")),
        /// A product of each axis begins after this tick.
        begins: Bit,
        /// The projection plus the terms of the pairs.
        projected: I(c.widths.sum()),
        /// The sums of the axes plus the terms of their pairs.
        total: [I(c.widths.sum()); c.axes] as Elements(of_axes!("total")),
        /// A start is not taken.
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
