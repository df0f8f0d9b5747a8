//! Control of the position pattern generator 14 (¶0010): what it multiplies and divides, and when.
//!
//! ```text
//!                              ┌───────────┐
//!  start, from, distance ─────▶│           ├──▶ position, valid
//!  speed, …time ──────────────▶│           ├──▶ ready, active
//!  advance, halt ────────────▶│ trapezoid │
//!  done, quotient, remainder ─▶│           ├──▶ compute, product_only, multiplicand,
//!                              └───────────┘    multiplier, addend, divisor
//! ```
//!
//! The speed is a `level` that goes up by Td in a scan of acceleration and down by Ta in one of
//! deceleration, so that Ta scans up and Td scans down both span Ta·Td. A scan weighs the levels
//! at its two ends, and makes that share of the distance of which all weights together are the
//! whole; what the division leaves goes into the next scan, so that nothing is lost.
//!
//! The speed has a fraction, so that a slow one is not rounded to whole counts a scan.
//!
//! Departures: the text says nothing of the discrete form. Every cycle ends exactly at its target;
//! a short one keeps its times and has a lower peak; times of 0 count as 1, a speed of 0 as the
//! least; `halt` ramps down from the present level, along the same line; a cycle has no more
//! than 2^(P−1) − 1 steady scans, and goes faster than V where those are too few.

use crate::kernel::Circuit;
use crate::logic::{Bit, Logic, Signed, Unsigned};
use crate::signals;

/// Names of the states: at rest, four steps of the preparation, between scans, in a scan.
pub const STATES: &[&str] = &[
    "idle", "ramps", "steady", "peak", "total", "waiting", "scan",
];
const RAMPS: u64 = 1;
const STEADY_SCANS: u64 = 2;
const PEAK: u64 = 3;
const TOTAL: u64 = 4;
const WAITING: u64 = 5;
const SCAN: u64 = 6;

/// Names of the phases.
pub const PHASES: &[&str] = &["accelerate", "steady", "decelerate"];
const STEADY: u64 = 1;
const DECELERATE: u64 = 2;

signals! {
    /// Ports in.
    pub struct In<L, const P: usize, const T: usize, const Q: usize> {
        /// Begins a cycle, unless one is under way; the ports down to `deceleration_time` are
        /// taken with it.
        pub start: L::Bit,
        /// Position at the start.
        pub from: L::I<P>,
        /// Distance to go; with 0 there is no cycle.
        pub distance: L::I<P>,
        /// V: greatest speed, in counts a scan with `T` bits of fraction; 0 counts as the least.
        pub speed: L::U<P>,
        /// Ta in scans; 0 counts as 1.
        pub acceleration_time: L::U<T>,
        /// Td in scans; 0 counts as 1.
        pub deceleration_time: L::U<T>,
        /// Makes the next position, if `ready`.
        pub advance: L::Bit,
        /// Ends the cycle: before its first scan at once, later by a ramp down.
        pub halt: L::Bit,
        /// The multiplier-divider has its result.
        pub done: L::Bit,
        /// Its quotient, or its product.
        pub quotient: L::U<Q>,
        /// Its remainder; 0 after a product.
        pub remainder: L::U<Q>,
    }
}

signals! {
    /// Flip-flops.
    pub struct Reg<L, const P: usize, const T: usize, const M: usize, const Q: usize> {
        /// What it does.
        state: L::U<3> as States(STATES) = 0,
        /// What the speed does in the next scan.
        phase: L::U<2> as States(PHASES) = 0,
        /// The multiplier-divider is to begin.
        request: L::Bit = 0,
        /// The multiplier-divider is at it, or shows `done`.
        under_way: L::Bit = 0,
        /// Length |Δ| of the cycle.
        length: L::U<P> = 0,
        /// The cycle goes down.
        backward: L::Bit = 0,
        /// V: greatest speed, with `T` bits of fraction.
        speed_limit: L::U<P> = 0,
        /// Ta in scans.
        ramp_up: L::U<T> = 0,
        /// Td in scans.
        ramp_down: L::U<T> = 0,
        /// Tc: scans of steady speed that are yet to come.
        steady_scans: L::U<P> = 0,
        /// Ta·Td: level of the steady speed.
        peak: L::U<M> = 0,
        /// W: all weights together.
        total: L::U<Q> = 0,
        /// Speed at the beginning of the next scan, in units of 2Δ/W a scan.
        level: L::U<M> as Analog = 0,
        /// x(n): the position.
        pub position: L::I<P> as Analog = 0,
        /// A new position stands at `position` from this tick on.
        pub valid: L::Bit = 0,
        /// `advance` is taken.
        pub ready: L::Bit = 0,
        /// A cycle is under way.
        pub active: L::Bit = 0,
    }
}

signals! {
    /// Nets.
    pub struct Net<L, const P: usize, const M: usize, const Q: usize> {
        /// A start is taken.
        take: L::Bit,
        /// It begins a cycle.
        begins: L::Bit,
        /// An abort ends the cycle with this tick.
        drop: L::Bit,
        /// A scan begins.
        scans: L::Bit,
        /// The multiplier-divider begins.
        pub compute: L::Bit,
        /// It has the result of what was requested last, and a cycle wants it.
        result: L::Bit,
        /// Only the product is wanted.
        pub product_only: L::Bit,
        /// First factor.
        pub multiplicand: L::U<Q>,
        /// Second factor.
        pub multiplier: L::U<M>,
        /// Added to the product.
        pub addend: L::U<Q>,
        /// What the sum is divided by.
        pub divisor: L::U<Q>,
        /// Ta + Td.
        times: L::U<Q>,
        /// 2|Δ|, with the fraction of V.
        length_twice: L::U<Q>,
        /// 2V.
        speed_twice: L::U<Q>,
        /// Tc would be 2^(P−1) or more.
        endless: L::Bit,
        /// How far the scan moves.
        share: L::I<P>,
        /// The next step of the preparation is asked for.
        prepares: L::Bit,
        /// 2|Δ| − V(Ta + Td) + 2V − 1, or 0 where the ramps alone are too long: Tc times 2V.
        excess: L::U<Q>,
        /// Speed at the end of the scan.
        next_level: L::U<M>,
        /// Share of the scan in the distance, in units of Δ/W.
        weight: L::U<M>,
        /// Scans of steady speed after this one.
        left: L::U<P>,
        /// What the speed does in the scan after this one.
        next_phase: L::U<2> as States(PHASES),
        /// What it does in the next tick.
        next_state: L::U<3> as States(STATES),
    }
}

/// Control of the position pattern generator 14, with positions of `P` bits and times of `T`;
/// M = 2T + 1 and Q = P + 2T + 2 are the words of its multiplier-divider.
#[derive(Debug, Clone, Default)]
pub struct Trapezoid<
    const P: usize = 32,
    const T: usize = 12,
    const M: usize = 25,
    const Q: usize = 58,
>;

impl<const P: usize, const T: usize, const M: usize, const Q: usize> Circuit
    for Trapezoid<P, T, M, Q>
{
    const NAME: &'static str = "trapezoid";
    const ABOUT: &'static str =
        "prepares a positioning cycle and makes its positions, scan by scan";
    type In<L: Logic> = In<L, P, T, Q>;
    type Reg<L: Logic> = Reg<L, P, T, M, Q>;
    type Net<L: Logic> = Net<L, P, M, Q>;

    fn comb<L: Logic>(&self, q: &Reg<L, P, T, M, Q>, i: &In<L, P, T, Q>) -> Net<L, P, M, Q> {
        const {
            assert!(T >= 1 && T < P, "times have fewer bits than positions");
            assert!(M == 2 * T + 1 && Q == P + 2 * T + 2 && Q <= 64);
        }
        let [ramps, steady_scans, peak, total, scan] =
            [RAMPS, STEADY_SCANS, PEAK, TOTAL, SCAN].map(|state| q.state.equals(state.into()));
        let (steady, decelerate) = (q.phase.bit(0), q.phase.bit(1));

        let take = i.start & !q.active;
        let begins = take & !i.distance.is_zero() & !i.halt;
        let drop = i.halt & q.active & q.level.is_zero() & !scan;
        let scans = i.advance & q.ready & !drop;
        let compute = q.request & (!q.under_way | i.done);
        let result = i.done & q.under_way & !q.request & q.active;

        let lowered = q.level - q.ramp_up.resize();
        let lowered = q.level.below(q.ramp_up.resize()).mux(0.into(), lowered);
        let raised = q.level + q.ramp_down.resize();
        let next_level = decelerate.mux(lowered, steady.mux(q.level, raised));
        let weight = q.level + next_level;
        let left = steady.mux(q.steady_scans - 1, q.steady_scans);
        let at_peak = next_level.equals(q.peak);
        let ends = decelerate | (at_peak & left.is_zero());

        let times = q.ramp_up.resize::<Q>() + q.ramp_down.resize();
        let scans_twice = times + q.steady_scans.resize().shift_left(1);
        let length_twice = q.length.resize::<Q>().shift_left(T + 1);
        let speed_twice = q.speed_limit.resize::<Q>().shift_left(1);
        let excess = length_twice - i.quotient + speed_twice - 1;
        let excess = i.quotient.below(length_twice).mux(excess, 0.into());

        let after = scan.mux(q.level.is_zero().mux(0.into(), WAITING.into()), q.state + 1);
        let goes_on = result.mux(after, q.state);
        Net {
            take,
            begins,
            drop,
            scans,
            compute,
            result,
            product_only: ramps | peak | total,
            times,
            length_twice,
            speed_twice,
            endless: !i.quotient.shift_right(P - 1).is_zero(),
            share: i.quotient.resize::<P>().signed(),
            prepares: begins | (result & !total & !scan),
            multiplicand: scan.mux(
                q.length.resize(),
                total.mux(
                    scans_twice,
                    peak.mux(q.ramp_up.resize(), q.speed_limit.resize()),
                ),
            ),
            multiplier: scan.mux(
                weight,
                total.mux(
                    q.peak,
                    peak.mux(q.ramp_down.resize(), ramps.mux(times.resize(), 0.into())),
                ),
            ),
            addend: scan.mux(i.remainder, steady_scans.mux(excess, 0.into())),
            divisor: scan.mux(q.total, speed_twice),
            excess,
            next_level,
            weight,
            left,
            next_phase: ends.mux(DECELERATE.into(), at_peak.mux(STEADY.into(), q.phase)),
            next_state: begins.mux(
                RAMPS.into(),
                drop.mux(0.into(), scans.mux(SCAN.into(), goes_on)),
            ),
        }
    }

    fn next<L: Logic>(
        &self,
        q: Reg<L, P, T, M, Q>,
        w: &Net<L, P, M, Q>,
        i: &In<L, P, T, Q>,
    ) -> Reg<L, P, T, M, Q> {
        let [steady_scans, peak, total, scan] =
            [STEADY_SCANS, PEAK, TOTAL, SCAN].map(|state| q.state.equals(state.into()));
        let speed = i.speed.is_zero().mux(1.into(), i.speed);
        let times = [i.acceleration_time, i.deceleration_time];
        let [up, down] = times.map(|time| time.is_zero().mux(1.into(), time));
        let weighs = scan & w.compute;
        let moves = scan & w.result;
        let moved = q.backward.mux(q.position - w.share, q.position + w.share);
        let phase = weighs.mux(w.next_phase, q.phase);
        let phase = (i.halt & q.active).mux(DECELERATE.into(), phase);
        let steady_left = weighs.mux(w.left, q.steady_scans);
        let none: L::U<P> = 0.into();
        let most = (none - 1).shift_right(1);
        let steady_all = w.endless.mux(most, i.quotient.resize());
        Reg {
            state: w.next_state,
            phase: w.begins.mux(0.into(), phase),
            request: !w.drop & (w.prepares | w.scans | (q.request & !w.compute)),
            under_way: w.compute | (q.under_way & !i.done),
            length: w.take.mux(i.distance.magnitude(), q.length),
            backward: w.take.mux(i.distance.is_negative(), q.backward),
            speed_limit: w.take.mux(speed, q.speed_limit),
            ramp_up: w.take.mux(up, q.ramp_up),
            ramp_down: w.take.mux(down, q.ramp_down),
            steady_scans: (steady_scans & w.result).mux(steady_all, steady_left),
            peak: (peak & w.result).mux(i.quotient.resize(), q.peak),
            total: (total & w.result).mux(i.quotient, q.total),
            level: weighs.mux(w.next_level, q.level),
            position: w.take.mux(i.from, moves.mux(moved, q.position)),
            valid: moves,
            ready: w.next_state.equals(WAITING.into()),
            active: !w.next_state.is_zero(),
        }
    }
}
