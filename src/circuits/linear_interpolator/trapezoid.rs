//! Control of the position pattern generator 14 (¶0010): operands and timing of its products and
//! divisions.
//!
//! ```text
//!                              ┌───────────┐
//!  start, from, distance ─────▶│           ├──▶ position, valid
//!  speed, …time ──────────────▶│           ├──▶ ready, active
//!  advance, halt ─────────────▶│ trapezoid │
//!  done, quotient, remainder ─▶│           ├──▶ compute, product_only, multiplicand,
//!                              └───────────┘    multiplier, addend, divisor
//! ```
//!
//! The speed is a `level` that rises by Td per scan of acceleration and falls by Ta per scan of
//! deceleration, so that Ta scans up and Td scans down both span Ta·Td. The weight of a scan is
//! the sum of the levels at its two ends; the scan moves weight/W of the distance, where W is the
//! sum of all weights. The remainder of the division is carried into the next scan, so that
//! nothing is lost.
//!
//! The speed has fraction bits, so a slow speed is not rounded to whole counts per scan.
//!
//! Departures: the text says nothing of the discrete form. Every cycle ends exactly at its target;
//! a short one keeps its times and has a lower peak; times of 0 count as 1, a speed of 0 as the
//! least; `halt` ramps down from the present level, along the same line; a cycle has at most
//! 2^(P−1) − 1 steady scans, and goes faster than V where those are too few.

use super::PatternGenerator;
use crate::prelude::*;

/// Names of the states: at rest, four steps of the preparation, between scans, in a scan.
pub const STATES: &[&str] = &[
    "idle", "ramps", "steady", "peak", "total", "waiting", "scan",
];
const RAMPS: u64 = 1;
const STEADY_SCANS: u64 = 2;
pub(super) const PEAK: u64 = 3;
pub(super) const TOTAL: u64 = 4;
pub(super) const WAITING: u64 = 5;
pub(super) const SCAN: u64 = 6;

/// Names of the phases.
pub const PHASES: &[&str] = &["accelerate", "steady", "decelerate"];
const STEADY: u64 = 1;
const DECELERATE: u64 = 2;

/// Control of the position pattern generator 14.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Trapezoid {
    /// Width of a position in bits, the P of its ports.
    pub position: usize,
    /// Width of a time in bits, the T of its ports; fewer than a position has.
    pub time: usize,
}

impl Trapezoid {
    /// Width of the multiplier of its multiplier-divider, which holds a level.
    #[must_use]
    pub const fn multiplier(&self) -> usize {
        2 * self.time + 1
    }

    /// Width of the words of its multiplier-divider.
    #[must_use]
    pub const fn word(&self) -> usize {
        self.position + 2 * self.time + 2
    }
}

signals! { for (Trapezoid, PatternGenerator) as c;
    /// A cycle, and its scans.
    pub struct Cycle {
        /// Starts a cycle; ignored while one is running. The ports `from` to `deceleration_time`
        /// are sampled with it.
        pub start: Bit,
        /// Position at the start.
        pub from: I(c.position),
        /// Signed distance to go; with 0 no cycle begins.
        pub distance: I(c.position),
        /// V: greatest speed, in counts per scan with `T` fraction bits; 0 counts as the least
        /// speed.
        pub speed: U(c.position),
        /// Ta: acceleration time in scans; 0 counts as 1.
        pub acceleration_time: U(c.time),
        /// Td: deceleration time in scans; 0 counts as 1.
        pub deceleration_time: U(c.time),
        /// Computes the next position; ignored unless `ready`.
        pub advance: Bit,
        /// Ends the cycle: immediately before its first scan, later by a ramp down.
        pub halt: Bit,
    }
}

signals! { for Trapezoid as c;
    /// Input ports.
    pub struct In {
        /// A cycle, and its scans.
        pub cycle: Cycle(c) as Flat,
        /// The multiplier-divider has a result.
        pub done: Bit,
        /// Quotient or product from the multiplier-divider.
        pub quotient: U(c.word()),
        /// Remainder from the multiplier-divider; 0 after a product.
        pub remainder: U(c.word()),
    }
    /// Flip-flops.
    pub struct Reg {
        /// State of the sequence.
        pub(super) state: U(3) as States(STATES) = 0,
        /// Phase of the next scan.
        phase: U(2) as States(PHASES) = 0,
        /// Starts the multiplier-divider.
        pub(super) request: Bit = 0,
        /// The multiplier-divider is running, or shows `done`.
        pub(super) under_way: Bit = 0,
        /// Magnitude |Δ| of the cycle's distance.
        length: U(c.position) = 0,
        /// Direction of the cycle; high counts down.
        backward: Bit = 0,
        /// V: greatest speed, in counts per scan with `T` fraction bits.
        pub(super) speed_limit: U(c.position) = 0,
        /// Ta: acceleration time in scans.
        pub(super) ramp_up: U(c.time) = 0,
        /// Td: deceleration time in scans.
        pub(super) ramp_down: U(c.time) = 0,
        /// Tc: remaining scans at steady speed.
        pub(super) steady_scans: U(c.position) = 0,
        /// Ta·Td: level of the steady speed.
        pub(super) peak: U(c.multiplier()) = 0,
        /// W: sum of all weights.
        pub(super) total: U(c.word()) = 0,
        /// Speed at the start of the next scan, in units of 2Δ/W per scan.
        level: U(c.multiplier()) as Analog = 0,
        /// x(n): position, in counts.
        pub position: I(c.position) as Analog = 0,
        /// A new position is at `position` from this tick on.
        pub valid: Bit = 0,
        /// Ready for `advance`.
        pub ready: Bit = 0,
        /// A cycle is running.
        pub active: Bit = 0,
    }
    /// Nets.
    pub struct Net {
        /// A start is accepted.
        take: Bit,
        /// The start begins a cycle.
        begins: Bit,
        /// An abort ends the cycle at the end of this tick.
        drop: Bit,
        /// A scan begins.
        scans: Bit,
        /// Starts the multiplier-divider.
        pub compute: Bit,
        /// The multiplier-divider has the last requested result, and a cycle needs it.
        result: Bit,
        /// Requests a product without a division.
        pub product_only: Bit,
        /// First factor.
        pub multiplicand: U(c.word()),
        /// Second factor.
        pub multiplier: U(c.multiplier()),
        /// Addend of the product.
        pub addend: U(c.word()),
        /// Divisor of the sum.
        pub divisor: U(c.word()),
        /// Ta + Td.
        times: U(c.word()),
        /// 2|Δ|, with the fraction bits of V.
        length_twice: U(c.word()),
        /// 2V.
        speed_twice: U(c.word()),
        /// Tc would be 2^(P−1) or more: it is limited.
        endless: Bit,
        /// Distance of the scan, in counts.
        share: I(c.position),
        /// The next step of the preparation is requested.
        prepares: Bit,
        /// Tc times 2V: 2|Δ| − V(Ta + Td) + 2V − 1, or 0 where the ramps alone are too long.
        excess: U(c.word()),
        /// Speed at the end of the scan.
        next_level: U(c.multiplier()),
        /// Share of the scan in the distance, in units of Δ/W.
        weight: U(c.multiplier()),
        /// Remaining scans at steady speed after this one.
        left: U(c.position),
        /// Phase of the scan after this one.
        next_phase: U(2) as States(PHASES),
        /// State of the next tick.
        next_state: U(3) as States(STATES),
    }
}

impl Circuit for Trapezoid {
    const NAME: &'static str = "trapezoid";
    const ABOUT: &'static str =
        "prepares a positioning cycle and computes its positions, scan by scan";
    records!(In, Reg, Net);

    fn objection(&self) -> Option<String> {
        let fits = self.time < self.position;
        (!fits).then(|| "times have fewer bits than positions".into())
    }

    fn tick(&self, i: In, q: Reg, _: Nothing) -> (Net, Reg<Edge>) {
        let cycle = i.cycle;
        let (position, word, multiplier) = (self.position, self.word(), self.multiplier());
        let [ramps, steady_scans, peak, total, scan] =
            [RAMPS, STEADY_SCANS, PEAK, TOTAL, SCAN].map(|state| q.state.equals(state));
        let (steady, decelerate) = (q.phase.bit(0), q.phase.bit(1));

        let take = cycle.start & !q.active;
        let begins = take & !cycle.distance.is_zero() & !cycle.halt;
        let drop = cycle.halt & q.active & q.level.is_zero() & !scan;
        let scans = cycle.advance & q.ready & !drop;
        let compute = q.request & (!q.under_way | i.done);
        let result = i.done & q.under_way & !q.request & q.active;
        let prepares = begins | (result & !total & !scan);

        // A scan.
        let ramp_up = q.ramp_up.resize(multiplier);
        let lowered = q.level.below(ramp_up).mux(0, q.level - ramp_up);
        let raised = q.level + q.ramp_down.resize(multiplier);
        let next_level = decelerate.mux(lowered, steady.mux(q.level, raised));
        let weight = q.level + next_level;
        let left = steady.mux(q.steady_scans - 1, q.steady_scans);
        let at_peak = next_level.equals(q.peak);
        let ends = decelerate | (at_peak & left.is_zero());
        let next_phase = ends.mux(DECELERATE, at_peak.mux(STEADY, q.phase));
        let share = i.quotient.resize(position).signed();

        // The preparation.
        let times = q.ramp_up.resize(word) + q.ramp_down.resize(word);
        let scans_twice = times + q.steady_scans.resize(word).shift_left(1);
        let length_twice = q.length.resize(word).shift_left(self.time + 1);
        let speed_twice = q.speed_limit.resize(word).shift_left(1);
        let excess = length_twice - i.quotient + speed_twice - 1;
        let excess = i.quotient.below(length_twice).mux(excess, 0);
        let endless = !i.quotient.shift_right(position - 1).is_zero();

        let [length, speed_limit, first_ramp] =
            [q.length, q.speed_limit, q.ramp_up].map(|factor| factor.resize(word));
        let first = total.mux(scans_twice, peak.mux(first_ramp, speed_limit));
        let second_ramp = q.ramp_down.resize(multiplier);
        let second = peak.mux(second_ramp, ramps.mux(times.resize(multiplier), 0));

        let after = scan.mux(q.level.is_zero().mux(U::new(0, 3), WAITING), q.state + 1);
        let goes_on = result.mux(after, q.state);
        let next_state = begins.mux(RAMPS, drop.mux(0, scans.mux(SCAN, goes_on)));

        let at_least_1 = |word: U| word.is_zero().mux(1, word);
        let weighs = scan & compute;
        let moves = scan & result;
        let moved = q.backward.mux(q.position - share, q.position + share);
        let phase = weighs.mux(next_phase, q.phase);
        let phase = (cycle.halt & q.active).mux(DECELERATE, phase);
        let steady_left = weighs.mux(left, q.steady_scans);
        let most = (U::new(0, position) - 1).shift_right(1);
        let steady_all = endless.mux(most, i.quotient.resize(position));
        let next = Reg {
            state: next_state,
            phase: begins.mux(0, phase),
            request: !drop & (prepares | scans | (q.request & !compute)),
            under_way: compute | (q.under_way & !i.done),
            length: take.mux(cycle.distance.magnitude(), q.length),
            backward: take.mux(cycle.distance.is_negative(), q.backward),
            speed_limit: take.mux(at_least_1(cycle.speed), q.speed_limit),
            ramp_up: take.mux(at_least_1(cycle.acceleration_time), q.ramp_up),
            ramp_down: take.mux(at_least_1(cycle.deceleration_time), q.ramp_down),
            steady_scans: (steady_scans & result).mux(steady_all, steady_left),
            peak: (peak & result).mux(i.quotient.resize(multiplier), q.peak),
            total: (total & result).mux(i.quotient, q.total),
            level: weighs.mux(next_level, q.level),
            position: take.mux(cycle.from, moves.mux(moved, q.position)),
            valid: moves,
            ready: next_state.equals(WAITING),
            active: !next_state.is_zero(),
        };
        let net = Net {
            take,
            begins,
            drop,
            scans,
            compute,
            result,
            product_only: ramps | peak | total,
            multiplicand: scan.mux(length, first),
            multiplier: scan.mux(weight, total.mux(q.peak, second)),
            addend: scan.mux(i.remainder, steady_scans.mux(excess, 0)),
            divisor: scan.mux(q.total, speed_twice),
            times,
            length_twice,
            speed_twice,
            endless,
            share,
            prepares,
            excess,
            next_level,
            weight,
            left,
            next_phase,
            next_state,
        };
        (net, next)
    }
}
