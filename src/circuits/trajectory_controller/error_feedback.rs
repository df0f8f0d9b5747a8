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
//! e = Pc − motors is what the text calls the error of the servo response (¶0003). The direction t of
//! the path is the way to the point of the path from that of a count before it, in counts: lengths are
//! ways along the path, so nothing is divided. Then s = e·t, the tangential error is s·t, the normal
//! error e − s·t, and the feedback N·(e − s·t) + T·s·t. Two bits of a factor a tick, of all axes at
//! once, each of the three products rounded down.

use crate::hdl::prelude::*;

/// Names of the states.
const STATES: &[&str] = &["idle", "project", "split", "scale"];
const IDLE: u64 = 0;
const PROJECT: u64 = 1;
const SPLIT: u64 = 2;
const SCALE: u64 = 3;

/// Widths of an error feedback in bits.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct FeedbackWidths {
    /// W: positions of the motors in counts, signed.
    pub count: usize,
    /// P: points in guard units, signed, with P − W guard bits.
    pub position: usize,
    /// K: gains, half of them fraction bits.
    pub gain: usize,
}

impl FeedbackWidths {
    /// Guard bits, which are the fraction bits of a direction.
    const fn guard(&self) -> usize {
        self.position - self.count
    }

    /// Pairs of bits of a direction: its fraction, its one and its sign.
    const fn direction_pairs(&self) -> usize {
        (self.guard() + 2).div_ceil(2)
    }

    /// Coordinate of a direction, signed.
    const fn direction(&self) -> usize {
        2 * self.direction_pairs()
    }

    /// Pairs of bits of a gain.
    const fn gain_pairs(&self) -> usize {
        self.gain.div_ceil(2)
    }

    /// The number of a pair of either.
    const fn pair(&self) -> usize {
        let (direction, gain) = (self.direction_pairs(), self.gain_pairs());
        log2(if direction > gain { direction } else { gain })
    }

    /// Fraction bits of a gain.
    pub const fn gain_fraction(&self) -> usize {
        self.gain / 2
    }

    /// Bits of a gain, or of a direction, that are not fraction.
    const fn whole(&self) -> usize {
        let (gain, direction) = (
            2 * self.gain_pairs() - self.gain_fraction(),
            self.direction() - self.guard(),
        );
        if gain > direction { gain } else { direction }
    }

    /// A sum: three times of three errors, or of a normal and a tangential one, above what a factor
    /// has of whole bits.
    const fn sum(&self) -> usize {
        self.position + self.whole() + 5
    }
}

signals! { for FeedbackWidths as c;
    /// Gains of an error feedback.
    pub struct FeedbackGains {
        /// T: of the tangential error, in units of 2^−(K/2); constant from `start` to `done`.
        pub tangential_gain: U(c.gain),
        /// N: of the normal error, likewise.
        pub normal_gain: U(c.gain),
    }
}

/// Feedback of the errors of all axes.
///
/// `done` is high [`latency`](ErrorFeedback::latency) ticks after `start`.
#[derive(Debug, Clone)]
pub struct ErrorFeedback {
    /// Its widths.
    pub widths: FeedbackWidths,
    /// How many axes, 1 to 3.
    pub axes: usize,
}

impl ErrorFeedback {
    /// Ticks from `start` to `done`.
    #[must_use]
    pub const fn latency(&self) -> u64 {
        (2 * self.widths.direction_pairs() + self.widths.gain_pairs()) as u64 + 1
    }
}

/// Names of a signal of each axis.
macro_rules! of_axes {
    ($name:literal) => {
        &[
            concat!($name, "_x"),
            concat!($name, "_y"),
            concat!($name, "_z"),
        ]
    };
}

signals! { for ErrorFeedback as c;
    /// Ports in. Points and positions are taken with `start` and need not be held.
    pub struct In {
        /// Begins, unless one is under way.
        pub start: Bit,
        /// Pc: the position command.
        pub command: [I(c.widths.position); c.axes] as Elements(of_axes!("command")),
        /// The point of the path there.
        pub path: [I(c.widths.position); c.axes] as Elements(of_axes!("path")),
        /// The point of the path a count before it.
        pub behind: [I(c.widths.position); c.axes] as Elements(of_axes!("behind")),
        /// Of the motors in counts.
        pub position: [I(c.widths.count); c.axes] as Elements(of_axes!("position")),
        /// Of both directions.
        pub gains: FeedbackGains(&c.widths) as Flat,
    }
    /// Flip-flops.
    pub struct Reg {
        /// What it does.
        state: U(2) as States(STATES) = 0,
        /// Pairs of bits that are done.
        pair: U(c.widths.pair()) = 0,
        /// e: command minus motor.
        error: [I(c.widths.position); c.axes] as Elements(of_axes!("error")),
        /// t: direction of the path, turned on by a pair a tick until it is as it was.
        direction: [U(c.widths.direction()); c.axes] as Elements(of_axes!("direction")),
        /// The projection so far, by the weight of the pair to come.
        projection: I(c.widths.sum()) = 0,
        /// s: the tangential error, as a way along the path.
        along: I(c.widths.position + 1) as Analog = 0,
        /// The tangential error, then what is fed back, so far, likewise; it stands from `done` on.
        pub sum: [I(c.widths.sum()); c.axes] as Elements(of_axes!("sum")),
        /// The tangential error of each axis.
        tangential: [I(c.widths.position + 1); c.axes] as Elements(of_axes!("tangential")),
        /// Bits of T that are yet to come.
        tangential_bits: U(2 * c.widths.gain_pairs()) as Hex = 0,
        /// Bits of N that are yet to come.
        normal_bits: U(2 * c.widths.gain_pairs()) as Hex = 0,
        /// The feedback stands in this tick, until the next start.
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
        /// The projection with what the pair adds.
        projected: I(c.widths.sum()),
        /// The sums of the axes with what their pairs add.
        total: [I(c.widths.sum()); c.axes] as Elements(of_axes!("total")),
        /// The normal error of each axis.
        normal: [I(c.widths.position + 2); c.axes] as Elements(of_axes!("normal")),
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
        let named = (1..=3).contains(&self.axes);
        let right = fits && named && self.widths.sum() <= 64;
        (!right).then(|| {
            format!(
                "1 to 3 axes, not {}; 1 to 30 guard bits behind counts of {count} in positions of \
                 {position}, and gains of 2 to 32 bits, not {gain}, whose sums have 64 at most",
                self.axes
            )
        })
    }

    fn tick(&self, i: In, q: Reg, _: Nothing) -> (Net, Reg<Edge>) {
        let (widths, wide) = (self.widths, self.widths.sum());
        let is = |state: u64| q.state.equals(state);
        let (projects, splits, scales) = (is(PROJECT), is(SPLIT), is(SCALE));
        let take = i.start & is(IDLE);
        let last = |pairs: usize| q.pair.equals(pairs as u64 - 1);
        let last_of_direction = (projects | splits) & last(widths.direction_pairs());
        let last_of_gain = scales & last(widths.gain_pairs());
        let zero = || I::new(0, wide);
        // By a pair of bits, the upper of which may be a sign.
        let times = |pair: U, sign: Bit, word: I| {
            let twice = word.shift_left(1);
            let lower = pair.bit(0).mux(word, 0);
            lower + pair.bit(1).mux(sign.mux(-twice, twice), 0)
        };
        let raised = |word: I, by: usize| word.resize(wide).shift_left(by);
        let above = widths.direction() - widths.guard();
        let terms = (q.direction.iter().zip(&q.error))
            .map(|(&bits, &error)| times(bits, last_of_direction, raised(error, above)));
        let projected = terms.fold(q.projection, |sum, term| sum + term);
        let along = raised(q.along, above);
        let normal: Vec<I> = (q.error.iter().zip(&q.tangential))
            .map(|(error, &tangential)| error.resize(widths.position + 1).minus(tangential))
            .collect();
        let above = 2 * widths.gain_pairs() - widths.gain_fraction();
        let total: Vec<I> = (0..self.axes)
            .map(|axis| {
                let part = times(q.direction[axis], last_of_direction, along);
                let low = Bit::low();
                let both = times(q.normal_bits, low, raised(normal[axis], above))
                    + times(q.tangential_bits, low, raised(q.tangential[axis], above));
                q.sum[axis] + splits.mux(part, scales.mux(both, zero()))
            })
            .collect();

        let goes_on = !is(IDLE) & !last_of_direction & !last_of_gain;
        let state = take.mux(PROJECT, q.state);
        let state = last_of_direction.mux(projects.mux(U::new(SPLIT, 2), SCALE), state);
        let begins_split = projects & last_of_direction;
        let begins_scale = splits & last_of_direction;
        let gain =
            |bits: U, gain: U| begins_scale.mux(gain.resize(bits.width()), bits.shift_right(2));
        let quarter = |word: I| word.shift_right(2);
        let short = widths.position + 1;
        let direction = |axis: usize| {
            let (bits, width) = (q.direction[axis], widths.direction());
            let turned = bits.slice(0, 2).join(bits.slice(2, width - 2));
            let way = (i.path[axis] - i.behind[axis]).resize(width).unsigned();
            take.mux(way, (projects | splits).mux(turned, bits))
        };
        let error = |axis: usize| {
            let position = i.position[axis].resize(widths.position);
            let off = i.command[axis] - position.shift_left(widths.guard());
            take.mux(off, q.error[axis])
        };
        let each = |of: &dyn Fn(usize) -> I| (0..self.axes).map(of).collect::<Vec<I>>();
        let next = Reg {
            state: last_of_gain.mux(IDLE, state),
            pair: goes_on.mux(q.pair + 1, 0),
            error: each(&error),
            direction: (0..self.axes).map(direction).collect(),
            projection: take.mux(0, projects.mux(quarter(projected), q.projection)),
            along: begins_split.mux(quarter(projected).resize(short), q.along),
            sum: each(&|axis| {
                let begins = begins_split | begins_scale;
                begins.mux(0, (splits | scales).mux(quarter(total[axis]), q.sum[axis]))
            }),
            tangential: each(&|axis| {
                let own = quarter(total[axis]).resize(short);
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
            projected,
            total,
            normal,
            busy: !is(IDLE),
        };
        (net, next)
    }
}
